// Each pair of features has one point, however bodies touch and whatever a mesh lists twice.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/point_oracle.h"

namespace tact::tests {
namespace {

// The points of all contacts, by features; a facet's vertices ascend.
std::map<PointKey, const ContactPoint*> points_once(const Report& report, const std::string& what) {
  std::map<PointKey, const ContactPoint*> points;
  for (const Contact& contact : report.contacts()) {
    for (const ContactPoint& point : contact.points()) {
      PointKey key{point.kind, point.a_vertices, point.b_vertices};
      for (std::array<int, 3>* vertices : {&std::get<1>(key), &std::get<2>(key)}) {
        if ((*vertices)[2] >= 0) std::ranges::sort(*vertices);
      }
      EXPECT_TRUE(points.emplace(key, &point).second)
          << what << ": kind " << static_cast<int>(point.kind) << ", " << point.a_vertices[0] << " of a and "
          << point.b_vertices[0] << " of b twice, gap " << point.gap;
    }
  }
  return points;
}

World world_of(const Mesh& a, const Mesh& b, double margin, Surface surface = Surface::closed) {
  World world({.threads = 1, .outputs = {.points = true}});
  for (const Mesh* mesh : {&a, &b})
    world.add_body({.positions = mesh->positions, .facets = mesh->facets, .surface = surface, .margin = margin});
  return world;
}

// A tetrahedron that stands on a box: an edge of it passes through the box and touches an edge of it.
TEST(PointsOnce, OfATetrahedronOnABox) {
  Mesh a;
  a.positions.resize(3, 4);
  a.positions << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  a.facets.resize(3, 4);
  a.facets << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
  const Mesh b = box({0.5, 0.25, -1.0}, {1.5, 1.25, 0.0});
  for (const double margin : {0.0, 0.01}) {
    for (const double lift : {0.0, 1e-9, -1e-9}) {
      World world = world_of(translated(a, {0.0, 0.0, lift}), b, margin);
      EXPECT_FALSE(points_once(world.detect(), "tetrahedron").empty() && lift <= 0.0);
    }
  }
}

// Solids at whole and half numbers: most touch in corners, edges and faces, or pass through each other along them.
TEST(PointsOnce, OfSolidsThatTouch) {
  Random random(4);
  std::size_t touching = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto solid = [&]() -> Mesh {
      switch (random.below(4)) {
        case 0: return box({0, 0, 0}, {1.0 + random.below(2), 1.0, 1.0});
        case 1: return gridded_box({0, 0, 0}, {1, 1, 1}, 2);
        case 2: return spike({0.5 * random.below(4), 0.5 * random.below(4), 1.0 + random.below(2)}, 1.0);
        default: {
          Mesh mesh = box({0, 0, 0}, {1, 1, 1});
          const double lean = 0.5 * random.below(3);
          return mapped(mesh, [&](Vec3 p) { return Vec3{p.x + lean * p.z, p.y, p.z}; });
        }
      }
    };
    const Mesh a = solid();
    const Vec3 by{0.5 * random.below(5) - 1.0, 0.5 * random.below(5) - 1.0, 0.5 * random.below(5) - 1.0};
    const Mesh b = translated(solid(), by);
    World world = world_of(a, b, random.chance(0.5) ? 0.0 : 0.25 * random.below(3));
    const auto points = points_once(world.detect(), "solids " + std::to_string(i));
    touching +=
        static_cast<std::size_t>(std::ranges::count_if(points, [](const auto& one) { return one.second->gap == 0.0; }));
  }
  EXPECT_GT(touching, 1000u);
}

// Lists some facets once more, in the same order, turned or the other way around.
Mesh with_repeated_facets(Mesh mesh, Random& random) {
  const int count = mesh.facet_count();
  std::vector<Eigen::Vector3i> more;
  for (int f = 0; f < count; ++f) {
    const Eigen::Vector3i c = mesh.facets.col(f);
    for (int n = random.below(3); n > 0; --n) {
      const int turn = random.below(4);
      more.push_back(turn == 0   ? c
                     : turn == 1 ? Eigen::Vector3i(c[1], c[2], c[0])
                     : turn == 2 ? Eigen::Vector3i(c[2], c[0], c[1])
                                 : Eigen::Vector3i(c[1], c[0], c[2]));
    }
  }
  mesh.facets.conservativeResize(3, count + static_cast<int>(more.size()));
  for (std::size_t i = 0; i < more.size(); ++i) mesh.facets.col(count + static_cast<int>(i)) = more[i];
  return mesh;
}

// The same points as without: those of a facet are those of the one that is listed first.
TEST(PointsOnce, OfFacetsThatAreListedAgain) {
  Random random(9);
  std::size_t inside_facets = 0;
  for (int i = 0; i < 60; ++i) {
    const Mesh lower = wrinkled_sheet(4 + random.below(10), 2.0, 0.1, random.bits() % 1000),
               upper = translated(wrinkled_sheet(4 + random.below(10), 2.0, 0.1, random.bits() % 1000), {0, 0, 0.22});
    World plain = world_of(lower, upper, 0.1, Surface::sheet),
          repeated =
              world_of(with_repeated_facets(lower, random), with_repeated_facets(upper, random), 0.1, Surface::sheet);
    const Report &one = plain.detect(), &other = repeated.detect();
    const auto expected = points_once(one, "plain"), points = points_once(other, "repeated");
    ASSERT_EQ(points.size(), expected.size());
    for (const auto& [key, point] : points) {
      const auto known = expected.find(key);
      ASSERT_NE(known, expected.end());
      EXPECT_EQ(point->id, known->second->id);
      EXPECT_EQ(point->gap, known->second->gap);
      EXPECT_EQ(point->a_weights, known->second->a_weights);
      EXPECT_EQ(point->b_weights, known->second->b_weights);
      inside_facets += point->a_vertices[2] >= 0 || point->b_vertices[2] >= 0;
    }
  }
  EXPECT_GT(inside_facets, 500u);
}

TEST(PointsOnce, SoHasEachImpact) {
  Random random(6);
  const Mesh lower = wrinkled_sheet(10, 2.0, 0.1, 3), upper = translated(wrinkled_sheet(10, 2.0, 0.1, 5), {0, 0, 0.4});
  std::vector<std::size_t> counts;
  for (const bool again : {false, true}) {
    World world({.threads = 1});
    BodyId moving;
    for (const Mesh* mesh : {&lower, &upper}) {
      const Mesh added = again ? with_repeated_facets(*mesh, random) : *mesh;
      moving = world.add_body({.positions = added.positions, .facets = added.facets, .surface = Surface::sheet});
    }
    world.detect();
    world.set_positions(moving, translated(upper, {0.1, 0.05, -0.8}).positions);
    counts.push_back(world.detect_motion().impacts().size());
  }
  EXPECT_GT(counts[0], 50u);
  EXPECT_EQ(counts[0], counts[1]);
}

TEST(PointsOnce, OfABodyThatListsFacetsAgainAndMeetsItself) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const auto layer = [&](double z) {
      return translated(wrinkled_sheet(8, 2.0, 0.05, random.bits() % 1000), {0.0, 0.0, z});
    };
    const std::array layers{layer(0.0), layer(0.13)};
    const Mesh folded = merged(layers), again = with_repeated_facets(folded, random);
    std::vector<std::size_t> counts;
    for (const Mesh* mesh : {&folded, &again}) {
      World world({.threads = 1, .outputs = {.points = true}});
      world.add_body({.positions = mesh->positions,
                      .facets = mesh->facets,
                      .surface = Surface::sheet,
                      .margin = 0.1,
                      .self_contact = true});
      counts.push_back(points_once(world.detect(), "folded").size());
    }
    EXPECT_EQ(counts[0], counts[1]);
    EXPECT_GT(counts[0], 20u);
  }
}

// What crosses without any vertex past it has points of the way apart; vertices with such a point are near as well.
TEST(PointsOnce, OfTrianglesThatCross) {
  Random random(5);
  std::size_t count = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<Mesh, 2> meshes;
    for (Mesh& mesh : meshes) {
      mesh.facets = Eigen::Vector3i(0, 1, 2);
      mesh.positions.resize(3, 3);
      for (double& x : mesh.positions.reshaped()) x = random.uniform(-1.0, 1.0);
    }
    World world = world_of(meshes[0], meshes[1], 0.2, Surface::sheet);
    count += points_once(world.detect(), "triangles").size();
  }
  EXPECT_GT(count, 2000u);
}

}  // namespace
}  // namespace tact::tests
