#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "narrowphase/direction/adjacent_faces.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/mesh_through.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::narrowphase {
namespace {

// A pyramid over a polygon, apex up, less a point below the apex: the heights of the faces around the apex differ, and
// none but the lowest of them is right.
struct Pyramid {
  std::vector<Vec3> corners;
  Vec3 inside;

  Pyramid(int sides, tests::Random& random) {
    const Vec3 apex{0, 0, 0};
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + random.uniform(0.0, 0.3)) / sides;
      corners.push_back({std::cos(angle), std::sin(angle), -0.4});
    }
    corners.push_back(apex);
    inside = {random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), -0.1};
  }

  double lowest_face() const {
    double lowest = std::numeric_limits<double>::infinity();
    const Vec3 apex = corners.back();
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const Vec3 next = corners[(i + 1) % (corners.size() - 1)];
      lowest = std::min(lowest, dot(normalized(cross(corners[i] - apex, next - apex)), apex - inside));
    }
    return lowest;
  }
};

TEST(AdjacentFaces, AroundACornerTheLowestIsFound) {
  tests::Random random(7);
  for (int sides = 3; sides <= 60; ++sides) {
    const Pyramid pyramid(sides, random);
    const ClusteredMesh a = tests::mesh_through(pyramid.corners);
    const ClusteredMesh b = tests::mesh_through(std::vector<Vec3>{pyramid.inside});
    const MinkowskiDifference m(a, b);
    const double tolerance = 4.0 * m.height_error();
    FaceFinder faces;
    AdjacentFaces adjacent(m, faces, tolerance);
    const Vec3 up{0, 0, 1};
    const MinkowskiVertex top = m.support(up);
    const auto lowest = adjacent.lowest(
        {.n = up, .height = dot(up, top.point), .top = top, .polygon = &faces.supported(m, up, tolerance, top)}, 0.0);
    ASSERT_TRUE(lowest) << sides;
    EXPECT_NEAR(dot(*lowest, m.support(*lowest).point) / m.scale(), pyramid.lowest_face(), 1e-14) << sides;
    EXPECT_GT(adjacent.support_queries(), sides);
  }
}

// The foot is a corner itself, but for rounding: no direction away from it is better than another.
TEST(AdjacentFaces, FromAFootOnACornerToAFace) {
  const double s = 1.0 / std::numbers::sqrt2, r = 1.0;
  const std::vector<Vec3> octahedron{{0, s, s}, {0, -s, s}, {0, s, -s}, {0, -s, -s}, {r, 0, 0}, {-r, 0, 0}};
  const ClusteredMesh a = tests::mesh_through(octahedron);
  const Vec3 n = normalized(Vec3{0, 1, 1});
  for (int i = 1; i <= 400; ++i) {
    const double k = s * (1.0 - i / 400.0);
    const ClusteredMesh b = tests::mesh_through(std::vector<Vec3>{{0, k, k}});  // M's corner is (0, s - k, s - k)
    const MinkowskiDifference m(a, b);
    const double tolerance = 4.0 * m.height_error();
    FaceFinder faces;
    AdjacentFaces adjacent(m, faces, tolerance);
    const MinkowskiVertex top = m.support(n);
    const auto lowest = adjacent.lowest(
        {.n = n, .height = dot(n, top.point), .top = top, .polygon = &faces.supported(m, n, tolerance, top)}, 0.0);
    ASSERT_TRUE(lowest) << i;
    EXPECT_NEAR(dot(*lowest, m.support(*lowest).point), dot(n, top.point) / std::numbers::sqrt3, 1e-14) << i;
  }
}

// The foot lies in the middle of the top of a box, or so near to a side of it that what is behind is lower.
TEST(AdjacentFaces, OverASideOnlyIfTheFootIsNearIt) {
  const std::vector<Vec3> box{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  const ClusteredMesh a = tests::mesh_through(box);
  const Vec3 up{0, 0, 1};
  for (const double x : {0.5, 0.95}) {
    const ClusteredMesh b = tests::mesh_through(std::vector<Vec3>{{x, 0.5, 0.9}});
    const MinkowskiDifference m(a, b);
    FaceFinder faces;
    AdjacentFaces adjacent(m, faces, 4.0 * m.height_error());
    const MinkowskiVertex top = m.support(up);
    const auto lowest = adjacent.lowest({.n = up,
                                         .height = dot(up, top.point),
                                         .top = top,
                                         .polygon = &faces.supported(m, up, 4.0 * m.height_error(), top)},
                                        0.06 * m.scale());
    EXPECT_EQ(lowest.has_value(), x > 0.9);
    EXPECT_NEAR(lowest.value_or(up).x, x > 0.9 ? 1.0 : 0.0, 1e-15);
  }
}

TEST(AdjacentFaces, ASideWithoutLengthTurnsNothing) {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const ClusteredMesh a = tests::mesh_through(corners);
  const ClusteredMesh b = tests::mesh_through(std::vector<Vec3>{{0.1, 0.1, 0.1}});
  const MinkowskiDifference m(a, b);
  const Vec3 up{0, 0, 1};
  const FacePolygon polygon{.u = {1, 0, 0}, .v = {0, 1, 0}, .corner = {{0.5, 0.5}, {0.5, 0.5}}};
  const Vec3 outward = outward_of_side(polygon, 0);
  EXPECT_TRUE(std::isnan(outward.x));
  const MinkowskiVertex top = m.support(up);
  EXPECT_EQ(turned_to_next_face(m, up, top.point, outward, 4.0 * m.height_error(), top), up);
}

}  // namespace
}  // namespace tact::narrowphase
