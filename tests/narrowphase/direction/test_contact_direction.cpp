#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "narrowphase/direction/contact_direction.h"
#include "narrowphase/direction/face_triangle.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/hostile_hulls.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/mesh_through.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;
using tests::Random;

struct Found {
  Vec3 n;
  double depth;  // metres
  int iterations;
};

Found direction(const ClusteredMesh& a, const ClusteredMesh& b, Vec3 start, const GjkSimplex& face = {}) {
  const MinkowskiDifference m(a, b);
  FaceFinder faces;
  const ContactDirection d = contact_direction(m, normalized(start), face, {}, faces);
  EXPECT_FALSE(d.limit_reached);
  EXPECT_NEAR(norm(d.n), 1.0, 1e-15);
  return {d.n, d.height / m.scale(), d.iterations};
}

void expect_near(Vec3 found, Vec3 expected, double tolerance) { EXPECT_LE(norm(found - expected), tolerance); }

TEST(ContactDirection, LeavesTheDiagonalOfACube) {  // fcl#545: the corner and the edge of [-1, 1]³ repeat too
  const ClusteredMesh cube = tests::clustered_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  for (const Vec3 start : {Vec3{1, 1, 1}, Vec3{1, 1, 0}, Vec3{-1, 1, -1}, Vec3{0, -1, 1}}) {
    const Found found = direction(cube, cube, start);
    EXPECT_NEAR(found.depth, 1.0, 1e-15);
    EXPECT_NEAR(std::abs(found.n.x) + std::abs(found.n.y) + std::abs(found.n.z), 1.0, 1e-15);
    EXPECT_GT(dot(found.n, start), 0.0);
  }
}

// Boxes right above each other: the foot lies on the diagonal of the face, where GJK ends on two vertices. A triangle
// around it is kept, and the face found again as the upper box sinks.
TEST(ContactDirection, KeepsTheFaceOfStackedBoxes) {
  const ClusteredMesh lower = tests::clustered_box({-0.5, -0.5, -1.0}, {0.5, 0.5, 0.0});
  const std::vector<Vec3> offsets{{0, 0, 0}, {0.25, 0, 0}, {0.25, 0.25, 0}, {0.1, -0.3, 0}};
  for (const Vec3 offset : offsets) {
    Vec3 n = normalized(Vec3{0.1, 0.05, 1.0});
    GjkSimplex face;
    for (int step = 0; step < 8; ++step) {
      const double depth = 0x1p-10 * (step + 1);
      const ClusteredMesh upper = tests::clustered_box(Vec3{-0.5, -0.5, -depth} + offset, Vec3{0.5, 0.5, 1.0} + offset);
      const MinkowskiDifference m(lower, upper);
      FaceFinder faces;
      const ContactDirection found = contact_direction(m, n, face, {}, faces);
      EXPECT_EQ(found.n, (Vec3{0, 0, 1})) << step;
      EXPECT_EQ(found.height / m.scale(), depth) << step;
      EXPECT_EQ(found.face.count, 3) << step;
      EXPECT_TRUE(step == 0 || found.iterations == 0) << step;
      n = found.n;
      face = found.face;
    }
  }
}

// What is kept of a face: a triangle that holds the foot, of vertices that are there; nothing of an edge or a vertex.
TEST(FaceFinder, KeepsATriangleAroundTheFoot) {
  const ClusteredMesh point = tests::mesh_through(std::vector<Vec3>{{0, 0, 0}});
  const ClusteredMesh edge = tests::mesh_through(std::vector<Vec3>{{-1, 0, 0}, {0, 0, 0}, {2, 0, 0}});
  const ClusteredMesh cross_edge = tests::mesh_through(std::vector<Vec3>{{0, -1, 0}, {0, 1, 0}});
  const ClusteredMesh square = tests::clustered(tests::sheet(6, 6, 2.0, 2.0));
  const ClusteredMesh other = tests::clustered(tests::translated(tests::sheet(3, 3, 2.0, 2.0), {0.25, -0.5, 0}));
  FaceFinder faces;
  const Vec3 up{0, 0, 1};
  const auto margin = [&](const ClusteredMesh& a, const ClusteredMesh& b) {
    const MinkowskiDifference m(a, b);
    faces.supported(m, up, 1e-15, m.support(up, m.vertex(0, 0)));
    const GjkSimplex face = faces.around_projection(m);
    return face.count == 3 ? FaceTriangle(m, face, up).side_of_projection().distance / m.scale() : -1.0;
  };
  EXPECT_EQ(margin(point, point), -1.0);
  EXPECT_EQ(margin(edge, point), -1.0);
  EXPECT_EQ(margin(edge, edge), -1.0);
  EXPECT_GT(margin(edge, cross_edge), 0.1);
  EXPECT_GT(margin(square, square), 0.5);
  EXPECT_GT(margin(square, other), 0.3);
  EXPECT_GT(margin(other, square), 0.3);
}

// Vertex on vertex along the start, at many depths: the corner repeats, and every tangent is as good as another.
TEST(ContactDirection, LeavesTheVerticesOfOctahedra) {
  const double s = 1.0 / std::numbers::sqrt2;
  const std::vector<Vec3> octahedron{{0, s, s}, {0, -s, s}, {0, s, -s}, {0, -s, -s}, {1, 0, 0}, {-1, 0, 0}};
  const ClusteredMesh a = tests::mesh_through(octahedron);
  for (int i = 1; i < 200; ++i) {
    std::vector<Vec3> other = octahedron;
    for (Vec3& p : other) p = p + (2.0 * s * (1.0 - i / 400.0)) * Vec3{0, 1, 1};
    const Found found = direction(a, tests::mesh_through(other), {0, 1, 1});
    EXPECT_TRUE(tests::is_local_minimum(octahedron, other, found.n, 1e-13)) << i;
  }
}

TEST(ContactDirection, StackedBoxesHaveDepthZero) {
  const Found found = direction(tests::clustered_box({0, 0, 0}, {1, 1, 1}), tests::clustered_box({0, 0, 1}, {1, 1, 2}),
                                {0.1, 0.2, 1.0});
  EXPECT_EQ(found.depth, 0.0);
  expect_near(found.n, {0, 0, 1}, 1e-15);
}

TEST(ContactDirection, CrossedBarsTouchEdgeToEdge) {
  // Two bars with a square section stood on an edge, across each other: the face of the difference is edge-edge.
  const Mesh bar =
      tests::rotated(tests::centered_box({2.0, 0.25, 0.25}),
                     tests::rotation(std::cos(std::numbers::pi / 8), std::sin(std::numbers::pi / 8), 0, 0));
  const Mesh across = tests::rotated(bar, tests::rotation(1, 0, 0, 1));
  const double reach = 0.25 * std::numbers::sqrt2;
  const Found found = direction(tests::clustered(bar),
                                tests::clustered(tests::translated(across, {0, 0, 2 * reach - 0.01})), {0.05, 0.02, 1});
  EXPECT_NEAR(found.depth, 0.01, 1e-15);
  expect_near(found.n, {0, 0, 1}, 1e-14);
}

TEST(ContactDirection, FlatStraightAndPointLikeDifferences) {
  const ClusteredMesh sheet = tests::clustered(tests::sheet(4, 4, 2.0, 2.0));
  for (const double sign : {1.0, -1.0}) {
    const Found flat = direction(sheet, sheet, {0.3, 0.1, sign});
    EXPECT_EQ(flat.depth, 0.0);
    expect_near(flat.n, {0, 0, sign}, 1e-15);
  }
  const std::vector<Vec3> ends{{-1, 0, 0}, {1, 0, 0}}, point{{0, 0, 0}};
  const Found straight = direction(tests::mesh_through(ends), tests::mesh_through(ends), {0.5, 0.3, 0.4});
  EXPECT_EQ(straight.depth, 0.0);
  expect_near(straight.n, {0, 0.6, 0.8}, 1e-15);
  const Found single = direction(tests::mesh_through(point), tests::mesh_through(point), {0, 0.6, 0.8});
  EXPECT_EQ(single.depth, 0.0);
  expect_near(single.n, {0, 0.6, 0.8}, 1e-15);
}

std::vector<Vec3> cloud(Random& random, int kind, Vec3 center) {
  std::vector<Vec3> points;
  for (int i = 0; i < (kind == 1 ? 8 : kind == 2 ? 100 : 10); ++i) {
    Vec3 p = kind == 2 ? random.direction() : random.in_ball();
    if (kind == 1) p = {i & 1 ? 0.5 : -0.5, i & 2 ? 0.6 : -0.6, i & 4 ? 0.7 : -0.7};
    if (kind == 3) p.z = 0.0;
    if (kind == 4) p = {p.x, 1e-6 * p.y, 1e-6 * p.z};
    points.push_back(p + center);
  }
  return points;
}

TEST(ContactDirection, IsALocalMinimumAndNeverHigherThanItsStart) {
  Random random(11);
  int overlapping = 0;
  for (int i = 0; i < 500; ++i) {
    const std::vector<Vec3> a = cloud(random, i % 5, {}),
                            b = cloud(random, i / 5 % 5, random.uniform(0.0, 1.0) * random.direction());
    const ClusteredMesh mesh_a = tests::mesh_through(a), mesh_b = tests::mesh_through(b);
    const MinkowskiDifference m(mesh_a, mesh_b);
    if (gjk(m, {}, {}, {}).status == GjkStatus::apart) continue;
    ++overlapping;
    const Vec3 start = random.direction();
    const Found found = direction(mesh_a, mesh_b, start);
    const double size = m.size() / m.scale();
    EXPECT_NEAR(found.depth, static_cast<double>(tests::minkowski_height(a, b, found.n)), 1e-14 * size) << "case " << i;
    EXPECT_TRUE(tests::is_local_minimum(a, b, found.n, 1e-13 * size)) << "case " << i;
    EXPECT_LE(found.depth, static_cast<double>(tests::minkowski_height(a, b, start)) + 1e-14 * size) << "case " << i;
  }
  EXPECT_GT(overlapping, 150);
}

// The first of them, and those that show what is left out: corners that are near to a face's foot, faces that are not
// supported, a walk that ends above its start; and a corner between directions that lead lower, at a side across which
// the next face is hardly turned and higher (the last).
TEST(ContactDirection, HostilePairsEndAtLocalMinima) {
  std::vector<std::uint64_t> seeds{1115, 2053, 2951, 83345, 100435, 110414, (std::uint64_t{9901} << 40) + 166731};
  for (std::uint64_t seed = 0; seed < 600; ++seed) seeds.push_back(seed);
  std::int64_t directions = 0;
  for (const std::uint64_t seed : seeds) {
    EXPECT_EQ(tests::problem_of_directions(tests::hostile_hull_pair(seed), directions), "") << "seed " << seed;
  }
  EXPECT_GT(directions, 600);
}

// Corners of a face that are one point once its place is added have no side between them. And those that show what else
// is left out: sides of a face too small for directions of their own (the first two), faces as low as the first but
// narrow, beyond which it is lower, steps around a corner that rounding makes nothing (these two), corners of a side
// across which the next face is hardly turned (the last six).
TEST(ContactDirection, CoordinatesOfAllSizesEndAtLocalMinima) {
  constexpr std::uint64_t kSome = std::uint64_t{77} << 40, kOthers = std::uint64_t{6} << 40,
                          kCorners = std::uint64_t{9901} << 40;
  std::vector<std::uint64_t> seeds{kSome + 6339, kSome + 10540, kSome + 33350, kOthers + 285224, kOthers + 367284};
  for (const std::uint64_t seed : {2793, 49018, 75812, 97301, 120694, 131530}) seeds.push_back(kCorners + seed);
  for (std::uint64_t seed = 0; seed < 4000; ++seed) seeds.push_back(seed);
  std::int64_t directions = 0;
  for (const std::uint64_t seed : seeds) {
    EXPECT_EQ(tests::problem_of_directions(tests::hull_pair_of_all_sizes(seed), directions), "") << "seed " << seed;
  }
  EXPECT_GT(directions, 4000);
}

// Rods up to 1e11 times as long as thick: the difference is rounded with a radius far below its length.
TEST(ContactDirection, RodsTakeFewIterations) {
  Random random(23);
  int overlapping = 0, most = 0;
  for (int i = 0; i < 600; ++i) {
    const auto thickness = [&] { return std::pow(10.0, random.uniform(-11.0, -1.0)); };
    const Mesh rod = tests::rotated(tests::centered_box({1.0, thickness(), thickness()}), random.rotation());
    const Mesh other = i % 3 == 0
                           ? tests::icosphere(1, thickness())
                           : tests::rotated(tests::centered_box({1.0, thickness(), thickness()}), random.rotation());
    std::vector<Vec3> a, b;
    for (int v = 0; v < rod.vertex_count(); ++v) a.push_back(rod.position(v));
    const Vec3 shift = random.uniform(-0.5, 0.5) * (a[1] - a[0]);  // along the rod
    for (int v = 0; v < other.vertex_count(); ++v) b.push_back(other.position(v) + shift);
    const ClusteredMesh mesh_a = tests::mesh_through(a), mesh_b = tests::mesh_through(b);
    const MinkowskiDifference m(mesh_a, mesh_b);
    if (gjk(m, {}, {}, {}).status == GjkStatus::apart) continue;
    ++overlapping;
    const Found found = direction(mesh_a, mesh_b, random.direction());
    most = std::max(most, found.iterations);
    EXPECT_NEAR(found.depth, static_cast<double>(tests::minkowski_height(a, b, found.n)), 1e-14 * 4.0) << "case " << i;
    EXPECT_TRUE(tests::is_local_minimum(a, b, found.n, 1e-10)) << "case " << i;
  }
  EXPECT_GT(overlapping, 300);
  EXPECT_LE(most, 20);
}

TEST(ContactDirection, CoherentMotionTakesOneIterationOrNone) {
  Random random(3);
  const Mesh ball = tests::blob(3, 1.0, 0.2, 4);
  const ClusteredMesh a = tests::clustered(ball);
  Vec3 n{1, 0, 0};
  GjkSimplex face;
  FaceFinder faces;
  int iterations = 0;
  constexpr int kSteps = 300;
  for (int step = 0; step < kSteps; ++step) {
    const double t = step / static_cast<double>(kSteps);
    const Mesh moved = tests::rotated(tests::blob(3, 1.0, 0.2, 5), tests::rotation(1, 0.2 * t, 0.5 * t, 0.7 * t));
    const ClusteredMesh b = tests::clustered(tests::translated(moved, {1.6 - 0.2 * t, 0.3 * t, 0.1}));
    const MinkowskiDifference m(a, b);
    const ContactDirection d = contact_direction(m, n, face, {}, faces);
    iterations += d.iterations;
    n = d.n;
    face = d.face;
  }
  EXPECT_LE(iterations, 1.2 * kSteps);
}

}  // namespace
}  // namespace tact::narrowphase
