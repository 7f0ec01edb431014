#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/inside/local_clusters.h"

namespace tact::narrowphase {
namespace {

using tests::LocalCluster;

constexpr std::int16_t kLast = static_cast<std::int16_t>(kLastCell);

// A frame that is turned, with cells of a two-hundredth and a margin of one.
constexpr LocalFrame kFrame{.axis = {{0.8f, 0.6f, 0.0f}, {-0.6f, 0.8f, 0.0f}, {0.0f, 0.0f, 1.0f}},
                            .offset = {0.1f, 0.2f, -0.1f},
                            .margin = 0.005f,
                            .cell_origin = {-0.5f, -0.5f, -0.2f},
                            .cell_scale = {200.0f, 200.0f, 200.0f},
                            .error = 1e-6};
constexpr CellBox kReached{{1, 1, 1}, {180, 150, 90}};

float placed(const LocalCluster& local, int axis, int vertex) {
  const float* n = kFrame.axis[axis];
  return ((n[0] * local.at(0, vertex) + n[1] * local.at(1, vertex)) + n[2] * local.at(2, vertex)) + kFrame.offset[axis];
}

std::int16_t cell(int axis, float x) {
  const float at = (x - kFrame.cell_origin[axis]) * kFrame.cell_scale[axis];
  return at <= 0.0f ? std::int16_t{0} : at >= static_cast<float>(kLast) ? kLast : static_cast<std::int16_t>(at);
}

// By a plain loop: corners, cells, which facets are near, and the largest of these.
TEST(PlaceFacets, GivesCornersCellsAndWhichFacetsReachTheBox) {
  int near_ones = 0, others = 0;
  tests::for_clusters([&](const ClusteredMesh& mesh, int cluster) {
    for (const Kernels* kernels : tests::available_kernels()) {
      LocalCluster local(*kernels, mesh, cluster);
      FloatCorners corners;
      FacetCells cells;
      const std::uint64_t near =
          kernels->place_facets(local.vertices(), local.facets, kFrame, kReached, &corners, &cells);
      float largest[3] = {0.0f, 0.0f, 0.0f};
      for (int f = 0; f < local.facets.facet_count; ++f) {
        float lower[3], upper[3];
        bool is_near = true;
        for (int axis = 0; axis < 3; ++axis) {
          const float p = placed(local, axis, local.facets.corner[0][f]),
                      q = placed(local, axis, local.facets.corner[1][f]),
                      r = placed(local, axis, local.facets.corner[2][f]);
          lower[axis] = std::min({p, q, r}), upper[axis] = std::max({p, q, r});
          is_near = is_near && cell(axis, lower[axis] - kFrame.margin) <= kReached.upper[axis] &&
                    cell(axis, upper[axis] + kFrame.margin) >= kReached.lower[axis];
        }
        ASSERT_EQ((near >> f & 1) != 0, is_near) << kernels->name << ' ' << f;
        (is_near ? near_ones : others) += 1;
        for (int axis = 0; axis < 3; ++axis) largest[axis] = std::max(largest[axis], upper[axis] - lower[axis]);
        for (int axis = 0; axis < 3 && is_near; ++axis) {
          for (int k = 0; k < 3; ++k)
            EXPECT_EQ(corners.corner[k][axis][f], placed(local, axis, local.facets.corner[k][f])) << kernels->name;
          EXPECT_EQ(cells.lower[axis][f], cell(axis, lower[axis] - kFrame.margin)) << kernels->name;
          EXPECT_EQ(cells.upper[axis][f], cell(axis, upper[axis] + kFrame.margin)) << kernels->name;
        }
      }
      EXPECT_EQ(near >> (local.facets.facet_count - 1) >> 1, 0u);
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(corners.extent[axis], static_cast<double>(largest[axis]));
    }
  });
  EXPECT_GT(near_ones, 100);
  EXPECT_GT(others, 100);
}

}  // namespace
}  // namespace tact::narrowphase
