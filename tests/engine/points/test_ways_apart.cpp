// Bodies that cross without a vertex in each other, and thin ones: each crossing has points, and whoever moves along
// them comes out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

BodyDefinition crossing_body(const Mesh& mesh, double margin = 0.0) {
  return {.positions = mesh.positions, .facets = mesh.facets, .margin = margin};
}

double reach_along(const Mesh& mesh, Vec3 n) {
  double most = -std::numeric_limits<double>::infinity();
  for (int v = 0; v < mesh.vertex_count(); ++v) most = std::max(most, dot(n, mesh.position(v)));
  return most;
}

// Of two convex bodies: over the normals of their facets and the directions across an edge of each.
double least_translation(const Mesh& a, const Mesh& b) {
  double least = std::numeric_limits<double>::infinity();
  const auto look_along = [&](Vec3 n) {
    if (!(norm(n) > 1e-9)) return;
    n = normalized(n);
    least = std::min({least, reach_along(a, n) + reach_along(b, -n), reach_along(a, -n) + reach_along(b, n)});
  };
  std::vector<Vec3> edges[2];
  for (const bool of_b : {false, true}) {
    const Mesh& mesh = of_b ? b : a;
    for (int f = 0; f < mesh.facet_count(); ++f) {
      const Vec3 p = mesh.position(mesh.facets(0, f)), q = mesh.position(mesh.facets(1, f)),
                 r = mesh.position(mesh.facets(2, f));
      look_along(cross(q - p, r - p));
      for (const Vec3 edge : {q - p, r - q, p - r}) edges[of_b].push_back(normalized(edge));
    }
  }
  for (const Vec3& e : edges[0]) {
    for (const Vec3& f : edges[1]) look_along(cross(e, f));
  }
  return least;
}

// How b moves if each point with a negative gap is closed after the other.
Vec3 along_points(const Contact& contact) {
  Vec3 way;
  for (const ContactPoint& point : contact.points()) {
    const Vec3 n{point.normal.x(), point.normal.y(), point.normal.z()};
    const double gap = point.gap + dot(n, way);
    if (point.gap < 0.0 && gap < 0.0) way = way + (1e-9 - gap) * n;
  }
  return way;
}

struct Parting {
  int passes = 0;  // until nothing meets
  double way = 0.0;
};

// Moves b along the points until it is out of a, or so often.
Parting part(const Mesh& a, Mesh b, double margin, const std::string& what) {
  constexpr int kMost = 12;
  World world({.threads = 1, .outputs = {.points = true}});
  const BodyId first = world.add_body(crossing_body(a, margin)), second = world.add_body(crossing_body(b, margin));
  Parting parting;
  Vec3 way;
  for (; parting.passes < kMost; ++parting.passes) {
    const Contact* contact = world.detect().find_contact(first, second);
    if (contact == nullptr || contact->facet_pairs().empty()) break;
    const Vec3 next = along_points(*contact);
    EXPECT_GT(norm(next), 0.0) << what << ": no point in pass " << parting.passes;
    way = way + next;
    b = translated(b, next);
    world.set_positions(second, b.positions);
  }
  EXPECT_LT(parting.passes, kMost) << what << ": not apart";
  parting.way = norm(way);
  return parting;
}

TEST(WaysApart, OfBladesPlatesAndRodsAreTheLeastTranslation) {
  const Mesh plate = centered_box({1, 1, 0.0625}), blade = centered_box({0.5, 0.0625, 0.5});
  // Out of the plate, half of the blade and half of the plate.
  EXPECT_NEAR(part(plate, blade, 0.0, "upright").way, 0.5625, 1e-6);
  EXPECT_NEAR(part(plate, translated(blade, {0, 0, 0.25}), 0.0, "half way in").way, 0.3125, 1e-6);
  // Over its rim, where the nearest way is aside.
  EXPECT_NEAR(part(plate, translated(blade, {1.4, 0.1, 0.0}), 0.0, "rim").way, 0.1, 1e-6);
  const Mesh rod = centered_box({1, 0.0625, 0.0625});
  const Mesh across = rotated(rod, rotation(1.0, 0.1, 0.2, 0.9));
  for (const double shift : {0.0, 0.02, -0.05}) {
    const Mesh moved = translated(across, {0.01, 0.03, shift});
    const Parting parting = part(rod, moved, 0.0, "rods");
    EXPECT_LE(parting.way, 1.01 * least_translation(rod, moved));
    EXPECT_LE(parting.passes, 2);
  }
}

// Bodies of facets wider than they are thick, at random: the kinds of which half of the crossings have no vertex
// inside.
TEST(WaysApart, OfRandomThinBodiesAreThereAndShort) {
  Random random(5);
  const Mesh kinds[] = {centered_box({1, 1, 0.05}), centered_box({1, 0.06, 0.06}), centered_box({1, 0.3, 0.025}),
                        gridded_box({-1, -1, -0.05}, {1, 1, 0.05}, 2), spike({0, 0, 1}, 0.6)};
  int crossings = 0, long_ways = 0;
  for (int k = 0; k < 400; ++k) {
    const Mesh& a = kinds[random.below(5)];
    const Mesh b = translated(rotated(kinds[random.below(5)], random.rotation()), 0.7 * random.in_ball());
    const std::string what = "pair " + std::to_string(k);
    const Parting parting = part(a, b, k % 2 == 0 ? 0.0 : 0.01, what);
    if (parting.passes == 0) continue;
    ++crossings;
    long_ways += parting.way > 1.5 * least_translation(a, b) + 1e-6;
    EXPECT_LE(parting.passes, 8) << what;
  }
  EXPECT_GT(crossings, 100);
  EXPECT_LE(long_ways, crossings / 10);
}

// A rod that sinks through another one: up, as far as it came in until it reaches out below.
TEST(WaysApart, OfARodThatSinksThroughARodLeadBackTheWayItCame) {
  const Mesh rod = centered_box({1, 0.0625, 0.0625}), across = rotated(rod, rotation(1.0, 0.0, 0.0, 0.9));
  for (const double margin : {0.0, 0.01}) {
    World world({.threads = 1, .outputs = {.points = true}});
    const BodyId a = world.add_body(crossing_body(rod, margin)),
                 b = world.add_body(crossing_body(translated(across, {0.01, 0.02, 0.2}), margin));
    world.detect();
    for (double z = 0.12; z > -0.12; z -= 0.01) {
      world.set_positions(b, translated(across, {0.01, 0.02, z}).positions);
      const Contact* contact = world.detect().find_contact(a, b);
      ASSERT_NE(contact, nullptr);
      ASSERT_FALSE(contact->points().empty()) << z;
      double deepest = 0.0;
      for (const ContactPoint& point : contact->points()) {
        if (point.gap < 0.0) {
          EXPECT_GT(point.normal.z(), 0.9) << z << ", margin " << margin;
        }
        deepest = std::min(deepest, point.gap);
      }
      EXPECT_LT(deepest, 0.0);
      if (z > 0.001) {
        EXPECT_NEAR(deepest, z - 0.125, 1e-9) << margin;
      }
    }
  }
}

// A square cup, open above: walls so thick.
Mesh cup(double wall) {
  MeshBuilder builder;
  const auto corners = [&](double half, double bottom) {
    for (int i = 0; i < 8; ++i) builder.vertex({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? 1.0 : bottom});
  };
  corners(1.0 + wall, -1.0 - wall);
  corners(1.0, -1.0);
  for (const auto& q : {std::array{0, 2, 3, 1},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5},
                        {8, 9, 11, 10},
                        {8, 12, 13, 9},
                        {10, 11, 15, 14},
                        {8, 10, 14, 12},
                        {9, 13, 15, 11},
                        {4, 5, 13, 12},
                        {5, 7, 15, 13},
                        {7, 6, 14, 15},
                        {6, 4, 12, 14}})
    builder.quad(q[0], q[1], q[2], q[3]);
  return builder.mesh();
}

// One vertex of the spike is in the wall of the cup, through both sides of which its edges come in.
TEST(Gaps, InAThinWallAreTheDistanceToTheWall) {
  const double wall = 0.0078125;
  MeshBuilder builder;
  for (const Vec3& v : {Vec3{1.25, 0, 0.6875}, {1.001953125, 0.25, 0.75}, {0.5, -0.25, 0.71875}, {0.5, 0, 0.65625}})
    builder.vertex(v);
  builder.facet(0, 2, 1), builder.facet(0, 1, 3), builder.facet(0, 3, 2), builder.facet(1, 2, 3);
  const Mesh tetrahedron = builder.mesh();
  World world({.threads = 1, .outputs = {.points = true}});
  const BodyId a = world.add_body(crossing_body(cup(wall))), b = world.add_body(crossing_body(tetrahedron));
  const Contact* contact = world.detect().find_contact(a, b);
  ASSERT_NE(contact, nullptr);
  int found = 0;
  for (const ContactPoint& point : contact->points()) {
    if (point.kind != FeaturePair::facet_vertex || point.gap >= 0.0) continue;
    EXPECT_EQ(point.b_vertices[0], 1);
    EXPECT_NEAR(point.gap, -0.001953125, 1e-12);
    ++found;
  }
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace tact::tests
