#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "narrowphase/criteria/criteria.h"
#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_blocks.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

using tests::all_bits;
using tests::block_of;
using tests::bodies;
using tests::clustered;
using tests::kEverything;

using Met = std::array<std::uint64_t, FacetBlock::kCapacity>;

// The facets of `b` that share cells with one of `a`.
std::uint64_t facets_sharing_cells(const Kernels& kernels, const FacetBlock& a, int facet, const FacetBlock& b) {
  Met met{};
  kernels.share_cells(a.cells, std::uint64_t{1} << facet, b.cells, all_bits(b.count), met.data());
  return met[facet];
}

// Whatever a grid is over, boxes that overlap share cells, also beyond its ends.
TEST(FindCells, BoxesThatOverlapShareCellsOfAnyGrid) {
  constexpr double kMost = 0x1p300;
  const std::vector<BoxBounds> boxes{
      {{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}, {{-0.3, 0.0, -0.3}, {0.3, 0.0, 0.3}},
      {{0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}},    {{0.0, 0.0, 0.0}, {0x1p-1074, 0x1p-1040, 0x1p-300}},
      {{-5.0, -5.0, 3.0}, {-4.0, 5.0, 4.0}}, {{-kMost, -kMost, -kMost}, {kMost, kMost, kMost}}};
  for (int seed = 0; seed < 12; ++seed) {
    for (const double scale : {1.0, 0x1p-300, 0x1p299}) {
      auto [mesh_a, mesh_b] = bodies(seed);
      mesh_a.positions *= scale;
      mesh_b.positions *= scale;
      const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
      for (const BoxBounds& box : boxes) {
        const Grid grid = grid_over(box, kLastCell);
        std::vector<std::uint64_t> first;
        for (const Kernels* kernels : tests::available_kernels()) {
          const FacetBlock block_a = block_of(*kernels, a, 0, tests::kAnywhere, grid);
          const FacetBlock block_b = block_of(*kernels, b, 0, tests::kAnywhere, grid);
          std::vector<std::uint64_t> found;
          for (int f = 0; f < block_a.count; ++f) {
            found.push_back(facets_sharing_cells(*kernels, block_a, f, block_b));
            for (int g = 0; g < block_b.count; ++g) {
              const bool overlap = overlaps(tests::facet_box(a, f), tests::facet_box(b, g));
              EXPECT_TRUE(!overlap || (found.back() >> g & 1) != 0) << kernels->name << ' ' << f << ' ' << g;
            }
          }
          if (first.empty()) first = found;
          EXPECT_EQ(found, first) << kernels->name;
        }
      }
    }
  }
}

// Cells are found of what was appended, and found anew in a block that begins anew.
TEST(FindCells, FindsThoseOfAppendedFacets) {
  const ClusteredMesh mesh = clustered(tests::blob(2, 0.5, 0.3, 3));
  const CullPlanes planes{{0, 0, 1, 0, 0, 0}, 0.25, kEverything};  // leaves a few of a cluster
  for (const Kernels* kernels : tests::available_kernels()) {
    KeptFacets kept;
    for (const double reach : {1.0, 2.0}) {
      const Grid grid = grid_over({{-reach, -reach, -reach}, {reach, reach, reach}}, kLastCell);
      FacetBlock at_once{};
      kept.clear();
      FacetBlock& one_by_one = kept.block;
      for (int c = 0; c < mesh.cluster_count(); ++c) {
        kernels->open_cluster(mesh.facets_of(c), planes, &at_once);
        kernels->open_cluster(mesh.facets_of(c), planes, &one_by_one);
        kernels->find_cells(grid, &one_by_one);
      }
      kernels->find_cells(grid, &at_once);
      ASSERT_GT(at_once.count, 20);
      ASSERT_EQ(one_by_one.count, at_once.count);
      for (int axis = 0; axis < 3; ++axis) {
        for (int f = 0; f < at_once.count; ++f) {
          EXPECT_EQ(one_by_one.cells.lower[axis][f], at_once.cells.lower[axis][f]) << kernels->name << ' ' << f;
          EXPECT_EQ(one_by_one.cells.upper[axis][f], at_once.cells.upper[axis][f]) << kernels->name << ' ' << f;
          EXPECT_GE(at_once.cells.upper[axis][f], at_once.cells.lower[axis][f]);
        }
      }
    }
  }
}

TEST(FindCells, EveryInstructionSetFindsTheSame) {
  for (int seed = 0; seed < 12; ++seed) {
    const ClusteredMesh mesh = clustered(bodies(seed).second);
    const FacetBlock expected = block_of(*scalar_kernels(), mesh, 0);
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block = block_of(*kernels, mesh, 0);
      for (int axis = 0; axis < 3; ++axis) {
        for (int f = 0; f < expected.count; ++f) {
          EXPECT_EQ(block.cells.lower[axis][f], expected.cells.lower[axis][f]) << kernels->name;
          EXPECT_EQ(block.cells.upper[axis][f], expected.cells.upper[axis][f]) << kernels->name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
