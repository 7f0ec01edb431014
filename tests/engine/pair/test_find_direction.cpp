// Direction and depth against brute force over every face of the Minkowski difference, and what carrying them promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/checks/contact_checks.h"
#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::tests {
namespace {

// Two small bodies whose difference can be searched whole.
struct SmallPair {
  Mesh a;
  Mesh b;
};

// A solid, a flat sheet, a facet, a straight or a point-like body: `kind` is 0 to 6.
Mesh small_body(int kind, std::uint64_t seed) {
  Random random(seed);
  const Rotation turn = random.rotation();
  switch (kind) {
    case 0: return random_hull(12, seed);
    case 1: return rotated(centered_box({random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), 0.5}), turn);
    case 2: return rotated(icosphere(0), turn);
    case 3: return rotated(sheet(2, 3, 1.5, 2.0), turn);
    case 4: return rotated(spike({1.0, 1.0, 1.0}, 1e-3), turn);
    case 5: return soup(1, 2.0, seed);
    default: {
      MeshBuilder builder;
      const Vec3 tip = random.direction();
      builder.triangle(-tip, tip, 0.25 * tip);
      return builder.mesh();
    }
  }
}

SmallPair small_pair(std::uint64_t seed) {
  Random random(seed);
  const int kind_a = random.below(7), kind_b = random.below(7);
  return {small_body(kind_a, seed), translated(small_body(kind_b, seed + 5000), 0.8 * random.in_ball())};
}

TEST(Directions, OfNewPairsAreSmallestSeparations) {
  int overlapping = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const SmallPair pair = small_pair(seed);
    const SmallestHeight smallest = smallest_height(used_points(pair.a), used_points(pair.b), 1e-12);
    World world;
    add_bodies(world, std::array{pair.a, pair.b});
    const Report& report = world.detect();
    if (std::abs(static_cast<double>(smallest.height)) > 1e-12) {
      ASSERT_EQ(report.contacts().size(), smallest.height > 0.0L ? 1u : 0u) << "seed " << seed;
    }
    if (report.contacts().empty()) continue;
    ++overlapping;
    const Contact& contact = report.contacts()[0];
    ASSERT_EQ(contact.source, DirectionSource::smallest);
    ASSERT_TRUE(is_sound(contact, pair.a, pair.b)) << "seed " << seed;
    ASSERT_NEAR(contact.depth, static_cast<double>(smallest.height), 1e-12) << "seed " << seed;
    const Vec3 n = from_eigen(contact.direction);
    ASSERT_TRUE(std::ranges::any_of(smallest.directions, [&](Vec3 m) { return norm(m - n) < 1e-5; }))
        << "seed " << seed;
  }
  EXPECT_GT(overlapping, 60);
}

// A body passes through another: where the direction starts, how it goes on, and that it never climbs.
TEST(Directions, StayLocalMinimaWhileCarried) {
  int carried = 0, fresh = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const SmallPair pair = small_pair(seed);
    const Vec3 way = random.direction();
    World world;
    const BodyId a = world.add_body({.positions = pair.a.positions, .facets = pair.a.facets});
    const BodyId b = world.add_body({.positions = pair.b.positions, .facets = pair.b.facets});
    Vec3 last;
    for (int step = 0; step < 24; ++step) {
      const Mesh moved = jittered(translated(pair.b, (3.0 - 0.25 * step) * way), 0.01, seed + 100);
      world.set_positions(b, moved.positions);
      const Report& report = world.detect();
      if (report.contacts().empty()) continue;
      const Contact& contact = report.contacts()[0];
      ASSERT_EQ(contact.a, a);
      ASSERT_TRUE(is_sound(contact, pair.a, moved)) << "seed " << seed << ", step " << step;
      if (contact.source == DirectionSource::carried) {
        const long double before = minkowski_height(used_points(pair.a), used_points(moved), last);
        ASSERT_LE(contact.depth, static_cast<double>(before) + 1e-12) << "seed " << seed << ", step " << step;
      }
      carried += contact.source == DirectionSource::carried ? 1 : 0;
      fresh += contact.source == DirectionSource::fresh ? 1 : 0;
      last = from_eigen(contact.direction);
    }
  }
  EXPECT_GT(carried, 40);
  EXPECT_GT(fresh, 15);
}

TEST(Directions, AreSmallestInEveryStepWhereAskedFor) {
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    Random random(seed);
    const SmallPair pair = small_pair(seed);
    const Vec3 way = random.direction();
    World world({.direction = DirectionPolicy::smallest});
    const std::vector<BodyId> ids = add_bodies(world, std::array{pair.a, pair.b});
    for (int step = 0; step < 12; ++step) {
      const Mesh moved = translated(pair.b, (1.5 - 0.25 * step) * way);
      world.set_positions(ids[1], moved.positions);
      const Report& report = world.detect();
      if (report.contacts().empty()) continue;
      ASSERT_EQ(report.contacts()[0].source, DirectionSource::smallest);
      const SmallestHeight smallest = smallest_height(used_points(pair.a), used_points(moved), 0.0);
      ASSERT_NEAR(report.contacts()[0].depth, std::max(0.0, static_cast<double>(smallest.height)), 1e-12)
          << "seed " << seed << ", step " << step;
    }
  }
}

TEST(Directions, TurnWhenBodiesAreSwapped) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Mesh a = random_hull(14, seed);
    const Mesh b = translated(random_hull(10, seed + 500), 0.5 * Random(seed).in_ball());
    World there, back;
    add_bodies(there, std::array{a, b});
    add_bodies(back, std::array{b, a});
    const auto one = there.detect().contacts(), other = back.detect().contacts();
    ASSERT_EQ(one.size(), other.size());
    if (one.empty()) continue;
    EXPECT_LT((one[0].direction + other[0].direction).norm(), 1e-12) << "seed " << seed;
    EXPECT_NEAR(one[0].depth, other[0].depth, 1e-14);
  }
}

TEST(Directions, KeepTheirBitsUnderScalingByPowersOfTwo) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const SmallPair pair = small_pair(seed);
    World world;
    add_bodies(world, std::array{pair.a, pair.b});
    const auto expected = world.detect().contacts();
    for (const int exponent : {-200, -20, 1, 30, 200}) {
      const double factor = std::ldexp(1.0, exponent);
      World other;
      add_bodies(other, std::array{scaled(pair.a, factor), scaled(pair.b, factor)});
      const auto found = other.detect().contacts();
      ASSERT_EQ(expected.size(), found.size()) << "seed " << seed << ", 2^" << exponent;
      if (expected.empty()) continue;
      EXPECT_EQ(expected[0].direction, found[0].direction) << "seed " << seed << ", 2^" << exponent;
      EXPECT_EQ(expected[0].depth * factor, found[0].depth) << "seed " << seed << ", 2^" << exponent;
    }
  }
}

// Far from zero the positions are coarser; direction and depth are those of the positions as they are.
TEST(Directions, AreSoundFarFromOrigin) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SmallPair pair = small_pair(seed);
    pair.a = translated(pair.a, {1e8, -1e8, 3e7});
    pair.b = translated(pair.b, {1e8, -1e8, 3e7});
    World world;
    add_bodies(world, std::array{pair.a, pair.b});
    for (const Contact& contact : world.detect().contacts()) {
      ASSERT_TRUE(is_sound(contact, pair.a, pair.b)) << "seed " << seed;
    }
  }
}

// A bowl of cloth, open above, 2 m wide and 1.6 m deep, with one corner turned up.
Mesh slack_cloth() {
  Mesh cloth = sheet(16, 16, 2.0, 2.0);
  for (int v = 0; v < cloth.vertex_count(); ++v) {
    const Vec3 p = cloth.position(v);
    cloth.set_position(v, {p.x, p.y, 0.8 * (p.x * p.x + p.y * p.y) - 1.6});
  }
  cloth.positions(2, 0) += 0.3;
  return cloth;
}

// The paper's case: a sphere that has sunk into a very flexible cloth is pushed back the way it came in, even where the
// way out through the bottom is shorter.
TEST(Directions, PushSphereBackOutOfSlackCloth) {
  const Mesh cloth = slack_cloth(), sphere = icosphere(2, 0.3);
  World world, smallest({.direction = DirectionPolicy::smallest});
  std::array<BodyId, 2> balls;
  for (World* w : {&world, &smallest}) {
    w->add_body({.positions = cloth.positions, .facets = cloth.facets, .surface = Surface::sheet});
    balls[w == &world ? 0 : 1] = w->add_body({.positions = sphere.positions, .facets = sphere.facets});
  }
  double last_depth = 0.0;
  bool shorter_way_out = false;
  for (int step = 0; step <= 70; ++step) {
    const Mesh ball = translated(sphere, {0.05, 0.02, 0.7 - 0.03 * step});  // from above the cloth to its bottom
    world.set_positions(balls[0], ball.positions);
    smallest.set_positions(balls[1], ball.positions);
    const auto contacts = world.detect().contacts(), other = smallest.detect().contacts();
    ASSERT_EQ(contacts.size(), other.size());
    if (contacts.empty()) continue;
    const Contact& contact = contacts[0];
    EXPECT_EQ(contact.source, last_depth == 0.0 ? DirectionSource::fresh : DirectionSource::carried);
    EXPECT_GT(contact.direction.z(), 0.9) << "step " << step;
    EXPECT_GE(contact.depth, last_depth) << "step " << step;
    EXPECT_GE(contact.depth, other[0].depth - 1e-12) << "step " << step;
    EXPECT_TRUE(is_sound(contact, cloth, ball)) << "step " << step;
    shorter_way_out = shorter_way_out || other[0].direction.z() < 0.0;
    last_depth = contact.depth;
  }
  EXPECT_GT(last_depth, 1.5);
  EXPECT_TRUE(shorter_way_out);  // or the test would show nothing
}

// Once the bodies have parted, the direction is that of the new approach.
TEST(Directions, ComeFromTheSideOfTheLastApproach) {
  const Mesh floor = centered_box({1.0, 1.0, 0.1}), ball = icosphere(1, 0.2);
  World world;
  world.add_body({.positions = floor.positions, .facets = floor.facets});
  const BodyId moving = world.add_body({.positions = ball.positions, .facets = ball.facets});
  const auto contact_at = [&](double z) {
    world.set_positions(moving, translated(ball, {0.1, 0.2, z}).positions);
    return world.detect().contacts()[0];
  };
  world.set_positions(moving, translated(ball, {0.1, 0.2, 0.31}).positions);
  EXPECT_TRUE(world.detect().contacts().empty());
  EXPECT_LT((contact_at(0.25).direction - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((contact_at(-0.05).direction - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  world.set_positions(moving, translated(ball, {0.1, 0.2, -0.31}).positions);
  EXPECT_TRUE(world.detect().contacts().empty());
  EXPECT_LT((contact_at(-0.25).direction + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((contact_at(0.05).direction + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

// (1,1,1)/sqrt(3) and (1,1,0)/sqrt(2) repeat under the paper's iteration, and are no minima.
TEST(Directions, LeaveUnstableFeet) {
  const Mesh cube = centered_box({0.5, 0.5, 0.5});
  for (const Vec3 start : {Vec3{1.0, 1.0, 1.0}, Vec3{1.0, 1.0, 0.0}, Vec3{0.0, -1.0, 1.0}}) {
    World world;
    const std::vector<BodyId> ids = add_bodies(world, std::array{cube, translated(cube, 1.5 * start)});
    EXPECT_TRUE(world.detect().contacts().empty());
    for (const double t : {1.01, 0.9, 0.5, 0.25, 0.0}) {
      const Mesh moved = translated(cube, t * start);
      world.set_positions(ids[1], moved.positions);
      for (const Contact& contact : world.detect().contacts()) {
        EXPECT_TRUE(is_sound(contact, cube, moved)) << t;
        EXPECT_NEAR(contact.direction.cwiseAbs().maxCoeff(), 1.0, 1e-15) << t;
        EXPECT_NEAR(contact.depth, 1.0 - t, 1e-15);
      }
    }
  }
}

TEST(Directions, AreCarriedInNoMoreThanAboutOneIteration) {
  World world;
  std::vector<Mesh> bodies = {organ(1), translated(tool(), {0.0, 0.0, -0.2}), wrinkled_sheet(16, 1.0, 0.2, 1)};
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  Random random(1);
  int iterations = 0, directions = 0;
  for (int step = 0; step < 40; ++step) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i] = jittered(translated(bodies[i], 0.005 * random.in_ball()), 1e-3, random.bits());
      world.set_positions(ids[i], bodies[i].positions);
    }
    const StepStats& stats = world.detect().stats();
    if (step == 0) continue;
    iterations += static_cast<int>(stats.direction_iterations);
    directions += static_cast<int>(stats.carried_directions);
  }
  ASSERT_GT(directions, 60);
  EXPECT_LE(iterations, 1.2 * directions);
}

TEST(Zones, HoldThePartOfTheBodyBetweenThePlanes) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    const std::array bodies = {blob(2, 1.0, 0.3, seed),
                               translated(blob(1, 0.7, 0.3, seed + 99), 1.4 * random.direction())};
    World world({.outputs = {.zones = true}});
    add_bodies(world, bodies);
    for (const Contact& contact : world.detect().contacts()) {
      for (const bool first : {true, false}) {
        const ZoneDisk& zone = first ? contact.zone_a : contact.zone_b;
        const Mesh& body = bodies[first ? 0 : 1];
        ASSERT_GE(zone.radius, 0.0);
        ASSERT_LE(zone.radius, 1.01 * extent(body));
        for (int v = 0; v < body.vertex_count(); ++v) {
          const Eigen::Vector3d p = body.positions.col(v);
          const double height = contact.direction.dot(p);
          if (height < contact.plane_b || height > contact.plane_a) continue;
          const Eigen::Vector3d offset = p - zone.center;
          const double across = (offset - contact.direction.dot(offset) * contact.direction).norm();
          ASSERT_LE(across, zone.radius + 1e-12) << "seed " << seed << ", vertex " << v;
        }
      }
    }
  }
}

TEST(Zones, AreNotComputedUnlessAskedFor) {
  World world;
  add_bodies(world, std::array{icosphere(1), icosphere(1)});
  const auto contacts = world.detect().contacts();
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_LT(contacts[0].zone_a.radius, 0.0);
  EXPECT_LT(contacts[0].zone_b.radius, 0.0);
}

}  // namespace
}  // namespace tact::tests
