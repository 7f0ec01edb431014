// Gaps, barriers and their derivatives against differences in 50 digits; more of them in tests/long.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tests/support/oracles/stencil_oracle.h"

namespace tact::tests {
namespace {

TEST(SolverDerivatives, AreThoseOfDifferencesInFiftyDigits) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) EXPECT_EQ(wrong_terms(random_stencil(seed)), "") << "seed " << seed;
}

// Parallel to a millionth: a plain cross product of rounded edges leaves weights wrong by 1e-5.
TEST(SolverDerivatives, OfThinStencilsAreThoseOfDifferencesInFiftyDigits) {
  for (const std::uint64_t seed : std::array<std::uint64_t, 3>{30064771351, 30064772639, 30064773375})
    EXPECT_EQ(wrong_terms(random_stencil(seed)), "") << "seed " << seed;
}

// Edges that touch and lie along each other, or nearly: a factor of zero takes no barrier away.
TEST(SolverDerivatives, OfBarriersAtATouchAreInfinite) {
  const solver::Stencil edges{.kind = solver::StencilKind::edge_edge,
                              .vertices = {0, 1, 2, 3},
                              .weights = Eigen::Vector4d(-0.5, -0.5, 0.5, 0.5),
                              .normal = Eigen::Vector3d::UnitZ()};
  solver::Corners x, rest;
  x << 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0;
  rest << 0, 1, 0.5, 0.5, 0, 0, -1, 1, 0, 0, 1, 1;
  for (const double turned : {0.0, 1e-3}) {
    x(1, 3) = turned;
    const solver::Term term = solver::barrier_term(edges, x, 0.1, solver::mollifier_threshold(rest));
    EXPECT_EQ(term.value, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(term.gradient.allFinite() && term.hessian.allFinite());
  }
}

// A formula that is wrong by a millionth is found.
TEST(SolverDerivatives, OfAnotherReachAreFound) {
  const PlacedStencil right = random_stencil(1);
  PlacedStencil wrong = right;
  wrong.stencil.gap = -1.0;  // the other sign of a vertex and a vertex
  wrong.stencil.normal = -wrong.stencil.normal;
  EXPECT_NE(wrong_terms(wrong), "");
}

}  // namespace
}  // namespace tact::tests
