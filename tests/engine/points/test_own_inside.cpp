// Points whose way runs through the inside of the body that they are on are none.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using Eigen::Vector3d;

struct PlacedPoint {
  ContactPoint point;
  Vector3d on_a, on_b;
};

Vector3d place_on(const Mesh& mesh, const std::array<int, 3>& vertices, const std::array<double, 3>& weights) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    if (vertices[k] >= 0) sum += weights[k] * mesh.positions.col(vertices[k]);
  }
  return sum;
}

std::vector<PlacedPoint> placed_points(const Mesh& a, const Mesh& b, double margin, Surface surface = Surface::closed) {
  World world({.threads = 1, .outputs = {.points = true}});
  for (const Mesh* mesh : {&a, &b})
    world.add_body({.positions = mesh->positions, .facets = mesh->facets, .surface = surface, .margin = margin});
  std::vector<PlacedPoint> placed;
  for (const Contact& contact : world.detect().contacts()) {
    for (const ContactPoint& point : contact.points())
      placed.push_back(
          {point, place_on(a, point.a_vertices, point.a_weights), place_on(b, point.b_vertices, point.b_weights)});
  }
  return placed;
}

Mesh with_turned_facets(Mesh mesh) {
  mesh.facets.row(0).swap(mesh.facets.row(1));
  return mesh;
}

// Two plates of 20 mm, 30 mm apart, seen from 200 mm: no way begins on the far side of one. What begins on a side wall
// runs along it.
TEST(OwnInside, HasNoPointsOfTwoPlates) {
  const Mesh lower = gridded_box({0.0, 0.0, 0.0}, {0.3, 0.3, 0.02}, 3);
  const Mesh upper = gridded_box({0.01, 0.02, 0.05}, {0.31, 0.32, 0.07}, 4);
  const auto begins_outside = [](const PlacedPoint& one) { return one.on_a.z() > 1e-9 && one.on_b.z() < 0.07 - 1e-9; };
  const auto points = placed_points(lower, upper, 0.1);
  EXPECT_GT(points.size(), 20u);
  EXPECT_TRUE(std::ranges::all_of(points, begins_outside));
  // Without an inside all count: sheets, and what is turned inside out.
  EXPECT_FALSE(std::ranges::all_of(placed_points(lower, upper, 0.1, Surface::sheet), begins_outside));
  EXPECT_EQ(placed_points(with_turned_facets(lower), with_turned_facets(upper), 0.1).size(),
            placed_points(lower, upper, 0.1, Surface::sheet).size());
}

// A body that is open is no solid, whatever it was declared.
TEST(OwnInside, IsNoneOfOpenBodies) {
  Mesh open = gridded_box({0.0, 0.0, 0.0}, {0.3, 0.3, 0.02}, 3);
  const Mesh upper = gridded_box({0.01, 0.02, 0.05}, {0.31, 0.32, 0.07}, 4);
  open.facets.conservativeResize(3, open.facet_count() - 1);
  bool from_below = false;
  for (const auto& [point, on_a, on_b] : placed_points(open, upper, 0.1)) from_below |= on_a.z() == 0.0;
  EXPECT_TRUE(from_below);
}

// Of thin rings, which are not convex: each point that is left out begins inside, and no other is lost.
TEST(OwnInside, LosesNoPointThatLeadsOutside) {
  std::size_t all_lost = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random random(seed);
    const Mesh ring = torus(16, 8, 1.0, 0.15);
    const Mesh a = rotated(ring, random.rotation()), b = translated(rotated(ring, random.rotation()), {2.4, 0.1, 0.2});
    const auto solid = placed_points(a, b, 0.4), thin = placed_points(a, b, 0.4, Surface::sheet);
    std::vector<std::uint64_t> ids;
    for (const PlacedPoint& one : solid) ids.push_back(one.point.id);
    World world;
    for (const Mesh* mesh : {&a, &b}) world.add_body({.positions = mesh->positions, .facets = mesh->facets});
    std::size_t lost = 0;
    for (const PlacedPoint& one : thin) {
      if (std::ranges::find(ids, one.point.id) != ids.end()) continue;
      ++lost;
      // A step along the way from either end is inside one of the bodies.
      bool is_inside = false;
      for (const Vector3d& at :
           {Vector3d(one.on_a + 1e-6 * one.point.normal), Vector3d(one.on_b - 1e-6 * one.point.normal)})
        is_inside |= !world.bodies_containing({.point = at}).empty();
      EXPECT_TRUE(is_inside) << "seed " << seed << ", gap " << one.point.gap;
    }
    EXPECT_EQ(solid.size() + lost, thin.size());
    all_lost += lost;
  }
  EXPECT_GT(all_lost, 0u);
}

// A thin closed body with itself: nothing runs from wall to wall.
TEST(OwnInside, HasNoPointsOfABodyWithItself) {
  const Mesh plate = gridded_box({0.0, 0.0, 0.0}, {1.0, 1.0, 0.02}, 6);
  World world({.threads = 1, .outputs = {.points = true}});
  world.add_body({.positions = plate.positions, .facets = plate.facets, .margin = 0.05, .self_contact = true});
  for (const Contact& contact : world.detect().contacts()) EXPECT_EQ(contact.points().size(), 0u);
}

}  // namespace
}  // namespace tact::tests
