#include "narrowphase/hull/kdop.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace tact::narrowphase {

Kdop kdop_of(const ClusteredMesh& mesh) { return kernels().kdop(mesh.points(), mesh.vertex_count()); }

namespace {

// The largest coordinate of a body along any diagonal.
double size_of(const Kdop& kdop) {
  double size = 0.0;
  for (int k = 0; k < kDiagonals; ++k) size = std::max({size, std::abs(kdop.lower[k]), std::abs(kdop.upper[k])});
  return size;
}

// True if a gap along a diagonal shows that two bodies are farther apart than `reach`, metres. A diagonal is a sum of
// two coordinates, so a metre along it is the root of two.
bool is_beyond(double gap, double reach, const Kdop& a, const Kdop& b) {
  if (reach == 0.0) return gap > 0.0;
  const double least = std::numbers::sqrt2 * reach;
  if (!(gap > least)) return false;
  constexpr double kRoundings = 0x1p-42;
  return gap - least > kRoundings * (least + size_of(a) + size_of(b)) + std::numeric_limits<double>::min();
}

}  // namespace

bool separates(SeparatingDiagonal diagonal, const Kdop& a, const Kdop& b, double reach) {
  if (diagonal == 0) return false;
  const int k = std::abs(diagonal) - 1;
  return is_beyond(diagonal > 0 ? b.lower[k] - a.upper[k] : a.lower[k] - b.upper[k], reach, a, b);
}

SeparatingDiagonal separating_diagonal(const Kdop& a, const Kdop& b, double reach) {
  double widest = 0.0;
  int separating = 0;
  for (int k = 0; k < kDiagonals; ++k) {
    const double b_above = b.lower[k] - a.upper[k], a_above = a.lower[k] - b.upper[k];
    const bool along = b_above >= a_above;
    const double gap = along ? b_above : a_above;
    separating = gap > widest ? (along ? 1 + k : -1 - k) : separating;
    widest = gap > widest ? gap : widest;
  }
  return static_cast<SeparatingDiagonal>(is_beyond(widest, reach, a, b) ? separating : 0);
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
