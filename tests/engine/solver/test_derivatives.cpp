// Gaps, barriers and their derivatives against differences in 50 digits; more of them in tests/long.
#include <gtest/gtest.h>

#include <array>

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
