// Overlaps against CGAL's corefinement, and turns against 50 digits. Not part of the ordinary tests: it is compiled at
// night alone, as corefinement takes a minute. How many is read from the environment.
//   TACT_LONG_OVERLAPS  200 if not set
//   TACT_LONG_TURNS     2000 if not set
//   TACT_LONG_SEED      which ones, 1 if not set
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/environment/environment.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/body_oracle.h"
#include "tests/support/oracles/query_oracle.h"

namespace tact::tests {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

SurfaceMesh surface_of(const Mesh& mesh) {
  SurfaceMesh surface;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.position(v);
    surface.add_vertex({p.x, p.y, p.z});
  }
  using Vertex = SurfaceMesh::Vertex_index;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const auto corner = [&](int k) { return Vertex(static_cast<SurfaceMesh::size_type>(mesh.facets(k, f))); };
    surface.add_face(corner(0), corner(1), corner(2));
  }
  return surface;
}

struct OverlapByCgal {
  double volume = 0.0, area = 0.0;
};

OverlapByCgal overlap_by_cgal(const Mesh& a, const Mesh& b) {
  SurfaceMesh of_a = surface_of(a), of_b = surface_of(b), both;
  namespace processing = CGAL::Polygon_mesh_processing;
  processing::corefine_and_compute_intersection(of_a, of_b, both);
  OverlapByCgal result;
  if (both.is_empty()) return result;
  result.volume = CGAL::to_double(processing::volume(both));
  for (const auto face : both.faces()) {
    std::vector<Vec3> corners;
    for (const auto vertex : CGAL::vertices_around_face(both.halfedge(face), both)) {
      const auto& p = both.point(vertex);
      corners.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    }
    result.area += 0.5 * norm(cross(corners[1] - corners[0], corners[2] - corners[0]));
  }
  return result;
}

Mesh placed_anywhere(const Mesh& mesh, double away, Random& random) {
  return translated(rotated(mesh, random.rotation()), away * random.direction());
}

void expect_overlap(const Mesh& a, const Mesh& b, const std::string& what) {
  World world;
  const BodyId of_a = world.add_body({.positions = a.positions, .facets = a.facets}),
               of_b = world.add_body({.positions = b.positions, .facets = b.facets});
  const OverlapByCgal expected = overlap_by_cgal(a, b);
  for (const Overlap& found : {world.overlap(of_a, of_b), world.overlap(of_b, of_a)}) {
    EXPECT_NEAR(found.volume, expected.volume, 1e-12) << what;
    EXPECT_NEAR(found.area, expected.area, 1e-12) << what;
  }
}

TEST(BodyQueriesAtLength, OverlapsEqualCgal) {
  const std::vector<Mesh> meshes{icosphere(2), torus(16, 8, 1.0, 0.4), blob(2, 1.0, 0.3, 1),
                                 gridded_box({-1, -1, -1}, {1, 1, 1}, 3), organ(3)};
  for_seeds("TACT_LONG_OVERLAPS", 200, [&](std::uint64_t seed) {
    Random random(seed);
    const auto any = [&]() -> const Mesh& { return meshes[static_cast<std::size_t>(random.below(5))]; };
    expect_overlap(any(), placed_anywhere(any(), random.uniform(0.2, 1.5), random), "seed " + std::to_string(seed));
  });
  expect_overlap(centered_box({1, 1, 1}), icosphere(2, 0.5), "one inside the other");
  expect_overlap(centered_box({1, 1, 1}), translated(icosphere(2, 0.5), {4, 0, 0}), "apart");
}

Mesh one_triangle(const Triangle& t) {
  MeshBuilder builder;
  builder.triangle(t[0], t[1], t[2]);
  return builder.mesh();
}

TEST(BodyQueriesAtLength, TurnsAreNeverLate) {
  for_seeds("TACT_LONG_TURNS", 2000, [](std::uint64_t seed) {
    Random random(seed);
    Triangle t, u;
    for (Vec3& p : t) p = random.in_cube(1.0);
    for (Vec3& p : u) p = random.in_cube(1.0);
    const double size = std::pow(10.0, -random.below(4));
    for (std::size_t k = 1; k < 3; ++k) t[k] = t[0] + size * (t[k] - t[0]), u[k] = u[0] + size * (u[k] - u[0]);
    const Vec3 axis = random.direction();
    const double angle = random.uniform(-8.0, 8.0);
    const Mesh first = one_triangle(t), second = one_triangle(u);
    World world({.threads = 1});
    const BodyId a = world.add_body({.positions = first.positions, .facets = first.facets});
    world.add_body({.positions = second.positions, .facets = second.facets});
    const SweepHit hit = world.sweep({.body = a, .axis = vector_of(axis), .angle = angle});
    const std::optional<double> expected = first_on_turn(t, axis, angle, u);
    ASSERT_EQ(hit.facet >= 0, expected.has_value()) << seed;
    if (!expected) return;
    ASSERT_LE(hit.fraction, *expected + 1e-13) << seed;
    // Facets that graze take a time for the last of their way that is one of the angle. Of 600,000 turns the earliest
    // but one are early by 7e-7 of them, or by 3e-6 radians of one by 5; one by 0.038 radians by 1.6e-6 of it.
    ASSERT_GE(hit.fraction, *expected - 1e-6 / std::min(1.0, std::abs(angle))) << seed;
  });
}

}  // namespace
}  // namespace tact::tests
