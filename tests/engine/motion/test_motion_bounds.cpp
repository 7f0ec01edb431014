// How far each vertex may go: all at once, and nothing meets, in rational arithmetic; and far enough.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/motion_oracle.h"

namespace tact::tests {
namespace {

using narrowphase::MovingVertex;

constexpr double kNoTime = std::numeric_limits<double>::infinity();

Eigen::Matrix3Xd as_far_as_bounds(const Eigen::Matrix3Xd& begin, const Eigen::Matrix3Xd& end,
                                  std::span<const double> bounds) {
  Eigen::Matrix3Xd at = end;
  for (Eigen::Index v = 0; v < end.cols(); ++v) {
    const double bound = bounds[static_cast<std::size_t>(v)];
    EXPECT_TRUE(bound >= 0.0 && bound <= 1.0);
    if (bound < 1.0) at.col(v) = begin.col(v) + bound * (end.col(v) - begin.col(v));
  }
  return at;
}

struct Goer {
  Mesh begin;
  Eigen::Matrix3Xd end, at;

  MovingVertex vertex(int v, const Eigen::Matrix3Xd& to) const {
    return {{begin.position(v), {to(0, v), to(1, v), to(2, v)}}};
  }
};

double distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d e = b - a;
  return (p - a - std::clamp((p - a).dot(e) / e.squaredNorm(), 0.0, 1.0) * e).norm();
}

double distance(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& t) {
  double least = std::min({distance(p, t[0], t[1]), distance(p, t[1], t[2]), distance(p, t[2], t[0])});
  const Eigen::Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  const auto inside = [&](int k) { return (t[(k + 1) % 3] - t[k]).cross(p - t[k]).dot(n) > 0.0; };
  if (inside(0) && inside(1) && inside(2)) least = std::min(least, std::abs(n.dot(p - t[0])) / n.norm());
  return least;
}

double distance(const std::array<Eigen::Vector3d, 2>& e, const std::array<Eigen::Vector3d, 2>& f) {
  double least = std::min(
      {distance(e[0], f[0], f[1]), distance(e[1], f[0], f[1]), distance(f[0], e[0], e[1]), distance(f[1], e[0], e[1])});
  const Eigen::Vector3d u = e[1] - e[0], w = f[1] - f[0], r = f[0] - e[0], n = u.cross(w);
  const double s = r.cross(w).dot(n) / n.squaredNorm(), t = r.cross(u).dot(n) / n.squaredNorm();
  if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) least = std::min(least, std::abs(r.dot(n)) / n.norm());
  return least;
}

std::set<std::array<int, 2>> edges_of_goer(const Mesh& mesh) {
  std::set<std::array<int, 2>> edges;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.facets(k, f), w = mesh.facets((k + 1) % 3, f);
      edges.insert({std::min(v, w), std::max(v, w)});
    }
  }
  return edges;
}

// The least distance of the features of each vertex from features of the other.
struct Nearest {
  std::vector<double> of_a, of_b;
  bool meet = false;  // anything, on the way to Goer::at

  Nearest(const Goer& a, const Goer& b) : of_a(a.begin.vertex_count(), kNoTime), of_b(b.begin.vertex_count(), kNoTime) {
    vertices(a, b, of_a, of_b);
    vertices(b, a, of_b, of_a);
    const auto edges_b = edges_of_goer(b.begin);
    for (const auto& e : edges_of_goer(a.begin)) {
      for (const auto& f : edges_b) {
        const double d = distance(std::array{at(a, e[0]), at(a, e[1])}, std::array{at(b, f[0]), at(b, f[1])});
        for (const int v : e) lower(of_a[static_cast<std::size_t>(v)], d);
        for (const int v : f) lower(of_b[static_cast<std::size_t>(v)], d);
        meet = meet || first_time_of_edges({a.vertex(e[0], a.at), a.vertex(e[1], a.at)},
                                           {b.vertex(f[0], b.at), b.vertex(f[1], b.at)});
      }
    }
  }

 private:
  static Eigen::Vector3d at(const Goer& one, int v) { return one.begin.positions.col(v); }
  static void lower(double& least, double d) { least = std::min(least, d); }
  void vertices(const Goer& a, const Goer& b, std::vector<double>& of_a_, std::vector<double>& of_b_) {
    for (int v = 0; v < a.begin.vertex_count(); ++v) {
      for (int f = 0; f < b.begin.facet_count(); ++f) {
        const auto c = b.begin.facets.col(f);
        const double d = distance(at(a, v), {at(b, c[0]), at(b, c[1]), at(b, c[2])});
        lower(of_a_[static_cast<std::size_t>(v)], d);
        for (int k = 0; k < 3; ++k) lower(of_b_[static_cast<std::size_t>(c[k])], d);
        meet = meet || first_time_of_vertex_and_facet(
                           a.vertex(v, a.at), {b.vertex(c[0], b.at), b.vertex(c[1], b.at), b.vertex(c[2], b.at)});
      }
    }
  }
};

// `far`: bounds are at least this part of the way.
void expect_far_enough(const Goer& goer, std::span<const double> bounds, const std::vector<double>& nearest) {
  for (Eigen::Index v = 0; v < goer.end.cols(); ++v) {
    const auto i = static_cast<std::size_t>(v);
    const double way = (goer.end.col(v) - goer.begin.positions.col(v)).norm();
    EXPECT_GE(bounds[i], std::min(1.0, 0.45 * nearest[i] / way) * (1.0 - 1e-6) - 1e-9);
  }
}

TEST(MotionBounds, NothingMeetsInRandomSteps) {
  Random random(41);
  int held = 0, whole = 0, rounds = 0;
  while (rounds < 600) {
    Goer goers[2];
    tact::World world({.threads = 1});
    BodyId ids[2];
    for (int i = 0; i < 2; ++i) {
      Goer& goer = goers[i];
      goer.begin = random.chance(0.5) ? centered_box({0.5, 0.5, 0.5}) : needles(2, 5.0, random.bits());
      goer.begin = jittered(translated(goer.begin, 1.5 * random.in_ball()), 0.05, random.bits());
      goer.end = goer.begin.positions;
      const Vec3 way = 2.0 * random.in_ball();
      const double wildness = random.chance(0.5) ? 0.0 : 0.5;
      for (int v = 0; v < goer.begin.vertex_count(); ++v) {
        const Vec3 p = way + wildness * random.in_ball();
        goer.end.col(v) += Eigen::Vector3d(p.x, p.y, p.z);
      }
      ids[i] = world.add_body(
          {.positions = goer.begin.positions, .facets = goer.begin.facets, .surface = Surface::sheet, .margin = 0.1});
    }
    if (world.detect().stats().facet_pairs > 0) continue;
    ++rounds;
    for (int i = 0; i < 2; ++i) world.set_positions(ids[i], goers[i].end);
    const MotionReport& motion = world.detect_motion({.distance = 0.0, .bounds = true});
    for (int i = 0; i < 2; ++i)
      goers[i].at = as_far_as_bounds(goers[i].begin.positions, goers[i].end, motion.bounds(ids[i]));
    const Nearest nearest(goers[0], goers[1]);
    ASSERT_FALSE(nearest.meet) << rounds;
    expect_far_enough(goers[0], motion.bounds(ids[0]), nearest.of_a);
    expect_far_enough(goers[1], motion.bounds(ids[1]), nearest.of_b);
    for (const BodyId id : ids) {
      for (const double bound : motion.bounds(id)) ++(bound < 1.0 ? held : whole);
    }
  }
  EXPECT_GT(held, 300);
  EXPECT_GT(whole, 1000);
}

// A cloth that falls on a ball: what meets nothing goes the whole way, and nothing meets.
TEST(MotionBounds, MostOfAClothThatFallsOnABallGoesTheWholeWay) {
  const Mesh cloth = translated(wrinkled_sheet(30, 4.0, 0.02, 3), {0, 0, 1.1}), ball = icosphere(3, 1.0);
  tact::World world({.threads = 2});
  world.add_body({.positions = ball.positions, .facets = ball.facets, .margin = 0.01});
  const BodyId falling = world.add_body({.positions = cloth.positions,
                                         .facets = cloth.facets,
                                         .surface = Surface::sheet,
                                         .margin = 0.01,
                                         .self_contact = true});
  world.detect();
  const Eigen::Matrix3Xd end = translated(cloth, {0.02, 0, -0.25}).positions;
  world.set_positions(falling, end);
  const MotionReport& report = world.detect_motion({.distance = 0.0, .bounds = true});
  std::set<int> meeting;
  for (const Impact& impact : report.impacts()) {
    for (const int v : impact.b == falling ? impact.b_vertices : impact.a_vertices) meeting.insert(v);
  }
  ASSERT_GT(meeting.size(), 20u);
  const std::vector<double> bounds(report.bounds(falling).begin(), report.bounds(falling).end());
  int free = 0, all = 0;
  for (int v = 0; v < cloth.vertex_count(); ++v) {
    if (meeting.contains(v)) continue;
    ++all;
    free += bounds[static_cast<std::size_t>(v)] == 1.0 ? 1 : 0;
  }
  EXPECT_GE(free, 0.9 * all);
  world.set_positions(falling, as_far_as_bounds(cloth.positions, end, bounds));
  EXPECT_EQ(world.detect_motion({.distance = 0.0}).first_time(), kNoTime);
  EXPECT_TRUE(world.detect_motion({.distance = 0.0}).bounds(falling).empty());
}

// In a world with margins the distance decides: more, less and none.
TEST(MotionBounds, ADistanceTakesThePlaceOfTheMargins) {
  const Mesh wall = sheet(4, 4, 4, 4), bullet = cube(0.2, {0, 0, 1});
  for (const double margin : {0.0, 0.1}) {
    for (const double distance : {0.0, 0.05, 0.4}) {
      tact::World world({.threads = 1});
      world.add_body({.positions = wall.positions, .facets = wall.facets, .surface = Surface::sheet, .margin = margin});
      const BodyId flying = world.add_body({.positions = bullet.positions, .facets = bullet.facets, .margin = margin});
      world.detect();
      world.set_positions(flying, translated(bullet, {0, 0, -2}).positions);
      EXPECT_NEAR(world.detect_motion({.distance = distance}).first_time(), (0.9 - distance) / 2.0, 1e-6);
      EXPECT_NEAR(world.detect_motion().first_time(), (0.9 - 2.0 * margin) / 2.0, 1e-6);
      world.set_positions(flying, translated(bullet, {0, 0, -0.6}).positions);  // to 0.3 above the wall
      EXPECT_EQ(world.detect_motion({.distance = distance}).first_time() <= 1.0, distance > 0.3);
    }
  }
}

TEST(MotionBounds, RefusesBadOptions) {
  tact::World world;
  for (const MotionOptions& options :
       {MotionOptions{.distance = -1.0}, MotionOptions{.distance = std::nan("")}, MotionOptions{.distance = kNoTime},
        MotionOptions{.wanted = Impacts::first, .bounds = true}}) {
    try {
      world.detect_motion(options);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace tact::tests
