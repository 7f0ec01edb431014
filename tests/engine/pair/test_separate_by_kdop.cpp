// Pairs that an axis of the 18-DOPs separates are not looked at: whatever moves, comes, goes or is replaced, they are
// apart, and what comes of them later starts from there.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/world_tuning.h"
#include "narrowphase/hull/gjk.h"
#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/hashes/work_hash.h"
#include "tests/support/inside/clustered.h"

namespace tact::tests {
namespace {

const Mesh kBall = icosphere(4);  // of radius 1

Eigen::Matrix3Xd ball_at(double x, double y, double z) { return translated(kBall, {x, y, z}).positions; }

BodyId add_ball(World& world, double x, double y, double z) {
  const Eigen::Matrix3Xd positions = ball_at(x, y, z);
  return world.add_body({.positions = positions, .facets = kBall.facets});
}

// Where all bodies moved, every pair is one of these.
void expect_sums(const StepStats& stats) {
  if (stats.kept_pairs > 0) return;
  EXPECT_EQ(stats.kdop_separated_pairs + stats.still_separated_pairs + stats.separated_pairs + stats.contacts,
            stats.candidate_pairs);
}

TEST(SeparatedPairs, ComeIntoContactFromTheAxisThatSeparatedThem) {
  World world;
  add_ball(world, 0, 0, 0);
  const BodyId b = add_ball(world, 1.6, 1.6, 0);
  EXPECT_EQ(world.detect().stats().kdop_separated_pairs, 1);
  EXPECT_EQ(world.detect().stats().kdop_separated_pairs, 0);  // nothing moved: it was not looked at
  for (double x = 1.59; x > 1.3; x -= 0.01) {
    world.set_positions(b, ball_at(x, x, 0));
    const Report& report = world.detect();
    expect_sums(report.stats());
    ASSERT_EQ(report.candidate_pairs().size(), 1u);
    EXPECT_EQ(report.candidate_pairs()[0].hulls_overlap, !report.contacts().empty());
    if (report.contacts().empty()) continue;
    EXPECT_LT(x, 1.415);  // where the balls, of facets, touch at the latest
    EXPECT_GT(x, 1.36);
    EXPECT_EQ(report.contacts()[0].source, DirectionSource::fresh);
    EXPECT_GT(report.contacts()[0].direction.dot(Eigen::Vector3d(1, 1, 0).normalized()), 0.99);
    return;
  }
  FAIL() << "the balls never touched";
}

// A body that nothing is near does not find its k-DOP; what it knew is of no use when it has moved on, and it
// finds it again when a pair wants to know.
TEST(SeparatedPairs, WhatABodyKnewIsForgottenWhenItMoves) {
  World world;
  add_ball(world, 0, 0, 0);
  const BodyId b = add_ball(world, 1.6, 1.6, 0);
  EXPECT_EQ(world.detect().stats().kdop_separated_pairs, 1);
  world.set_positions(b, ball_at(50, 50, 0));
  EXPECT_EQ(world.detect().stats().candidate_pairs, 0);
  world.set_positions(b, ball_at(1.5, 0, 0));
  EXPECT_EQ(world.detect().stats().contacts, 1);
  for (const double x : {50.0, 60.0}) {
    world.set_positions(b, ball_at(x, 50, 0));
    world.detect();
  }
  world.set_positions(b, ball_at(1.6, 1.6, 0));
  EXPECT_EQ(world.detect().stats().kdop_separated_pairs, 1);
}

// Whether a body finds its k-DOP hangs on all its pairs; what is found of one does not.
TEST(SeparatedPairs, AnswerAsIfTheyWereAlone) {
  World alone, among_others;
  std::array<BodyId, 2> moving;
  for (World* world : {&alone, &among_others}) {
    add_ball(*world, 0, 0, 0);
    moving[world == &alone ? 0 : 1] = add_ball(*world, 50, 50, 0);
  }
  for (const double x : {48.4, 51.6}) add_ball(among_others, x, 48.4, 0);  // which the ball is apart from
  for (const double x : {50.0, 50.01, 1.6, 1.59, 1.45, 1.42, 1.41, 1.4}) {
    alone.set_positions(moving[0], ball_at(x, x, 0));
    among_others.set_positions(moving[1], ball_at(x, x, 0));
    const Report &expected = alone.detect(), &report = among_others.detect();
    if (x > 2) continue;
    ASSERT_EQ(report.stats().kdop_separated_pairs, expected.stats().kdop_separated_pairs) << x;
    ASSERT_EQ(report.contacts().size(), expected.contacts().size()) << x;
    for (std::size_t i = 0; i < expected.contacts().size(); ++i) {
      EXPECT_EQ(report.contacts()[i].direction, expected.contacts()[i].direction) << x;
      EXPECT_EQ(report.contacts()[i].depth, expected.contacts()[i].depth) << x;
      EXPECT_EQ(report.contacts()[i].source, expected.contacts()[i].source) << x;
    }
  }
  EXPECT_EQ(alone.detect().contacts().size(), 1u);
}

TEST(SeparatedPairs, ABodyInTheSlotOfAnotherStartsAnew) {
  World world;
  add_ball(world, 0, 0, 0);
  const BodyId b = add_ball(world, 1.6, 1.6, 0);
  EXPECT_EQ(world.detect().stats().kdop_separated_pairs, 1);
  world.remove_body(b);
  const BodyId other = add_ball(world, 1.2, 1.2, 0);
  EXPECT_EQ(other.index, b.index);
  const Report& report = world.detect();
  ASSERT_EQ(report.contacts().size(), 1u);
  EXPECT_EQ(report.contacts()[0].source, DirectionSource::smallest);
}

TEST(SeparatedPairs, LargeBodiesAreLookedAt) {
  World world;
  const Mesh large = icosphere(5);
  add_bodies(world, std::array{large, translated(large, {1.6, 1.6, 0})});
  const StepStats& stats = world.detect().stats();
  EXPECT_EQ(stats.kdop_separated_pairs, 0);
  EXPECT_EQ(stats.separated_pairs, 1);
}

bool hulls_overlap_by_gjk(const Mesh& a, const Mesh& b) {
  const narrowphase::ClusteredMesh mesh_a = clustered(a), mesh_b = clustered(b);
  return gjk(narrowphase::MinkowskiDifference(mesh_a, mesh_b), {}, {}, {}).status != narrowphase::GjkStatus::apart;
}

// Others that move in between change nothing for a body that rests beside one that an axis separates it from.
TEST(SeparatedPairs, StaySeparatedWhileOthersMove) {
  World world;
  const BodyId a = add_ball(world, 0, 0, 0), other = add_ball(world, 50, 50, 0);
  add_ball(world, 1.6, 1.6, 0);
  world.detect();
  for (int step = 1; step <= 5; ++step) {
    world.set_positions(a, ball_at(0.001 * step, 0, 0));
    EXPECT_EQ(world.detect().stats().kdop_separated_pairs, 1) << "step " << step;
    world.set_positions(other, ball_at(50, 50, step));
    EXPECT_EQ(world.detect().stats().kdop_separated_pairs, 0);
  }
}

// A body that is put in place before the first step and rests from then on.
TEST(SeparatedPairs, KnowBodiesThatWereMovedBeforeTheFirstStep) {
  World world;
  const BodyId shelf = add_ball(world, 9, 9, 9), passing = add_ball(world, 1.6, 1.6, 0);
  world.set_positions(shelf, ball_at(0, 0, 0));
  EXPECT_EQ(world.detect().stats().kdop_separated_pairs, 1);
  world.set_positions(passing, ball_at(1.61, 1.6, 0));
  EXPECT_EQ(world.detect().stats().kdop_separated_pairs, 1);
}

// A lattice of balls that jostle, most pairs of which an axis separates, so many that threads share them.
TEST(SeparatedPairs, OfAJostlingCrowdAreApart) {
  constexpr int kSide = 11;
  const Mesh ball = scaled(icosphere(1), 0.6);
  std::vector<Mesh> bodies;
  Random random(5);
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const auto at = [&](int k) { return k + random.uniform(-0.05, 0.05); };
    bodies.push_back(translated(ball, {at(i % kSide), at(i / kSide % kSide), at(i / kSide / kSide)}));
  }
  World one({.threads = 1}), two({.threads = 2});
  const auto ids_one = add_bodies(one, bodies), ids_two = add_bodies(two, bodies);
  std::int64_t separated = 0, contacts = 0;
  for (int step = 0; step < 6; ++step) {
    const Report &report = one.detect(), &other = two.detect();
    EXPECT_EQ(report.hash(), other.hash()) << "step " << step;
    EXPECT_EQ(work_hash(report), work_hash(other)) << "step " << step;
    EXPECT_EQ(report.stats().kdop_separated_pairs, other.stats().kdop_separated_pairs);
    EXPECT_GT(report.stats().candidate_pairs, 4096);
    expect_sums(report.stats());
    for (const CandidatePair& pair : report.candidate_pairs()) {
      ASSERT_EQ(pair.hulls_overlap, hulls_overlap_by_gjk(bodies[pair.a.index], bodies[pair.b.index]))
          << "step " << step << ", pair " << pair.a.index << ' ' << pair.b.index;
    }
    separated += report.stats().kdop_separated_pairs;
    contacts += report.stats().contacts;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (step % 2 == 1 && random.chance(0.3)) continue;
      const Vec3 by = random.in_cube(0.1);
      bodies[i].positions.colwise() += Eigen::Vector3d(by.x, by.y, by.z);
      one.set_positions(ids_one[i], bodies[i].positions);
      two.set_positions(ids_two[i], bodies[i].positions);
    }
  }
  EXPECT_GT(separated, 20'000);
  EXPECT_GT(contacts, 5'000);
}

// What is farther apart along a diagonal than the margins together is settled there; what is nearer is looked at.
TEST(SeparatedPairs, MarginsAreTakenOff) {
  const double apart = std::sqrt(2.0) * 1.6 - 2.0 * kBall.positions.col(0).norm();  // of balls, about
  for (const double margin : {0.0, 0.1, 0.45 * apart, 0.6 * apart, 1.0}) {
    World world({.outputs = {.points = true}});
    add_ball(world, 0, 0, 0);
    world.set_margin(add_ball(world, 1.6, 1.6, 0), margin);
    world.set_margin(world.bodies()[0], margin);
    const Report& report = world.detect();
    EXPECT_EQ(report.stats().kdop_separated_pairs, 2.0 * margin < 0.95 * apart ? 1 : 0) << margin;
    EXPECT_EQ(report.contacts().size(), 2.0 * margin > apart ? 1U : 0U) << margin;
  }
}

// Reports are those of a world that does without, while balls with margins come near, touch and part.
TEST(SeparatedPairs, OfBodiesWithMarginsChangesNoReport) {
  const Mesh ball = scaled(icosphere(1), 0.4);
  World with({.outputs = {.points = true}}), without({.outputs = {.points = true}});
  base::Tuning tuning;
  tuning.separates_by_kdop = false;
  WorldTuning::set(without, tuning);
  std::vector<Mesh> balls;
  std::vector<BodyId> ids, same_ids;
  Random random(6);
  for (int i = 0; i < 125; ++i) {
    balls.push_back(translated(ball, {0.9 * (i % 5), 0.9 * (i / 5 % 5), 0.9 * (i / 25)}));
    const double margin = i % 3 == 0 ? 0.0 : 0.06;
    for (World* world : {&with, &without}) {
      const BodyId id = world->add_body({.positions = balls.back().positions, .facets = ball.facets, .margin = margin});
      (world == &with ? ids : same_ids).push_back(id);
    }
  }
  std::int64_t separated = 0, near = 0;
  for (int step = 0; step < 20; ++step) {
    const Report &report = with.detect(), &expected = without.detect();
    ASSERT_EQ(report.hash(), expected.hash()) << "step " << step;
    EXPECT_EQ(expected.stats().kdop_separated_pairs, 0);
    separated += report.stats().kdop_separated_pairs;
    near += static_cast<std::int64_t>(report.contacts().size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
      balls[i] = translated(balls[i], random.in_cube(0.03));
      with.set_positions(ids[i], balls[i].positions);
      without.set_positions(same_ids[i], balls[i].positions);
    }
  }
  EXPECT_GT(separated, 1000);
  EXPECT_GT(near, 1000);
}

}  // namespace
}  // namespace tact::tests
