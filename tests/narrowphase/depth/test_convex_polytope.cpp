#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "narrowphase/depth/convex_polytope.h"

namespace tact::narrowphase {
namespace {

std::size_t face_count(const ConvexPolytope& polytope) {
  const auto& faces = polytope.faces();
  return static_cast<std::size_t>(
      std::count_if(faces.begin(), faces.end(), [](const auto& face) { return !face.removed; }));
}

// Adds every point that lies outside, and validates after each.
ConvexPolytope hull_of(const std::vector<Vec3>& points, const std::array<Vec3, 4>& tetrahedron) {
  ConvexPolytope polytope(tetrahedron);
  polytope.validate();
  for (const Vec3& p : points) {
    const int below = polytope.face_below(p);
    if (below < 0) continue;
    const int first = polytope.expand(below, p);
    EXPECT_TRUE(polytope.faces()[below].removed);
    for (int f = first; f < static_cast<int>(polytope.faces().size()); ++f) EXPECT_EQ(polytope.corner(f, 2), p);
    polytope.validate();
  }
  for (const Vec3& p : points) EXPECT_EQ(polytope.face_below(p), -1);
  return polytope;
}

const std::array<Vec3, 4> kTetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

}  // namespace

TEST(ConvexPolytope, TetrahedronInAnyOrder) {
  std::array<int, 4> order{0, 1, 2, 3};
  do {
    std::array<Vec3, 4> points;
    for (std::size_t i = 0; i < 4; ++i) points[i] = kTetrahedron[order[i]];
    const ConvexPolytope polytope(points);
    polytope.validate();
    EXPECT_EQ(polytope.face_below({0.1, 0.1, 0.1}), -1);
    EXPECT_GE(polytope.face_below({0.4, 0.4, 0.4}), 0);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(ConvexPolytope, ValidateNoticesAPolytopeThatIsNotConvex) {
  ConvexPolytope polytope(kTetrahedron);
  const Vec3 p{1, 1, 1};
  const int below = polytope.face_below(p);
  polytope.expand(below == 0 ? 1 : 0, p);  // a face that p does not lie beyond
  EXPECT_THROW(polytope.validate(), std::logic_error);
}

TEST(ConvexPolytope, CubeHasTwelveFaces) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0});
  EXPECT_EQ(face_count(hull_of(corners, kTetrahedron)), 12u);
}

TEST(ConvexPolytope, RandomPoints) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points(150);
  for (Vec3& p : points) {
    p = base::normalized({normal(random), normal(random), normal(random)});
  }
  EXPECT_EQ(face_count(hull_of(points, {points[0], points[1], points[2], points[3]})), 2 * points.size() - 4);
}

// A grid: almost every point lies in the plane of a face or on the line of an edge.
TEST(ConvexPolytope, GridsFullOfCoplanarPoints) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<Vec3> grid;
    for (int i = 0; i < 64; ++i) grid.push_back({i % 4 + 0.0, i / 4 % 4 + 0.0, i / 16 + 0.0});
    std::shuffle(grid.begin(), grid.end(), std::mt19937(seed));
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    hull_of(grid, kTetrahedron);
  }
}

// The same grid turned: planes and lines hold but for rounding, and faces are as thin as rounding.
TEST(ConvexPolytope, GridsThatAreCoplanarButForRounding) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<Vec3> grid;
    const double c = std::cos(seed + 1.0), s = std::sin(seed + 1.0);
    for (int i = 0; i < 64; ++i) {
      const Vec3 p{i % 4 + 0.0, i / 4 % 4 + 0.0, i / 16 + 0.0};
      const Vec3 q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
      grid.push_back({q.x, c * q.y - s * q.z, s * q.y + c * q.z});
    }
    const std::array<Vec3, 4> tetrahedron{grid[0], grid[1], grid[4], grid[16]};
    std::shuffle(grid.begin(), grid.end(), random);
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    hull_of(grid, tetrahedron);
  }
}

TEST(ConvexPolytope, NearlyFlatPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Vec3> points(200);
  for (Vec3& p : points) p = {uniform(random), uniform(random), 1e-300 * uniform(random)};
  hull_of(points, {points[0], points[1], points[2], points[3]});
}

}  // namespace tact::narrowphase
