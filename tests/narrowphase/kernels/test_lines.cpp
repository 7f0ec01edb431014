// The kernels that follow sixteen segments down the tree of a mesh, and decide what they meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/numeric/double_double.h"
#include "narrowphase/queries/prepared_segment.h"
#include "narrowphase/queries/segment_batch.h"
#include "narrowphase/triangles/triangle_triangle.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

using tests::Random;

// The tree of one mesh.
class OneTree {
 public:
  explicit OneTree(const ClusteredMesh& mesh) {
    room_.begin(std::array{mesh.cluster_count()}, std::size_t{1} << 20);
    room_.make_tree(mesh, 0);
    for (std::size_t i = 0; i < room_.node_count(); ++i) room_.make_node(i);
  }
  const LineTree& tree() const { return *room_.tree(0); }

 private:
  SegmentBatch room_;
};

// Through a corner, an edge or the inside of a facet, along an axis or not, from near and far.
Segment aimed_segment(const ClusteredMesh& mesh, Random& random, int trial) {
  const Triangle target = mesh.triangle(random.below(mesh.facet_count()));
  const Vec3 at = trial % 3 == 0   ? target[0]
                  : trial % 3 == 1 ? 0.5 * (target[0] + target[1])
                                   : 0.4 * target[0] + 0.3 * (target[1] + target[2]);
  Vec3 way = (trial % 2 == 0 ? 3.0 : 300.0) * random.in_cube(1.0);
  if (trial % 5 == 0) {
    way = {};
    way[random.below(3)] = 2.0;
  }
  return {at - way, at + way};
}

using Segments = std::array<Segment, LineBlock::kLines>;

LinesApart set_out(const Kernels& kernels, const LineTree& tree, const Segments& segments, LineBlock& block) {
  for (int i = 0; i < LineBlock::kLines; ++i) {
    const Vec3 from = segments[i][0];
    for (int axis = 0; axis < 3; ++axis) {
      const DoubleDouble way = two_sum(segments[i][1][axis], -from[axis]);
      block.from[axis][i] = from[axis];
      block.direction[axis][i] = way.head;
      block.direction_tail[axis][i] = way.tail;
    }
    block.latest[i] = 1.0f + 0x1p-20f;
  }
  return kernels.prepare_segments(tree, &block);
}

enum class Descent { all_nodes, groups };

// The facets that a segment may meet, in the order in which they are found.
std::vector<int> facets_found(const Kernels& kernels, const LineTree& tree, int line, LineBlock& block) {
  std::vector<int> facets;
  const auto number = static_cast<std::uint8_t>(line);
  for (;;) {
    kernels.find_facets(tree, &number, 1, &block);
    const std::int32_t taken = block.taken[line];
    if (taken == LineBlock::kNothing) return facets;
    if (taken == LineBlock::kLaterNodes) {
      kernels.enter_later_nodes(tree, 1U << line, &block);
    } else if (taken < 0) {
      const int begin = ~taken * kNodesOfGroup;
      kernels.enter_nodes(tree, begin, std::min(kNodesOfGroup, tree.node_count - begin), line, &block);
    } else {
      for (std::uint32_t left = block.facets[line]; left != 0; left &= left - 1)
        facets.push_back(taken * LineLeaf::kFacets + std::countr_zero(left));
    }
  }
}

class LineDescents : public testing::TestWithParam<Descent> {};
INSTANTIATE_TEST_SUITE_P(Both, LineDescents, testing::Values(Descent::all_nodes, Descent::groups));

TEST_P(LineDescents, LeadToAllFacetsThatASegmentMeetsAndToFewOthers) {
  Random random(1);
  PredicateCounts counts;
  std::size_t met = 0, found = 0, segment_count = 0;
  for (const tests::Mesh& source : {tests::wrinkled_sheet(40, 2.0, 0.3, 1), tests::icosphere(4),
                                    tests::soup(150, 1.0, 2), tests::blob(3, 1e-3, 0.3, 3)}) {
    const ClusteredMesh mesh = tests::clustered(source);
    if (GetParam() == Descent::groups && mesh.group_count() == 1) continue;  // its box is that of the mesh alone
    const OneTree made(mesh);
    const LineTree& tree = made.tree();
    for (int trial = 0; trial < 12; ++trial) {
      Segments segments;
      for (int i = 0; i < LineBlock::kLines; ++i) segments[i] = aimed_segment(mesh, random, trial + i);
      std::array<std::vector<int>, LineBlock::kLines> expected;
      for (const Kernels* kernels : tests::available_kernels()) {
        LineBlock block;
        const LinesApart apart = set_out(*kernels, tree, segments, block);
        if (GetParam() == Descent::all_nodes) kernels->enter_all_nodes(tree, &block);
        for (int i = 0; i < LineBlock::kLines; ++i) {
          if ((apart.alone >> i & 1U) != 0) continue;
          if (GetParam() == Descent::groups) kernels->enter_groups(tree, i, &block);
          const bool is_past = (apart.past >> i & 1U) != 0;
          std::vector<int> facets = is_past ? std::vector<int>{} : facets_found(*kernels, tree, i, block);
          std::ranges::sort(facets);
          if (kernels == tests::available_kernels().front()) {
            expected[i] = facets;
            found += facets.size();
            ++segment_count;
            for (int f = 0; f < mesh.facet_count(); ++f) {
              if (!segment_triangle_meet(segments[i], mesh.triangle(f), counts)) continue;
              EXPECT_TRUE(std::ranges::binary_search(facets, f)) << "facet " << f << " of " << mesh.facet_count();
              ++met;
            }
          }
          EXPECT_EQ(facets, expected[i]) << kernels->name;
        }
        EXPECT_EQ(block.overflowing, 0U);
      }
    }
  }
  EXPECT_GT(segment_count, 300U);
  EXPECT_GT(met, segment_count);
  EXPECT_LT(found, met + 2 * segment_count);
}

TEST(LineTrees, GiveTheFirstLeafFirst) {
  // Squares one above the other.
  tests::Mesh stack;
  constexpr int kSquares = 24;
  stack.positions.resize(3, 4 * kSquares);
  stack.facets.resize(3, 2 * kSquares);
  for (int i = 0; i < kSquares; ++i) {
    for (int k = 0; k < 4; ++k) stack.positions.col(4 * i + k) << k % 2, k / 2, i;
    stack.facets.col(2 * i) << 4 * i, 4 * i + 1, 4 * i + 2;
    stack.facets.col(2 * i + 1) << 4 * i + 1, 4 * i + 3, 4 * i + 2;
  }
  const ClusteredMesh mesh = tests::clustered(stack);
  const OneTree made(mesh);
  for (const Kernels* kernels : tests::available_kernels()) {
    LineBlock block;
    Segments segments;
    for (int i = 0; i < LineBlock::kLines; ++i)
      segments[i] = i % 2 == 0 ? Segment{Vec3{0.2, 0.2, -1.0}, Vec3{0.2, 0.2, 30.0}}
                               : Segment{Vec3{0.2, 0.2, 30.0}, Vec3{0.2, 0.2, -1.0}};
    set_out(*kernels, made.tree(), segments, block);
    kernels->enter_all_nodes(made.tree(), &block);
    for (int i = 0; i < 2; ++i) {
      const std::vector<int> facets = facets_found(*kernels, made.tree(), i, block);
      ASSERT_EQ(facets.size(), static_cast<std::size_t>(kSquares));
      double before = -1e9;
      for (const int facet : facets) {
        double nearest = 1e9;  // of the facet's leaf, as the segment comes
        const int first = facet / LineLeaf::kFacets * LineLeaf::kFacets;
        for (int f = first; f < first + LineLeaf::kFacets; ++f)
          nearest = std::min(nearest, i == 0 ? mesh.triangle(f)[0].z : -mesh.triangle(f)[0].z);
        EXPECT_GE(nearest, before) << kernels->name;
        before = nearest;
      }
    }
  }
}

TEST(SetOutLines, TellsWhatFloatsAreNotFor) {
  const ClusteredMesh mesh = tests::clustered(tests::icosphere(2));
  const OneTree made(mesh);
  Segments segments;
  segments.fill({Vec3{-2.0, 0.1, 0.2}, Vec3{2.0, 0.2, 0.3}});
  segments[3] = {Vec3{0.5, 0.5, 0.5}, Vec3{0.5, 0.5, 0.5}};      // a point
  segments[5] = {Vec3{-5000.0, 0.0, 0.0}, Vec3{0.0, 0.1, 0.1}};  // from far away
  segments[9] = {Vec3{-2.0, 20.0, 0.0}, Vec3{2.0, 20.0, 0.0}};   // past the mesh
  for (const Kernels* kernels : tests::available_kernels()) {
    LineBlock block;
    const LinesApart apart = set_out(*kernels, made.tree(), segments, block);
    EXPECT_EQ(apart.alone, 1U << 3 | 1U << 5) << kernels->name;
    EXPECT_EQ(apart.past, 1U << 9) << kernels->name;
  }
}

// Triangles that a segment meets, passes by, touches at a corner or an edge, or lies in the plane of.
TEST(MeetLines, EqualsPreparedSegmentBitForBit) {
  Random random(4);
  PredicateCounts counts;
  const ClusteredMesh mesh = tests::clustered(tests::wrinkled_sheet(12, 2.0, 0.3, 1));
  const OneTree made(mesh);
  int met = 0, missed = 0, uncertain = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Segments segments;
    LinePairs expected;
    for (int i = 0; i < LineBlock::kLines; ++i) segments[i] = aimed_segment(mesh, random, trial + i);
    for (const Kernels* kernels : tests::available_kernels()) {
      LineBlock block;
      LinePairs pairs;
      set_out(*kernels, made.tree(), segments, block);
      Random same(trial);
      std::array<int, LinePairs::kMost> facet{};
      for (pairs.count = 0; pairs.count < LinePairs::kMost - trial % 3; ++pairs.count) {
        const int i = pairs.count, line = same.below(LineBlock::kLines), z = static_cast<int>(block.longest[line]);
        facet[i] = same.below(mesh.facet_count());
        // Most segments were aimed at another facet: half of the pairs are made to meet.
        if (same.chance(0.5)) {
          for (int f = 0; f < mesh.facet_count(); ++f) {
            if (segment_triangle_meet(segments[line], mesh.triangle(f), counts)) facet[i] = f;
          }
        }
        const Triangle t = mesh.triangle(facet[i]);
        pairs.line[i] = line;
        for (int k = 0; k < 3; ++k) {
          for (int axis = 0; axis < 3; ++axis) pairs.corner[k][axis][i] = t[k][(z + 1 + axis) % 3];
        }
      }
      for (int i = pairs.count; i < LinePairs::kMost; ++i) pairs.line[i] = 0;
      kernels->meet_lines(block, &pairs);
      EXPECT_EQ(pairs.meets & pairs.uncertain, 0U);
      EXPECT_EQ((pairs.meets | pairs.uncertain) >> pairs.count, 0U) << kernels->name;
      if (kernels == tests::available_kernels().front()) expected = pairs;
      EXPECT_EQ(pairs.meets, expected.meets) << kernels->name;
      EXPECT_EQ(pairs.uncertain, expected.uncertain) << kernels->name;
      for (int i = 0; i < pairs.count; ++i) {
        if ((pairs.uncertain >> i & 1U) != 0) {
          ++uncertain;
          continue;
        }
        const auto place = PreparedSegment(segments[pairs.line[i]]).meet(mesh.triangle(facet[i]), counts);
        ASSERT_EQ(place.has_value(), (pairs.meets >> i & 1U) != 0) << kernels->name << ", trial " << trial;
        ++(place ? met : missed);
        if (!place) continue;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(place->time), std::bit_cast<std::uint64_t>(pairs.time[i]));
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_EQ(std::bit_cast<std::uint64_t>(place->weight[k]), std::bit_cast<std::uint64_t>(pairs.weight[k][i]));
      }
    }
  }
  EXPECT_GT(met, 1500);
  EXPECT_GT(missed, 3000);
  EXPECT_GT(uncertain, 200);
}

}  // namespace
}  // namespace tact::narrowphase
