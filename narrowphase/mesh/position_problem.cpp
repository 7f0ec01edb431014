#include "narrowphase/mesh/position_problem.h"

#include <cmath>

namespace tact::narrowphase {

PositionProblem find_position_problem(const double* positions, std::size_t count, double largest) {
  for (std::size_t i = 0; i < 3 * count; ++i) {
    const double x = positions[i];
    if (std::abs(x) <= largest) continue;
    const auto kind = std::isfinite(x) ? PositionProblem::out_of_range : PositionProblem::non_finite;
    return {kind, static_cast<int>(i / 3), static_cast<int>(i % 3), x};
  }
  return {};
}

}  // namespace tact::narrowphase
