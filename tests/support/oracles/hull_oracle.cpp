#include "tests/support/oracles/hull_oracle.h"

#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include "tests/support/oracles/exact_numbers.h"

namespace tact::tests {

// A common point is a sum of vertices of each, so weighted: no weight is negative, and those of a hull sum to 1.
bool hulls_meet_by_oracle(std::span<const base::Vec3> a, std::span<const base::Vec3> b) {
  CGAL::Quadratic_program<double> program(CGAL::EQUAL, true, 0.0, false, 0.0);
  int column = 0;
  const auto add = [&](const base::Vec3& p, double sign, int row_of_sum) {
    for (int axis = 0; axis < 3; ++axis) program.set_a(column, axis, sign * p[axis]);
    program.set_a(column, row_of_sum, 1.0);
    ++column;
  };
  for (const base::Vec3& p : a) add(p, 1.0, 3);
  for (const base::Vec3& p : b) add(p, -1.0, 4);
  program.set_b(3, 1.0);
  program.set_b(4, 1.0);
  CGAL::Quadratic_program_options options;
  options.set_pricing_strategy(CGAL::QP_BLAND);  // the default chooses by doubles, which vanish where bodies are tiny
  return !CGAL::solve_nonnegative_linear_program(program, ExactFloat(), options).is_infeasible();
}

}  // namespace tact::tests
