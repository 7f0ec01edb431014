// Bodies that have crossed, at once or by steps of any size: each crossing has points, and whoever moves along them
// comes out. Thin bodies thrown at each other without detect_motion(). How many is read from the environment.
//   TACT_LONG_CROSSINGS  pairs of each kind, 8 if not set; some hundred a second
//   TACT_LONG_THROWS     of each kind, 10 if not set; some ten a second
//   TACT_LONG_SEED       which, 1 if not set
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "tests/support/checks/parting.h"
#include "tests/support/environment/environment.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

struct CrossingKind {
  const char* name;
  Mesh (*make)(Random&);
  bool is_convex;
};

Mesh ell(Random&) {
  const Mesh parts[] = {box({-0.5, -0.5, -0.03}, {0.5, 0.5, 0.03}), box({0.44, -0.5, 0.03}, {0.5, 0.5, 0.6})};
  return merged(parts);
}

const std::vector<CrossingKind> kKinds{
    {"plate",
     [](Random& r) {
       return centered_box({0.5, 0.5, r.uniform(0.01, 0.05)});
     },
     true},
    {"fine plate",
     [](Random& r) {
       return gridded_box({-0.5, -0.5, -0.03}, {0.5, 0.5, 0.03}, 2 + r.below(3));
     },
     true},
    {"ribbon",
     [](Random& r) {
       return centered_box({0.8, 0.15, r.uniform(0.005, 0.02)});
     },
     true},
    {"rod",
     [](Random& r) {
       return centered_box({0.8, r.uniform(0.03, 0.08), r.uniform(0.03, 0.08)});
     },
     true},
    {"tetrahedron", [](Random& r) { return spike(r.uniform(0.3, 0.9) * r.direction(), 0.5); }, true},
    {"two plates at a right angle", ell, false},
    {"hull", [](Random& r) { return random_hull(6 + r.below(20), r.bits() >> 32); }, true},
    {"blob", [](Random& r) { return blob(2, 0.6, 0.3, r.bits() >> 32); }, false},
    {"torus", [](Random& r) { return torus(16, 8, 0.5, r.uniform(0.05, 0.2)); }, false},
};

struct CrossingCounts {
  int crossings = 0, without_point = 0, not_apart = 0, long_ways = 0, most_passes = 0;
};

// One pair: b somewhere in a, at once or by some steps of any size, with or without margins.
void count_crossing(const CrossingKind& first, const CrossingKind& second, Random& random, CrossingCounts& counts) {
  const Mesh a = first.make(random);
  const Vec3 place = 0.7 * random.in_ball();  // compilers evaluate arguments in orders of their own
  const Rotation turn = random.rotation();
  const Mesh b = translated(rotated(second.make(random), turn), place);
  PartingInput input{.margin = random.chance(0.5) ? 0.0 : 0.01, .most_passes = 40};
  if (random.chance(0.5)) {
    input.steps = 1 << random.below(7);
    input.came_by = 2.5 * random.direction();
  }
  const Parting parting = part_by_points(a, b, input);
  if (parting.passes == 0) return;
  ++counts.crossings;
  counts.without_point += parting.without_point > 0 ? 1 : 0;
  counts.not_apart += parting.passes == input.most_passes ? 1 : 0;
  counts.most_passes = std::max(counts.most_passes, parting.passes);
  if (first.is_convex && second.is_convex && input.steps == 0)
    counts.long_ways += parting.way > 1.5 * least_overlap(a, b).depth + 1e-6 ? 1 : 0;
}

TEST(CrossingsLong, OfEveryKindHavePointsThatLeadApart) {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    for (std::size_t k = i; k < kKinds.size(); ++k) {
      CrossingCounts counts;
      for_seeds("TACT_LONG_CROSSINGS", 8, [&](std::uint64_t seed) {
        Random random(seed + 1000003 * (i * kKinds.size() + k));
        count_crossing(kKinds[i], kKinds[k], random, counts);
      });
      std::printf(
          "%s and %s: %d cross, %d without a point, %d not apart, in %d passes at most, %d fresh ways longer than 1.5 "
          "of the least\n",
          kKinds[i].name, kKinds[k].name, counts.crossings, counts.without_point, counts.not_apart, counts.most_passes,
          counts.long_ways);
      EXPECT_EQ(counts.without_point, 0) << kKinds[i].name << " and " << kKinds[k].name;
      // Bodies that hold each other, a ring and what goes through it say, cannot be moved apart: of two rings one
      // in 30. Of convex ones 2 of 42,391 went to and fro for 40 passes.
      const bool may_hold = !kKinds[i].is_convex || !kKinds[k].is_convex;
      EXPECT_LE(counts.not_apart, counts.crossings / (may_hold ? 20 : 5000) + 1)
          << kKinds[i].name << " and " << kKinds[k].name;
      EXPECT_LE(counts.long_ways, counts.crossings / 10 + 1) << kKinds[i].name << " and " << kKinds[k].name;
    }
  }
}

struct ThrownCounts {
  int met = 0, stuck = 0, other_side = 0, longest = 0;
};

// At 20 m/s relative to each other, in steps of so many of the least thickness.
ThrownCounts throw_thin_bodies(double thicknesses, bool with_margins) {
  ThrownCounts counts;
  for_seeds("TACT_LONG_THROWS", 10, [&](std::uint64_t seed) {
    Random random(seed);
    const Mesh thin[] = {centered_box({0.5, 0.5, 0.025}), centered_box({0.6, 0.04, 0.04}),
                         centered_box({0.6, 0.2, 0.025})};
    constexpr double kThickness[] = {0.05, 0.08, 0.05};
    const int first = random.below(3), second = random.below(3);
    const double length = thicknesses * std::min(kThickness[first], kThickness[second]);
    const Vec3 way = random.direction();
    const Mesh a = rotated(thin[first], random.rotation());
    const auto approach = static_cast<int>(1.6 / length) + 1;
    const Mesh b = translated(rotated(thin[second], random.rotation()),
                              0.2 * random.in_ball() - (approach + random.uniform()) * length * way);
    const Thrown thrown = throw_at(a, b, length * way, approach + 40, with_margins ? 0.5 * length : 0.0);
    counts.met += thrown.met ? 1 : 0;
    counts.stuck += thrown.longest_crossing > 10 ? 1 : 0;
    counts.other_side += thrown.other_side ? 1 : 0;
    counts.longest = std::max(counts.longest, thrown.longest_crossing);
  });
  std::printf(
      "steps of %.2g thicknesses, %s margins: %d met, %d longer than ten steps in each other, at most %d, %d on the "
      "other side\n",
      thicknesses, with_margins ? "with" : "without", counts.met, counts.stuck, counts.longest, counts.other_side);
  return counts;
}

TEST(ThrownLong, ThinBodiesComeApartAndStayOnTheirSide) {
  for (const bool with_margins : {false, true}) {
    const ThrownCounts small = throw_thin_bodies(0.5, with_margins), large = throw_thin_bodies(5.0, with_margins);
    EXPECT_GT(small.met, 0);
    EXPECT_EQ(small.stuck, 0);
    EXPECT_EQ(small.other_side, 0);
    EXPECT_EQ(large.stuck, 0);
  }
}

}  // namespace
}  // namespace tact::tests
