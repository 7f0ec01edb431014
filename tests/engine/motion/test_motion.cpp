// World::detect_motion(): sets against brute force, and what it promises of the world.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/engine/motion/couples.h"
#include "tests/support/environment/allocation_hook.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/hashes/answer_hash.h"
#include "tests/support/oracles/motion_by_brute_force.h"

namespace tact::tests {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// The first of each pair of features: those that part may meet again, and stop then.
std::map<ImpactKey, double> impacts_of(const MotionReport& report, BodyId a, BodyId b) {
  std::map<ImpactKey, double> found;
  for (const Impact& impact : report.impacts()) {
    if (impact.a != a || impact.b != b) continue;
    const bool is_new = found.emplace(ImpactKey{impact.kind, impact.a_vertices, impact.b_vertices}, impact.time).second;
    EXPECT_TRUE(is_new || impact.stops);
  }
  return found;
}

TEST(DetectMotion, SetsEqualBruteForceForAnyNumberOfThreads) {
  for (const Couple& couple : couples()) {
    for (const double margin : {0.0, 0.02}) {
      const auto expected = impacts_by_brute_force(couple.a, couple.b, 2 * margin);
      EXPECT_FALSE(expected.empty()) << couple.name;
      for (const int threads : {1, 2, 3}) {
        tact::World world({.threads = threads});
        const BodyId a =
            world.add_body({.positions = couple.a.begin.positions, .facets = couple.a.begin.facets, .margin = margin});
        const BodyId b =
            world.add_body({.positions = couple.b.begin.positions, .facets = couple.b.begin.facets, .margin = margin});
        world.detect();
        world.set_positions(a, couple.a.end);
        world.set_positions(b, couple.b.end);
        const MotionReport& report = world.detect_motion();
        EXPECT_EQ(impacts_of(report, a, b), expected) << couple.name << ", " << threads << " threads";
        EXPECT_EQ(report.first_time(), report.pairs()[0].first_time);
        EXPECT_EQ(report.pairs()[0].impacts.size(), report.impacts().size());
      }
    }
  }
}

// A tip with many facets around it, more than planes are tried of, above a facet that has a corner there; they part.
Couple tips(Random& random) {
  constexpr int kAround = 96;
  const auto on_side = [&](int sign) {  // of a slanted plane through the tip
    for (;;) {
      const Eigen::Vector3d p(random.below(9) - 4, random.below(9) - 4, random.below(9) - 4);
      if (sign * (p.x() + 2.0 * p.y() + 3.0 * p.z()) >= 0.0 && !p.isZero()) return p;
    }
  };
  Mesh fan, facet;
  fan.positions = Eigen::Matrix3Xd::Zero(3, kAround + 1);
  fan.facets.resize(3, kAround);
  for (int i = 0; i < kAround; ++i) {
    fan.positions.col(i + 1) = on_side(1);
    fan.facets.col(i) << 0, i + 1, (i + 1) % kAround + 1;
  }
  facet.positions = Eigen::Matrix3Xd::Zero(3, 3);
  facet.positions.col(1) = on_side(-1);
  facet.positions.col(2) = on_side(-1);
  facet.facets.resize(3, 1);
  facet.facets << 0, 1, 2;
  return {"tips", {fan, translated(fan, {0, 0, random.uniform(0.0, 1.0)}).positions}, {facet, facet.positions}};
}

// Facets are grouped by where they are when a body is added: first scattered, then in their place.
TEST(DetectMotion, DoesNotDependOnHowFacetsAreGrouped) {
  std::vector<Couple> all = couples();
  Random of_tips(17);
  for (int i = 0; i < 200; ++i) all.push_back(tips(of_tips));
  for (const Couple& couple : all) {
    const auto answer = [&](bool scattered) {
      tact::World world({.threads = 1});
      Random random(18);
      for (const MovingMesh* mesh : {&couple.a, &couple.b}) {
        Mesh first = mesh->begin;
        if (scattered)
          first.positions = soup((mesh->begin.vertex_count() + 2) / 3, 1.0, random.bits())
                                .positions.leftCols(mesh->begin.vertex_count());
        const BodyId id =
            world.add_body({.positions = first.positions, .facets = first.facets, .surface = Surface::sheet});
        world.set_positions(id, mesh->begin.positions);
      }
      world.detect();
      for (const BodyId id : world.bodies()) world.set_positions(id, id.index == 0 ? couple.a.end : couple.b.end);
      AnswerHash hash;
      hash.add(world.detect_motion());
      return hash.hashes();
    };
    EXPECT_EQ(answer(false), answer(true)) << couple.name;
  }
}

TEST(DetectMotion, OfABodyWithItselfEqualsBruteForce) {
  Random random(12);
  for (const Mesh& mesh : {crumpled(sheet(16, 16, 1, 1), 5), blob(3, 1.0, 0.3, 6), soup(150, 1.0, 9)}) {
    const MovingMesh moving{mesh, moved(mesh, {1, 0, 0}, 0.2, random)};
    for (const double margin : {0.0, 0.01}) {
      const auto expected = self_impacts_by_brute_force(moving, 2 * margin);
      EXPECT_GT(expected.size(), 10u);
      tact::World world({.threads = 2});
      const BodyId id = world.add_body({.positions = mesh.positions,
                                        .facets = mesh.facets,
                                        .surface = Surface::sheet,
                                        .margin = margin,
                                        .self_contact = true});
      world.detect();
      world.set_positions(id, moving.end);
      EXPECT_EQ(impacts_of(world.detect_motion(), id, id), expected);
      world.set_self_contact(id, false);
      EXPECT_TRUE(world.detect_motion().impacts().empty());
    }
  }
}

// What is flat, and moves in its plane without a facet that is turned over, has no contact with itself, so it has no
// impact.
TEST(DetectMotion, OfAFlatSheetInItsPlaneIsNone) {
  struct InPlane {
    const char* name;
    double xx, xy, yx, yy;
  };
  const InPlane ways[] = {{"shrinks", 0.6, 0, 0, 0.6},        {"shrinks to a tenth", 0.1, 0, 0, 0.1},
                          {"narrows", 0.3, 0, 0, 1},          {"is pulled", 0.6, 0, 0, 1.4},
                          {"is sheared", 1, 0.7, 0, 1},       {"is sheared back", 1, -0.7, 0, 0.8},
                          {"turns", 0.6, 0.4, -0.4, 0.6},     {"shrinks and is sheared", 0.7, -0.3, 0.2, 0.5},
                          {"hardly moves", 0.98, 0, 0, 1.01}, {"grows", 1.5, 0.1, 0.1, 1.5}};
  Random random(21);
  for (const InPlane& way : ways) {
    for (const bool is_even : {true, false}) {
      Mesh mesh = sheet(9, 7, 9.0, 7.0);
      if (!is_even) mesh = mapped(jittered(mesh, 0.15, 5), [](Vec3 p) { return Vec3{p.x, p.y, 0.0}; });
      const Rotation turn = random.rotation();
      const Mesh end = mapped(mesh, [&](Vec3 p) {
        return Vec3{way.xx * p.x + way.xy * p.y, way.yx * p.x + way.yy * p.y, 0.0};
      });
      for (const double margin : {0.05, 0.2, 0.3, 0.45, 1.3}) {
        tact::World world({.threads = 2, .outputs = {.points = true}});
        const BodyId id = world.add_body({.positions = rotated(mesh, turn).positions,
                                          .facets = mesh.facets,
                                          .surface = Surface::sheet,
                                          .margin = margin,
                                          .self_contact = true});
        world.detect();
        world.set_positions(id, rotated(end, turn).positions);
        const std::size_t impacts = world.detect_motion().impacts().size();
        EXPECT_EQ(impacts, 0u) << way.name << ", margin " << margin;
        EXPECT_TRUE(world.detect().contacts().empty()) << way.name << ", margin " << margin;
      }
    }
  }
}

// A sheet that folds: where its layers come within the margins there are impacts, and stopped before the first one it
// has a gap at least.
TEST(DetectMotion, OfASheetThatFoldsIsFound) {
  const Mesh flat = sheet(24, 6, 1.0, 0.3);
  const double margin = 0.01;
  MovingMesh closing{pleated(flat, 2, 0.3, 0.1), pleated(flat, 2, 0.3, 0.2).positions};
  const auto expected = self_impacts_by_brute_force(closing, 2 * margin);
  ASSERT_GT(expected.size(), 10u);
  tact::World world({.threads = 2, .outputs = {.points = true}});
  const BodyId id = world.add_body({.positions = closing.begin.positions,
                                    .facets = flat.facets,
                                    .surface = Surface::sheet,
                                    .margin = margin,
                                    .self_contact = true});
  ASSERT_TRUE(world.detect().contacts().empty());
  world.set_positions(id, closing.end);
  const MotionReport& report = world.detect_motion();
  EXPECT_EQ(impacts_of(report, id, id), expected);
  const double first = report.first_time();
  ASSERT_LT(first, 1.0);
  const auto at = [&](double time) {
    return Eigen::Matrix3Xd(closing.begin.positions + time * (closing.end - closing.begin.positions));
  };
  world.set_positions(id, at(first - 1e-6));
  EXPECT_TRUE(world.detect().contacts().empty());
  world.set_positions(id, at(first + 1e-6));
  ASSERT_EQ(world.detect().contacts().size(), 1u);
}

// Boxes on a grid of tenths, one of which passes the other diagonally: they come as near as the distance of boxes says.
TEST(DetectMotion, OfBoxesThatPassCornerToCornerIsRight) {
  const Mesh still = box({0, 0, 0}, {1, 1, 1});
  int meeting = 0, missing = 0;
  for (int i = 0; i < 19; ++i) {
    for (int k = 0; k < 19; ++k) {
      const Vec3 begin{0.1 * i + 0.4, 0.1 * k + 0.1, 0.25}, way{-1.0, 1.0, 0.0};
      // Of boxes that do not turn the square of the distance is convex in time.
      const auto gap = [&](double t) {
        const auto beyond = [](double d) { return std::max(std::abs(d) - 1.0, 0.0); };
        return std::hypot(beyond(begin.x + t * way.x), beyond(begin.y + t * way.y));
      };
      double low = 0.0, high = 1.0;
      for (int step = 0; step < 200; ++step) {
        const double t = low + (high - low) / 3.0, u = high - (high - low) / 3.0;
        (gap(t) <= gap(u) ? high : low) = gap(t) <= gap(u) ? u : t;
      }
      const double least = gap(low);
      if (gap(0.0) <= 0.11 || std::abs(least - 0.1) < 1e-9) continue;  // begins within the margins; touches them
      tact::World world({.threads = 1});
      world.add_body({.positions = still.positions, .facets = still.facets, .margin = 0.05});
      const Mesh mover = translated(still, begin);
      const BodyId id = world.add_body({.positions = mover.positions, .facets = mover.facets, .margin = 0.05});
      world.detect();
      world.set_positions(id, translated(mover, way).positions);
      const double time = world.detect_motion().first_time();
      (least < 0.1 ? meeting : missing) += 1;
      EXPECT_EQ(time <= 1.0, least < 0.1) << i << ' ' << k << ", least distance " << least << ", time " << time;
      if (time <= 1.0) {
        EXPECT_NEAR(gap(time), 0.1, 1e-9) << i << ' ' << k;
      }
    }
  }
  EXPECT_GT(meeting, 30);
  EXPECT_GT(missing, 50);
}

TEST(DetectMotion, GoesFromTheLastStepHoweverOftenPositionsAreSet) {
  BallAndWall scene;
  scene.put(2.0);
  EXPECT_EQ(scene.world.detect_motion().first_time(), kNever);  // no step has seen it: it stands
  scene.put(1.0);
  scene.world.detect();
  EXPECT_EQ(scene.world.detect_motion().first_time(), kNever);
  for (const double z : {0.5, -3.0, -1.0}) scene.put(z);
  EXPECT_NEAR(scene.world.detect_motion().first_time(), 0.45, 1e-9);
  scene.put(-3.0);
  EXPECT_NEAR(scene.world.detect_motion().first_time(), 0.225, 1e-9);
  EXPECT_NEAR(scene.world.detect_motion(Impacts::first).first_time(), 0.225, 1e-9);
  scene.put(1.0);
  EXPECT_EQ(scene.world.detect_motion().first_time(), kNever);
  scene.put(-1.0);
  scene.world.detect();
  EXPECT_EQ(scene.world.detect_motion().first_time(), kNever);
  scene.put(1.0);
  EXPECT_NEAR(scene.world.detect_motion().first_time(), 0.45, 1e-9);
}

TEST(DetectMotion, PositionsThatAreRefusedChangeNothing) {
  BallAndWall scene;
  scene.world.detect();
  Eigen::Matrix3Xd bad = scene.ball.positions;
  bad(2, 3) = std::nan("");
  EXPECT_THROW(scene.world.set_positions(scene.flying, bad), Error);
  EXPECT_EQ(scene.world.detect_motion().first_time(), kNever);
  scene.put(-1.0);
  EXPECT_THROW(scene.world.set_positions(scene.flying, bad), Error);
  EXPECT_NEAR(scene.world.detect_motion().first_time(), 0.45, 1e-9);
}

TEST(DetectMotion, MarginsLayersAndMovesOfOthersCount) {
  BallAndWall scene;
  scene.world.detect();
  scene.put(-1.0);
  scene.world.set_margin(scene.flying, 0.1);
  EXPECT_NEAR(scene.world.detect_motion().first_time(), 0.40, 1e-9);
  scene.world.set_margin(scene.standing, 0.1);
  EXPECT_NEAR(scene.world.detect_motion().first_time(), 0.35, 1e-9);
  scene.world.set_layers(scene.flying, 2, 2);
  EXPECT_EQ(scene.world.detect_motion().first_time(), kNever);
  EXPECT_EQ(scene.world.detect_motion().stats().body_pairs, 0);
}

TEST(DetectMotion, RemovedAndAddedBodies) {
  BallAndWall scene;
  scene.world.detect();
  scene.put(-1.0);
  const BodyId second =
      scene.world.add_body({.positions = translated(scene.ball, {0, 0, -0.5}).positions, .facets = scene.ball.facets});
  const MotionReport& report = scene.world.detect_motion();
  ASSERT_EQ(report.pairs().size(), 2u);
  EXPECT_EQ(report.pairs()[1].b, second);
  scene.world.remove_body(scene.standing);
  EXPECT_EQ(scene.world.detect_motion().pairs().size(), 1u);
  scene.world.remove_body(scene.flying);
  EXPECT_EQ(scene.world.detect_motion().first_time(), kNever);
  const BodyId third = scene.world.add_body({.positions = scene.ball.positions, .facets = scene.ball.facets});
  EXPECT_EQ(third.index, scene.flying.index);
  scene.world.set_positions(third, translated(scene.ball, {0, 0, -5}).positions);
  EXPECT_EQ(scene.world.detect_motion().first_time(), kNever);
}

TEST(DetectMotion, ChangesNoHistory) {
  Random random(13);
  const Mesh mesh = blob(3, 1.0, 0.2, 1);
  tact::World plain({.threads = 2}), asked({.threads = 2});
  std::vector<BodyId> ids;
  for (int i = 0; i < 6; ++i) {
    const Mesh body = translated(mesh, 3.0 * random.in_cube(1.0));
    ids.push_back(plain.add_body({.positions = body.positions, .facets = body.facets}));
    asked.add_body({.positions = body.positions, .facets = body.facets});
  }
  for (int step = 0; step < 12; ++step) {
    for (std::size_t i = step % 2; i < ids.size(); i += 2) {
      const Mesh body = translated(mesh, 3.0 * random.in_cube(1.0));
      plain.set_positions(ids[i], body.positions);
      asked.set_positions({ids[i].index, ids[i].generation, asked.bodies()[0].world}, body.positions);
    }
    asked.detect_motion(static_cast<Impacts>(step % 3));
    ASSERT_EQ(plain.detect().hash(), asked.detect().hash()) << step;
  }
}

TEST(DetectMotion, TheFirstIsTheFirstOfAll) {
  for (const int threads : {1, 3}) {
    Random random(14);
    tact::World world({.threads = threads});
    const Mesh mesh = blob(2, 1.0, 0.2, 1);
    std::vector<BodyId> ids;
    for (int i = 0; i < 16; ++i) {
      const Mesh body = translated(mesh, 5.0 * random.in_cube(1.0));
      ids.push_back(world.add_body({.positions = body.positions, .facets = body.facets}));
    }
    for (int step = 0; step < 2; ++step) {
      world.detect();
      for (const BodyId id : ids) world.set_positions(id, translated(mesh, 5.0 * random.in_cube(1.0)).positions);
      std::vector<Impact> firsts;
      for (const ImpactPair& pair : world.detect_motion().pairs()) firsts.push_back(pair.impacts[0]);
      ASSERT_GT(firsts.size(), 5u);
      const auto equal = [](const Impact& x, const Impact& y) {
        return x.a == y.a && x.b == y.b && x.kind == y.kind && x.time == y.time && x.a_vertices == y.a_vertices &&
               x.b_vertices == y.b_vertices;
      };
      const auto found = world.detect_motion(Impacts::first_of_pair).impacts();
      EXPECT_TRUE(std::ranges::equal(found, firsts, equal));
      const auto first = std::ranges::min_element(firsts, {}, &Impact::time);
      const MotionReport& report = world.detect_motion(Impacts::first);
      ASSERT_EQ(report.impacts().size(), 1u);
      EXPECT_TRUE(equal(report.impacts()[0], *first));
      EXPECT_EQ(report.first_time(), first->time);
      const auto stats_of = [&](Impacts wanted) {
        world.set_margin(ids[0], 0.0);  // it knows nothing of its way
        return world.detect_motion(wanted).stats();
      };
      const MotionStats alone = stats_of(Impacts::first), every = stats_of(Impacts::all);
      EXPECT_LT(2 * alone.candidates, every.candidates);
      EXPECT_EQ(alone.cluster_pairs, every.cluster_pairs);
    }
  }
}

TEST(DetectMotion, AWorldThatMovesByTheFirstTimeNeverCrosses) {
  Random random(15);
  tact::World world({.threads = 2});
  const Mesh mesh = blob(1, 0.3, 0.2, 1);
  std::vector<BodyId> ids;
  std::vector<Mesh> bodies;
  for (int i = 0; i < 27; ++i) {
    bodies.push_back(translated(mesh, {double(i % 3), double(i / 3 % 3), double(i / 9)}));
    ids.push_back(world.add_body({.positions = bodies.back().positions, .facets = bodies.back().facets}));
  }
  ASSERT_EQ(world.detect().stats().facet_pairs, 0);
  int stopped = 0;
  for (int step = 0; step < 200; ++step) {
    std::vector<Eigen::Matrix3Xd> ways;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const Vec3 way = 2.0 * random.in_ball();
      ways.push_back(moved(mesh, way, 0.02, random) - mesh.positions);
      world.set_positions(ids[i], bodies[i].positions + ways[i]);
    }
    const double first = world.detect_motion(Impacts::first).first_time();
    stopped += first <= 1.0;
    const double part = std::min(1.0, 0.999 * first);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      bodies[i].positions += part * ways[i];
      world.set_positions(ids[i], bodies[i].positions);
    }
    ASSERT_EQ(world.detect_motion().first_time(), kNever) << step;
    ASSERT_EQ(world.detect().stats().facet_pairs, 0) << step;
  }
  EXPECT_GT(stopped, 100);
}

// A ball falls on a wall. Each step it goes as far as nothing meets; where detect() finds it within the margins, it is
// pushed to half their sum. It gets on at every step, comes to rest there, and never comes through.
TEST(DetectMotion, ASolverThatStopsBeforeImpactsSettlesWithinTheMargins) {
  constexpr double kStep = 1.0 / 60.0, kReach = 0.01;
  BallAndWall scene;
  scene.world.set_margin(scene.flying, kReach);
  scene.world.set_margin(scene.standing, kReach);
  scene.world.detect();
  double z = 1.0, velocity = 0.0, gap = 1.0;
  int stalled = 0, in_contact = 0;
  for (int step = 0; step < 300; ++step) {
    velocity -= 9.81 * kStep;
    if (gap < 2 * kReach) velocity = std::max(velocity, 0.2 * (kReach - gap) / kStep);
    scene.put(z + kStep * velocity);
    const double part = std::min(1.0, 0.99 * scene.world.detect_motion(Impacts::first).first_time());
    stalled += part < 0.1 ? 1 : 0;
    z += part * kStep * velocity;
    scene.put(z);
    const Report& report = scene.world.detect();
    ASSERT_EQ(report.stats().facet_pairs, 0) << step;
    gap = report.contacts().empty() ? 1.0 : -report.contacts()[0].depth;
    in_contact += report.contacts().empty() ? 0 : 1;
  }
  EXPECT_LE(stalled, 3);
  EXPECT_GT(in_contact, 200);
  EXPECT_NEAR(gap, kReach, 1e-6);
}

TEST(DetectMotion, SteadyStepsAllocateNothing) {
  const Couple couple = couples()[0];
  tact::World world({.threads = 1});
  const BodyId a = world.add_body({.positions = couple.a.begin.positions, .facets = couple.a.begin.facets});
  world.add_body({.positions = couple.b.begin.positions, .facets = couple.b.begin.facets});
  // What a step besides allocates is asked elsewhere.
  const auto allocations_of_step = [&] {
    const long before = allocation_count();
    world.set_positions(a, couple.a.end);
    world.detect_motion();
    world.set_positions(a, couple.a.begin.positions);
    world.detect_motion(Impacts::first);
    const long after = allocation_count();
    world.detect();
    return after - before;
  };
  for (int i = 0; i < 3; ++i) allocations_of_step();
  EXPECT_EQ(allocations_of_step(), 0);
}

// A vertex that flies through a facet, and one that misses it by a whole size, in any unit.
TEST(DetectMotion, FindsSubnormalImpactsAtTheirTime) {
  Eigen::Matrix3Xd wall(3, 3), hits(3, 3);
  wall << 0, 4, 0, 0, 0, 4, 0, 0, 0;
  hits << 1, 2, 1, 1, 1, 2, 4, 5, 5;
  const Eigen::Matrix3Xi facet = Eigen::Vector3i(0, 1, 2);
  for (const int power : {0, 900, 1000, 1020, 1022, 1030, 1040, 1060, 1070}) {
    for (const double miss : {0.0, 8.0}) {
      const double unit = std::ldexp(1.0, -power);
      Eigen::Matrix3Xd begin = hits;
      begin.row(0).array() += miss;
      Eigen::Matrix3Xd end = begin;
      end.row(2).array() -= 8.0;
      World world({.threads = 1});
      world.add_body({.positions = unit * wall, .facets = facet, .surface = Surface::sheet});
      const BodyId flying = world.add_body({.positions = unit * begin, .facets = facet, .surface = Surface::sheet});
      world.detect();
      world.set_positions(flying, unit * end);
      const MotionReport& report = world.detect_motion();
      EXPECT_EQ(report.impacts().size(), miss == 0.0 ? 3u : 0u) << power;
      if (miss == 0.0) {
        EXPECT_NEAR(report.first_time(), 0.5, 1e-6) << power;
      }
    }
  }
}

TEST(DetectMotion, RefusesWhatIsNoName) {
  tact::World world;
  try {
    world.detect_motion(static_cast<Impacts>(3));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
  }
  EXPECT_EQ(world.detect_motion().first_time(), kNever);
}

}  // namespace
}  // namespace tact::tests
