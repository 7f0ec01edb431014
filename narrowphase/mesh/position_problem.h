// Coordinates that a mesh cannot take.
#pragma once

#include <cstddef>

namespace tact::narrowphase {

/// The first coordinate that cannot be taken, if any.
struct PositionProblem {
  enum Kind { none, non_finite, out_of_range } kind = none;
  int source_vertex = -1;
  int axis = -1;
  double value = 0.0;
};

/// Finds the first of 3 x `count` coordinates, column by column, that is not finite or larger than `largest`. Each is
/// read once, so that the report holds even if another thread writes to it.
PositionProblem find_position_problem(const double* positions, std::size_t count, double largest);

}  // namespace tact::narrowphase
