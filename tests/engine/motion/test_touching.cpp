// Features that share a point when a step begins: what goes on into the other stops, what parts or slides does not.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/generators/remeshed.h"

namespace tact::tests {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct BoxOnFloor {
  Mesh box, floor;
  tact::World world{{.threads = 1}};
  BodyId standing, moving;

  BoxOnFloor(const Mesh& ground, Surface surface, double margin, Vec3 at = {0.1, 0.2, 0.0})
      : box(translated(tests::box({0, 0, 0}, {1, 1, 1}), at)), floor(ground) {
    standing =
        world.add_body({.positions = floor.positions, .facets = floor.facets, .surface = surface, .margin = margin});
    moving = world.add_body({.positions = box.positions, .facets = box.facets, .margin = margin});
    world.detect();
  }
  const MotionReport& go(Vec3 way, Impacts wanted = Impacts::all) {
    world.set_positions(moving, translated(box, way).positions);
    return world.detect_motion(wanted);
  }
};

// The loop of the manual.
int steps_until_there(BoxOnFloor& scene, Vec3 way) {
  double part = 0.0;
  int steps = 0;
  for (; steps < 200 && 1.0 - part > 1e-9; ++steps) {
    const Mesh start = translated(scene.box, part * way);
    const double first = scene.go(way, Impacts::first).first_time();
    part += std::min(1.0, 0.999 * first) * (1.0 - part);
    scene.world.set_positions(scene.moving, translated(scene.box, part * way).positions);
    scene.world.detect();
  }
  return steps;
}

TEST(TouchingMotion, ABoxThatStandsOnAFloorLeavesAndSlides) {
  const Mesh sheet_floor = sheet(4, 4, 8.0, 8.0), slab = tests::box({-4, -4, -1}, {4, 4, 0});
  for (const double margin : {0.0, 0.01}) {
    for (const Vec3 way : {Vec3{0, 0, 1}, Vec3{1, 0.5, 0}, Vec3{0.5, 0, 0.5}, Vec3{-2.5, 0, 0}}) {
      BoxOnFloor on_sheet(sheet_floor, Surface::sheet, margin), on_slab(slab, Surface::closed, margin);
      EXPECT_EQ(steps_until_there(on_sheet, way), 1) << margin << ' ' << way.x << ' ' << way.z;
      EXPECT_EQ(steps_until_there(on_slab, way), 1) << margin << ' ' << way.x << ' ' << way.z;
    }
  }
}

TEST(TouchingMotion, WhatGoesOnIntoTheOtherStopsAtOnce) {
  for (const double margin : {0.0, 0.01}) {
    for (const Vec3 way : {Vec3{0, 0, -0.1}, Vec3{1, 0, -1e-9}, Vec3{0, 0, -3}}) {
      BoxOnFloor scene(sheet(4, 4, 8.0, 8.0), Surface::sheet, margin);
      const MotionReport& report = scene.go(way);
      EXPECT_EQ(report.first_time(), 0.0);
      EXPECT_TRUE(std::ranges::any_of(report.impacts(), &Impact::stops));
      EXPECT_EQ(scene.go(way, Impacts::first).first_time(), 0.0);
    }
  }
}

TEST(TouchingMotion, WhatPartsIsListedAndMarked) {
  BoxOnFloor scene(sheet(4, 4, 8.0, 8.0), Surface::sheet, 0.0);
  const MotionReport& report = scene.go({0, 0, 1});
  EXPECT_EQ(report.first_time(), kInfinite);
  ASSERT_EQ(report.pairs().size(), 1u);
  EXPECT_EQ(report.pairs()[0].first_time, kInfinite);
  EXPECT_GE(report.impacts().size(), 4u);
  for (const Impact& impact : report.impacts()) {
    EXPECT_EQ(impact.time, 0.0);
    EXPECT_FALSE(impact.stops);
  }
  EXPECT_TRUE(scene.go({0, 0, 1}, Impacts::first).impacts().empty());
  EXPECT_TRUE(scene.go({0, 0, 1}, Impacts::first_of_pair).impacts().empty());
}

// One corner of a box that tips over goes down, the others go up.
TEST(TouchingMotion, OneCornerThatGoesDownStops) {
  BoxOnFloor scene(sheet(4, 4, 8.0, 8.0), Surface::sheet, 0.0);
  Eigen::Matrix3Xd end = scene.box.positions;
  end.row(2).array() += 0.5;
  Eigen::Index lowest = 0;
  scene.box.positions.colwise().sum().minCoeff(&lowest);
  end(2, lowest) = -0.01;
  scene.world.set_positions(scene.moving, end);
  EXPECT_EQ(scene.world.detect_motion().first_time(), 0.0);
}

// A box slides on its floor into a wall, and over the border of the floor.
TEST(TouchingMotion, WhatSlidesIsStoppedByWhatStandsInTheWay) {
  BoxOnFloor scene(sheet(4, 4, 8.0, 8.0), Surface::sheet, 0.0);
  const Mesh wall = tests::box({2.1, -1, 0}, {3, 3, 2});
  scene.world.add_body({.positions = wall.positions, .facets = wall.facets});
  scene.world.detect();
  EXPECT_NEAR(scene.go({2, 0, 0}).first_time(), 0.5, 1e-6);
  EXPECT_EQ(scene.go({0, 3.7, 0}).first_time(), kInfinite);
}

// Sheets in one plane whose borders come together in it.
TEST(TouchingMotion, BordersThatMeetInAPlaneStop) {
  const Mesh left = sheet(3, 3, 1.0, 1.0), right = translated(left, {1.5, 0.1, 0});
  tact::World world({.threads = 1});
  world.add_body({.positions = left.positions, .facets = left.facets, .surface = Surface::sheet});
  const BodyId moving =
      world.add_body({.positions = right.positions, .facets = right.facets, .surface = Surface::sheet});
  world.detect();
  world.set_positions(moving, translated(right, {-1.0, 0, 0}).positions);
  EXPECT_NEAR(world.detect_motion().first_time(), 0.5, 1e-6);
}

// Exact for the whole numbers that are given.
double volume(const Eigen::Matrix3Xd& x, int a, int b, int c, const Eigen::Vector3d& p) {
  return (x.col(b) - x.col(a)).cross(x.col(c) - x.col(a)).dot(p - x.col(a));
}

// Whether an edge of a facet of the one goes through the inside of a facet of the other.
bool any_edge_through(const Mesh& a, const Eigen::Matrix3Xd& at_a, const Mesh& b, const Eigen::Matrix3Xd& at_b) {
  for (int f = 0; f < a.facet_count(); ++f) {
    const auto c = a.facets.col(f);
    for (int g = 0; g < b.facet_count(); ++g) {
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d p = at_b.col(b.facets(k, g)), q = at_b.col(b.facets((k + 1) % 3, g));
        const double of_p = volume(at_a, c[0], c[1], c[2], p), of_q = volume(at_a, c[0], c[1], c[2], q);
        if (!(of_p * of_q < 0.0)) continue;
        double sides[3];
        for (int s = 0; s < 3; ++s) sides[s] = (q - p).dot((at_a.col(c[s]) - p).cross(at_a.col(c[(s + 1) % 3]) - p));
        const auto [low, high] = std::minmax({sides[0], sides[1], sides[2]});
        if (low > 0.0 || high < 0.0) return true;
      }
    }
  }
  return false;
}

// Small bodies on a lattice, touching in all ways. All numbers are whole, and stay so at eighths of the way times
// eight.
TEST(TouchingMotion, NothingCrossesBeforeTheFirstStop) {
  Random random(31);
  int marked = 0, free = 0;
  for (int round = 0; round < 3000; ++round) {
    Mesh bodies[2];
    Eigen::Matrix3Xd ends[2];
    for (int i = 0; i < 2; ++i) {
      bodies[i] = random.chance(0.5) ? tests::box({0, 0, 0}, {1, 1, 1}) : lattice_soup(2, 2, random.bits());
      const Vec3 at{double(random.below(3)) - 1, double(random.below(3)) - 1, double(random.below(3)) - 1};
      bodies[i] = translated(bodies[i], at);
      ends[i] = bodies[i].positions;
      const bool rigid = random.chance(0.5);
      Eigen::Vector3d way(0, 0, 0);
      for (int v = 0; v < ends[i].cols(); ++v) {
        if (v == 0 || !rigid) way = Eigen::Vector3d(random.below(3) - 1, random.below(3) - 1, random.below(3) - 1);
        ends[i].col(v) += way;
      }
    }
    if (any_edge_through(bodies[0], bodies[0].positions, bodies[1], bodies[1].positions) ||
        any_edge_through(bodies[1], bodies[1].positions, bodies[0], bodies[0].positions))
      continue;
    tact::World world({.threads = 1});
    BodyId ids[2];
    for (int i = 0; i < 2; ++i)
      ids[i] =
          world.add_body({.positions = bodies[i].positions, .facets = bodies[i].facets, .surface = Surface::sheet});
    world.detect();
    for (int i = 0; i < 2; ++i) world.set_positions(ids[i], ends[i]);
    const MotionReport& report = world.detect_motion();
    const double first = report.first_time();
    marked += std::ranges::any_of(report.impacts(), [](const Impact& impact) { return !impact.stops; }) ? 1 : 0;
    free += first > 1.0 ? 1 : 0;
    for (int eighth = 1; eighth <= 8 && eighth / 8.0 < first; ++eighth) {
      Eigen::Matrix3Xd at[2];
      for (int i = 0; i < 2; ++i) at[i] = 8.0 * bodies[i].positions + eighth * (ends[i] - bodies[i].positions);
      ASSERT_FALSE(any_edge_through(bodies[0], at[0], bodies[1], at[1])) << round << ' ' << eighth << ' ' << first;
      ASSERT_FALSE(any_edge_through(bodies[1], at[1], bodies[0], at[0])) << round << ' ' << eighth << ' ' << first;
    }
  }
  EXPECT_GT(marked, 200);
  EXPECT_GT(free, 200);
}

// The facets right of the middle have vertices of their own along it, below the tip at zero.
Remeshed slit(const Mesh& mesh) {
  Remeshed to = unchanged(mesh);
  std::vector<int> twin(to.vertex_map.size(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.position(v).x != 0.0 || !(mesh.position(v).y < 0.0)) continue;
    twin[static_cast<std::size_t>(v)] = static_cast<int>(to.vertex_map.size());
    to.vertex_map.push_back(v);
  }
  to.mesh.positions.conservativeResize(3, static_cast<Eigen::Index>(to.vertex_map.size()));
  for (int v = mesh.vertex_count(); v < to.mesh.vertex_count(); ++v)
    to.mesh.set_position(v, mesh.position(to.vertex_map[static_cast<std::size_t>(v)]));
  for (auto facet : to.mesh.facets.colwise()) {
    if (!std::ranges::any_of(facet, [&](int v) { return mesh.position(v).x > 0.0; })) continue;
    for (int& v : facet) v = twin[static_cast<std::size_t>(v)] < 0 ? v : twin[static_cast<std::size_t>(v)];
  }
  return to;
}

// A sheet that was slit, somewhere in space.
struct SlitSheet {
  Mesh whole = sheet(8, 8, 1.0, 1.0);
  Remeshed cut = slit(whole);
  Rotation turn;
  Random random;
  tact::World world{{.threads = 1}};
  BodyId body;

  SlitSheet(std::uint64_t seed, double margin) : random(seed) {
    turn = seed == 0 ? Rotation{} : rotation(random.uniform(0.5, 1), random.uniform(-1, 1), random.uniform(-1, 1), 0.2);
    body = world.add_body({.positions = rotated(whole, turn).positions,
                           .facets = whole.facets,
                           .surface = Surface::sheet,
                           .margin = margin,
                           .self_contact = true});
    world.detect();
    world.set_facets(body, rotated(cut.mesh, turn).positions, cut.mesh.facets, cut.vertex_map);
  }
  bool is_right(int v) const { return v >= whole.vertex_count() || whole.position(v).x > 0.0; }
  // Bends all by `bends`, and moves the right side away by `opens` of how far it is below the tip, with some noise.
  void move(double opens, double bends, double noise) {
    Mesh end = cut.mesh;
    for (int v = 0; v < end.vertex_count(); ++v) {
      Vec3 at = end.position(v);
      const double below = std::max(0.0, -at.y), wave = bends * std::sin(5.0 * at.y);
      at = at + Vec3{wave, 0.0, wave + bends * at.x * at.x};
      const auto some = [&] { return noise * opens * below * random.uniform(-1, 1); };
      if (is_right(v)) at = at + Vec3{opens * below + some(), some(), some()};
      end.set_position(v, at);
    }
    world.set_positions(body, rotated(end, turn).positions);
  }
};

TEST(TouchingMotion, TheWallsOfACutPartHoweverTheyBend) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    for (const double margin : {0.0, 0.0005}) {
      for (const double opens : {1e-6, 1e-3, 0.1}) {
        SlitSheet scene(seed, margin);
        scene.move(opens, seed % 3 == 0 ? 0.0 : 0.03, seed % 2 == 0 ? 0.0 : 0.3);
        const MotionReport& report = scene.world.detect_motion();
        EXPECT_EQ(report.first_time(), kInfinite) << seed << ' ' << margin << ' ' << opens;
        EXPECT_FALSE(report.impacts().empty());
        EXPECT_EQ(scene.world.detect_motion(Impacts::first).first_time(), kInfinite);
      }
    }
  }
}

TEST(TouchingMotion, TheWallsOfACutThatGoTogetherDoNotStop) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SlitSheet scene(seed, 0.0);
    EXPECT_EQ(scene.world.detect_motion().first_time(), kInfinite);
    scene.move(0.0, 0.03, 0.0);
    EXPECT_EQ(scene.world.detect_motion().first_time(), kInfinite) << seed;
  }
}

TEST(TouchingMotion, TheWallsOfACutThatGoIntoEachOtherStop) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SlitSheet scene(seed, 0.0);
    scene.move(-0.01, 0.0, 0.0);
    EXPECT_EQ(scene.world.detect_motion().first_time(), 0.0) << seed;
    EXPECT_EQ(scene.world.detect_motion(Impacts::first).first_time(), 0.0) << seed;
  }
}

// Two halves of a solid, facets back to back.
TEST(TouchingMotion, TheHalvesOfASolidPart) {
  const Mesh left = gridded_box({-1, 0, 0}, {0, 1, 1}, 4);
  const Mesh right = turned_inside_out(mapped(left, [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; }));
  const Mesh both = merged(std::array{left, right});
  Random random(5);
  for (const Rotation& turn : {Rotation{}, rotation(0.9, 0.3, -0.2, 0.5)}) {
    for (const double noise : {0.0, 0.3}) {
      tact::World world({.threads = 1});
      const BodyId body =
          world.add_body({.positions = rotated(both, turn).positions, .facets = both.facets, .self_contact = true});
      world.detect();
      Mesh end = both;
      for (int v = left.vertex_count(); v < both.vertex_count(); ++v) {
        const auto some = [&] { return 0.01 * noise * random.uniform(-1, 1); };
        end.set_position(v, both.position(v) + Vec3{0.01 + some(), some(), some()});
      }
      world.set_positions(body, rotated(end, turn).positions);
      EXPECT_EQ(world.detect_motion().first_time(), kInfinite) << noise;
    }
  }
}

// Halves of a sheet on a lattice, whose borders touch vertex by vertex and move at random, most often away.
TEST(TouchingMotion, NoWallsCrossBeforeTheFirstStop) {
  const std::vector<Mesh> halves = components(cut(unchanged(sheet(4, 3, 4.0, 3.0)), {1, 0, 0}, 0.0).mesh);
  ASSERT_EQ(halves.size(), 2u);
  Random random(7);
  int free = 0;
  for (int round = 0; round < 400; ++round) {
    tact::World world({.threads = 1});
    const int opens = random.below(3);
    Eigen::Matrix3Xd begin[2], ends[2];
    BodyId ids[2];
    for (int i = 0; i < 2; ++i) {
      begin[i] = 2.0 * halves[i].positions;
      ends[i] = begin[i];
      for (auto at : ends[i].colwise())
        at +=
            Eigen::Vector3d((i == 0 ? -opens : opens) + random.below(3) - 1, random.below(3) - 1, random.below(3) - 1);
      ids[i] = world.add_body({.positions = begin[i], .facets = halves[i].facets, .surface = Surface::sheet});
    }
    world.detect();
    for (int i = 0; i < 2; ++i) world.set_positions(ids[i], ends[i]);
    const double first = world.detect_motion().first_time();
    free += first > 1.0 ? 1 : 0;
    for (const int part : {1, 16, 128, 256, 384, 512, 640, 768, 896, 1024}) {
      if (!(part / 1024.0 < first)) break;
      Eigen::Matrix3Xd at[2];
      for (int i = 0; i < 2; ++i) at[i] = 1024.0 * begin[i] + part * (ends[i] - begin[i]);
      ASSERT_FALSE(any_edge_through(halves[0], at[0], halves[1], at[1])) << round << ' ' << part << ' ' << first;
      ASSERT_FALSE(any_edge_through(halves[1], at[1], halves[0], at[0])) << round << ' ' << part << ' ' << first;
    }
  }
  EXPECT_GT(free, 150);
}

}  // namespace
}  // namespace tact::tests
