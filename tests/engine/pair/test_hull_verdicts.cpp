// Hulls that touch or nearly do, in a world: what one order of the bodies says the other says, and it is what a linear
// program in exact numbers says; whatever the last step was.
#include <gtest/gtest.h>

#include <array>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/touching_hulls.h"
#include "tests/support/oracles/hull_oracle.h"

namespace tact::tests {
namespace {

Mesh facets_through(std::span<const Vec3> points) {
  MeshBuilder builder;
  for (const Vec3& p : points) builder.vertex(p);
  const int count = builder.vertex_count();
  for (int i = 0; i < count; ++i) builder.facet(i, (i + 1) % count, (i + 2) % count);
  return builder.mesh();
}

// Are the hulls in contact after each of three steps: B where it was before, where it is now, and there again? And the
// depth at last, 0 where they are not.
struct Played {
  std::array<bool, 3> contact;
  double depth = 0.0;
};

Played play(const TouchingHulls& pair, const Settings& settings, bool a_comes_first) {
  const Mesh a = facets_through(pair.a), before = facets_through(pair.b_before), now = facets_through(pair.b);
  World world(settings);
  const std::vector<BodyId> ids =
      a_comes_first ? add_bodies(world, std::array{a, before}) : add_bodies(world, std::array{before, a});
  const BodyId b = ids[a_comes_first ? 1 : 0];
  Played played{};
  for (std::size_t step = 0; step < 3; ++step) {
    if (step > 0) world.set_positions(b, now.positions);
    if (step > 1) world.set_positions(ids[a_comes_first ? 0 : 1], a.positions);
    const Report& report = world.detect();
    played.contact[step] = !report.contacts().empty();
    played.depth = played.contact[step] ? report.contacts()[0].depth : 0.0;
  }
  return played;
}

TEST(HullVerdicts, AreThoseOfALinearProgramInEitherOrder) {
  int meeting = 0, parted = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const TouchingHulls pair = touching_hulls(seed);
    const bool before = hulls_meet_by_oracle(pair.a, pair.b_before), now = hulls_meet_by_oracle(pair.a, pair.b);
    const std::array<bool, 3> expected{before, now, now};
    for (const DirectionPolicy policy : {DirectionPolicy::carried, DirectionPolicy::smallest}) {
      const Settings settings{.accuracy = Accuracy::hulls, .direction = policy};
      const Played one = play(pair, settings, true), other = play(pair, settings, false);
      ASSERT_EQ(one.contact, expected) << pair.kind << ", seed " << seed;
      ASSERT_EQ(other.contact, expected) << pair.kind << ", seed " << seed;
    }
    ++(now ? meeting : parted);
  }
  EXPECT_GT(meeting, 200);
  EXPECT_GT(parted, 100);
}

// Margins look at the distance: hulls that are apart by less than rounding are near, whoever came first.
TEST(HullVerdicts, HullsApartByLessThanRoundingAreNearWithMargins) {
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const TouchingHulls pair{"",
                           square,
                           {{0.25, 0.5, 0x1p-100}, {0.5, 0.5, 1}, {0.5, 0.25, 1}},
                           {{0.25, 0.5, 1}, {0.5, 0.5, 2}, {0.5, 0.25, 2}}};
  for (const bool a_comes_first : {true, false}) {
    EXPECT_EQ(play(pair, {.accuracy = Accuracy::hulls}, a_comes_first).contact, (std::array{false, false, false}));
    World world({.accuracy = Accuracy::hulls});
    const std::vector<BodyId> ids = add_bodies(world, std::array{facets_through(a_comes_first ? pair.a : pair.b),
                                                                 facets_through(a_comes_first ? pair.b : pair.a)});
    world.set_margin(ids[0], 1e-3);
    const Report& report = world.detect();
    ASSERT_EQ(report.contacts().size(), 1u);
    EXPECT_LE(report.contacts()[0].depth, 0.0);
    EXPECT_GE(report.contacts()[0].depth, -1e-15);
    EXPECT_NEAR(report.contacts()[0].direction.z(), a_comes_first ? 1.0 : -1.0, 1e-15);
  }
}

}  // namespace
}  // namespace tact::tests
