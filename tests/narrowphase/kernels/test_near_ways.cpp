#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

constexpr BoxBounds kWayBox{{-0.2, -0.1, 0.0}, {0.3, 0.2, 0.4}};

VertexWays random_ways(tests::Random& random, int count) {
  VertexWays ways;
  ways.count = count;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < count; ++i) {
      // Some end where a side of the box is.
      const auto coordinate = [&] { return 0.1 * static_cast<double>((random.below(21) - 10)); };
      const double begin = coordinate(), end = coordinate();
      ways.lower[axis][i] = std::min(begin, end);
      ways.upper[axis][i] = std::max(begin, end);
    }
  }
  return ways;
}

unsigned sides_beyond(const VertexWays& ways, int i) {
  unsigned sides = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (ways.upper[axis][i] < kWayBox.lower[axis]) sides |= 1u << (2 * axis);
    if (ways.lower[axis][i] > kWayBox.upper[axis]) sides |= 2u << (2 * axis);
  }
  return sides;
}

TEST(FlagWays, HaveABitForEachSideThatAVertexStaysBeyond) {
  tests::Random random(1);
  int beyond = 0;
  for (const int count : {1, 7, 8, 63, 64, 65, 130, 192}) {
    const VertexWays ways = random_ways(random, count);
    for (const Kernels* kernels : tests::available_kernels()) {
      std::uint8_t outside[VertexWays::kRoom];
      kernels->flag_ways(ways, kWayBox, outside);
      for (int i = 0; i < count; ++i) {
        ASSERT_EQ(outside[i], sides_beyond(ways, i)) << kernels->name << ", vertex " << i;
        beyond += outside[i] != 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(beyond, 100);
}

// Appended in blocks of 64, as clusters with many edges need it; against a loop over all features.
TEST(AppendNearWays, TakeFeaturesThatNoSideRulesOutAndTheBoxesOfTheirWays) {
  tests::Random random(2);
  int taken = 0, left_out = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const int corners = 1 + trial % 3, vertices = 1 + random.below(192), features = 1 + random.below(192);
    const VertexWays ways = random_ways(random, vertices);
    std::vector<std::uint8_t> corner[3];
    for (auto& one : corner) {
      one.resize(256);
      for (std::uint8_t& v : one) v = static_cast<std::uint8_t>(random.below(vertices));
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      std::uint8_t outside[VertexWays::kRoom];
      kernels->flag_ways(ways, kWayBox, outside);
      FeatureWays near;
      for (int first = 0; first < features; first += 64) {
        FeatureCorners some{{}, corners, std::min(features - first, 64)};
        for (int k = 0; k < corners; ++k) some.corner[k] = corner[k].data() + first;
        kernels->append_near_ways(ways, outside, some, first, &near);
      }
      int n = 0;
      for (int i = 0; i < features; ++i) {
        unsigned common = ~0u;
        for (int k = 0; k < corners; ++k) common &= sides_beyond(ways, corner[k][i]);
        (common == 0 ? taken : left_out) += 1;
        if (common != 0) continue;
        ASSERT_LT(n, near.count) << kernels->name;
        ASSERT_EQ(near.feature[n], i) << kernels->name;
        for (int axis = 0; axis < 3; ++axis) {
          double low = ways.lower[axis][corner[0][i]], high = ways.upper[axis][corner[0][i]];
          for (int k = 0; k < corners; ++k) {
            ASSERT_EQ(near.corner[k][n], corner[k][i]) << kernels->name;
            low = std::min(low, ways.lower[axis][corner[k][i]]);
            high = std::max(high, ways.upper[axis][corner[k][i]]);
          }
          ASSERT_EQ(near.lower[axis][n], low) << kernels->name;
          ASSERT_EQ(near.upper[axis][n], high) << kernels->name;
        }
        ++n;
      }
      ASSERT_EQ(near.count, n) << kernels->name;
    }
  }
  EXPECT_GT(taken, 1000);
  EXPECT_GT(left_out, 1000);
}

}  // namespace
}  // namespace tact::narrowphase
