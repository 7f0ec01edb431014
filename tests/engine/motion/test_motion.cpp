// World::detect_motion(): sets against brute force, and what it promises of the world.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "tests/support/environment/allocation_hook.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/folds.h"
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

// A motion that no rigid body makes.
Eigen::Matrix3Xd moved(const Mesh& mesh, Vec3 way, double wildness, Random& random) {
  Eigen::Matrix3Xd end = mesh.positions;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = way + wildness * random.in_ball();
    end.col(v) += Eigen::Vector3d(p.x, p.y, p.z);
  }
  return end;
}

struct Couple {
  const char* name;
  MovingMesh a, b;
};

// Both about one axis that passes far from them.
Couple turned(const char* name, const Mesh& a, const Mesh& b) {
  const auto turn = [](const Mesh& mesh) {
    const Eigen::Vector3d pivot(3, 0, 0);
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    return Eigen::Matrix3Xd(((rotation * (mesh.positions.colwise() - pivot)).colwise() + pivot));
  };
  Couple couple{name, {a, turn(a)}, {b, turn(b)}};
  couple.b.end.row(0).array() -= 0.05;
  return couple;
}

std::vector<Couple> couples() {
  Random random(11);
  std::vector<Couple> all;
  const auto add = [&](const char* name, const Mesh& a, Vec3 way_a, const Mesh& b, Vec3 way_b, double wildness) {
    all.push_back({name, {a, moved(a, way_a, wildness, random)}, {b, moved(b, way_b, wildness, random)}});
  };
  const Mesh ball = blob(3, 1.0, 0.2, 1), other = translated(blob(3, 1.0, 0.2, 2), {3.0, 0.2, 0.1});
  add("balls that pass through each other", ball, {4, 0, 0}, other, {-4, 0, 0}, 0.0);
  add("balls that graze", ball, {0.6, 0, 0}, other, {-0.6, 0, 0}, 0.05);
  add("balls that overlap", ball, {0.1, 0, 0}, translated(other, {-1.8, 0, 0}), {-0.1, 0, 0}, 0.01);
  add("a sheet that a ball falls through", translated(icosphere(2), {0, 0, 3}), {0.1, 0.2, -7}, sheet(24, 24, 6, 6),
      {0, 0, 0.5}, 0.02);
  add("boxes on a grid, face to face", gridded_box({0, 0, 0}, {1, 1, 1}, 4), {0.5, 0, 0},
      gridded_box({1, 0, 0}, {2, 1, 1}, 4), {0, 0.25, 0}, 0.0);
  add("boxes on a grid that meet", gridded_box({0, 0, 0}, {1, 1, 1}, 4), {2, 0, 0},
      gridded_box({1.5, 0.25, 0}, {2.5, 1.25, 1}, 4), {0, 0, 0}, 0.0);
  add("soups", soup(120, 1.0, 3), {0.5, 0, 0}, soup(120, 1.0, 4), {-0.5, 0, 0}, 0.3);
  add("soups with facets without area", lattice_soup(150, 3, 5), {1, 1, 0}, lattice_soup(150, 3, 6), {0, 0, 1}, 0.0);
  add("needles", needles(100, 1e4, 7), {0.3, 0, 0}, needles(100, 1e4, 8), {-0.3, 0.1, 0}, 0.1);
  add("balls that graze, carried along", ball, {30.6, -7, 4}, other, {29.4, -7, 4}, 0.05);
  add("soups, carried along", soup(120, 1.0, 3), {0.5, 9, 0}, soup(120, 1.0, 4), {-0.5, 9, 0}, 0.3);
  all.push_back(turned("soups, turned by half a radian", soup(120, 1.0, 3), soup(120, 1.0, 4)));
  return all;
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

struct BallAndWall {
  tact::World world;
  Mesh ball = translated(icosphere(1, 0.1), {0, 0, 1}), wall = sheet(4, 4, 4, 4);
  BodyId flying = world.add_body({.positions = ball.positions, .facets = ball.facets});
  BodyId standing = world.add_body(
      {.positions = wall.positions, .facets = wall.facets, .surface = Surface::sheet, .motion = Motion::fixed});

  void put(double z) { world.set_positions(flying, translated(ball, {0, 0, z - 1.0}).positions); }
};

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

// A couple in a world that has seen where it begins.
struct CoupleOnItsWay {
  tact::World world;
  BodyId a, b;

  CoupleOnItsWay(const Couple& couple, double margin, int threads) : world({.threads = threads}) {
    a = world.add_body({.positions = couple.a.begin.positions, .facets = couple.a.begin.facets, .margin = margin});
    b = world.add_body({.positions = couple.b.begin.positions, .facets = couple.b.begin.facets, .margin = margin});
    world.detect();
  }
  void go(const Couple& couple, double part_a, double part_b) {
    // As two solvers write it.
    world.set_positions(a, couple.a.begin.positions + part_a * (couple.a.end - couple.a.begin.positions));
    world.set_positions(b, (1.0 - part_b) * couple.b.begin.positions + part_b * couple.b.end);
  }
};

AnswerHashes answer_of(tact::World& world, const MotionOptions& options) {
  AnswerHash answer;
  answer.add(world.detect_motion(options));
  return answer.hashes();
}

// What a call knows of an earlier one on a longer way changes no answer: two bodies that go the same part, or each its
// own, which is another way; and farther again.
TEST(DetectMotion, OnAPartOfAWayIsAsWithoutTheWholeOne) {
  const std::vector<Couple> every = couples();
  std::vector<Couple> all{every[2], every[5], every[10], every[1]};
  all.back().name = "balls that graze, far away";
  for (MovingMesh* const mesh : {&all.back().a, &all.back().b}) {
    mesh->begin.positions.array() += 3e5;
    mesh->end.array() += 3e5;
  }
  std::int64_t candidates = 0, without = 0;
  for (const Couple& couple : all) {
    for (const Impacts wanted : {Impacts::all, Impacts::first, Impacts::first_of_pair}) {
      const double margin = wanted == Impacts::first ? 0.02 : 0.0;
      CoupleOnItsWay known(couple, margin, 2), scratch(couple, margin, 1);
      known.go(couple, 1.0, 1.0);
      const double first = std::min(known.world.detect_motion(wanted).first_time(), 1.0);
      for (const auto [part, of_b] : {std::array{0.9, 0.9}, {0.6, 0.5}, {0.999 * first, 0.999 * first}, {0.3, 0.3}}) {
        if (!(part > 0.0)) continue;
        const MotionOptions options{.wanted = part == 0.3 ? Impacts::all : wanted, .bounds = part == 0.3};
        for (CoupleOnItsWay* const two : {&known, &scratch}) two->go(couple, part, of_b);
        scratch.world.set_margin(scratch.a, margin);  // it knows nothing of its way
        EXPECT_EQ(answer_of(known.world, options), answer_of(scratch.world, options))
            << couple.name << ", " << part << " and " << of_b << " of the way";
        if (&couple != &all.front() || wanted != Impacts::all || part != 0.9) continue;
        candidates += known.world.detect_motion(options).stats().candidates;
        scratch.world.set_margin(scratch.a, margin);
        without += scratch.world.detect_motion(options).stats().candidates;
      }
    }
  }
  EXPECT_LT(2 * candidates, without);
}

// What changes besides positions is seen by the next call on the same way.
TEST(DetectMotion, OnAPartOfAWayGoesByTheSettingsOfNow) {
  const Couple couple = couples()[2];
  using Change = std::function<void(CoupleOnItsWay&)>;
  const std::vector<Change> changes{
      [](CoupleOnItsWay& two) { two.world.set_margin(two.a, 0.1); },
      [](CoupleOnItsWay& two) { two.world.set_rest_offset(two.b, 0.01); },
      [](CoupleOnItsWay& two) { two.world.set_layers(two.a, 2, 2); },
      [](CoupleOnItsWay& two) { two.world.set_excluded(two.a, two.b, true); },
      [](CoupleOnItsWay& two) { two.world.set_self_contact(two.a, true); },
      [](CoupleOnItsWay& two) { two.world.set_motion(two.b, Motion::fixed); },
      [&](CoupleOnItsWay& two) {
        std::vector<int> map(static_cast<std::size_t>(couple.a.end.cols()));
        std::iota(map.begin(), map.end(), 0);
        two.world.set_facets(two.a, couple.a.end, couple.a.begin.facets.leftCols(100), map);
      },
      [](CoupleOnItsWay& two) { two.world.detect(); },
      [](CoupleOnItsWay& two) { two.world.restore(two.world.save()); },
  };
  for (const Change& change : changes) {
    CoupleOnItsWay known(couple, 0.02, 1), scratch(couple, 0.02, 1);
    for (CoupleOnItsWay* const two : {&known, &scratch}) {
      two->go(couple, 1.0, 1.0);
      if (two == &known) two->world.detect_motion();
      change(*two);
      if (two->world.motion(two->b) != Motion::fixed) two->go(couple, 0.7, 0.7);
    }
    EXPECT_EQ(answer_of(known.world, {}), answer_of(scratch.world, {})) << "change " << &change - changes.data();
  }
}

// A body that no step has seen has no way, wherever it is put: what was found of it at one place tells nothing of
// another.
TEST(DetectMotion, OnAPartOfAWayBodiesThatNoStepHasSeenMayBeAnywhere) {
  constexpr double kBeside =
      2.09;  // metres along x and y: the wall's corner is in the box of the ball's way, and not met
  for (const Motion motion : {Motion::deformable, Motion::rigid}) {
    BallAndWall scene;
    scene.world.remove_body(scene.standing);
    scene.world.detect();
    const BodyId late = scene.world.add_body(
        {.positions = scene.wall.positions, .facets = scene.wall.facets, .surface = Surface::sheet, .motion = motion});
    const auto put_late = [&](double beside) {
      if (motion == Motion::rigid) {
        scene.world.set_pose(late, Eigen::Matrix3d::Identity(), {beside, beside, 0.0});
      } else {
        scene.world.set_positions(late, translated(scene.wall, {beside, beside, 0.0}).positions);
      }
    };
    put_late(kBeside);
    scene.put(-1.0);
    EXPECT_TRUE(scene.world.detect_motion().impacts().empty());
    put_late(0.0);
    EXPECT_FALSE(scene.world.detect_motion().impacts().empty()) << static_cast<int>(motion);
  }
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
