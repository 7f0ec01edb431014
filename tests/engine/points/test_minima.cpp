// Which contact points are minima of both surfaces.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using Eigen::Vector3d;

std::vector<ContactPoint> points_of(const Mesh& a, const Mesh& b, double margin, Surface surface_a = Surface::sheet,
                                    Surface surface_b = Surface::closed) {
  World world({.threads = 1, .outputs = {.points = true}});
  world.add_body({.positions = a.positions, .facets = a.facets, .surface = surface_a, .margin = margin});
  world.add_body({.positions = b.positions, .facets = b.facets, .surface = surface_b, .margin = margin});
  const Report& report = world.detect();
  if (report.contacts().empty()) return {};
  const auto points = report.contacts()[0].points();
  return {points.begin(), points.end()};
}

int count_minima(const std::vector<ContactPoint>& points) {
  return static_cast<int>(std::ranges::count_if(points, [](const ContactPoint& point) { return point.minimum; }));
}

// A square of 4 in cells, around the origin, turned and moved.
Mesh floor_of(int cells, const Rotation& turn) {
  return rotated(translated(sheet(cells, cells, 4.0, 4.0), {0.0, 0.0, 0.0}), turn);
}

// Whether some facet at the feature leads along n by more than `slope`: plain numbers, all facets.
bool leads(const Mesh& mesh, const std::array<int, 3>& feature, const std::array<double, 3>& weights, const Vector3d& n,
           double slope) {
  Vector3d at = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    if (feature[k] >= 0) at += weights[k] * mesh.positions.col(feature[k]);
  }
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const bool has =
        std::ranges::all_of(feature, [&](int v) { return v < 0 || (mesh.facets.col(f).array() == v).any(); });
    for (int k = 0; k < 3 && has; ++k) {
      const Vector3d way = mesh.positions.col(mesh.facets(k, f)) - at;
      if (way.norm() > 0.0 && way.dot(n) > slope * way.norm()) return true;
    }
  }
  return false;
}

// Those that are clearly one or the other, by brute force.
TEST(Minima, AreThoseOfBruteForce) {
  int minima = 0, others = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    const Mesh a = blob(2, 1.0, 0.25, seed);
    for (const double reach : {0.05, 0.3}) {
      for (const double away : {1.7, 2.1}) {
        const Mesh b = translated(blob(2, 1.0, 0.25, seed + 40), {away, 0.1, 0.2});
        for (const ContactPoint& point : points_of(a, b, reach, Surface::closed)) {
          const auto slope = [&](double limit) {
            return leads(a, point.a_vertices, point.a_weights, point.normal, limit) ||
                   (point.gap > 0.0 && leads(b, point.b_vertices, point.b_weights, -point.normal, limit)) ||
                   (point.gap < 0.0 && point.kind != FeaturePair::vertex_facet &&
                    leads(b, point.b_vertices, point.b_weights, -point.normal, limit));
          };
          if (point.gap < 0.0 && point.kind == FeaturePair::facet_vertex) continue;
          point.minimum ? ++minima : ++others;
          if (point.minimum) {
            EXPECT_FALSE(slope(1e-6)) << "seed " << seed << ", gap " << point.gap;
          }
          if (!point.minimum) {
            EXPECT_TRUE(slope(1e-12)) << "seed " << seed << ", gap " << point.gap;
          }
        }
      }
    }
  }
  EXPECT_GT(minima, 10);
  EXPECT_GT(others, 200);
}

TEST(Minima, OfABallOverAPlaneIsOne) {
  const Mesh ball = icosphere(3, 0.5);
  for (const double x : {0.05, 0.31, 0.77}) {
    const auto points = points_of(floor_of(3, {}), translated(ball, {x, 0.02, 0.51}), 0.03);
    EXPECT_GT(points.size(), 10u);
    EXPECT_LE(count_minima(points), 4);  // a facet of the ball may lie level
    EXPECT_GE(count_minima(points), 1);
  }
}

// A box over a flat floor of many facets, turned anyhow with it: minima are along the floor's normal, and each lower
// corner has one, whatever rounding does to its height.
TEST(Minima, OfABoxOnAFlatFloorAreAlongItsNormal) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const Rotation turn = random.rotation();
    const Mesh floor = floor_of(9, turn);
    const Vec3 at = random.in_cube(0.5);
    const Mesh cube = rotated(translated(centered_box({0.3, 0.3, 0.3}), {at.x + 1.0, at.y + 1.0, 0.31}), turn);
    const Vector3d up(turn.row[0].z, turn.row[1].z, turn.row[2].z);
    int corners = 0;
    for (const ContactPoint& point : points_of(floor, cube, 0.2)) {
      const double slant = point.normal.cross(up).norm();
      if (point.minimum) {
        EXPECT_LT(slant, 1e-9) << "seed " << seed << ", kind " << static_cast<int>(point.kind);
      }
      corners += point.minimum && point.kind == FeaturePair::facet_vertex ? 1 : 0;
    }
    EXPECT_EQ(corners, 4) << "seed " << seed;
  }
}

// Floor vertices ahead of a box have points that lean against it.
TEST(Minima, AreNoFloorVerticesAheadOfABox) {
  const Mesh floor = floor_of(8, {}), cube = translated(centered_box({0.3, 0.3, 0.3}), {0.69, 0.1, 0.31});
  int leaning = 0;
  for (const ContactPoint& point : points_of(floor, cube, 0.05)) {
    const bool leans = std::hypot(point.normal.x(), point.normal.y()) > 1e-9;
    leaning += leans ? 1 : 0;
    if (leans) {
      EXPECT_FALSE(point.minimum);
    }
  }
  EXPECT_GT(leaning, 0);
}

TEST(Minima, OfEdgesAndTipsAndPointsOfNoFacet) {
  // Two edges across each other, the tip of a spike, and a body that is one vertex.
  const Mesh ridge = spike({0.0, 0.0, 1.0}, 0.5), floor = floor_of(2, {});
  for (const ContactPoint& point : points_of(floor,
                                             translated(mapped(ridge,
                                                               [](Vec3 p) {
                                                                 return Vec3{p.x, p.y, -p.z};
                                                               }),
                                                        {1.1, 1.2, 1.05}),
                                             0.1, Surface::sheet, Surface::sheet))
    EXPECT_EQ(point.minimum, point.kind == FeaturePair::facet_vertex && std::abs(point.normal.z()) > 0.999);
  Mesh dot;
  dot.positions.resize(3, 1);
  dot.positions << 1.1, 1.2, 0.05;
  dot.facets = Eigen::Matrix3Xi::Zero(3, 1);
  const auto points = points_of(floor, dot, 0.1, Surface::sheet, Surface::sheet);
  ASSERT_EQ(count_minima(points), 1);
}

}  // namespace
}  // namespace tact::tests
