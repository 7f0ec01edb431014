#include <gtest/gtest.h>

#include <cmath>

#include "narrowphase/direction/contact_direction.h"
#include "narrowphase/hull/gjk.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/hostile_hulls.h"
#include "tests/support/generators/known_shapes.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/mesh_through.h"
#include "tests/support/oracles/minkowski_oracle.h"

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
  const ClusteredMesh cube = tests::clustered_box({0, 0, 0}, {1, 1, 1});
  distance(cube, tests::clustered_box({1, 0, 0}, {2, 1, 1}), GjkStatus::touching);
  distance(cube, tests::clustered_box({0.3, 0.4, 0.45}, {2, 2, 2}), GjkStatus::overlapping);
  distance(cube, cube, GjkStatus::touching);  // zero is the middle of an edge between two vertices of M
  EXPECT_NEAR(distance(cube, tests::clustered_box({1 + 1e-9, 0.2, 0}, {2, 1, 1}), GjkStatus::apart), 1e-9, 1e-15);
}

TEST(Gjk, FindsCubesFarFromZero) {  // openGJK#52: 0.0033 at 9e4, where the answer is 0
  const double far = 9e4;
  distance(tests::clustered_box({far, far, far}, {far + 1, far + 1, far + 1}),
           tests::clustered_box({far + 0.97, far + 0.1, far + 0.15}, {far + 2, far + 1, far + 1}),
           GjkStatus::overlapping);
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
  const ClusteredMesh cuboid = tests::clustered_box({-2, -3, -4}, {2, 3, 4}),
                      edge = tests::clustered_box({1, 1, -2}, {2, 2, 2}),
                      corner = tests::clustered_box({1, 1, 1}, {2, 2, 2});
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
    expect_closest(tests::clustered_box({-0.5, -0.0016, -0.0016}, {0.5, 0.0016, 0.0016}),
                   points({{0.5 + off, 0.001, 0.0005}}), off, {0.5, 0.001, 0.0005}, {0.5 + off, 0.001, 0.0005});
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

// The first of them, one whose nearest point is lost unless it is taken along the normal of its triangle, and two
// around which needles' volumes lose digits: points inside each other, touching, a little or far apart.
TEST(Gjk, HostilePairsAreAsFarApartAsSaid) {
  std::vector<std::uint64_t> seeds{1261025, (std::uint64_t{9901} << 40) + 191315, (std::uint64_t{9903} << 40) + 168563};
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

// The points of the surfaces of overlapping hulls whose difference is the foot of the origin in the face of M that the
// direction ends on.
ClosestPoints deepest_points(const MinkowskiDifference& m, const ContactDirection& found) {
  return closest_points(m, gjk(m, (found.height + 0.1) * found.n, found.face, {}));
}

ContactDirection direction_from(const MinkowskiDifference& m, Vec3 start) {
  FaceFinder faces;
  return contact_direction(m, start, {}, {}, faces);
}

// Are the nearest or deepest points of such a pair (-0.5, y) and (depth - 0.5, y) at one height?
void expect_points_of_edge_and_face(const Mesh& a, const Mesh& b, double y, double depth, const tests::Pose& frame,
                                    double error) {
  const ClusteredMesh mesh_a = tests::clustered(a), mesh_b = tests::clustered(b);
  const MinkowskiDifference m(mesh_a, mesh_b);
  const GjkResult result = gjk(m, {}, {}, {});
  ClosestPoints points = closest_points(m, result);
  const auto& row = frame.rotation.row;
  if (depth > 0.0) {
    const ContactDirection found = direction_from(m, {-row[0].x, -row[1].x, -row[2].x});
    EXPECT_NE(result.status, GjkStatus::apart);
    EXPECT_NEAR(found.height / m.scale(), depth, error);
    points = deepest_points(m, found);
  } else {
    EXPECT_NEAR(result.distance / m.scale(), -depth, error);
  }
  const auto in_frame = [&](Vec3 p) {
    const Vec3 d = p - frame.translation;
    return d.x * row[0] + d.y * row[1] + d.z * row[2];
  };
  const Vec3 on_a = in_frame(points.a), on_b = in_frame(points.b);
  EXPECT_NEAR(on_a.x, -0.5, error);
  EXPECT_NEAR(on_a.y, y, error);
  EXPECT_NEAR(on_b.x, depth - 0.5, error);
  EXPECT_NEAR(on_b.y, y, error);
  EXPECT_NEAR(on_a.z, on_b.z, error);
  EXPECT_NEAR(on_a.z, 0.5, 0.5 + error);
}

// FCL: an edge against a face, apart, touching and inside; in several frames of the world, in doubles and in floats.
TEST(Gjk, FindsThePointsOfAnEdgeAndAFace) {
  const std::vector<tests::Pose> frames = tests::frames_of_the_world();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const double y : {0.0, 0.1, -0.1, -0.05}) {
      for (const double depth : {-0.1, 0.0, 0.1}) {
        SCOPED_TRACE(::testing::Message() << "frame " << i << ", y " << y << ", depth " << depth);
        const tests::BoxPair boxes = tests::edge_against_face(y, depth);
        const Mesh a = tests::posed(boxes.a, frames[i]), b = tests::posed(boxes.b, frames[i]);
        expect_points_of_edge_and_face(a, b, y, depth, frames[i], 1e-14);
        expect_points_of_edge_and_face(tests::rounded_to_floats(a), tests::rounded_to_floats(b), y, depth, frames[i],
                                       1e-6);
      }
    }
  }
}

// FCL's boxes from the field: the signed distance is that of the two points.
TEST(Gjk, FindsThePointsOfBoxesFromTheField) {
  std::vector<tests::BoxPair> pairs = tests::boxes_from_the_field();
  pairs.push_back(tests::boxes_from_the_field_that_touch());
  tests::DistanceCounts counts;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::vector<Vec3> a = tests::used_points(pairs[i].a), b = tests::used_points(pairs[i].b);
    EXPECT_EQ(tests::problem_of_distance(a, b, counts), "") << "pair " << i;
    EXPECT_EQ(tests::problem_of_distance(b, a, counts), "") << "pair " << i;
    const tests::SmallestHeight smallest = tests::smallest_height(a, b, 0.0);
    const ClusteredMesh mesh_a = mesh_through(a), mesh_b = mesh_through(b);
    const MinkowskiDifference m(mesh_a, mesh_b);
    const GjkResult result = gjk(m, {}, {}, {});
    const auto height = static_cast<double>(smallest.height);
    ASSERT_EQ(result.status, height < 0.0 ? GjkStatus::apart : GjkStatus::overlapping) << "pair " << i;
    if (height < 0.0) continue;
    const ContactDirection found = direction_from(m, smallest.directions[0]);
    const ClosestPoints points = deepest_points(m, found);
    EXPECT_NEAR(norm(points.a - points.b), height, 1e-14) << "pair " << i;
    EXPECT_LE(norm(points.a - points.b - height * found.n), 1e-13) << "pair " << i;
  }
}

// Jolt's EPATests: the points on the edge or the corner, and on the ball, where it is deepest.
TEST(Gjk, FindsTheDeepestPointsOfABoxAndOfBalls) {
  const auto expect_deepest = [](const Mesh& box, const Mesh& ball, Vec3 n, Vec3 on_box, double depth, Vec3 free) {
    const ClusteredMesh mesh_a = tests::clustered(box), mesh_b = tests::clustered(ball);
    const MinkowskiDifference m(mesh_a, mesh_b);
    EXPECT_EQ(gjk(m, {}, {}, {}).status, GjkStatus::overlapping);
    const ContactDirection found = direction_from(m, n + Vec3{0.01, -0.02, 0.015});
    EXPECT_NEAR(found.height / m.scale(), depth, 1e-14);
    EXPECT_LE(norm(found.n - normalized(n)), 1e-14);
    const ClosestPoints points = deepest_points(m, found);
    EXPECT_LE(norm(points.a - points.b - depth * normalized(n)), 1e-14);
    const Vec3 along_box = dot(points.a - on_box, free) * free;
    EXPECT_LE(norm(points.a - on_box - along_box), 1e-14);
    EXPECT_LE(norm(along_box), 0.5);
  };
  const double eight = std::sqrt(8.0), twelve = std::sqrt(12.0);
  expect_deepest(tests::box({1, 1, -2}, {2, 2, 2}), tests::ball_with_facet({4, 4, 0}, eight + 0.01, {-1, -1, 0}),
                 {1, 1, 0}, {2, 2, 0}, 0.01, {0, 0, 1});
  expect_deepest(tests::box({1, 1, 1}, {2, 2, 2}), tests::ball_with_facet({4, 4, 4}, twelve + 0.01, {-1, -1, -1}),
                 {1, 1, 1}, {2, 2, 2}, 0.01, {});
}

// Jolt's GJKTests: two balls of radius 1 whose centres are 2 apart along (1, 1, 1) touch in one vertex.
TEST(Gjk, BallsThatTouchInAVertex) {
  const Vec3 tip = normalized(Vec3{1, 1, 1});
  std::vector<Vec3> a{tip}, b{tip};
  for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    for (const double sign : {1.0, -1.0}) {
      a.push_back(sign * d);
      b.push_back(2.0 * tip + sign * d);
    }
  }
  const ClusteredMesh mesh_a = mesh_through(a), mesh_b = mesh_through(b);
  const MinkowskiDifference m(mesh_a, mesh_b);
  const GjkResult result = gjk(m, {}, {}, {});
  EXPECT_EQ(result.status, GjkStatus::touching);
  EXPECT_EQ(result.distance, 0.0);
  const ClosestPoints closest = closest_points(m, result);
  EXPECT_LE(norm(closest.a - tip), 4e-16);
  EXPECT_LE(norm(closest.b - tip), 4e-16);
}

// openGJK#54: a cube with its corners cut off, and points before its faces, edges and cut corners.
TEST(Gjk, FindsTheDistanceOfPointsFromACutCube) {
  constexpr double kLong = 0.414213562373, kShort = 0.171572875254;
  std::vector<Vec3> cube;
  for (int axis = 0; axis < 3; ++axis) {
    for (int signs = 0; signs < 8; ++signs) {
      Vec3 p{kLong, kLong, kLong};
      p[axis] = kShort;
      cube.push_back({(signs & 1) != 0 ? -p.x : p.x, (signs & 2) != 0 ? -p.y : p.y, (signs & 4) != 0 ? -p.z : p.z});
    }
  }
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int axes = x * x + y * y + z * z;
        if (axes == 0) continue;
        for (const double t : {0.415, 0.5, 1.0, 100.0}) {
          const Vec3 p{t * x, t * y, t * z};
          const double expected =
              axes == 3 ? (3.0 * t - 2.0 * kLong - kShort) / std::sqrt(3.0) : (t - kLong) * std::sqrt(axes);
          EXPECT_NEAR(distance(points(cube), points({p}), GjkStatus::apart), expected, 1e-15 * (1.0 + t))
              << x << ' ' << y << ' ' << z << " times " << t;
        }
      }
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
