#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/mesh/features.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_blocks.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

constexpr double kScale = 0.5;
constexpr BoxBounds kCutBox{{-0.15, -0.1, -0.2}, {0.15, 0.25, 0.1}};
constexpr Grid kCutGrid{{-0.15, -0.1, -0.2}, {300.0, 1e6, 0.0}};  // the second axis has more cells than there are
constexpr double kWiden = 0.01;

// The vertices of a cluster, those that it owns first.
std::vector<Vec3> scaled_vertices(const ClusteredMesh& mesh, int cluster) {
  const ClusterFacets facets = mesh.facets_of(cluster);
  std::vector<Vec3> all;
  for (int i = 0; i < facets.owned_count; ++i) all.push_back(kScale * mesh.position(facets.owned_begin + i));
  for (int i = 0; i < facets.borrowed_count; ++i) all.push_back(kScale * mesh.position(facets.borrowed[i]));
  return all;
}

// A bit for each side of the box that a point is beyond.
unsigned outside(Vec3 p) {
  unsigned sides = 0;
  for (int axis = 0; axis < 3; ++axis) {
    sides |= (p[axis] < kCutBox.lower[axis] ? 1u : 0u) << (2 * axis);
    sides |= (p[axis] > kCutBox.upper[axis] ? 1u : 0u) << (2 * axis + 1);
  }
  return sides;
}

std::int16_t cell(int axis, double x) {
  return static_cast<std::int16_t>(std::clamp((x - kCutGrid.origin[axis]) * kCutGrid.scale[axis], 0.0, kLastCell));
}

template <class Check>
void for_clusters(const Check& check) {
  for (int seed = 0; seed < 12; ++seed) {
    const ClusteredMesh mesh = tests::clustered(tests::bodies(seed).first);
    const Features features(mesh);
    for (int c = 0; c < mesh.cluster_count(); ++c) check(mesh, features, c);
  }
}

TEST(PlacePoints, ScaleTheVerticesAndTellWhichSidesRuleThemOut) {
  int inside = 0, beyond = 0;
  for_clusters([&](const ClusteredMesh& mesh, const Features&, int cluster) {
    const std::vector<Vec3> expected = scaled_vertices(mesh, cluster);
    for (const Kernels* kernels : tests::available_kernels()) {
      ClusterPoints points;
      for (const int begin : {0, 61}) {  // alone, and after others
        points.count = begin;
        kernels->place_points(mesh.facets_of(cluster), kScale, kCutBox, &points);
        ASSERT_EQ(points.count, begin + static_cast<int>(expected.size())) << kernels->name;
        for (int i = begin; i < points.count; ++i) {
          const Vec3 p = expected[i - begin];
          ASSERT_EQ((Vec3{points.at[0][i], points.at[1][i], points.at[2][i]}), p) << kernels->name;
          const double* const together = points.together + 4 * i;
          ASSERT_EQ((Vec3{together[0], together[1], together[2]}), p) << kernels->name;
          ASSERT_EQ(points.outside[i], outside(p)) << kernels->name;
          (outside(p) == 0 ? inside : beyond) += 1;
        }
      }
    }
  });
  EXPECT_GT(inside, 150);
  EXPECT_GT(beyond, 300);
}

// Against plain loops: which features are left, in order, and the cells of their boxes. Placed alone, or after as many
// points of another cluster and as many other features. Returns how many were left out.
int expect_placed(const ClusteredMesh& mesh, int cluster, const FeatureCorners& in, int other_points,
                  int other_features) {
  const std::vector<Vec3> vertices = scaled_vertices(mesh, cluster);
  int left_out = 0;
  for (const Kernels* kernels : tests::available_kernels()) {
    ClusterPoints points;
    points.count = other_points;
    kernels->place_points(mesh.facets_of(cluster), kScale, kCutBox, &points);
    const std::uint64_t left = kernels->features_left(points, other_points, in);
    FeatureBlock block;
    block.count = block.cells.count = std::min(other_features, FeatureBlock::kCapacity - std::popcount(left));
    int n = block.count;
    kernels->place_features(points, other_points, in, left, kCutGrid, kWiden, &block);
    for (int i = 0; i < in.count; ++i) {
      unsigned common = ~0u;
      for (int k = 0; k < in.corners; ++k) common &= outside(vertices[in.corner[k][i]]);
      if (common != 0) {
        ++left_out;
        continue;
      }
      EXPECT_LT(n, block.count) << kernels->name;
      EXPECT_EQ(block.feature[n], in.first + i) << kernels->name;
      EXPECT_EQ(left >> i & 1, 1u) << kernels->name;
      for (int axis = 0; axis < 3; ++axis) {
        double low = vertices[in.corner[0][i]][axis], high = low;
        for (int k = 0; k < in.corners; ++k) {
          EXPECT_EQ(block.corner[k][n], other_points + in.corner[k][i]) << kernels->name;
          low = std::min(low, vertices[in.corner[k][i]][axis]);
          high = std::max(high, vertices[in.corner[k][i]][axis]);
        }
        EXPECT_EQ(block.cells.lower[axis][n], cell(axis, low - kWiden)) << kernels->name;
        EXPECT_EQ(block.cells.upper[axis][n], cell(axis, high + kWiden)) << kernels->name;
      }
      ++n;
    }
    EXPECT_EQ(block.count, n) << kernels->name;
    EXPECT_EQ(block.cells.count, n) << kernels->name;
  }
  return left_out;
}

void expect_placed_after(int other_points, int other_features) {
  std::vector<std::uint8_t> numbers(256);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint8_t>(i);
  int left_out[3] = {0, 0, 0};
  for_clusters([&](const ClusteredMesh& mesh, const Features& features, int c) {
    const ClusterFacets all = mesh.facets_of(c);
    left_out[0] += expect_placed(mesh, c, {{all.corner[0], all.corner[1], all.corner[2]}, 3, all.facet_count, 7},
                                 other_points, other_features);
    left_out[1] +=
        expect_placed(mesh, c, {{numbers.data()}, 1, std::min(all.owned_count, 64)}, other_points, other_features);
    const int edges = features.edge_end(c) - features.edge_begin(c);
    if (edges == 0) return;
    const auto corners = features.edge_corners(features.edge_begin(c));
    left_out[2] +=
        expect_placed(mesh, c, {{corners[0], corners[1]}, 2, std::min(edges, 64), 70000}, other_points, other_features);
  });
  for (const int one : left_out) EXPECT_GT(one, 100);
}

TEST(PlaceFeatures, TakeThoseThatNoSideRulesOutAndFindTheirCells) { expect_placed_after(0, 0); }

TEST(PlaceFeatures, StandAfterThoseOfOtherClusters) {
  expect_placed_after(64, 5);
  expect_placed_after(61, 37);
}

TEST(PlaceFeatures, OfNoneNoneIsLeft) {
  for (const Kernels* kernels : tests::available_kernels()) {
    ClusterPoints points;
    EXPECT_EQ(kernels->features_left(points, 0, {{nullptr}, 1, 0}), 0u) << kernels->name;
  }
}

}  // namespace
}  // namespace tact::narrowphase
