#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "narrowphase/criteria/criteria.h"
#include "tests/support/clustered.h"
#include "tests/support/facet_blocks.h"
#include "tests/support/generators.h"

namespace tact::narrowphase {
namespace {

using tests::all_bits;
using tests::block_of;
using tests::bodies;
using tests::box_of;
using tests::clustered;
using tests::decide_all;
using tests::Decisions;
using tests::Digits;
using tests::kEverything;
using tests::kGrid;
using tests::meeting_in_truth;
using tests::merged;

TEST(FacetBlocks, OpenClusterLeavesOutWhatOneSideRulesOut) {
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

using Met = std::array<std::uint64_t, FacetBlock::kCapacity>;

// The facets of `b` that share cells with one of `a`.
std::uint64_t sharing_cells(const Kernels& kernels, const FacetBlock& a, int facet, const FacetBlock& b) {
  Met met{};
  kernels.share_cells(a, std::uint64_t{1} << facet, b, all_bits(b.count), met.data());
  return met[static_cast<std::size_t>(facet)];
}

// Whatever a grid is over, boxes that overlap share cells, also beyond its ends.
TEST(FacetBlocks, BoxesThatOverlapShareCellsOfAnyGrid) {
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
            found.push_back(sharing_cells(*kernels, block_a, f, block_b));
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
TEST(FacetBlocks, CellsOfAppendedFacetsAreFound) {
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
          EXPECT_EQ(one_by_one.lower_cell[axis][f], at_once.lower_cell[axis][f]) << kernels->name << ' ' << f;
          EXPECT_EQ(one_by_one.upper_cell[axis][f], at_once.upper_cell[axis][f]) << kernels->name << ' ' << f;
          EXPECT_GE(at_once.upper_cell[axis][f], at_once.lower_cell[axis][f]);
        }
      }
    }
  }
}

// The corners of all facets, which lie in kEverything.
FloatCorners floats_of(const Kernels& kernels, const FacetBlock& block) {
  FloatCorners corners;
  kernels.float_corners(block, all_bits(block.count), grid_over(kEverything, 1.0), &corners);
  return corners;
}

// All pairs that the cells of kGrid, and planes where they are asked, leave of two blocks, b's facets held against a's
// if `few_are_b`.
std::vector<FacetPair> paired(const Kernels& kernels, const FacetBlock& a, const FacetBlock& b, bool few_are_b,
                              int plane_from, std::int64_t& box_pairs) {
  std::vector<FacetPair> all;
  const FacetBlock &few = few_are_b ? b : a, &many = few_are_b ? a : b;
  Met met{};
  const SharedCells shared = kernels.share_cells(few, all_bits(few.count), many, all_bits(many.count), met.data());
  box_pairs += shared.pairs;
  constexpr double kGap[3] = {1.0 / kLastCell, 1.0 / kLastCell, 1.0 / kLastCell};
  kernels.leave_aside(floats_of(kernels, few), shared.facets, floats_of(kernels, many), kGap, plane_from, met.data());
  for (std::uint64_t left = shared.facets; left != 0;) {
    FacetPairList pairs;
    left = kernels.list_pairs(left, met.data(), few_are_b, &pairs);
    EXPECT_TRUE(left == 0 || pairs.count == FacetPairList::kCapacity) << kernels.name;
    EXPECT_EQ(left & ~shared.facets, 0u);
    for (int k = 0; k < pairs.count; ++k) all.push_back({pairs.a[k], pairs.b[k]});
  }
  std::sort(all.begin(), all.end());
  return all;
}

constexpr int kAlways = 0, kNever = 65;  // is the plane asked

// Neither by the box of the others, nor by planes and boxes, is a facet lost that meets one.
TEST(FacetBlocks, FacetsThatMeetAreNearAndPaired) {
  for (int seed = 0; seed < 30; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    const std::vector<FacetPair> meeting = meeting_in_truth(a, b);
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block_a = block_of(*kernels, a, 0), block_b = block_of(*kernels, b, 0);
      for (const FacetPair& pair : meeting) {
        const BoxBounds box = box_of(block_a, pair.a);
        const CellBox cells = cells_of(kGrid, box);
        const BoxBounds both = merged(box, box_of(block_b, pair.b));
        EXPECT_NE(kernels->near_facets(block_b, all_bits(block_b.count), cells) >> pair.b & 1, 0u);
        EXPECT_TRUE(kernels->any_near(block_b, std::uint64_t{1} << pair.b, cells, box, both));
      }
      for (const bool few_are_b : {false, true}) {
        for (const int plane_from : {kAlways, 6, kNever}) {
          std::int64_t box_pairs = 0;
          const std::vector<FacetPair> left = paired(*kernels, block_a, block_b, few_are_b, plane_from, box_pairs);
          EXPECT_TRUE(std::includes(left.begin(), left.end(), meeting.begin(), meeting.end()))
              << kernels->name << " seed " << seed << " plane from " << plane_from;
          EXPECT_EQ(std::adjacent_find(left.begin(), left.end()), left.end());
        }
      }
    }
  }
}

// Cells of kGrid, whose coordinates stay within it.
bool share_cells(const BoxBounds& a, const BoxBounds& b) {
  const auto cell = [](double x) { return std::floor((x + 9.0) / 18.0 * kLastCell); };
  for (int axis = 0; axis < 3; ++axis) {
    if (cell(a.upper[axis]) < cell(b.lower[axis]) || cell(b.upper[axis]) < cell(a.lower[axis])) return false;
  }
  return true;
}

TEST(FacetBlocks, FacetsArePairedByTheirBoxesAndPlanes) {
  std::size_t left_aside = 0;
  for (int seed = 0; seed < 12; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    const FacetBlock block_a = block_of(*scalar_kernels(), a, 0), block_b = block_of(*scalar_kernels(), b, 0);
    std::vector<FacetPair> sharing;
    for (int f = 0; f < block_a.count; ++f) {
      for (int g = 0; g < block_b.count; ++g) {
        const bool share = share_cells(box_of(block_a, f), box_of(block_b, g));
        EXPECT_TRUE(share || !overlaps(tests::facet_box(a, f), tests::facet_box(b, g)));
        if (share) sharing.push_back({f, g});
      }
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      for (const bool few_are_b : {false, true}) {
        std::int64_t box_pairs = 0;
        EXPECT_EQ(paired(*kernels, block_a, block_b, few_are_b, kNever, box_pairs), sharing) << kernels->name;
        EXPECT_EQ(box_pairs, static_cast<std::int64_t>(sharing.size()));
        left_aside += sharing.size() - paired(*kernels, block_a, block_b, few_are_b, kAlways, box_pairs).size();
        EXPECT_EQ(box_pairs, 2 * static_cast<std::int64_t>(sharing.size()));
      }
    }
  }
  EXPECT_GT(left_aside, 1000u);
}

TEST(FacetBlocks, EveryInstructionSetGivesTheSameBits) {
  for (int seed = 0; seed < 12; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    const HeightAxis axis{0.48, -0.6, 0.64, 0.01, 0.02, -0.03};
    const CullPlanes planes{.axis = axis, .lowest = 0.1, .box = {{-0.4, -0.3, -0.5}, {0.5, 0.4, 0.6}}};
    const FacetBlock expected = block_of(*scalar_kernels(), b, 0), own = block_of(*scalar_kernels(), a, 0);
    const FacetBlock left = block_of(*scalar_kernels(), b, 0, planes);
    const std::uint64_t away = scalar_kernels()->facing_away(expected, axis);
    const IndexRange all{0, b.vertex_count()};
    const HighestPoint highest = scalar_kernels()->highest_point(b.points(), nullptr, &all, 1, axis, -1e300);
    const CellBox cells = cells_of(kGrid, planes.box);
    const std::uint64_t near = scalar_kernels()->near_facets(expected, all_bits(expected.count), cells);
    const CellBox of_near = scalar_kernels()->cells_of(expected, near);
    ASSERT_NE(near, 0u);
    for (int k = 0; k < 3; ++k) {
      std::int16_t first = 0x7fff, last = 0;
      for (int f = 0; f < expected.count; ++f) {
        const bool is_near = (near >> f & 1) != 0,
                   misses = expected.upper_cell[k][f] < cells.lower[k] || cells.upper[k] < expected.lower_cell[k][f];
        EXPECT_FALSE(is_near && misses);
        if (is_near)
          first = std::min(first, expected.lower_cell[k][f]), last = std::max(last, expected.upper_cell[k][f]);
      }
      EXPECT_EQ(of_near.lower[k], first);
      EXPECT_EQ(of_near.upper[k], last);
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block = block_of(*kernels, b, 0);
      for (int axis_index = 0; axis_index < 3; ++axis_index) {
        for (int f = 0; f < b.facet_end(0); ++f) {
          EXPECT_EQ(block.lower[axis_index][f], expected.lower[axis_index][f]);
          EXPECT_EQ(block.upper[axis_index][f], expected.upper[axis_index][f]);
          EXPECT_EQ(block.lower_cell[axis_index][f], expected.lower_cell[axis_index][f]) << kernels->name;
          EXPECT_EQ(block.upper_cell[axis_index][f], expected.upper_cell[axis_index][f]) << kernels->name;
        }
      }
      EXPECT_EQ(kernels->facing_away(block, axis), away) << kernels->name;
      const FacetBlock others_left = block_of(*kernels, b, 0, planes);
      EXPECT_EQ(std::vector(others_left.facet, others_left.facet + others_left.count),
                std::vector(left.facet, left.facet + left.count))
          << kernels->name;
      const HighestPoint top = kernels->highest_point(b.points(), nullptr, &all, 1, axis, highest.height);
      EXPECT_EQ(top.height, highest.height) << kernels->name;
      EXPECT_EQ(top.index, highest.index) << kernels->name;
      const double above = std::nextafter(highest.height, 1e300);
      EXPECT_EQ(kernels->highest_point(b.points(), nullptr, &all, 1, axis, above).index, -1) << kernels->name;
      EXPECT_EQ(kernels->near_facets(block, all_bits(block.count), cells), near) << kernels->name;
      const CellBox others = kernels->cells_of(block, near);
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(others.lower[k], of_near.lower[k]) << kernels->name;
        EXPECT_EQ(others.upper[k], of_near.upper[k]) << kernels->name;
      }
      for (const int plane_from : {kAlways, 6}) {
        std::int64_t box_pairs = 0;
        EXPECT_EQ(paired(*kernels, own, block, false, plane_from, box_pairs),
                  paired(*scalar_kernels(), own, expected, false, plane_from, box_pairs))
            << kernels->name;
      }
      for (const Digits digits : {Digits::few, Digits::simple, Digits::wide}) {
        const Decisions one = decide_all(*kernels, a, b, digits), other = decide_all(*scalar_kernels(), a, b, digits);
        EXPECT_EQ(one.meeting, other.meeting) << kernels->name;
        EXPECT_EQ(one.undecided, other.undecided) << kernels->name;
        EXPECT_EQ(one.flat, other.flat) << kernels->name;
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
