#include <gtest/gtest.h>

#include <cmath>

#include "narrowphase/gjk.h"
#include "tests/support/clustered.h"
#include "tests/support/generators.h"
#include "tests/support/hostile_hulls.h"
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

// Three vertices nearly on a line below a point, and two nearly parallel segments across each other: the triangle and
// the parallelogram in which the nearest point lies have sides at an angle of `width`.
TEST(Gjk, ClosestPointsOfSliversAreRight) {
  Random random(31);
  int triangles = 0, thinnest = 0;
  for (int i = 0; i < 3000; ++i) {
    const double gap = std::pow(10.0, random.uniform(-13.0, 0.0)), width = std::pow(10.0, random.uniform(-15.5, -4.0));
    const tests::Rotation turn = random.rotation();
    const auto turned = [&](Vec3 p) { return Vec3{dot(turn.row[0], p), dot(turn.row[1], p), dot(turn.row[2], p)}; };
    std::vector<Vec3> a{{-1, 0, 0}, {1, 0, 0}}, b{{-1, -width, gap}, {1, width, gap}};
    if (i % 2 == 0) {
      a.push_back({random.uniform(-0.5, 0.5), width, 0});
      b = {{a[2].x + random.uniform(-0.1, 0.1), 0.5 * width, gap}};
    }
    for (std::vector<Vec3>* points : {&a, &b}) {
      for (Vec3& p : *points) p = turned(p);
    }
    tests::DistanceCounts counts;
    EXPECT_EQ(tests::problem_of_distance(a, b, counts), "") << "case " << i << ", width " << width << ", gap " << gap;
    const ClusteredMesh mesh_a = mesh_through(a), mesh_b = mesh_through(b);
    const MinkowskiDifference m(mesh_a, mesh_b);
    const GjkResult result = gjk(m, {}, {}, {});
    if (result.status != GjkStatus::apart) continue;
    triangles += result.simplex.count == 3 ? 1 : 0;
    thinnest += result.simplex.count == 3 && width < 1e-10 ? 1 : 0;
    // A vertex is turned to within 4 roundoffs, which moves the hulls by no more.
    const ClosestPoints closest = closest_points(m, result);
    EXPECT_NEAR(norm(closest.a - closest.b), gap, 1e-12 * gap + 1e-14) << "case " << i << ", width " << width;
  }
  EXPECT_GT(triangles, 600);
  EXPECT_GT(thinnest, 100);
}

// The first of them, and one whose nearest point is lost unless it is taken along the normal of its triangle: points
// inside each other, touching, a little or far apart.
TEST(Gjk, HostilePairsAreAsFarApartAsSaid) {
  std::vector<std::uint64_t> seeds{1261025};
  for (std::uint64_t seed = 0; seed < 1000; ++seed) seeds.push_back(seed);
  tests::DistanceCounts counts;
  for (const std::uint64_t seed : seeds) {
    const tests::HullPair pair = tests::hostile_hull_pair(seed);
    for (const std::vector<Vec3>* b : {&pair.b, &pair.b_before, &pair.b_parted}) {
      EXPECT_EQ(tests::problem_of_distance(pair.a, *b, counts), "") << pair.kinds << ", seed " << seed;
    }
  }
  EXPECT_GT(counts.apart, 1000);
  EXPECT_GT(counts.touching, 100);
  EXPECT_GT(counts.overlapping, 500);
}

std::vector<Vec3> degenerate_hull(Random& random, int kind) {
  const Vec3 p = random.in_ball(), e = random.direction(), f = random.direction();
  const double width = std::pow(10.0, random.uniform(-16.0, -3.0));
  switch (kind) {
    case 0: return {p};
    case 1: return {p, p + e};
    case 2: return {p, p + e, p + 0.5 * e + width * f, p + 0.3 * e - width * f, p + 0.7 * e + width * random.in_ball()};
    case 3: return {p, p + e, p + f, p + e + f, p + 0.5 * (e + f)};
    case 4: return {p, p, p, p};                        // coincident
    case 5: return {p, p + e, p, p + e, p + f, p + f};  // twice the same
    default: return {p, p + e, p + f, p + random.in_ball(), p + width * random.in_ball()};
  }
}

// Points, segments, needles, flat and coincident sets; apart, sharing a vertex, crossing, and one the other's copy; of
// all sizes, about zero and so far from it that a few bits are left.
TEST(Gjk, DegenerateHullsAreAsFarApartAsSaidAtEveryScale) {
  Random random(41);
  tests::DistanceCounts counts;
  for (const double scale : {1e-9, 1e-4, 1.0, 1e5, 1e9}) {
    for (const double far : {0.0, 1e4, 1e8}) {
      for (int pair = 0; pair < 49; ++pair) {
        for (int place = 0; place < 4; ++place) {
          std::vector<Vec3> a = degenerate_hull(random, pair / 7);
          std::vector<Vec3> b = place == 3 ? a : degenerate_hull(random, pair % 7);
          const Vec3 by = place == 0   ? random.uniform(0.0, 3.0) * random.direction()
                          : place == 1 ? a.back() - b.back()
                          : place == 2 ? 0.5 * (a.front() + a.back()) - 0.5 * (b.front() + b.back())
                                       : Vec3{};
          const Vec3 offset = far * random.direction();
          for (Vec3& p : b) p = p + by;
          for (std::vector<Vec3>* points : {&a, &b}) {
            for (Vec3& p : *points) p = scale * (p + offset);
          }
          EXPECT_EQ(tests::problem_of_distance(a, b, counts), "")
              << "scale " << scale << ", far " << far << ", kinds " << pair / 7 << " and " << pair % 7 << ", place "
              << place;
        }
      }
    }
  }
  EXPECT_GT(counts.apart, 500);
  EXPECT_GT(counts.touching, 500);
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
      EXPECT_TRUE(result.closed) << "case " << i << ", tolerance " << tolerance;
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
