// Derivatives of tact/solver.h against differences in 50 digits. Not part of the ordinary tests: how many stencils is
// read from the environment.
//   TACT_LONG_STENCILS  20 if not set; some hundred a second
//   TACT_LONG_SEED      which, 1 if not set
#include <gtest/gtest.h>

#include "tests/support/environment/environment.h"
#include "tests/support/oracles/stencil_oracle.h"

namespace tact::tests {
namespace {

TEST(LongSolver, DerivativesAreThoseOfDifferencesInFiftyDigits) {
  for_seeds("TACT_LONG_STENCILS", 20,
            [](std::uint64_t seed) { EXPECT_EQ(wrong_terms(random_stencil(seed)), "") << "seed " << seed; });
}

}  // namespace
}  // namespace tact::tests
