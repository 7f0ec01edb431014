// Normals and directions have a length of 1, of however narrow or small facets.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

// How many points there are.
int expect_units(const Mesh& a, const Mesh& b, double margin, const std::string& what) {
  World world({.threads = 1, .outputs = {.zones = true, .patches = true, .points = true}});
  for (const Mesh* mesh : {&a, &b}) {
    world.add_body({.positions = mesh->positions,
                    .facets = mesh->facets,
                    .surface = mesh->facet_count() > 3 ? Surface::closed : Surface::sheet,
                    .margin = margin});
  }
  int points = 0;
  for (const Contact& contact : world.detect().contacts()) {
    EXPECT_NEAR(contact.direction.norm(), 1.0, 1e-12) << what;
    EXPECT_TRUE(std::isfinite(contact.depth)) << what;
    for (const ContactPoint& point : contact.points()) {
      ++points;
      EXPECT_NEAR(point.normal.norm(), 1.0, 1e-12) << what << ", kind " << static_cast<int>(point.kind) << ", gap "
                                                   << point.gap << ", normal " << point.normal.transpose();
      EXPECT_TRUE(std::isfinite(point.gap)) << what;
      for (const auto& weights : {point.a_weights, point.b_weights}) {
        EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1.0, 1e-12) << what;
        EXPECT_GE(*std::ranges::min_element(weights), 0.0) << what;
      }
    }
    for (const Patch& patch : contact.patches()) {
      EXPECT_NEAR(patch.direction.norm(), 1.0, 1e-12) << what;
      EXPECT_TRUE(patch.point.allFinite() && std::isfinite(patch.area)) << what;
    }
  }
  return points;
}

Mesh one_facet(Vec3 p, Vec3 q, Vec3 r) {
  MeshBuilder builder;
  builder.triangle(p, q, r);
  return builder.mesh();
}

TEST(Normals, OfAVertexOnANeedleAreUnits) {
  const Mesh tip = one_facet({0.0, 0.0, 0.25}, {1.0, 0.0, 0.25}, {1.0, 1.0, 0.25});
  for (int power = 0; power <= 323; ++power) {
    const double width = std::pow(10.0, -power);
    const Mesh needle = one_facet({0.0, 0.0, 0.0}, {0.0, width, 0.0}, {0.0, 0.0, 1.0});
    const std::string what = "1e-" + std::to_string(power);
    EXPECT_GT(expect_units(needle, tip, 0.01, what), 0);
    EXPECT_GT(expect_units(tip, needle, 0.01, what), 0);
    expect_units(needle, tip, 0.0, what);
  }
}

// Facets, edges and whole bodies that are small beside the others, in any position; and ways that are as short.
TEST(Normals, OfNarrowAndSmallFacetsAreUnits) {
  Random random(5);
  int points = 0;
  for (int i = 0; i < 1500; ++i) {
    const double small = std::pow(10.0, -random.uniform(0.0, 323.0)), margin = random.chance(0.5) ? 0.01 : 0.0;
    const auto about = [&](Vec3 p) { return p + small * random.in_cube(1.0); };
    const Vec3 at = random.chance(0.5) ? Vec3{} : random.in_cube(1.0);
    const auto shape = [&]() -> Mesh {
      switch (random.below(6)) {
        case 0: return one_facet(at, about(at), random.in_cube(1.0));
        case 1: return one_facet(about(at), about(at), about(at));
        case 2: return one_facet(about(at), random.in_cube(1.0), random.in_cube(1.0));
        case 3: return translated(scaled(icosphere(0), small), at);
        case 4: return mapped(icosphere(0), [&](Vec3 p) { return Vec3{p.x, p.y, small * p.z} + at; });
        default: return one_facet(at, at + Vec3{small, 0.0, 0.0}, at + Vec3{0.0, small, 0.0});
      }
    };
    const Mesh a = shape(), b = shape();
    points += expect_units(a, b, margin, "case " + std::to_string(i));
  }
  EXPECT_GT(points, 1000);
}

// Small facets in a large mesh are facets: a vertex as little above the inside of one has a point there.
TEST(Normals, OfSmallFacetsInALargeMeshStandOnThem) {
  for (const double small : {1e-3, 1e-80, 1e-150, 1e-162, 1e-200, 1e-300}) {
    MeshBuilder builder;
    builder.triangle({0.0, 0.0, 0.0}, {4.0 * small, 0.0, 0.0}, {0.0, 4.0 * small, 0.0});
    builder.triangle({1.0, 1.0, 0.0}, {2.0, 1.0, 0.0}, {1.0, 2.0, 0.0});
    const Mesh vertex = one_facet({small, small, 0.5 * small}, {small, small, 1.0}, {0.5, small, 1.0});
    World world({.threads = 1, .outputs = {.points = true}});
    const Mesh mesh = builder.mesh();
    for (const Mesh* one : {&mesh, &vertex}) {
      world.add_body({.positions = one->positions, .facets = one->facets, .surface = Surface::sheet, .margin = 0.01});
    }
    const Report& report = world.detect();
    ASSERT_EQ(report.contacts().size(), 1u);
    bool found = false;
    for (const ContactPoint& point : report.contacts()[0].points()) {
      if (point.kind != FeaturePair::facet_vertex || point.a_vertices[2] < 0) continue;
      found = true;
      EXPECT_NEAR(point.normal.z(), 1.0, 1e-15) << small;
      EXPECT_NEAR(point.gap, 0.5 * small, 1e-15 * small) << small;
    }
    EXPECT_TRUE(found) << small;
  }
}

}  // namespace
}  // namespace tact::tests
