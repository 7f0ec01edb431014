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

/// Looks at 3 x `count` coordinates, column by column: is each finite and at most `largest` in size? Each is read once,
/// so that what is told of it holds even if another thread writes to it.
PositionProblem find_position_problem(const double* positions, std::size_t count, double largest);

}  // namespace tact::narrowphase
