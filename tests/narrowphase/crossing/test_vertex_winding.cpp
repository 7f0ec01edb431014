#include <gtest/gtest.h>

#include "narrowphase/crossing/part_exit.h"
#include "narrowphase/crossing/vertex_winding.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

// The caller's numbers of the vertices that are inside another part.
std::vector<int> vertices_inside(const Mesh& mesh) {
  const ClusteredMesh clustered = tests::clustered(mesh);
  const Features features(clustered);
  const ScaledMesh scaled{clustered, features, unit_scale_of(clustered.box())};
  const PartExitFinder exits(clustered);
  VertexWinding winding;
  std::vector<int> inside;
  for (int source = 0; source < mesh.vertex_count(); ++source) {
    const int vertex = features.vertex_of_source(source);
    NearestExit at;
    at.place.vertices[0] = vertex;
    if (winding.is_inside(scaled, vertex, exits.normal_at(scaled, at))) inside.push_back(source);
  }
  return inside;
}

TEST(VertexWinding, IsInsideWhereBoxesOfOneMeshOverlap) {
  const Mesh first = tests::box({0, 0, 0}, {2, 2, 2});
  const Mesh apart[] = {first, tests::box({3, 0, 0}, {4, 1, 1})},
             nested[] = {first, tests::box({0.5, 0.5, 0.5}, {1, 1, 1})};
  EXPECT_TRUE(vertices_inside(tests::merged(apart)).empty());
  EXPECT_EQ(vertices_inside(tests::merged(nested)).size(), 8u);
  const Mesh corners[] = {first, tests::box({1.5, 1.25, 1.75}, {3, 3, 3})};
  const Mesh both = tests::merged(corners);
  const std::vector<int> inside = vertices_inside(both);
  ASSERT_EQ(inside.size(), 2u);
  EXPECT_EQ(both.position(inside[0]), (base::Vec3{2, 2, 2}));
  EXPECT_EQ(both.position(inside[1]), (base::Vec3{1.5, 1.25, 1.75}));
}

// What touches another part from outside is not inside it; nor is anything of a shell, of which one wall is turned
// inside out. What sinks into another part along its surface is.
TEST(VertexWinding, IsNotInsideWherePartsTouch) {
  const Mesh first = tests::box({0, 0, 0}, {1, 1, 1});
  const Mesh touching[] = {first, tests::box({1, 0, 0}, {2, 1, 1})},
             beside[] = {first, tests::box({1, 0.25, 0.5}, {2, 2, 2})};
  EXPECT_TRUE(vertices_inside(tests::merged(touching)).empty());
  EXPECT_TRUE(vertices_inside(tests::merged(beside)).empty());
  const Mesh level[] = {first, tests::box({0.5, 0, 0}, {2, 1, 1})};
  EXPECT_EQ(vertices_inside(tests::merged(level)).size(), 8u);
  const Mesh shell[] = {first, tests::turned_inside_out(tests::box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}))};
  EXPECT_TRUE(vertices_inside(tests::merged(shell)).empty());
}

TEST(VertexWinding, KnowsMeshesWithoutABorder) {
  const auto closed = [](const Mesh& mesh) {
    const ClusteredMesh clustered = tests::clustered(mesh);
    const Features features(clustered);
    return is_closed({&clustered, &features});
  };
  EXPECT_TRUE(closed(tests::icosphere(1)));
  EXPECT_FALSE(closed(tests::sheet(2, 2, 1, 1)));
  Mesh open = tests::cube(1.0, {});
  std::swap(open.facets(0, 0), open.facets(1, 0));
  EXPECT_FALSE(closed(open));
}

}  // namespace
}  // namespace tact::narrowphase
