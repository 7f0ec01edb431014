// What users of other libraries reported, each with the number of its row in the list of pains, and the answer of tact.
// Rows that another test answers are not repeated: 5, 20, 22 to 25 stand in test_known_answers.cpp, 7 in
// test_world.cpp, 11 and 37 in test_allocation.cpp, 18 in test_facet_pairs.cpp, 35 in test_determinism.cpp, 45 in the
// tests of the triangle tests, 46 in tests/threads, 47 in test_layers.cpp.
//
// Left out are rows that no behaviour of detection answers: 34 is of a library for GPUs; 38 and 43 are
// times, which tact-bench measures; 44 is Embree's interface. Rows 17 and 31, margins, stand in tests/engine/points,
// and 42, motion, in tests/engine/motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/support/checks/contact_checks.h"
#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::tests {
namespace {

// 1 fcl#574, 2 coal#357: the depth of two meshes came out as 0, or as the height of a wall. Ours is that of the hulls.
TEST(UserPains, DepthOfTwoMeshesIsThatOfTheirHulls) {
  const Mesh a = torus(16, 8, 1.0, 0.25), b = translated(torus(16, 8, 1.0, 0.25), {0.0, 0.0, 0.4});
  const std::optional<Contact> contact = contact_of(a, b);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->depth, 0.1, 1e-12);
  EXPECT_TRUE(is_sound(*contact, a, b));
}

// 3 fcl#545: a small cube on the diagonal of a larger one; the depth came out sqrt(3) times too large, along the
// diagonal.
TEST(UserPains, CubeInTheCornerOfAnother) {
  for (const double edge : {0.01, 0.1, 0.2, 0.5}) {
    const std::optional<Contact> contact = contact_of(cube(1.0, {}), cube(edge, {0.4, 0.4, 0.4}));
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->depth, 0.1 + edge / 2, 1e-15);
    EXPECT_NEAR(contact->direction.cwiseAbs().maxCoeff(), 1.0, 4e-16);
  }
}

// 4 fcl#503, 27 JoltPhysics#940: depths of 0.33 to 16 for shapes that touch. A depth is bounded by every overlap of the
// hulls.
TEST(UserPains, SmallestDepthIsNoMoreThanAnyOverlap) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    const Mesh a = rotated(stretched(icosphere(1), {2.0, 0.1, 0.1}), random.rotation());
    const Mesh b = translated(wrinkled_sheet(4, 2.0, 0.3, seed), 0.5 * random.in_ball());
    const std::optional<Contact> contact = contact_of(a, b);
    if (!contact) continue;
    for (int i = 0; i < 100; ++i) {
      const auto overlap = static_cast<double>(minkowski_height(used_points(a), used_points(b), random.direction()));
      ASSERT_LE(contact->depth, overlap + 1e-13) << "seed " << seed;
    }
  }
}

// 6 fcl#366: an iteration limit was told by the number that also means apart. 14 coal#636, 16 coal#147: a contact of
// NaN, or none, after an early stop.
TEST(UserPains, ReachedLimitIsAFlagAndNeverASeparation) {
  int flagged = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Mesh still = random_hull(30, seed), moving = random_hull(30, seed + 100);
    World world({.gjk_tolerance = 0.1, .iteration_limit = 1});
    const std::vector<BodyId> ids = add_bodies(world, std::array{still, translated(moving, {3.0, 3.0, 3.0})});
    for (const double x : {1.5, 0.5, 0.1}) {
      const Mesh moved = translated(moving, {x, 0.9 * x, 0.8 * x});
      world.set_positions(ids[1], moved.positions);
      const Report& report = world.detect();
      std::int64_t limits = 0;
      for (const Contact& contact : report.contacts()) {
        limits += contact.limit_reached ? 1 : 0;
        EXPECT_TRUE(contact.direction.allFinite() && std::isfinite(contact.depth));
        EXPECT_NEAR(contact.direction.norm(), 1.0, 1e-14);
      }
      EXPECT_EQ(report.stats().limits_reached, limits);
      EXPECT_TRUE(same_facet_pairs(facet_pairs_by_oracle(still, moved), report.contacts().empty()
                                                                            ? std::span<const FacetPair>{}
                                                                            : report.contacts()[0].facet_pairs()));
      flagged += static_cast<int>(limits);
    }
  }
  EXPECT_GT(flagged, 0);
}

// 8 fcl#368: an update with nothing moved turned (A, B) into (B, A). 36 sofa#6231: the order varied from launch to
// launch.
TEST(UserPains, OrderOfPairsIsThatOfTheBodies) {
  World world;
  const std::vector<Mesh> bodies = crowd_of_blobs(40, 1);
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  const Report& report = world.detect();
  const auto in_order = [&] {
    for (const Contact& contact : report.contacts()) {
      if (contact.a.index >= contact.b.index) return false;
    }
    return std::ranges::is_sorted(report.contacts(), [](const Contact& x, const Contact& y) {
      return std::pair(x.a.index, x.b.index) < std::pair(y.a.index, y.b.index);
    });
  };
  ASSERT_GT(report.contacts().size(), 40u);
  EXPECT_TRUE(in_order());
  for (std::size_t i = 0; i < ids.size(); ++i) world.set_positions(ids[i], bodies[i].positions);
  world.detect();
  EXPECT_EQ(report.stats().moved_bodies, 0);
  EXPECT_TRUE(in_order());
}

// 9 fcl#577, 10 fcl#40, 12 python-fcl#45: a deforming mesh was missed until three more calls refreshed its boxes, or
// its old box went on meeting everything. One call is all.
TEST(UserPains, OneCallRefreshesADeformingBody) {
  World world;
  const Mesh ball = icosphere(2, 0.5), far = translated(icosphere(2, 0.5), {4.0, 0.0, 0.0});
  const std::vector<BodyId> ids = add_bodies(world, std::array{ball, far});
  EXPECT_TRUE(world.detect().candidate_pairs().empty());
  const Mesh long_ball = stretched(ball, {8.0, 1.0, 1.0});
  world.set_positions(ids[0], long_ball.positions);
  EXPECT_TRUE(
      same_meeting_bodies(meeting_bodies_by_oracle(std::array{long_ball, far}), meeting_bodies(world.detect(), ids)));
  EXPECT_EQ(world.detect().contacts().size(), 1u);
  world.set_positions(ids[0], ball.positions);
  EXPECT_TRUE(world.detect().candidate_pairs().empty());
}

// 13 coal#894: the answer depended on which query the process had made first.
TEST(UserPains, NothingIsLeftBehindByOtherWorlds) {
  const std::vector<Mesh> bodies = crowd_of_blobs(10, 1);
  const auto hash = [&] {
    World world;
    add_bodies(world, bodies);
    return world.detect().hash();
  };
  const std::uint64_t expected = hash();
  meeting_bodies_by_engine(mixed_crowd(30, 1), {.gjk_tolerance = 0.01, .iteration_limit = 2});
  EXPECT_EQ(hash(), expected);
  meeting_bodies_by_engine(brick_wall(3, 3), {.accuracy = Accuracy::paper});
  EXPECT_EQ(hash(), expected);
}

// 15 coal#37, #48: near touching, GJK went on to its limit, or ended the program on two triangles 13 m from the origin.
TEST(UserPains, TrianglesThatNearlyTouchReachNoLimit) {
  Random random(15);
  World carried({.threads = 1}), smallest({.threads = 1, .direction = DirectionPolicy::smallest});
  for (int i = 0; i < 3000; ++i) {
    const Vec3 at{-12.8 + random.uniform(), -1.7, 3.9};
    const double size = i % 2 == 0 ? 0.005 : 10.0;  // a small one and one as long as a hall, as reported
    const Vec3 p = at + 0.005 * random.in_ball(), q = at + 0.005 * random.in_ball(), r = at + 0.005 * random.in_ball();
    Vec3 tip = 0.25 * p + 0.25 * q + 0.5 * r;  // in the first, or nearly
    for (int axis = 0; axis < 3; ++axis) {
      for (int ulp = random.below(4); ulp > 0; --ulp)
        tip[axis] = std::nextafter(tip[axis], 1e9 * (random.uniform() - 0.5));
    }
    MeshBuilder first, second;
    first.triangle(p, q, r);
    second.triangle(tip, tip + size * random.direction(), tip + size * random.direction());
    const Mesh a = first.mesh(), b = second.mesh();
    for (World* world : {&carried, &smallest}) {
      const std::vector<BodyId> ids = add_bodies(*world, std::array{a, b});
      const Report& report = world->detect();
      ASSERT_EQ(report.stats().limits_reached, 0) << "case " << i;
      ASSERT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(std::array{a, b}), meeting_bodies(report, ids)))
          << "case " << i;
      for (const BodyId id : ids) world->remove_body(id);
    }
  }
}

// 19 coal#144: two boxes face to face met in one point at a corner, (0.995, -1, -1). A patch stands in their middle.
TEST(UserPains, PatchOfTwoBoxesFaceToFaceStandsInTheMiddle) {
  World world({.outputs = {.patches = true}});
  add_bodies(world, std::array{cube(2.0, {}), cube(2.0, {1.9999, 0.0, 0.0})});
  const auto contacts = world.detect().contacts();
  ASSERT_EQ(contacts.size(), 1u);
  ASSERT_EQ(contacts[0].patches().size(), 1u);
  const Patch& patch = contacts[0].patches()[0];
  EXPECT_LT((patch.point - Eigen::Vector3d(0.99995, 0.0, 0.0)).norm(), 0.1);
  EXPECT_GT(patch.direction.x(), 0.9);
  EXPECT_EQ(patch.facet_pairs.size(), contacts[0].facet_pairs().size());
}

// 21 openGJK#13: of 10,000 cubes deep in each other, two were called apart by tens of centimetres.
TEST(UserPains, CubesDeepInEachOtherAlwaysOverlap) {
  Random random(13);
  const Mesh unit = cube(1.0, {});
  World world({.threads = 1, .accuracy = Accuracy::hulls});
  const std::vector<BodyId> ids = add_bodies(world, std::array{unit, unit});
  for (int i = 0; i < 10000; ++i) {
    const Mesh a = rotated(unit, random.rotation());
    const Mesh turned = rotated(unit, random.rotation());
    const Mesh b = translated(turned, 0.49 * random.in_ball());  // the centre of b is inside a
    world.set_positions(ids[0], a.positions);
    world.set_positions(ids[1], b.positions);
    const auto contacts = world.detect().contacts();
    ASSERT_EQ(contacts.size(), 1u) << "pair " << i;
    ASSERT_GT(contacts[0].depth, 0.5) << "pair " << i;
    ASSERT_FALSE(contacts[0].limit_reached) << "pair " << i;
  }
}

// 26 ncollide#181: an assertion failed after 174,668 rounds of a loop.
TEST(UserPains, LongSoakOfOnePair) {
  Random random(26);
  const Mesh a = random_hull(12, 1), b = random_hull(12, 2);
  World world({.threads = 1, .accuracy = Accuracy::hulls});
  const std::vector<BodyId> ids = add_bodies(world, std::array{a, b});
  Vec3 at{0.5, 0.2, 0.1};
  for (int i = 0; i < 175000; ++i) {
    at = 0.999 * at + 0.05 * random.in_cube(1.0);
    const Mesh moved = translated(b, at);
    world.set_positions(ids[1], moved.positions);
    for (const Contact& contact : world.detect().contacts()) {
      ASSERT_FALSE(contact.limit_reached) << "step " << i;
      ASSERT_TRUE(contact.depth >= 0.0 && contact.depth < 4.0) << "step " << i << ", depth " << contact.depth;
      if (i % 1000 == 0) {
        ASSERT_TRUE(is_sound(contact, a, moved)) << "step " << i;
      }
    }
  }
}

// 28 JoltPhysics#943: 29 contacts in one run and 30 in the next, told from several threads at once.
TEST(UserPains, EventsAreSortedAndTheSameInEveryRun) {
  std::vector<std::vector<ContactEvent>> runs;
  for (int run = 0; run < 5; ++run) {
    World world({.threads = 4});
    std::vector<Mesh> bodies = crowd_of_blobs(50, 28);
    const std::vector<BodyId> ids = add_bodies(world, bodies);
    std::vector<ContactEvent> events;
    for (int step = 0; step < 3; ++step) {
      const Report& report = world.detect();
      for (const auto list : {report.began(), report.ended()}) {
        EXPECT_TRUE(std::ranges::is_sorted(list, [](const ContactEvent& x, const ContactEvent& y) {
          return std::pair(x.a.index, x.b.index) < std::pair(y.a.index, y.b.index);
        }));
        for (const ContactEvent& event : list) events.push_back({{event.a.index}, {event.b.index}});
      }
      for (std::size_t i = 0; i < bodies.size(); i += 2) {
        bodies[i] = translated(bodies[i], {0.3, 0.1, 0.0});
        world.set_positions(ids[i], bodies[i].positions);
      }
    }
    runs.push_back(std::move(events));
  }
  EXPECT_GT(runs[0].size(), 50u);
  for (const std::vector<ContactEvent>& run : runs) EXPECT_EQ(run, runs[0]);
}

// 29 JoltPhysics#789, 30 godot#27039, 32 bullet3#2829: soft bodies against soft bodies, cloth against all, by the same
// call.
TEST(UserPains, SoftBodiesAndClothMeetEachOther) {
  World world;
  std::vector<Mesh> bodies = {organ(1), organ(2), wrinkled_sheet(20, 1.5, 0.3, 3), wrinkled_sheet(16, 1.5, 0.3, 4)};
  std::vector<BodyId> ids;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    ids.push_back(world.add_body({.positions = bodies[i].positions,
                                  .facets = bodies[i].facets,
                                  .surface = i < 2 ? Surface::closed : Surface::sheet}));
  }
  for (int step = 0; step < 5; ++step) {
    const std::vector<MeetingBodies> found = meeting_bodies(world.detect(), ids);
    EXPECT_EQ(found.size(), 6u);
    EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(bodies), found));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i] = jittered(bodies[i], 0.01, 10 * i + static_cast<std::size_t>(step));
      world.set_positions(ids[i], bodies[i].positions);
    }
  }
}

// 33 bullet3#4588, 40 newton#3828: refitted boxes were wrong after scaling, or stale. Setting positions equals adding
// anew.
TEST(UserPains, SetPositionsEqualAddingAnew) {
  const std::array start = {blob(2, 1.0, 0.3, 1), translated(blob(2, 0.9, 0.3, 2), {1.0, 0.0, 0.0})};
  const Mesh noise = crumpled(start[0], 3);
  World world;
  const std::vector<BodyId> ids = add_bodies(world, start);
  for (const double scale : {1e3, 1e-3, 1.0}) {
    for (const Mesh& shape : {start[0], noise, stretched(start[0], {1e-6, 1.0, 50.0})}) {
      const std::array bodies = {scaled(shape, scale), scaled(start[1], scale)};
      for (std::size_t i = 0; i < 2; ++i) world.set_positions(ids[i], bodies[i].positions);
      EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_engine(bodies), meeting_bodies(world.detect(), ids))) << scale;
      EXPECT_TRUE(engine_agrees_with_oracle(bodies)) << scale;
    }
  }
}

// 39 newton#3795: 56,362 contacts of a cloth, room for 256, the rest lost in silence. Here every facet meets every
// other.
TEST(UserPains, NoFacetPairIsLostHoweverManyThereAre) {
  MeshBuilder upright, flat;
  for (int i = 0; i < 300; ++i) {
    const double t = 1e-3 * i;
    upright.triangle({t, 0.0, -1.0}, {t, 0.0, 2.0}, {t, 1.0, 0.0});
    flat.triangle({-1.0, -1.0, t}, {2.0, -1.0, t}, {0.0, 3.0, t});
  }
  const std::vector<FacetPair> found = facet_pairs_by_engine(upright.mesh(), flat.mesh());
  EXPECT_EQ(found.size(), 90000u);
  EXPECT_TRUE(engine_agrees_with_oracle(upright.mesh(), flat.mesh()));
}

// 41 newton#2409, mujoco_warp#1635: a deterministic mode that lost all contacts of one kind. There is one mode, and
// levels of accuracy agree where they overlap.
TEST(UserPains, LevelsAgreeOnHulls) {
  const std::vector<Mesh> bodies = crowd_of_blobs(30, 41);
  World hulls({.accuracy = Accuracy::hulls}), paper({.accuracy = Accuracy::paper}), exact;
  for (World* world : {&hulls, &paper, &exact}) add_bodies(*world, bodies);
  const auto a = hulls.detect().contacts(), b = paper.detect().contacts(), c = exact.detect().contacts();
  ASSERT_EQ(a.size(), c.size());
  ASSERT_EQ(b.size(), c.size());
  for (std::size_t i = 0; i < c.size(); ++i) {
    EXPECT_EQ(a[i].direction, c[i].direction);
    EXPECT_EQ(b[i].direction, c[i].direction);
    EXPECT_EQ(a[i].depth, c[i].depth);
    EXPECT_TRUE(std::ranges::includes(c[i].facet_pairs(), b[i].facet_pairs()));
  }
}

// ifc-lite#3561: one NaN hid a whole mesh. It is refused, and the body answers as before.
TEST(UserPains, NanHidesNothing) {
  const std::array bodies = {icosphere(1), translated(icosphere(1), {1.0, 0.0, 0.0})};
  World world;
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  const std::vector<MeetingBodies> expected = meeting_bodies(world.detect(), ids);
  ASSERT_EQ(expected.size(), 1u);
  Mesh broken = bodies[0];
  broken.positions(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(throws_error([&] { world.set_positions(ids[0], broken.positions); }, ErrorCode::non_finite_position));
  EXPECT_TRUE(same_meeting_bodies(expected, meeting_bodies(world.detect(), ids)));
}

// drake#23133: deformable bodies at rest should cost nothing.
TEST(UserPains, BodiesAtRestAreNotLookedAt) {
  World world;
  const std::vector<Mesh> bodies = crowd_of_blobs(40, 1);
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  world.detect();
  world.set_positions(ids[7], translated(bodies[7], {0.01, 0.0, 0.0}).positions);
  const StepStats stats = world.detect().stats();
  EXPECT_EQ(stats.moved_bodies, 1);
  EXPECT_GT(stats.kept_pairs, stats.candidate_pairs / 2);
  EXPECT_EQ(world.detect().stats().gjk_iterations, 0);
}

}  // namespace
}  // namespace tact::tests
