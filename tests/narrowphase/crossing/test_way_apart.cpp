#include <gtest/gtest.h>

#include <numeric>

#include "narrowphase/crossing/way_apart.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

std::vector<int> all_facets(const Mesh& mesh) {
  std::vector<int> facets(static_cast<std::size_t>(mesh.facet_count()));
  std::iota(facets.begin(), facets.end(), 0);
  return facets;
}

// The points between some facets of two meshes, or all of them.
std::vector<FeaturePoint> points_apart(const Mesh& a, const Mesh& b, std::vector<int> some_a, Vec3 came = {}) {
  const ClusteredMesh first = tests::clustered(a), second = tests::clustered(b);
  const Features of_first(first), of_second(second);
  const ScaledMesh scaled_a{first, of_first, 0.5}, scaled_b{second, of_second, 0.5};
  const PartOfSurface part_a{std::move(some_a), {}}, part_b{all_facets(b), {}};
  WayApart way;
  std::vector<FeaturePoint> found;
  way.append_points({.a = scaled_a,
                     .b = scaled_b,
                     .part_a = part_a,
                     .part_b = part_b,
                     .came = came,
                     .direction = {0, 0, 1},
                     .depth = 16.0},
                    found);
  return found;
}

TEST(WayApart, OfABoxInAnotherIsShortest) {
  const Mesh lower = tests::box({-1, -1, -1}, {1, 1, 0}), upper = tests::box({-0.5, -0.25, -0.125}, {0.5, 0.25, 1});
  const auto points = points_apart(lower, upper, all_facets(lower));
  ASSERT_EQ(points.size(), 4u);  // a corner each
  for (const FeaturePoint& point : points) {
    EXPECT_EQ(point.kind, FeaturePair::facet_vertex);
    EXPECT_DOUBLE_EQ(point.gap, -0.125);
    EXPECT_DOUBLE_EQ(point.normal.z, 1.0);
  }
}

TEST(WayApart, LeadsBackWhereItCameFrom) {
  const Mesh lower = tests::box({-1, -1, -1}, {1, 1, 0}), upper = tests::box({-0.5, -0.25, -0.125}, {0.5, 0.25, 1});
  for (const FeaturePoint& point : points_apart(lower, upper, all_facets(lower), {0.6, 0.0, 0.8}))
    EXPECT_DOUBLE_EQ(point.gap, -0.125);
  for (const FeaturePoint& point : points_apart(lower, upper, all_facets(lower), {1.0, 0.0, 0.0})) {
    EXPECT_DOUBLE_EQ(point.gap, -1.5);
    EXPECT_DOUBLE_EQ(point.normal.x, 1.0);
  }
}

// Of bars across each other, edges up and down: one point between these edges.
TEST(WayApart, MayBeBetweenEdges) {
  const Mesh along = tests::rotated(tests::centered_box({1, 0.1, 0.1}), tests::rotation(1, 0.41421356237309503, 0, 0)),
             across = tests::translated(
                 tests::rotated(tests::centered_box({0.1, 1, 0.1}), tests::rotation(1, 0, 0.41421356237309503, 0)),
                 {0, 0, 0.25});
  const auto points = points_apart(along, across, all_facets(along));
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].kind, FeaturePair::edge_edge);
  EXPECT_NEAR(points[0].gap, 0.25 - 0.2 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(points[0].normal.z, 1.0, 1e-12);
}

// Of a grid, the facets around the place where a blade goes through know nothing of those beside them, which the blade
// would meet on its way aside: these join until the way is up.
TEST(WayApart, TakesFacetsThatAreInTheWay) {
  const Mesh plate = tests::gridded_box({-1, -1, -0.0625}, {1, 1, 0}, 16),
             blade = tests::box({0.01, -0.02, -0.25}, {0.03, 0.05, 0.5});
  std::vector<int> beside;
  for (int f = 0; f < plate.facet_count(); ++f) {
    const Vec3 p = plate.position(plate.facets(0, f)), q = plate.position(plate.facets(1, f)),
               r = plate.position(plate.facets(2, f));
    const Vec3 middle = (1.0 / 3.0) * (p + q + r);
    if (std::abs(middle.x) < 0.15 && std::abs(middle.y) < 0.15) beside.push_back(f);
  }
  const auto points = points_apart(plate, blade, beside);
  ASSERT_FALSE(points.empty());
  for (const FeaturePoint& point : points) EXPECT_NEAR(point.gap, -0.25, 1e-9);
}

}  // namespace
}  // namespace tact::narrowphase
