// Verdicts, contact directions and distances of hostile pairs of hulls against linear programs and the heights of their
// Minkowski difference. Not part of the ordinary tests: how many pairs is read from the environment.
//   TACT_LONG_HULL_PAIRS  5000 if not set
//   TACT_LONG_SEED        which pairs, 1 if not set
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <string>

#include "narrowphase/hull/hull_verdict.h"
#include "tests/support/environment/environment.h"
#include "tests/support/generators/hostile_hulls.h"
#include "tests/support/generators/touching_hulls.h"
#include "tests/support/inside/mesh_through.h"
#include "tests/support/oracles/hull_oracle.h"
#include "tests/support/oracles/minkowski_oracle.h"

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

TEST(VerdictsLong, TouchingHullsAreAsALinearProgramSays) {
  using namespace narrowphase;
  const std::uint64_t pairs = from_environment("TACT_LONG_HULL_PAIRS", 5'000);
  const std::uint64_t seed = from_environment("TACT_LONG_SEED", 1) << 40;
  std::int64_t meeting = 0, parted = 0;
  for (std::uint64_t i = 0; i < pairs; ++i) {
    const TouchingHulls pair = touching_hulls(seed + i);
    const bool meet = hulls_meet_by_oracle(pair.a, pair.b);
    const ClusteredMesh a = mesh_through(pair.a), b = mesh_through(pair.b);
    for (const bool swapped : {false, true}) {
      const MinkowskiDifference m(swapped ? b : a, swapped ? a : b);
      const GjkResult near = gjk(m, {}, {}, {});
      const bool is_certain = near.status == GjkStatus::apart || near.status == GjkStatus::overlapping;
      std::vector<std::int32_t> scratch;
      const bool apart = is_certain ? near.status == GjkStatus::apart : hull_verdict(m, near.simplex, scratch).apart;
      EXPECT_EQ(apart, !meet) << pair.kind << ", pair " << i << (swapped ? ", swapped" : "");
      if (!is_certain) ++(apart ? parted : meeting);
    }
  }
  std::printf("%llu pairs; left to integers: %lld meet, %lld are apart\n", static_cast<unsigned long long>(pairs),
              static_cast<long long>(meeting), static_cast<long long>(parted));
  EXPECT_GT(meeting, static_cast<std::int64_t>(pairs / 5));
  EXPECT_GT(parted, static_cast<std::int64_t>(pairs / 10));
}

}  // namespace
}  // namespace tact::tests
