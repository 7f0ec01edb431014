// Bodies that lose the shape in which their facets were grouped: the groups are made anew, and nothing else changes.
#include <gtest/gtest.h>

#include <array>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

constexpr int kLongEnough = 40;  // moves in which a body is looked at once

Mesh shifted(const Mesh& mesh, int step) { return translated(mesh, {0.0, 0.0, 0x1p-20 * step}); }

// Two bodies of which the first is not what it was when it was added.
class Regrouping : public ::testing::Test {
 protected:
  void add(World& world, const Mesh& first) {
    add_bodies(world, std::array{first, b_});
    world.detect();
  }
  const Report& move(World& world, int step) {
    world.set_positions(world.bodies()[0], shifted(a_, step).positions);
    return world.detect();
  }

  Mesh a_ = blob(4, 1.0, 0.2, 1);
  Mesh b_ = translated(blob(4, 1.0, 0.2, 2), {1.4, 0.3, 0.2});
};

TEST_F(Regrouping, GivesBackWhatWasLost) {
  World scrambled_first({.threads = 1}), sound({.threads = 1});
  add(scrambled_first, scrambled(a_, 3));
  add(sound, a_);
  std::int64_t regrouped = 0, opened_before = 0, opened_after = 0;
  for (int step = 1; step <= kLongEnough; ++step) {
    const Report& report = move(scrambled_first, step);
    const Report& expected = move(sound, step);
    ASSERT_TRUE(
        same_meeting_bodies(meeting_bodies(expected, sound.bodies()), meeting_bodies(report, scrambled_first.bodies())))
        << "step " << step;
    EXPECT_EQ(expected.stats().regrouped_bodies, 0);
    regrouped += report.stats().regrouped_bodies;
    (regrouped == 0 ? opened_before : opened_after) = report.stats().opened_facets;
    if (regrouped > 0) {
      EXPECT_LE(opened_after, 2 * expected.stats().opened_facets) << "step " << step;
    }
  }
  EXPECT_EQ(regrouped, 1);
  EXPECT_GT(opened_before, 2 * opened_after);
}

TEST_F(Regrouping, ABodyThatWasOnePointWhenItWasAddedIsGrouped) {
  Mesh point = a_;
  point.positions.setZero();
  World world({.threads = 1});
  add(world, point);
  std::int64_t regrouped = 0;
  for (int step = 1; step <= kLongEnough; ++step) regrouped += move(world, step).stats().regrouped_bodies;
  EXPECT_EQ(regrouped, 1);
  EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(std::array{shifted(a_, kLongEnough), b_}),
                                  meeting_bodies(world.detect(), world.bodies())));
}

// The vertices that a pair remembers have other numbers afterwards.
TEST_F(Regrouping, PairsRememberWhatTheyKnew) {
  for (const DirectionPolicy direction : {DirectionPolicy::carried, DirectionPolicy::smallest}) {
    World world({.threads = 1, .direction = direction});
    add(world, scrambled(a_, 3));
    std::int64_t regrouped = 0;
    for (int step = 1; step <= kLongEnough; ++step) {
      const StepStats stats = move(world, step).stats();
      regrouped += stats.regrouped_bodies;
      if (step == 1) continue;
      EXPECT_EQ(stats.still_overlapping_pairs, 1) << "step " << step;
      EXPECT_EQ(stats.direction_iterations, 0) << "step " << step;
    }
    EXPECT_EQ(regrouped, 1);
  }
}

TEST_F(Regrouping, PairsThatAreApartRememberTheirPlane) {
  a_ = icosphere(5);  // so large that diagonals are not asked
  b_ = translated(a_, {1.8, 0.9, 0.4});
  World world({.threads = 1});
  add(world, scrambled(a_, 3));
  std::int64_t regrouped = 0;
  for (int step = 1; step <= kLongEnough; ++step) {
    const StepStats stats = move(world, step).stats();
    EXPECT_EQ(stats.still_separated_pairs, 1) << "step " << step;
    regrouped += stats.regrouped_bodies;
  }
  EXPECT_EQ(regrouped, 1);
}

TEST_F(Regrouping, IsTheSameForAnyNumberOfThreads) {
  World one({.threads = 1}), two({.threads = 2});
  add(one, scrambled(a_, 3));
  add(two, scrambled(a_, 3));
  for (int step = 1; step <= kLongEnough; ++step) {
    const std::uint64_t hash = move(one, step).hash();
    ASSERT_EQ(hash, move(two, step).hash()) << "step " << step;
    ASSERT_EQ(one.detect().stats().regrouped_bodies, 0);  // nothing moved
  }
}

TEST_F(Regrouping, BodiesThatGrowStretchOrFlattenAreLeftAlone) {
  World world({.threads = 1});
  add(world, a_);
  for (const Vec3 factors : {Vec3{1.2, 1.2, 1.2}, Vec3{0.8, 0.8, 0.8}, Vec3{1.05, 1.0, 1.0}, Vec3{1.0, 1.0, 0.9}}) {
    Mesh mesh = a_;
    for (int step = 1; step <= kLongEnough; ++step) {
      mesh = stretched(mesh, factors);
      world.set_positions(world.bodies()[0], mesh.positions);
      EXPECT_EQ(world.detect().stats().regrouped_bodies, 0);
    }
  }
}

TEST_F(Regrouping, ABodyThatIsRemovedInTimeIsForgotten) {
  World world({.threads = 1});
  add(world, scrambled(a_, 3));
  for (int step = 1; step <= kLongEnough; ++step) world.set_positions(world.bodies()[0], shifted(a_, step).positions);
  world.remove_body(world.bodies()[0]);
  EXPECT_EQ(world.detect().stats().regrouped_bodies, 0);
  world.add_body({.positions = a_.positions, .facets = a_.facets});
  const Report& report = world.detect();
  EXPECT_EQ(report.stats().regrouped_bodies, 0);
  EXPECT_TRUE(
      same_meeting_bodies(meeting_bodies_by_oracle(std::array{a_, b_}), meeting_bodies(report, world.bodies())));
}

TEST_F(Regrouping, ABodyThatIsOnlyMadeWorseIsLeftAlone) {
  World world({.threads = 1});
  add(world, a_);
  a_ = scrambled(a_, 3);
  for (int step = 1; step <= 3 * kLongEnough; ++step) EXPECT_EQ(move(world, step).stats().regrouped_bodies, 0);
}

TEST_F(Regrouping, ABodyInTheSlotOfALargerOneIsNotTakenForIt) {
  World world({.threads = 1});
  add(world, a_);
  world.remove_body(world.bodies()[0]);
  const Mesh small = blob(2, 1.0, 0.2, 1);
  const BodyId id = world.add_body({.positions = scrambled(small, 3).positions, .facets = small.facets});
  for (int step = 1; step <= kLongEnough; ++step) world.set_positions(id, shifted(small, step).positions);
  const Report& report = world.detect();
  EXPECT_EQ(report.stats().regrouped_bodies, 1);
  EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(std::array{shifted(small, kLongEnough), b_}),
                                  meeting_bodies(report, world.bodies())));
}

// A record that was another pair's may hold a surface between vertices of that.
TEST_F(Regrouping, SurfacesOfEarlierPairsAreLeftAlone) {
  World world({.threads = 1, .direction = DirectionPolicy::smallest});
  add(world, a_);
  for (const BodyId id : world.bodies()) world.remove_body(id);
  world.detect();
  const Mesh cloth = sheet(16, 16, 1.0, 1.0), floor = sheet(1, 1, 4.0, 4.0);
  const BodyId id = world.add_body({.positions = scrambled(cloth, 3).positions, .facets = cloth.facets});
  world.add_body({.positions = floor.positions, .facets = floor.facets});
  world.detect();
  std::int64_t regrouped = 0;
  for (int step = 1; step <= kLongEnough; ++step) {
    world.set_positions(id, translated(cloth, {0x1p-20 * step, 0.0, 0.0}).positions);
    const Report& report = world.detect();
    EXPECT_EQ(report.contacts().size(), 1u);
    regrouped += report.stats().regrouped_bodies;
  }
  EXPECT_EQ(regrouped, 1);
}

TEST_F(Regrouping, ABodyThatIsLooseNoMoreIsLeftAlone) {
  World world({.threads = 1});
  add(world, scrambled(a_, 3));
  for (int step = 1; step <= kLongEnough; ++step) world.set_positions(world.bodies()[0], shifted(a_, step).positions);
  Mesh point = a_;
  point.positions.setZero();
  world.set_positions(world.bodies()[0], point.positions);
  EXPECT_EQ(world.detect().stats().regrouped_bodies, 0);
}

// Small facets, each alone, that change places to and fro.
TEST_F(Regrouping, ComesAtLongerAndLongerIntervals) {
  const Mesh here = soup(400, 0.1, 5);
  Mesh there = here;
  const std::vector<int> places = Random(6).permutation(here.facet_count());
  for (int f = 0; f < here.facet_count(); ++f) {
    for (int k = 0; k < 3; ++k) there.positions.col(here.facets(k, f)) = here.positions.col(here.facets(k, places[f]));
  }
  World world({.threads = 1});
  const BodyId id = add_bodies(world, std::array{here})[0];
  int regrouped = 0;
  for (int step = 1; step <= 2048; ++step) {
    world.set_positions(id, shifted(step / 40 % 2 == 0 ? here : there, step).positions);
    regrouped += static_cast<int>(world.detect().stats().regrouped_bodies);
  }
  EXPECT_GE(regrouped, 2);
  EXPECT_LE(regrouped, 6);
}

}  // namespace
}  // namespace tact::tests
