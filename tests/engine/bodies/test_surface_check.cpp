// World::check_surface(): faults put into good meshes are found where they were put, and no others.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <array>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/mesh.h"

namespace tact::tests {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

SurfaceCheck checked(const Mesh& mesh) {
  World world;
  return world.check_surface(world.add_body({.positions = mesh.positions, .facets = mesh.facets}));
}

// In all 24 orientations of the axes.
template <class Expect>
void for_each_turn(const Mesh& mesh, const Expect& expect) {
  for (const Rotation& first : {rotation(1, 0, 0, 0), rotation(0, 1, 0, 0), rotation(1, 1, 0, 0), rotation(1, -1, 0, 0),
                                rotation(1, 0, 1, 0), rotation(1, 0, -1, 0)}) {
    for (const Rotation& second :
         {rotation(1, 0, 0, 0), rotation(1, 0, 0, 1), rotation(0, 0, 0, 1), rotation(1, 0, 0, -1)})
      expect(checked(rotated(rotated(mesh, first), second)));
  }
}

Mesh without_facets(Mesh mesh, int count) {
  mesh.facets = mesh.facets.rightCols(mesh.facet_count() - count).eval();
  return mesh;
}

TEST(SurfaceCheckOf, GoodSolids) {
  const Mesh two[] = {icosphere(2), translated(torus(16, 8, 1.0, 0.2), {4.0, 0.0, 0.0})};
  const Mesh hollow[] = {icosphere(2), turned_inside_out(icosphere(2, 0.5))};
  for (const Mesh& mesh :
       {icosphere(2), box({0, 0, 0}, {1, 2, 3}), organ(1), torus(16, 8, 1.0, 0.2), merged(two), merged(hollow)}) {
    const SurfaceCheck check = checked(mesh);
    EXPECT_TRUE(check.is_solid());
    EXPECT_TRUE(check.is_clean());
    EXPECT_TRUE(check.border_edges.empty() && check.unused_vertices.empty());
  }
  EXPECT_EQ(checked(merged(hollow)).components.size(), 2u);
}

TEST(SurfaceCheckOf, ACupHoweverItIsTurned) {
  Mesh cup = without_facets(box({0, 0, 0}, {1, 1, 1}), 2);
  for_each_turn(cup, [](const SurfaceCheck& check) {
    EXPECT_FALSE(check.is_solid());
    EXPECT_TRUE(check.is_clean());
    EXPECT_EQ(check.border_edges.size(), 4u);
    ASSERT_EQ(check.components.size(), 1u);
    EXPECT_FALSE(check.components[0].closed || check.components[0].inside_out);
  });
  for_each_turn(turned_inside_out(box({0, 0, 0}, {1, 1, 1})), [](const SurfaceCheck& check) {
    EXPECT_FALSE(check.is_solid() || check.is_clean());
    ASSERT_EQ(check.components.size(), 1u);
    EXPECT_TRUE(check.components[0].closed && check.components[0].inside_out);
  });
}

TEST(SurfaceCheckOf, FacetsThatWereTurned) {
  Mesh mesh = icosphere(2);
  for (const int facet : {3, 100, 101}) mesh.facets.col(facet).reverseInPlace();
  const SurfaceCheck check = checked(mesh);
  EXPECT_EQ(check.turned_facets, (std::vector<int>{3, 100, 101}));
  EXPECT_FALSE(check.is_solid() || check.is_clean());
}

TEST(SurfaceCheckOf, FacetsAndVerticesThatAreRepeated) {
  Mesh mesh = box({0, 0, 0}, {1, 1, 1});
  const Mesh once[] = {mesh, turned_inside_out(mesh)};
  const SurfaceCheck doubled = checked(merged(once));
  EXPECT_EQ(doubled.repeated_facets.size(), 12u);
  EXPECT_EQ(doubled.repeated_facets[0], (std::array<int, 2>{12, 0}));
  EXPECT_EQ(doubled.repeated_vertices.size(), 8u);
  EXPECT_EQ(doubled.repeated_vertices[7], (std::array<int, 2>{15, 7}));
  EXPECT_FALSE(doubled.is_clean());

  mesh.facets.conservativeResize(3, 13);
  mesh.facets.col(12) = mesh.facets.col(4);
  const SurfaceCheck check = checked(mesh);
  EXPECT_EQ(check.repeated_facets, (Pairs{{12, 4}}));
  EXPECT_EQ(check.branching_edges.size(), 3u);
  EXPECT_FALSE(check.is_solid());
}

TEST(SurfaceCheckOf, CrossingsSliversAndUnusedVertices) {
  const Mesh crossed[] = {icosphere(1), translated(icosphere(1), {1.0, 0.0, 0.0})};
  EXPECT_FALSE(checked(merged(crossed)).crossings.empty());

  MeshBuilder builder;
  builder.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  builder.vertex({5, 5, 5});
  builder.triangle({0, 0, 1}, {1, 0, 1}, {0.5, 1e-9, 1});
  builder.triangle({0, 0, 2}, {1, 0, 2}, {2, 0, 2});
  builder.triangle({3, 3, 3}, {3, 3, 3}, {3, 3, 3});
  const SurfaceCheck check = checked(builder.mesh());
  EXPECT_EQ(check.slivers, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(check.unused_vertices, (std::vector<int>{3}));
  EXPECT_EQ(check.border_edges.size(), 12u);
}

TEST(SurfaceCheckOf, NothingAndOfBadArguments) {
  World world;
  const BodyId body = world.add_body({.positions = Eigen::Matrix3Xd(3, 0), .facets = Eigen::Matrix3Xi(3, 0)});
  EXPECT_TRUE(world.check_surface(body).components.empty());
  EXPECT_THROW(world.check_surface(body, -1.0), Error);
  world.remove_body(body);
  EXPECT_THROW(world.check_surface(body), Error);
}

}  // namespace
}  // namespace tact::tests
