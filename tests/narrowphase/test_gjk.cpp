#include <gtest/gtest.h>

#include "narrowphase/gjk.h"
#include "tests/support/clustered.h"
#include "tests/support/generators.h"
#include "tests/support/minkowski_oracle.h"
#include "tests/support/random.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;
using tests::mesh_through;
using tests::Random;

// The distance of the hulls in metres, 0 where they overlap.
double distance(const ClusteredMesh& a, const ClusteredMesh& b, GjkStatus expected) {
  const MinkowskiDifference m(a, b);
  const GjkResult result = gjk(m, {}, {}, {});
  EXPECT_EQ(result.status, expected);
  return expected == GjkStatus::apart ? result.distance / m.scale() : 0.0;
}

ClusteredMesh points(std::vector<Vec3> p) { return mesh_through(p); }
ClusteredMesh box(Vec3 lower, Vec3 upper) { return tests::clustered(tests::box(lower, upper)); }

TEST(Gjk, PointsSegmentsAndFlatHulls) {
  EXPECT_NEAR(distance(points({{0, 0, 0}}), points({{3, 4, 0}}), GjkStatus::apart), 5.0, 1e-14);
  EXPECT_NEAR(distance(points({{0, 0, 0}, {2, 0, 0}}), points({{1, 1, 1}, {1, 1, -1}}), GjkStatus::apart), 1.0, 1e-14);
  EXPECT_NEAR(distance(points({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}), points({{0.5, 0.5, 1e-9}}), GjkStatus::apart), 1e-9,
              1e-14);
  distance(points({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}), points({{0.5, 0.5, 0}}), GjkStatus::touching);
  distance(points({{1, 1, 1}}), points({{1, 1, 1}}), GjkStatus::touching);
  distance(points({{0, 0, 0}, {1, 0, 0}}), points({{0.5, 0, 0}, {2, 0, 0}}), GjkStatus::touching);
}

TEST(Gjk, CubesThatTouchOverlapAndPart) {
  const ClusteredMesh cube = box({0, 0, 0}, {1, 1, 1});
  distance(cube, box({1, 0, 0}, {2, 1, 1}), GjkStatus::touching);
  distance(cube, box({0.3, 0.4, 0.45}, {2, 2, 2}), GjkStatus::overlapping);
  distance(cube, cube, GjkStatus::touching);  // zero is the middle of an edge between two vertices of M
  EXPECT_NEAR(distance(cube, box({1 + 1e-9, 0.2, 0}, {2, 1, 1}), GjkStatus::apart), 1e-9, 1e-15);
}

TEST(Gjk, FindsCubesFarFromZero) {  // openGJK#52: 0.0033 at 9e4, where the answer is 0
  const double far = 9e4;
  distance(box({far, far, far}, {far + 1, far + 1, far + 1}),
           box({far + 0.97, far + 0.1, far + 0.15}, {far + 2, far + 1, far + 1}), GjkStatus::overlapping);
}

TEST(Gjk, FindsTheDistanceOfTwoPolytopes) {  // openGJK's first example, whose readme gives the distance
  const std::vector<Vec3> p = {{0.0, 5.5, 0.0}, {2.3, 1.0, -2.0}, {8.1, 4.0, 2.4}, {4.3, 5.0, 2.2}, {2.5, 1.0, 2.3},
                               {7.1, 1.0, 2.4}, {1.0, 1.5, 0.3},  {3.3, 0.5, 0.3}, {6.0, 1.4, 0.2}};
  std::vector<Vec3> q;
  for (const Vec3& v : p) q.push_back(-v);
  EXPECT_NEAR(distance(points(p), points(q), GjkStatus::apart), 3.653650, 5e-7);
}

// The distance and the points between which it is.
void expect_closest(const ClusteredMesh& a, const ClusteredMesh& b, double distance, Vec3 on_a, Vec3 on_b,
                    double error = 1e-12) {
  const MinkowskiDifference m(a, b);
  const GjkResult result = gjk(m, {}, {}, {});
  EXPECT_EQ(result.status, GjkStatus::apart);
  EXPECT_NEAR(result.distance / m.scale(), distance, error);
  const ClosestPoints closest = closest_points(m, result);
  EXPECT_LE(norm(closest.a - on_a), error);
  EXPECT_LE(norm(closest.b - on_b), error);
}

// Jolt's EPATests and GJKTests. A ball is the hull of its tips: only the one that is nearest counts.
TEST(Gjk, FindsTheClosestPointsOfABoxAndOfBalls) {
  const auto ball = [](Vec3 center, double r, Vec3 tip) {
    std::vector<Vec3> p = {center + r * normalized(tip)};
    for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      p.push_back(center + r * d);
      p.push_back(center - r * d);
    }
    return mesh_through(p);
  };
  const ClusteredMesh cuboid = box({-2, -3, -4}, {2, 3, 4}), edge = box({1, 1, -2}, {2, 2, 2}),
                      corner = box({1, 1, 1}, {2, 2, 2});
  expect_closest(cuboid, ball({4, 0, 0}, 1.99, {-1, 0, 0}), 0.01, {2, 0, 0}, {2.01, 0, 0});
  const double eight = std::sqrt(8.0), twelve = std::sqrt(12.0);
  const double x = 4 - (eight - 0.01) / std::sqrt(2.0), y = 4 - (twelve - 0.01) / std::sqrt(3.0);
  expect_closest(edge, ball({4, 4, 0}, eight - 0.01, {-1, -1, 0}), 0.01, {2, 2, 0}, {x, x, 0});
  expect_closest(corner, ball({4, 4, 4}, twelve - 0.01, {-1, -1, -1}), 0.01, {2, 2, 2}, {y, y, y});
  const double third = 1.0 / std::sqrt(3.0);
  expect_closest(ball({}, 1, {1, 1, 1}), ball({10, 10, 10}, 1, {-1, -1, -1}), std::sqrt(300.0) - 2,
                 {third, third, third}, {10 - third, 10 - third, 10 - third});
}

// parry#76: a facet without area is a segment. Box2D's test_distance.c: a plank 3.2 mm thick, a point off its end.
TEST(Gjk, FindsTheClosestPointsOfThinThings) {
  const Vec3 p{2.27699995, -7.9000001, 16.3180008}, q{-0.569999993, -8.10000038, 16.6070004},
      r{1.10000002, -7.9000001, 16.5879993};
  const Vec3 foot = p + dot(r - p, q - p) / dot(q - p, q - p) * (q - p);
  EXPECT_NEAR(norm(foot - r), 0.17147861, 5e-7);  // found in floats
  expect_closest(points({p, q, q}), points({r}), norm(foot - r), foot, r);
  for (const double off : {0.005, 1e-6}) {
    expect_closest(box({-0.5, -0.0016, -0.0016}, {0.5, 0.0016, 0.0016}), points({{0.5 + off, 0.001, 0.0005}}), off,
                   {0.5, 0.001, 0.0005}, {0.5 + off, 0.001, 0.0005});
  }
}

// Where hulls overlap the two points are one; where they are apart, the distance is theirs.
TEST(Gjk, ClosestPointsLieInTheHulls) {
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    std::vector<Vec3> a, b;
    const Vec3 by = random.uniform(0.0, 3.0) * random.direction();
    for (int k = 0; k < 10; ++k) {
      a.push_back(random.in_ball());
      b.push_back(random.in_ball() + by);
    }
    const ClusteredMesh mesh_a = mesh_through(a), mesh_b = mesh_through(b);
    const MinkowskiDifference m(mesh_a, mesh_b);
    const GjkResult result = gjk(m, {}, {}, {});
    const ClosestPoints closest = closest_points(m, result);
    const double apart = result.status == GjkStatus::apart ? result.distance / m.scale() : 0.0;
    EXPECT_NEAR(norm(closest.a - closest.b), apart, 1e-12) << "case " << i;
    // No direction sees the point beyond its hull.
    for (int k = 0; k < 50; ++k) {
      const Vec3 n = random.direction();
      const auto top = [&](const std::vector<Vec3>& hull) {
        double h = -std::numeric_limits<double>::infinity();
        for (const Vec3& v : hull) h = std::max(h, dot(n, v));
        return h;
      };
      EXPECT_LE(dot(n, closest.a), top(a) + 1e-12) << "case " << i;
      EXPECT_LE(dot(n, closest.b), top(b) + 1e-12) << "case " << i;
    }
  }
}

TEST(Gjk, BoundsCloseToTheToleranceThatIsSet) {
  Random random(7);
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
    for (int i = 0; i < 200; ++i) {
      std::vector<Vec3> a, b;
      const Vec3 by = random.uniform(2.1, 4.0) * random.direction();
      for (int k = 0; k < 40; ++k) {
        a.push_back(normalized(random.in_ball()));
        b.push_back(normalized(random.in_ball()) + by);
      }
      const ClusteredMesh mesh_a = mesh_through(a), mesh_b = mesh_through(b);
      const MinkowskiDifference m(mesh_a, mesh_b);
      const GjkResult result = gjk(m, {}, {}, {.tolerance = tolerance});
      ASSERT_EQ(result.status, GjkStatus::apart) << "case " << i;
      EXPECT_LE(result.distance - result.lower_bound, tolerance * result.distance + 16 * 0x1p-52 * m.size())
          << "case " << i << ", tolerance " << tolerance;
    }
  }
}

TEST(Gjk, BoundsCloseOnRandomHullsAtEveryScale) {
  Random random(5);
  for (int i = 0; i < 600; ++i) {
    const double scale = std::ldexp(1.0, (i % 13 - 6) * 5), aspect = i % 7 == 0 ? 1e-9 : 1.0;
    const Vec3 offset = (i % 5 == 0 ? 1e8 : 0.0) * scale * random.direction(),
               apart = random.uniform(0.5, 3.0) * random.direction();
    std::vector<Vec3> a, b;
    for (int k = 0; k < 12; ++k) {
      Vec3 p = random.in_ball(), q = random.in_ball() + apart;
      p.z *= aspect;
      a.push_back(offset + scale * p);
      b.push_back(offset + scale * q);
    }
    const ClusteredMesh mesh_a = mesh_through(a), mesh_b = mesh_through(b);
    const MinkowskiDifference m(mesh_a, mesh_b);
    const GjkResult result = gjk(m, {}, {}, {});
    ASSERT_NE(result.status, GjkStatus::limit_reached) << "case " << i;
    if (result.status != GjkStatus::apart) {
      EXPECT_GE(static_cast<double>(tests::smallest_height(a, b, 0.0).height) * m.scale(), -4.0 * m.height_error())
          << "case " << i;
      continue;
    }
    // The direction between the closest points separates the hulls by the distance. Differences are exact, and spare
    // the oracle the offset.
    const Vec3 base = a[0];
    for (std::vector<Vec3>* points : {&a, &b}) {
      for (Vec3& p : *points) p = p - base;
    }
    const double w = static_cast<double>(tests::minkowski_height(a, b, -result.offset));
    EXPECT_NEAR(-w * m.scale(), result.distance, 1e-11 * result.distance + 4.0 * m.height_error()) << "case " << i;
  }
}

TEST(Gjk, AWarmStartGivesTheSameAnswerWithFewerQueries) {
  const Mesh ball = tests::icosphere(4), other = tests::translated(tests::icosphere(4), {2.5, 0.3, 0.1});
  const ClusteredMesh a = tests::clustered(ball), b = tests::clustered(other);
  const MinkowskiDifference m(a, b);
  const GjkResult cold = gjk(m, {}, {}, {}), warm = gjk(m, {}, cold.simplex, {});
  EXPECT_EQ(cold.status, GjkStatus::apart);
  EXPECT_NEAR(warm.distance, cold.distance, 1e-14);
  EXPECT_LT(warm.support_queries, cold.support_queries);
  EXPECT_LE(warm.support_queries, 2);
}

}  // namespace
}  // namespace tact::narrowphase
