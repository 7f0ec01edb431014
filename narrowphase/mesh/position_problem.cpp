#include "narrowphase/mesh/position_problem.h"

#include <algorithm>
#include <cmath>

namespace tact::narrowphase {

PositionProblem find_position_problem(const double* positions, std::size_t count, double largest) {
  const auto is_good = [&](double x) { return std::abs(x) <= largest; };
  const double *end = positions + 3 * count, *bad = std::find_if_not(positions, end, is_good);
  if (bad == end) return {};
  const auto at = bad - positions;
  const auto kind = std::isfinite(*bad) ? PositionProblem::out_of_range : PositionProblem::non_finite;
  return {kind, static_cast<int>(at / 3), static_cast<int>(at % 3)};
}

}  // namespace tact::narrowphase
