// What lies at one place, or equally near: numbers are exact ones, rounded once, so that a tie is a tie.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/query_oracle.h"

namespace tact::tests {
namespace {

__extension__ typedef __int128 Whole;

// Exact for whole numbers of a few thousand.
Eigen::Vector3d whole_in_cube(Random& random, int reach) {
  const auto any = [&] { return static_cast<double>(random.below(2 * reach + 1) - reach); };
  return {any(), any(), any()};
}

// Two facets with a common side.
Mesh two_facets(Random& random, int reach) {
  Mesh mesh;
  mesh.positions.resize(3, 4);
  for (int v = 0; v < 4; ++v) mesh.positions.col(v) = whole_in_cube(random, reach);
  mesh.facets.resize(3, 2);
  mesh.facets << 0, 1, 1, 0, 2, 3;
  return mesh;
}

// When a ray crosses the plane of a facet: a quotient of whole numbers. Not a number if it lies in it.
double crossing_time(const Mesh& mesh, int facet, const Ray& ray) {
  const Eigen::Vector3d p = mesh.positions.col(mesh.facets(0, facet)), q = mesh.positions.col(mesh.facets(1, facet)),
                        r = mesh.positions.col(mesh.facets(2, facet)), n = (q - p).cross(r - p);
  return n.dot(p - ray.from) / n.dot(ray.to - ray.from);
}

// Of rays through a side, a corner or the inside.
TEST(PlaceTies, AFacetIsMetAtItsExactTimeAndOfSeveralTheLeastIsFirst) {
  Random random(5);
  int ties = 0;
  for (const int reach : {3, 10, 100}) {
    for (int i = 0; i < 3000; ++i) {
      const Mesh mesh = two_facets(random, reach);
      const Eigen::Vector3d way = whole_in_cube(random, reach), v0 = mesh.positions.col(0), v1 = mesh.positions.col(1),
                            v2 = mesh.positions.col(2);
      const Eigen::Vector3d at = i % 3 == 0   ? v0
                                 : i % 3 == 1 ? Eigen::Vector3d(0.5 * (v0 + v1))
                                              : Eigen::Vector3d(0.25 * (v0 + v1 + 2.0 * v2));
      const Ray ray{.from = at + way, .to = at - way};
      World world({.threads = 1});
      world.add_body({.positions = mesh.positions, .facets = mesh.facets, .surface = Surface::sheet});
      const std::vector<RayHit> hits = world.cast_ray_all(ray);
      if (hits.empty()) continue;
      EXPECT_TRUE(std::ranges::is_sorted(hits, {}, [](const RayHit& h) { return std::pair(h.fraction, h.facet); }));
      const RayHit first = world.cast_ray(ray);
      EXPECT_EQ(first.facet, hits[0].facet);
      EXPECT_EQ(first.fraction, hits[0].fraction);
      for (const RayHit& hit : hits) {
        const double time = crossing_time(mesh, hit.facet, ray);
        if (!std::isfinite(time)) continue;
        EXPECT_EQ(hit.fraction, time) << "reach " << reach << ", case " << i;
      }
      ties += hits.size() == 2 && hits[0].fraction == hits[1].fraction;
    }
  }
  EXPECT_GT(ties, 3000);
}

// In one batch, and in a world of several bodies whose faces lie on each other.
TEST(PlaceTies, StackedBodiesAreMetInTheOrderOfBodiesAndFacets) {
  World world({.threads = 2});
  for (int k = 0; k < 4; ++k) {
    const Mesh mesh = gridded_box({-1.0, -1.0, 0.1 * (3 - k)}, {1.0, 1.0, 0.1 * (4 - k)}, 8);
    world.add_body({.positions = mesh.positions, .facets = mesh.facets});
  }
  Random random(3);
  std::vector<Ray> rays(400);
  for (Ray& ray : rays) {
    const Eigen::Vector3d at(0.25 * (random.below(7) - 3), random.uniform(-1.0, 1.0), 0.0);
    ray = {.from = at + Eigen::Vector3d(0.0, 0.0, -1.0), .to = at + Eigen::Vector3d(0.0, 0.0, 3.0)};
  }
  std::vector<RayHit> together(rays.size());
  world.cast_rays(rays, together);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::vector<RayHit> hits = world.cast_ray_all(rays[i]);
    std::set<double> places;
    for (const RayHit& hit : hits) places.insert(hit.fraction);
    EXPECT_EQ(places.size(), 5u) << i;  // the faces of four boxes, one above the other
    EXPECT_EQ(together[i].facet, hits[0].facet);
    EXPECT_EQ(together[i].body, hits[0].body);
    EXPECT_EQ(together[i].fraction, hits[0].fraction);
    for (std::size_t k = 1; k < hits.size(); ++k) {
      EXPECT_LT(std::tuple(hits[k - 1].fraction, hits[k - 1].body, hits[k - 1].facet),
                std::tuple(hits[k].fraction, hits[k].body, hits[k].facet));
    }
  }
}

TEST(PlaceTies, ARayInAPlaneEntersEachFacetWhereItLeavesTheOneBefore) {
  const Mesh mesh = sheet(6, 1, 0.9, 0.3);  // its sides lie at 0.15 and the like
  World world({.threads = 1});
  world.add_body({.positions = mesh.positions, .facets = mesh.facets, .surface = Surface::sheet});
  const Mesh wall = mapped(mesh, [](Vec3 p) { return Vec3{p.x, p.z, p.y}; });  // across it, with the same sides
  world.add_body({.positions = wall.positions, .facets = wall.facets, .surface = Surface::sheet});
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const double y = random.uniform(-0.1, 0.1);
    const Ray ray{.from = {-1.0 - random.uniform(), y, 0.0}, .to = {1.0 + random.uniform(), -y, 0.0}};
    for (const RayHit& hit : world.cast_ray_all(ray)) {
      const Eigen::Vector3d on_ray = ray.from + hit.fraction * (ray.to - ray.from);
      Eigen::Vector3d on_facet = Eigen::Vector3d::Zero();
      const Mesh& of = hit.body.index == 0 ? mesh : wall;
      for (int k = 0; k < 3; ++k)
        on_facet += hit.barycentric[static_cast<std::size_t>(k)] * of.positions.col(of.facets(k, hit.facet));
      EXPECT_LT((on_ray - on_facet).norm(), 1e-14);
    }
  }
}

struct WholeQuotient {
  Whole above, below;
  friend bool operator<(const WholeQuotient& p, const WholeQuotient& q) {
    return p.above * q.below < q.above * p.below;
  }
  friend bool operator==(const WholeQuotient& p, const WholeQuotient& q) {
    return p.above * q.below == q.above * p.below;
  }
};

Whole whole_dot(const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return static_cast<Whole>(p.dot(q)); }

// The square of the distance of a point from a facet, all at whole numbers.
WholeQuotient square_of_distance(const Eigen::Vector3d& point, const Mesh& mesh, int facet) {
  std::array<Eigen::Vector3d, 3> c;
  for (int k = 0; k < 3; ++k) c[static_cast<std::size_t>(k)] = mesh.positions.col(mesh.facets(k, facet)) - point;
  const Eigen::Vector3d n = (c[1] - c[0]).cross(c[2] - c[0]);
  WholeQuotient least{whole_dot(c[0], c[0]), 1};
  int inner = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d &p = c[k], &q = c[(k + 1) % 3], side = q - p;
    inner += n.dot(p.cross(q)) > 0.0;
    const Whole along = -whole_dot(p, side), length = whole_dot(side, side);
    WholeQuotient of_side{whole_dot(p, p), 1};
    if (along > 0 && along < length) of_side = {whole_dot(p.cross(side), p.cross(side)), length};
    if (along >= length) of_side = {whole_dot(q, q), 1};
    least = std::min(least, of_side);
  }
  if (inner == 3) least = {whole_dot(n, c[0]) * whole_dot(n, c[0]), whole_dot(n, n)};
  return least;
}

TEST(PlaceTies, OfEquallyNearFacetsTheLeastIsFound) {
  Random random(11);
  int ties = 0;
  for (const int reach : {2, 3, 10}) {
    for (int i = 0; i < 2000; ++i) {
      const Mesh first = two_facets(random, reach), second = two_facets(random, reach);
      World world({.threads = 1});
      for (const Mesh* mesh : {&first, &second})
        world.add_body({.positions = mesh->positions, .facets = mesh->facets, .surface = Surface::sheet});
      const Eigen::Vector3d point = whole_in_cube(random, 3 * reach);
      std::vector<WholeQuotient> squares;
      for (const Mesh* mesh : {&first, &second}) {
        for (int f = 0; f < 2; ++f) squares.push_back(square_of_distance(point, *mesh, f));
      }
      const auto least = std::ranges::min_element(squares, std::less<WholeQuotient>());
      const ClosestPoint closest = world.closest_point({.point = point});
      ASSERT_EQ(static_cast<int>(2 * closest.body.index) + closest.facet, least - squares.begin())
          << "reach " << reach << ", case " << i;
      const double distance = std::sqrt(static_cast<double>(least->above) / static_cast<double>(least->below));
      EXPECT_NEAR(closest.distance, distance, 1e-15 * distance);
      ties += std::ranges::count(squares, *least) > 1;
    }
  }
  EXPECT_GT(ties, 1500);
}

// What is found at a distance is found again within that distance, and not within the next smaller number.
TEST(PlaceTies, WhatIsFoundIsWithinItsDistance) {
  Random random(262);
  int found = 0;
  for (const Mesh& source : meshes_to_query()) {
    for (const double scale : {1.0, 1e-4, 1e6, 0x1p-1030}) {
      const Mesh mesh = scaled(source, scale);
      World world({.threads = 1});
      world.add_body({.positions = mesh.positions, .facets = mesh.facets, .surface = Surface::sheet});
      for (int i = 0; i < 60; ++i) {
        const Vec3 point = scale * hard_point(source, random);
        PointQuery query{.point = vector_of(point)};
        const ClosestPoint closest = world.closest_point(query);
        ASSERT_GE(closest.facet, 0);
        query.within = closest.distance;
        const ClosestPoint again = world.closest_point(query);
        EXPECT_EQ(again.facet, closest.facet) << "distance " << closest.distance;
        EXPECT_EQ(again.distance, closest.distance);
        if (closest.distance == 0.0) continue;
        query.within = std::nextafter(closest.distance, 0.0);
        EXPECT_LT(world.closest_point(query).facet, 0) << "distance " << closest.distance;
        ++found;
      }
    }
  }
  EXPECT_GT(found, 1000);
}

// Everything scaled by a power of two: the same answers, down to the smallest numbers.
TEST(PlaceTies, SubnormalBodiesHaveTheAnswersOfLargeOnes) {
  Mesh mesh;
  mesh.positions.resize(3, 3);
  mesh.positions << 0, 8192, 1024, 0, 512, 8192, 0, 3000, 1000;
  mesh.facets = Eigen::Vector3i(0, 1, 2);
  const Eigen::Vector3d from(1000, 1200, 9000), to(2500, 3000, -7000), point(2000, 2000, 3000);
  RayHit expected;
  double expected_distance = 0.0;
  for (const int power : {0, 300, 500, 900, 970, 985, 1000, 1020, 1022, 1030, 1040, 1050, 1060, 1070}) {
    const double unit = std::ldexp(1.0, -power);
    World world({.threads = 1});
    world.add_body(
        {.positions = Eigen::Matrix3Xd(unit * mesh.positions), .facets = mesh.facets, .surface = Surface::sheet});
    const Ray ray{.from = unit * from, .to = unit * to};
    const RayHit hit = world.cast_ray(ray);
    const ClosestPoint closest = world.closest_point({.point = unit * point});
    if (power == 0) expected = hit, expected_distance = closest.distance;
    EXPECT_EQ(hit.facet, 0) << power;
    EXPECT_EQ(hit.fraction, expected.fraction) << power;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(hit.barycentric[k], expected.barycentric[k], 1e-14) << power;
    EXPECT_EQ(closest.distance, unit * expected_distance) << power;
    EXPECT_EQ(world.closest_point({.point = unit * point, .within = closest.distance}).facet, 0) << power;
  }
}

}  // namespace
}  // namespace tact::tests
