// Every way to an answer, forced through a world's thresholds: none changes which facets meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/checks/tunings.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/generators/fans.h"
#include "tests/support/generators/random.h"
#include "tests/support/hashes/work_hash.h"

namespace tact::tests {
namespace {

class AtTuning : public ::testing::TestWithParam<NamedTuning> {
 protected:
  std::vector<MeetingBodies> meeting(std::span<const Mesh> bodies, const Settings& settings) const {
    World world(settings);
    world.set_tuning(GetParam().tuning);
    const std::vector<BodyId> ids = add_bodies(world, bodies);
    return meeting_bodies(world.detect(), ids);
  }
};

INSTANTIATE_TEST_SUITE_P(Tunings, AtTuning, ::testing::ValuesIn(kTunings),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(AtTuning, FacetPairsOfEveryKindEqualOracle) {
  for (const BodyPairKind& kind : body_pair_kinds()) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const std::vector<Mesh> bodies = kind.make(seed);
      const std::vector<MeetingBodies> expected = meeting_bodies_by_oracle(bodies);
      for (const Settings& settings :
           {Settings{.threads = 1}, Settings{.threads = 2, .direction = DirectionPolicy::smallest}}) {
        ASSERT_TRUE(same_meeting_bodies(expected, meeting(bodies, settings))) << kind.name << ", seed " << seed;
      }
    }
  }
}

TEST_P(AtTuning, FacetPairsOfKissingBodiesAndCrowdsEqualOracle) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const std::vector<Mesh> bodies = kissing_bodies(seed);
    ASSERT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(bodies), meeting(bodies, {.threads = 1}))) << seed;
  }
  for (const std::vector<Mesh>& bodies : {mixed_crowd(40, 1), brick_wall(6, 6)})
    EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(bodies), meeting(bodies, {.threads = 2})));
}

// Moved one by one and many at once; some stand still; batches are packed, clusters grouped anew, pairs come and go.
TEST_P(AtTuning, FacetPairsOfMovingBodiesEqualOracleInEveryStep) {
  for (const DirectionPolicy direction : {DirectionPolicy::carried, DirectionPolicy::smallest}) {
    std::vector<Mesh> bodies = crowd_of_blobs(30, 7);
    bodies.push_back(wrinkled_sheet(20, 5.0, 0.6, 7));
    World world({.threads = 2, .direction = direction});
    world.set_tuning(GetParam().tuning);
    const std::vector<BodyId> ids = add_bodies(world, bodies);
    Random random(7);
    for (int step = 0; step < 8; ++step) {
      ASSERT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(bodies), meeting_bodies(world.detect(), ids)))
          << "step " << step;
      std::vector<PositionsUpdate> updates;
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (random.chance(0.3)) continue;
        bodies[i] = jittered(translated(bodies[i], 0.2 * random.in_ball()), 0.01, random.bits());
        updates.push_back({ids[i], bodies[i].positions});
      }
      if (step % 2 == 0) {
        world.set_positions(updates);
      } else {
        for (const PositionsUpdate& update : updates) world.set_positions(update.body, update.positions);
      }
    }
  }
}

TEST_P(AtTuning, HashesAreTheSameForAnyNumberOfThreads) {
  std::vector<std::array<std::uint64_t, 2>> expected;
  for (const int threads : {1, 2, 3}) {
    World world({.threads = threads, .outputs = {.zones = true, .patches = true}});
    world.set_tuning(GetParam().tuning);
    std::vector<Mesh> bodies = crowd_of_blobs(24, 3);
    bodies.push_back(wrinkled_sheet(20, 4.0, 0.5, 3));
    const std::vector<BodyId> ids = add_bodies(world, bodies);
    std::vector<std::array<std::uint64_t, 2>> hashes;
    for (int step = 0; step < 4; ++step) {
      const Report& report = world.detect();
      hashes.push_back({report.hash(), work_hash(report)});
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies[i] = translated(bodies[i], {0.03125, 0.0625, -0.03125 * static_cast<double>(i % 3)});
        world.set_positions(ids[i], bodies[i].positions);
      }
    }
    if (expected.empty()) expected = hashes;
    EXPECT_EQ(hashes, expected) << threads << " threads";
  }
}

// A direction starts from something else, and ends at the same.
TEST_P(AtTuning, DirectionsAndDepthsAgreeWithTheDefault) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const std::array bodies = {blob(2, 1.0, 0.2, seed), translated(blob(2, 0.8, 0.2, seed + 50), {1.2, 0.3, 0.1})};
    World world, other;
    other.set_tuning(GetParam().tuning);
    add_bodies(world, bodies);
    add_bodies(other, bodies);
    const auto expected = world.detect().contacts(), found = other.detect().contacts();
    ASSERT_EQ(found.size(), expected.size()) << "seed " << seed;
    if (expected.empty()) continue;
    EXPECT_LT((expected[0].direction - found[0].direction).norm(), 1e-12) << "seed " << seed;
    EXPECT_NEAR(expected[0].depth, found[0].depth, 1e-13) << "seed " << seed;
  }
}

// Of a sheet with itself and a ball that falls on it: contact points, self-contact and motion find their cluster pairs
// by the same thresholds. Returns how many points and impacts there are.
std::array<std::size_t, 2> expect_answers_of_default(const base::Tuning& tuning, const Mesh& sheet, const Mesh& ball,
                                                     Vec3 way) {
  tact::World world({.threads = 1, .outputs = {.points = true}}), other({.threads = 2, .outputs = {.points = true}});
  WorldTuning::set(other, tuning);
  std::vector<std::array<BodyId, 2>> bodies;
  for (tact::World* one : {&world, &other}) {
    const BodyId of_sheet = one->add_body({.positions = sheet.positions,
                                           .facets = sheet.facets,
                                           .surface = Surface::sheet,
                                           .margin = 0.02,
                                           .self_contact = true});
    bodies.push_back({of_sheet, one->add_body({.positions = ball.positions, .facets = ball.facets, .margin = 0.02})});
  }
  std::array<std::size_t, 2> counts{};
  const auto expected = world.detect().contacts(), found = other.detect().contacts();
  EXPECT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < std::min(expected.size(), found.size()); ++i) {
    EXPECT_TRUE(same_facet_pairs(expected[i].facet_pairs(), found[i].facet_pairs()));
    const auto points = expected[i].points(), others = found[i].points();
    EXPECT_TRUE(std::ranges::equal(
        points, others, [](const ContactPoint& p, const ContactPoint& q) { return p.id == q.id && p.gap == q.gap; }));
    counts[0] += points.size();
  }
  const Mesh fallen = translated(ball, way), swayed = mapped(sheet, [](Vec3 p) { return Vec3{p.x, p.y, 0.97 * p.z}; });
  const auto move = [&](tact::World& one, const std::array<BodyId, 2>& those) {
    one.set_positions(those[0], swayed.positions);
    one.set_positions(those[1], fallen.positions);
    return one.detect_motion().impacts();
  };
  const auto impacts = move(world, bodies[0]), others = move(other, bodies[1]);
  EXPECT_TRUE(std::ranges::equal(impacts, others, [](const Impact& p, const Impact& q) {
    return p.time == q.time && p.a_vertices == q.a_vertices && p.b_vertices == q.b_vertices && p.stops == q.stops;
  }));
  counts[1] = impacts.size();
  return counts;
}

TEST_P(AtTuning, PointsSelfContactAndMotionAreThoseOfTheDefault) {
  const Mesh cloth = crumpled(sheet(24, 24, 2.0, 2.0), 5), ball = translated(blob(2, 0.6, 0.1, 6), {0.1, 0.0, 0.5});
  const auto [points, impacts] = expect_answers_of_default(GetParam().tuning, cloth, ball, {0.05, 0.02, -0.4});
  EXPECT_GT(points, 20u);
  EXPECT_GT(impacts, 10u);
}

// Planes leave out cluster pairs of these, around vertices and edges of many facets and along the sides of slivers.
TEST_P(AtTuning, AnswersOfSliversAndFansAreThoseOfTheDefault) {
  Random random(31);
  const Rotation turn = random.rotation();
  const Mesh tube = rotated(sliver_tube(150, 0.1, 4.0), turn);
  const Mesh shapes[] = {tube, fan_cone(140, 0.3), star(200, 3), open_book(140), crumpled(fan_cone(100, 0.3), 9)};
  for (const Mesh& shape : shapes) {
    const Mesh other = &shape == shapes ? rotated(translated(sliver_tube(150, 0.1, 4.0), {0.21, 0.03, 0.3}), turn)
                                        : translated(blob(2, 0.4, 0.1, 6), {0.003, 0.0, 0.0});
    const auto [points, impacts] = expect_answers_of_default(GetParam().tuning, shape, other, {0.05, 0.02, -0.4});
    EXPECT_GT(points, 10u) << "shape " << &shape - shapes;
    EXPECT_GT(impacts, 10u) << "shape " << &shape - shapes;
  }
}

// Without this all that is above might run the same way.
TEST(Tuning, ForcesTheWaysOfItsWorld) {
  const Mesh ball = icosphere(2);
  // One that overlaps the first, one that an axis of the k-DOPs separates, and one that is apart but along none.
  const std::array offsets{Vec3{0.0, 0.0, 0.0}, Vec3{1.7, 0.1, 0.0}, Vec3{-1.6, -1.6, 0.0}, Vec3{-1.17, 1.17, 1.17}};
  std::vector<Mesh> balls;
  for (const Vec3& offset : offsets) balls.push_back(translated(ball, offset));
  const auto stats_with = [&](const base::Tuning& tuning) {
    World world({.threads = 2, .outputs = {.trace = true}});
    world.set_tuning(tuning);
    const std::vector<BodyId> ids = add_bodies(world, balls);
    world.detect();
    StepStats seen;
    bool cut = false;
    for (int step = 1; step <= 3; ++step) {
      const Mesh moved = translated(ball, {0.0, 0.0, 0x1p-10 * step});
      world.set_positions(std::array{PositionsUpdate{ids[0], moved.positions}});
      const Report& report = world.detect();
      EXPECT_EQ(report.stats().candidate_pairs, 3);
      EXPECT_EQ(report.stats().touching_contacts, 1);
      for (const auto& field : kStepCounts) seen.*field.value += report.stats().*field.value;
      cut = cut || std::ranges::any_of(report.trace(),
                                       [](const TraceEvent& event) { return event.kind == TraceEvent::Kind::range; });
    }
    return std::pair(seen, cut);
  };
  const auto [plain, plain_is_cut] = stats_with(kPlain);
  EXPECT_EQ(plain.kdop_separated_pairs, 0);
  EXPECT_EQ(plain.still_separated_pairs, 0);
  EXPECT_EQ(plain.still_overlapping_pairs, 0);
  EXPECT_EQ(plain.tree_pairs, 0);
  EXPECT_EQ(plain.regrouped_bodies, 0);
  EXPECT_FALSE(plain_is_cut);
  const auto [usual, usual_is_cut] = stats_with(base::kTuning);
  EXPECT_GT(usual.kdop_separated_pairs, 0);
  EXPECT_GT(usual.still_separated_pairs, 0);
  EXPECT_GT(usual.still_overlapping_pairs, 0);
  EXPECT_EQ(usual.tree_pairs, 0);
  EXPECT_EQ(usual.regrouped_bodies, 0);
  EXPECT_FALSE(usual_is_cut);
  const auto [forced, forced_is_cut] = stats_with(kForced);
  EXPECT_EQ(forced.tree_pairs, 3);
  EXPECT_GT(forced.regrouped_bodies, 0);
  EXPECT_TRUE(forced_is_cut);
  EXPECT_GT(plain.triangle_tests, usual.triangle_tests);
}

}  // namespace
}  // namespace tact::tests
