#include "narrowphase/hull/kdop.h"

#include <cassert>
#include <cstdlib>
#include <numbers>

namespace tact::narrowphase {

DiagonalBounds kdop_of(const ClusteredMesh& mesh) {
  return kernels().diagonal_bounds(mesh.points(), mesh.vertex_count());
}

PartingDiagonal parting_diagonal(const DiagonalBounds& a, const DiagonalBounds& b) {
  double widest = 0.0;
  int parting = 0;
  for (int k = 0; k < kDiagonals; ++k) {
    const double b_above = b.lower[k] - a.upper[k], a_above = a.lower[k] - b.upper[k];
    const bool along = b_above >= a_above;
    const double gap = along ? b_above : a_above;
    parting = gap > widest ? (along ? 1 + k : -1 - k) : parting;
    widest = gap > widest ? gap : widest;
  }
  return static_cast<PartingDiagonal>(parting);
}

base::Vec3 direction_of(PartingDiagonal parting) {
  assert(parting != 0 && std::abs(parting) <= kDiagonals);
  const int k = std::abs(parting) - 1, axis = k % 3;
  constexpr double r = 0.5 * std::numbers::sqrt2;
  base::Vec3 n;
  n[(axis + 1) % 3] = r;
  n[(axis + 2) % 3] = k < 3 ? r : -r;
  return parting > 0 ? n : -n;
}

}  // namespace tact::narrowphase
