// The kernels that follow one segment: which boxes it enters, and when; which facets its line may meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/triangles/triangle_triangle.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/inside/local_clusters.h"

namespace tact::narrowphase {
namespace {

using tests::Random;

SegmentSlabs slabs_of(const Segment& segment) {
  SegmentSlabs slabs{};
  for (int axis = 0; axis < 3; ++axis) {
    const double way = segment[1][axis] - segment[0][axis];
    slabs.from[axis] = segment[0][axis];
    slabs.inverse[axis] = way == 0.0 ? 0.0 : 1.0 / way;
    slabs.stays[axis] = way == 0.0;
  }
  return slabs;
}

// Half of them along an axis, and many through the corner of a box.
Segment some_segment(Random& random, const Box& box) {
  const Vec3 from = random.in_cube(3.0);
  Vec3 to = random.in_cube(3.0);
  if (random.chance(0.5)) to = random.chance(0.5) ? 2.0 * box.lower - from : box.lower;
  if (random.chance(0.3)) {
    to = from;
    to[random.below(3)] += 3.0;
  }
  return {from, to};
}

// When a segment enters a box, in long doubles; 2 if it does not.
long double entry_of(const Segment& segment, const Box& box) {
  long double first = 0.0L, last = 1.0L;
  for (int axis = 0; axis < 3; ++axis) {
    const long double from = segment[0][axis], way = static_cast<long double>(segment[1][axis]) - from;
    if (way == 0.0L) {
      if (from < box.lower[axis] || from > box.upper[axis]) return 2.0L;
      continue;
    }
    long double enter = (box.lower[axis] - from) / way, leave = (box.upper[axis] - from) / way;
    if (leave < enter) std::swap(enter, leave);
    first = std::max(first, enter), last = std::min(last, leave);
  }
  return first <= last ? first : 2.0L;
}

TEST(RankByEntry, IsNeverLateAndLeavesNothingOut) {
  Random random(1);
  BoxArrays boxes;
  constexpr int kCount = 45;
  boxes.resize(kCount);
  int entered = 0, ranked_in_all = 0;
  for (int trial = 0; trial < 400; ++trial) {
    for (int i = 0; i < kCount; ++i) {
      const Vec3 p = random.in_cube(1.5), size = random.in_cube(0.4);
      boxes.set(i, {p, p + Vec3{std::abs(size.x), std::abs(size.y), std::abs(size.z)}});
    }
    const Segment segment = some_segment(random, boxes[7]);
    const double latest = random.chance(0.5) ? 1.0 : random.uniform();
    RankedBoxes expected;
    scalar_kernels()->rank_by_entry(boxes.pointers(), kCount, slabs_of(segment), latest, &expected);
    int next = 0;
    for (int i = 0; i < kCount; ++i) {
      const long double entry = entry_of(segment, boxes[i]);
      const bool listed = next < expected.count && expected.index[next] == i;
      if (entry <= latest) {
        ASSERT_TRUE(listed) << "trial " << trial << ", box " << i;
        EXPECT_LE(expected.rank[next], entry);
        EXPECT_NEAR(expected.rank[next], static_cast<double>(entry), 1e-12);
        ++entered;
      }
      if (listed) ++next;
    }
    ranked_in_all += expected.count;
    for (const Kernels* kernels : tests::available_kernels()) {
      RankedBoxes ranked;
      kernels->rank_by_entry(boxes.pointers(), kCount, slabs_of(segment), latest, &ranked);
      ASSERT_EQ(ranked.count, expected.count) << kernels->name;
      for (int i = 0; i < ranked.count; ++i) {
        EXPECT_EQ(ranked.index[i], expected.index[i]) << kernels->name;
        EXPECT_EQ(ranked.rank[i], expected.rank[i]) << kernels->name;
      }
    }
  }
  EXPECT_GT(entered, 100);
  EXPECT_LT(ranked_in_all, entered + 20);
}

LineOfSight line_of(const Segment& segment) {
  const Vec3 way = segment[1] - segment[0];
  int z = 0;
  for (int axis = 1; axis < 3; ++axis) z = std::abs(way[axis]) > std::abs(way[z]) ? axis : z;
  LineOfSight line{{(z + 1) % 3, (z + 2) % 3, z}, {segment[0].x, segment[0].y, segment[0].z}, {}, 0x1p-40};
  for (int k = 0; k < 2; ++k) line.slope[k] = way[line.axis[k]] / way[z];
  return line;
}

TEST(SightFacets, LeavesOutNoFacetThatTheLineMeetsAndMostOthers) {
  Random random(2);
  PredicateCounts counts;
  int met = 0, left = 0, facets = 0;
  tests::for_clusters([&](const ClusteredMesh& mesh, int c) {
    const ClusterFacets cluster = mesh.facets_of(c);
    for (int trial = 0; trial < 20; ++trial) {
      const Triangle target = mesh.triangle(cluster.facet_begin + random.below(cluster.facet_count));
      const Vec3 from = random.in_cube(3.0), at = trial % 2 == 0 ? target[0] : 0.5 * (target[0] + target[1]);
      const Segment segment{from, at + (at - from)};
      if (segment[0] == segment[1]) continue;
      const std::uint64_t expected = scalar_kernels()->sight_facets(cluster, line_of(segment));
      for (const Kernels* kernels : tests::available_kernels())
        EXPECT_EQ(kernels->sight_facets(cluster, line_of(segment)), expected) << kernels->name;
      for (int i = 0; i < cluster.facet_count; ++i) {
        if (!segment_triangle_meet(segment, mesh.triangle(cluster.facet_begin + i), counts)) continue;
        EXPECT_TRUE(expected >> i & 1) << "facet " << i;
        ++met;
      }
      left += std::popcount(expected);
      facets += cluster.facet_count;
    }
  });
  EXPECT_GT(met, 900);
  EXPECT_LT(left, facets / 4);
}

}  // namespace
}  // namespace tact::narrowphase
