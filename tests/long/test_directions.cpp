// Contact directions and distances of hostile pairs of hulls against the heights of their Minkowski difference. Not
// part of the ordinary tests: how many pairs is read from the environment.
//   TACT_LONG_HULL_PAIRS  5000 if not set
//   TACT_LONG_SEED        which pairs, 1 if not set
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <string>

#include "tests/support/environment.h"
#include "tests/support/hostile_hulls.h"

namespace tact::tests {
namespace {

TEST(DirectionsLong, HostilePairsEndAtLocalMinima) {
  const std::uint64_t pairs = from_environment("TACT_LONG_HULL_PAIRS", 5'000);
  const std::uint64_t seed = from_environment("TACT_LONG_SEED", 1) << 40;
  std::int64_t directions = 0;
  for (std::uint64_t i = 0; i < pairs; ++i) {
    const std::string problem = problem_of_directions(hostile_hull_pair(seed + i), directions);
    EXPECT_EQ(problem, "") << "pair " << i;
  }
  std::printf("%llu pairs, %lld directions\n", static_cast<unsigned long long>(pairs),
              static_cast<long long>(directions));
  EXPECT_GT(directions, static_cast<std::int64_t>(pairs));
}

// Not all: see narrowphase/README.md.
TEST(DirectionsLong, NearlyAllOfAllSizesEndAtLocalMinima) {
  const std::uint64_t pairs = from_environment("TACT_LONG_HULL_PAIRS", 5'000);
  const std::uint64_t seed = from_environment("TACT_LONG_SEED", 1) << 40;
  std::int64_t directions = 0;
  std::uint64_t problems = 0;
  for (std::uint64_t i = 0; i < pairs; ++i) {
    const std::string problem = problem_of_directions(hull_pair_of_all_sizes(seed + i), directions);
    if (!problem.empty()) std::printf("pair %llu: %s\n", static_cast<unsigned long long>(i), problem.c_str());
    problems += problem.empty() ? 0 : 1;
  }
  EXPECT_LE(problems, 2 + pairs / 20'000);
  EXPECT_GT(directions, static_cast<std::int64_t>(pairs));
}

TEST(DistancesLong, HostilePairsAreAsFarApartAsSaid) {
  const std::uint64_t pairs = from_environment("TACT_LONG_HULL_PAIRS", 5'000);
  const std::uint64_t seed = from_environment("TACT_LONG_SEED", 1) << 40;
  DistanceCounts counts;
  for (std::uint64_t i = 0; i < pairs; ++i) {
    const HullPair pair = hostile_hull_pair(seed + i);
    for (const std::vector<Vec3>* b : {&pair.b, &pair.b_before, &pair.b_parted}) {
      EXPECT_EQ(problem_of_distance(pair.a, *b, counts), "") << pair.kinds << ", pair " << i;
    }
  }
  std::printf("%lld apart, %lld touching, %lld overlapping\n", static_cast<long long>(counts.apart),
              static_cast<long long>(counts.touching), static_cast<long long>(counts.overlapping));
}

}  // namespace
}  // namespace tact::tests
