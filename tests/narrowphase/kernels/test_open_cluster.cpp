#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_blocks.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

using tests::block_of;
using tests::bodies;
using tests::clustered;

TEST(OpenCluster, LeavesOutWhatOneSideRulesOut) {
  for (int seed = 0; seed < 12; ++seed) {
    const ClusteredMesh mesh = clustered(bodies(seed).first);
    const CullPlanes planes{{0.48, -0.6, 0.64, 0.1, 0.2, 0.3}, -0.2, {{-0.3, -0.2, -0.4}, {0.3, 0.5, 0.2}}};
    for (int c = 0; c < mesh.cluster_count(); ++c) {
      std::vector<std::int32_t> expected;
      int low = 0;
      for (int f = mesh.facet_begin(c); f < mesh.facet_end(c); ++f) {
        Box box;
        double top = -9.0;
        for (const Vec3& p : mesh.triangle(f)) {
          box = extended(box, p);
          top = std::max(top, (0.48 * (p.x - 0.1) + -0.6 * (p.y - 0.2)) + 0.64 * (p.z - 0.3));
        }
        low += top < planes.lowest ? 1 : 0;
        if (top >= planes.lowest && overlaps(box, Box{{-0.3, -0.2, -0.4}, {0.3, 0.5, 0.2}})) expected.push_back(f);
      }
      for (const Kernels* kernels : tests::available_kernels()) {
        FacetBlock block{};
        const Culled opened = kernels->open_cluster(mesh.facets_of(c), planes, &block);
        EXPECT_EQ(opened.left, block.count) << kernels->name << " seed " << seed;
        EXPECT_EQ(opened.low, low) << kernels->name << " seed " << seed;
        EXPECT_EQ(std::vector(block.facet, block.facet + block.count), expected) << kernels->name << " seed " << seed;
        for (int i = 0; i < block.count; ++i) {
          const Triangle t = mesh.triangle(block.facet[i]);
          for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 corner{block.corner[k][0][i], block.corner[k][1][i], block.corner[k][2][i]};
            EXPECT_EQ(corner, t[k]) << kernels->name << " seed " << seed;
          }
        }
      }
    }
  }
}

// All facets of a cluster, whatever the block held before, with the cells that find_cells() finds.
TEST(OpenWhole, WritesCornersAndCells) {
  for (int seed = 0; seed < 12; ++seed) {
    const auto [first, second] = bodies(seed);
    for (const Kernels* kernels : tests::available_kernels()) {
      FacetBlock block = block_of(*kernels, clustered(first), 0);
      const ClusteredMesh mesh = clustered(second);
      for (int c = 0; c < mesh.cluster_count(); ++c) {
        const FacetBlock expected = block_of(*scalar_kernels(), mesh, c);
        kernels->open_whole(mesh.facets_of(c), tests::kGrid, &block);
        ASSERT_EQ(block.count, mesh.facet_end(c) - mesh.facet_begin(c)) << kernels->name << " seed " << seed;
        ASSERT_EQ(block.cells.count, block.count) << kernels->name << " seed " << seed;
        for (int i = 0; i < block.count; ++i) {
          for (int axis = 0; axis < 3; ++axis) {
            for (int k = 0; k < 3; ++k) EXPECT_EQ(block.corner[k][axis][i], expected.corner[k][axis][i]);
            EXPECT_EQ(block.cells.lower[axis][i], expected.cells.lower[axis][i]) << kernels->name << " facet " << i;
            EXPECT_EQ(block.cells.upper[axis][i], expected.cells.upper[axis][i]) << kernels->name << " facet " << i;
          }
        }
      }
    }
  }
}

// What the block holds besides the corners: boxes and normals, the same bits for every instruction set.
TEST(OpenCluster, WritesBoxesAndNormals) {
  for (int seed = 0; seed < 12; ++seed) {
    const ClusteredMesh mesh = clustered(bodies(seed).second);
    const FacetBlock expected = block_of(*scalar_kernels(), mesh, 0);
    ASSERT_EQ(expected.count, mesh.facet_end(0));
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block = block_of(*kernels, mesh, 0);
      ASSERT_EQ(block.count, expected.count);
      for (int f = 0; f < block.count; ++f) {
        const Box box = tests::facet_box(mesh, f);
        const Triangle t = mesh.triangle(f);
        const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(block.lower[axis][f], box.lower[axis]) << kernels->name;
          EXPECT_EQ(block.upper[axis][f], box.upper[axis]) << kernels->name;
          EXPECT_EQ(block.normal[axis][f], expected.normal[axis][f]) << kernels->name;
          EXPECT_EQ(block.normal[axis][f], normal[axis]) << kernels->name;
        }
      }
    }
  }
}

TEST(OpenCluster, AppendsNothingWhereThereIsNoRoom) {
  const ClusteredMesh mesh = clustered(tests::blob(2, 0.5, 0.3, 3));
  for (const Kernels* kernels : tests::available_kernels()) {
    FacetBlock block = block_of(*kernels, mesh, 0);
    const int before = block.count;
    ASSERT_EQ(before, FacetBlock::kCapacity);
    EXPECT_GT(kernels->open_cluster(mesh.facets_of(1), tests::kAll, &block).left, 0) << kernels->name;
    EXPECT_EQ(block.count, before) << kernels->name;
  }
}

}  // namespace
}  // namespace tact::narrowphase
