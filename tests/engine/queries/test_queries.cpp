// Rays, nearest points, boxes and what is inside, against brute force in rational numbers and long doubles.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/query_oracle.h"
#include "tests/support/oracles/triangle_oracle.h"

namespace tact::tests {
namespace {

TEST(Queries, RaysEqualRationalArithmetic) {
  Random random(1);
  std::size_t hits = 0;
  for (const Mesh& mesh : meshes_to_query()) {
    tact::World world({.threads = 2});
    const BodyId id = world.add_body({.positions = mesh.positions, .facets = mesh.facets});
    std::vector<Ray> rays;
    for (int i = 0; i < 150; ++i) rays.push_back(random_ray(mesh, random));
    std::vector<RayHit> firsts(rays.size());
    world.cast_rays(rays, firsts);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Vec3 from = point_of(rays[i].from), to = point_of(rays[i].to);
      std::set<int> expected, found;
      for (int f = 0; f < mesh.facet_count(); ++f) {
        if (cgal_meet({from, to, to}, facet_at(mesh, f))) expected.insert(f);
      }
      const std::vector<RayHit> all = world.cast_ray_all(rays[i]);
      for (const RayHit& hit : all) {
        EXPECT_EQ(hit.body, id);
        found.insert(hit.facet);
        const Vec3 on_ray = from + hit.fraction * (to - from),
                   on_facet = weighted(facet_at(mesh, hit.facet), hit.barycentric);
        EXPECT_LT(norm(on_ray - on_facet), 1e-12 * (1.0 + norm(to - from))) << "ray " << i;
        EXPECT_TRUE(hit.fraction >= 0.0 && hit.fraction <= 1.0);
      }
      ASSERT_EQ(found, expected) << "ray " << i;
      hits += all.size();
      EXPECT_EQ(firsts[i].facet < 0, all.empty());
      EXPECT_EQ(world.cast_ray(rays[i], RayHits::any).facet < 0, all.empty());
      if (all.empty()) continue;
      EXPECT_EQ(firsts[i].facet, all[0].facet);
      EXPECT_EQ(firsts[i].fraction, all[0].fraction);
    }
  }
  EXPECT_GT(hits, 500u);
}

// Many rays open the same clusters, whose facets are then held against them in floats.
TEST(Queries, ManyRaysAtOnceAnswerAsEachAlone) {
  Random random(7);
  // The last one has groups of nodes.
  for (const Mesh& mesh :
       {blob(4, 1.0, 0.3, 3), wrinkled_sheet(40, 2.0, 0.3, 1), needles(300, 1e4, 2), wrinkled_sheet(92, 2.0, 0.3, 1)}) {
    std::vector<Ray> rays;
    for (int i = 0; i < 1500; ++i) rays.push_back(i % 2 == 0 ? hard_ray(mesh, random) : random_ray(mesh, random));
    std::vector<RayHit> expected, hits(rays.size());
    for (const int threads : {1, 2, 16}) {  // on 16 they share trees of the last meshes
      tact::World world({.threads = threads});
      world.add_body({.positions = mesh.positions, .facets = mesh.facets});
      const Eigen::Matrix3Xd beside = mesh.positions.array() + 0.25;
      const BodyId other = world.add_body({.positions = mesh.positions, .facets = mesh.facets});
      for (int step = 0; step < 2; ++step) {
        world.set_positions(other, step == 0 ? mesh.positions : beside);
        for (const RayHits wanted : {RayHits::first, RayHits::any}) {
          world.cast_rays(rays, hits, wanted);
          std::size_t found = 0;
          for (std::size_t i = 0; i < rays.size(); ++i) {
            const RayHit alone = world.cast_ray(rays[i], wanted);
            ASSERT_TRUE(hits[i].body == alone.body && hits[i].facet == alone.facet &&
                        hits[i].fraction == alone.fraction && hits[i].barycentric == alone.barycentric)
                << "ray " << i << " on " << threads << " threads";
            found += alone.facet >= 0;
          }
          EXPECT_GT(found, rays.size() / 4);
        }
      }
      if (threads == 1) expected = hits;
      EXPECT_TRUE(std::ranges::equal(hits, expected, [](const RayHit& a, const RayHit& b) {
        return a.facet == b.facet && a.fraction == b.fraction && a.barycentric == b.barycentric;
      }));
    }
  }
}

// A ray that enters more leaves than a list has room for is asked alone.
TEST(Queries, ManyRaysThroughManyLayersAnswerAsEachAlone) {
  constexpr int kLayers = 2000;
  Mesh stack;
  stack.positions.resize(3, 4 * kLayers);
  stack.facets.resize(3, 2 * kLayers);
  for (int i = 0; i < kLayers; ++i) {
    for (int k = 0; k < 4; ++k) stack.positions.col(4 * i + k) << k % 2, k / 2, 0.001 * i;
    stack.facets.col(2 * i) << 4 * i, 4 * i + 1, 4 * i + 2;
    stack.facets.col(2 * i + 1) << 4 * i + 1, 4 * i + 3, 4 * i + 2;
  }
  tact::World world({.threads = 2});
  world.add_body({.positions = stack.positions, .facets = stack.facets});
  Random random(8);
  std::vector<Ray> rays(256);
  for (Ray& ray : rays) {
    ray.from << random.uniform(), random.uniform(), -1.0;
    ray.to << random.uniform(), random.uniform(), 3.0;
    if (random.chance(0.5)) std::swap(ray.from, ray.to);
  }
  std::vector<RayHit> hits(rays.size());
  world.cast_rays(rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayHit alone = world.cast_ray(rays[i]);
    EXPECT_TRUE(hits[i].facet == alone.facet && hits[i].fraction == alone.fraction &&
                hits[i].barycentric == alone.barycentric);
    EXPECT_EQ(hits[i].facet / 2, rays[i].from.z() < 0.0 ? 0 : kLayers - 1);
  }
}

TEST(Queries, NearestPointsEqualBruteForce) {
  Random random(2);
  for (const Mesh& mesh : meshes_to_query()) {
    tact::World world({.threads = 2});
    world.add_body({.positions = mesh.positions, .facets = mesh.facets});
    std::vector<PointQuery> queries;
    for (int i = 0; i < 100; ++i) {
      const Vec3 corner = facet_at(mesh, random.below(mesh.facet_count()))[0];
      queries.push_back({.point = vector_of(i % 4 == 0 ? corner : 3.0 * random.in_cube(1.0))});
    }
    std::vector<ClosestPoint> answers(queries.size());
    world.closest_points(queries, answers);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Vec3 p = point_of(queries[i].point);
      const double expected = static_cast<double>(distance_by_brute_force(mesh, p));
      EXPECT_NEAR(answers[i].distance, expected, 1e-12);
      EXPECT_NEAR(norm(weighted(facet_at(mesh, answers[i].facet), answers[i].barycentric) - p), expected, 1e-12);
      PointQuery nearer = queries[i];
      nearer.within = 0.5 * expected;
      EXPECT_TRUE(expected == 0.0 || world.closest_point(nearer).facet < 0);
      nearer.within = 2.0 * expected;
      EXPECT_EQ(world.closest_point(nearer).facet, answers[i].facet);
    }
  }
}

TEST(Queries, BoxesEqualCgal) {
  Random random(3);
  std::size_t hits = 0;
  for (const Mesh& mesh : meshes_to_query()) {
    tact::World world;
    const BodyId id = world.add_body({.positions = mesh.positions, .facets = mesh.facets});
    for (int i = 0; i < 40; ++i) {
      // On the grid on which some of the meshes have their vertices, too.
      const Vec3 p = i % 2 == 0
                         ? 2.0 * random.in_cube(1.0)
                         : Vec3{0.5 * random.below(6) - 1.5, 0.5 * random.below(6) - 1.5, 0.5 * random.below(6) - 1.5};
      const Vec3 size = i % 2 == 0 ? Vec3{random.uniform(), random.uniform(), random.uniform()} : Vec3{0.5, 0.5, 0.5};
      const BoxQuery query{.lower = vector_of(p), .upper = vector_of(p + size)};
      const Mesh solid = box(p, p + size);
      std::vector<FacetOfBody> expected;
      for (int f = 0; f < mesh.facet_count(); ++f) {
        const Triangle t = facet_at(mesh, f);
        bool meets = false;
        for (const Vec3& q : t) {
          const Eigen::Vector3d v = vector_of(q);
          meets = meets || ((v.array() >= query.lower.array()).all() && (v.array() <= query.upper.array()).all());
        }
        for (int k = 0; k < solid.facet_count() && !meets; ++k) meets = cgal_meet(t, facet_at(solid, k));
        if (meets) expected.push_back({id, f});
      }
      ASSERT_EQ(world.overlap_box(query), expected);
      hits += expected.size();
    }
  }
  EXPECT_GT(hits, 1000u);
}

TEST(Queries, WhatIsInsideIsCountedByItsWinding) {
  Random random(4);
  const Mesh grid = gridded_box({-1, -1, -1}, {1, 1, 1}, 4), ring = torus(16, 10, 1.0, 0.4),
             ball = blob(2, 1.0, 0.3, 1);
  tact::World world;
  const BodyId cube_id = world.add_body({.positions = grid.positions, .facets = grid.facets});
  const BodyId ring_id = world.add_body({.positions = ring.positions, .facets = ring.facets, .layer = 2});
  const BodyId ball_id = world.add_body({.positions = ball.positions, .facets = ball.facets, .layer = 4});
  const BodyId open = world.add_body({.positions = grid.positions, .facets = grid.facets, .surface = Surface::sheet});
  const auto is_in = [&](Vec3 p, BodyId id) {
    const std::vector<BodyId> found = world.bodies_containing({.point = vector_of(p)});
    EXPECT_FALSE(std::ranges::count(found, open));
    return std::ranges::count(found, id) == 1;
  };
  int inside = 0;
  for (int i = 0; i < 4000; ++i) {
    // On planes, edges and corners of the grid, and anywhere.
    Vec3 p = 1.5 * random.in_cube(1.0);
    if (i % 2 == 0) p = {0.25 * random.below(13) - 1.5, 0.25 * random.below(13) - 1.5, 0.25 * random.below(13) - 1.5};
    const bool expected = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= 1.0;
    EXPECT_EQ(is_in(p, cube_id), expected);
    inside += expected;
    if (i % 20 != 1) continue;
    // By the parity of crossings of a segment in a direction of its own.
    const Vec3 far = p + 10.0 * random.direction();
    for (const auto& [mesh, id] : {std::pair(&ring, ring_id), std::pair(&ball, ball_id)}) {
      int crossings = 0;
      for (int f = 0; f < mesh->facet_count(); ++f) crossings += cgal_meet({p, far, far}, facet_at(*mesh, f));
      EXPECT_EQ(is_in(p, id), crossings % 2 == 1);
    }
  }
  EXPECT_GT(inside, 500);
  // A corner of the ring is on its surface.
  EXPECT_TRUE(is_in(ring.position(0), ring_id));
  EXPECT_FALSE(is_in({0, 0, 0}, ring_id));
}

TEST(Queries, LayersMasksAndPositionsThatWereSet) {
  tact::World world;
  const Mesh ball = icosphere(1);
  const BodyId a = world.add_body({.positions = ball.positions, .facets = ball.facets, .layer = 2});
  const Ray ray{{0, 0, 5}, {0, 0, -5}};
  EXPECT_EQ(world.cast_ray(ray).body, a);
  EXPECT_LT(world.cast_ray({ray.from, ray.to, {.mask = 1}}).facet, 0);
  EXPECT_EQ(world.cast_ray({ray.from, ray.to, {.mask = 2}}).body, a);
  world.set_layers(a, 2, 8);
  EXPECT_LT(world.cast_ray({ray.from, ray.to, {.layer = 4}}).facet, 0);
  world.set_positions(a, translated(ball, {9, 0, 0}).positions);
  EXPECT_LT(world.cast_ray(ray).facet, 0);
  EXPECT_NEAR(world.closest_point({.point = {9, 0, 3}}).distance, 2.0, 0.2);
  world.remove_body(a);
  EXPECT_LT(world.closest_point({.point = {9, 0, 3}}).facet, 0);
}

TEST(Queries, HugeAndTinyBodies) {
  for (const double unit : {0x1p-900, 0x1p-300, 1.0, 0x1p290}) {
    tact::World world;
    Mesh ball = icosphere(2);
    ball.positions *= unit;
    world.add_body({.positions = ball.positions, .facets = ball.facets});
    const RayHit hit = world.cast_ray({{0.1 * unit, 0.2 * unit, 5 * unit}, {0.1 * unit, 0.2 * unit, -5 * unit}});
    ASSERT_GE(hit.facet, 0) << unit;
    EXPECT_NEAR(hit.fraction, 0.4, 0.01) << unit;
    const ClosestPoint closest = world.closest_point({.point = {0, 0, 3 * unit}});
    ASSERT_GE(closest.facet, 0) << unit;
    EXPECT_NEAR(closest.distance / unit, 2.0, 0.01) << unit;
    EXPECT_EQ(world.bodies_containing({.point = {0.1 * unit, 0, 0}}).size(), 1u) << unit;
  }
}

TEST(Queries, RefusalsNameTheQuery) {
  tact::World world;
  const auto code_of = [](const auto& call) {
    try {
      call();
    } catch (const Error& error) {
      return std::string(error_code_name(error.code())) + ": " + error.what();
    }
    return std::string();
  };
  std::vector<Ray> rays(3);
  rays[2].to.y() = std::nan("");
  std::vector<RayHit> hits(3);
  EXPECT_EQ(code_of([&] { world.cast_rays(rays, hits); }),
            "non_finite_position: query 2: the end of a ray has y = nan, which is not finite");
  hits.resize(2);
  EXPECT_EQ(code_of([&] { world.cast_rays(rays, hits); }), "wrong_size: 3 queries, but room for 2 answers");
  EXPECT_EQ(code_of([&] { world.closest_point({.within = -1.0}); }).substr(0, 16), "invalid_argument");
  EXPECT_EQ(code_of([&] {
              world.overlap_box({.lower = {1, 0, 0}, .upper = {0, 0, 0}});
            }).substr(0, 16),
            "invalid_argument");
  EXPECT_EQ(code_of([&] { world.bodies_containing({.point = {1e300, 0, 0}}); }).substr(0, 21), "position_out_of_range");
}

}  // namespace
}  // namespace tact::tests
