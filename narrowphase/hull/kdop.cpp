#include "narrowphase/hull/kdop.h"

#include <cassert>
#include <cstdlib>
#include <numbers>

namespace tact::narrowphase {

Kdop kdop_of(const ClusteredMesh& mesh) { return kernels().kdop(mesh.points(), mesh.vertex_count()); }

SeparatingDiagonal separating_diagonal(const Kdop& a, const Kdop& b) {
  double widest = 0.0;
  int separating = 0;
  for (int k = 0; k < kDiagonals; ++k) {
    const double b_above = b.lower[k] - a.upper[k], a_above = a.lower[k] - b.upper[k];
    const bool along = b_above >= a_above;
    const double gap = along ? b_above : a_above;
    separating = gap > widest ? (along ? 1 + k : -1 - k) : separating;
    widest = gap > widest ? gap : widest;
  }
  return static_cast<SeparatingDiagonal>(separating);
}

base::Vec3 direction_of(SeparatingDiagonal diagonal) {
  assert(diagonal != 0 && std::abs(diagonal) <= kDiagonals);
  const int k = std::abs(diagonal) - 1, axis = k % 3;
  constexpr double r = 0.5 * std::numbers::sqrt2;
  base::Vec3 n;
  n[(axis + 1) % 3] = r;
  n[(axis + 2) % 3] = k < 3 ? r : -r;
  return diagonal > 0 ? n : -n;
}

}  // namespace tact::narrowphase
