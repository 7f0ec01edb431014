#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

#include "narrowphase/distance/edge_edge.h"
#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::tests {
namespace {

using narrowphase::ClusterPoints;
using narrowphase::EdgePairs;
using narrowphase::EdgeSide;
using narrowphase::FeatureBlock;

// Some points, three arrays of coordinates.
struct Points {
  std::vector<double> at[3] = {};
  int add(Vec3 p) {
    for (int axis = 0; axis < 3; ++axis) at[axis].push_back(p[axis]);
    return static_cast<int>(at[0].size()) - 1;
  }
  narrowphase::PointArrays arrays() const { return {at[0].data(), at[1].data(), at[2].data()}; }
  Vec3 operator[](int i) const { return {at[0][i], at[1][i], at[2][i]}; }
};

void add(EdgePairs& pairs, const std::array<int, 4>& a, const std::array<int, 4>& b) {
  for (int k = 0; k < 4; ++k) {
    pairs.vertex[0][k][pairs.count] = a[k];
    pairs.vertex[1][k][pairs.count] = b[k];
  }
  ++pairs.count;
}

void fill_up(EdgePairs& pairs) {
  for (auto& of_mesh : pairs.vertex) {
    for (auto& vertex : of_mesh) std::fill(vertex + pairs.count, std::end(vertex), 0);
  }
}

// Nothing that is left out has a point by the function that decides, and most of what is not has one; every instruction
// set leaves out the same.
TEST(EdgesBeyond, LeaveOutNoPoint) {
  Random random(12);
  std::int64_t left_out = 0, points = 0, kept = 0, blocked = 0;
  for (int block = 0; block < 1600; ++block) {
    const double reach = block % 3 == 0 ? 0.3 : block % 3 == 1 ? 0.02 : 1e-6;
    const EdgeSide side = block % 2 == 0 ? EdgeSide::before : EdgeSide::passed;
    Points a, b;
    EdgePairs pairs;
    for (int wanted = 1 + random.below(64); pairs.count < wanted;) {
      const Vec3 along = random.in_cube(0.5);
      Vec3 across = random.in_cube(0.5);
      if (random.chance(0.2)) across = along + 1e-4 * random.in_cube(1.0);  // nearly parallel
      if (random.chance(0.05)) across = along;
      const double s = random.uniform(-0.3, 1.3), t = random.uniform(-0.3, 1.3);
      const Vec3 p = random.in_cube(0.5), way = random.uniform(-1.5, 1.5) * reach * normalized(cross(along, across));
      const bool has_way = norm(cross(along, across)) > 0.0;
      const Vec3 r = p + s * along - t * across + (has_way ? way : Vec3{});
      std::array<int, 4> of_a{a.add(p), a.add(p + along), 0, 0}, of_b{b.add(r), b.add(r + across), 0, 0};
      // Facets that lead back, on either side, level with both edges, or of one edge alone.
      for (int k = 2; k < 4; ++k) {
        const Vec3 lift = random.chance(0.2) ? Vec3{} : random.uniform(-0.2, 0.6) * normalized(way);
        of_a[k] = random.chance(0.1) ? of_a[0]
                                     : a.add(p + random.in_cube(0.5).x * across + random.in_cube(0.5).x * along - lift);
        of_b[k] = random.chance(0.1) ? of_b[0]
                                     : b.add(r + random.in_cube(0.5).x * along + random.in_cube(0.5).x * across + lift);
      }
      add(pairs, of_a, of_b);
    }
    fill_up(pairs);
    const auto beyond_by = [&](const narrowphase::Kernels& kernels) {
      return kernels.edges_beyond(pairs, a.arrays(), b.arrays(), 0.5, 0.5 * reach, side);
    };
    const std::uint64_t beyond = beyond_by(*narrowphase::scalar_kernels());
    for (const narrowphase::Kernels* kernels : available_kernels())
      ASSERT_EQ(beyond_by(*kernels), beyond) << kernels->name;
    for (int i = 0; i < pairs.count; ++i) {
      const auto ends = [&](const Points& of, int mesh) {
        return narrowphase::EdgeEnds{0.5 * of[pairs.vertex[mesh][0][i]], 0.5 * of[pairs.vertex[mesh][1][i]]};
      };
      const int third_a[2] = {pairs.vertex[0][2][i], pairs.vertex[0][3][i]};
      const int third_b[2] = {pairs.vertex[1][2][i], pairs.vertex[1][3][i]};
      const auto has_point_beside = [&](const narrowphase::ScaledVertices& of_a,
                                        const narrowphase::ScaledVertices& of_b) {
        return narrowphase::nearest_between_edges(ends(a, 0), of_a, ends(b, 1), of_b, 0.5 * reach, side).has_value();
      };
      const bool has_point = has_point_beside({a.arrays(), third_a, 0.5}, {b.arrays(), third_b, 0.5});
      const bool is_near = has_point_beside({}, {});
      points += has_point ? 1 : 0;
      if ((beyond >> i & 1) == 0) {
        ++kept;
        continue;
      }
      ++left_out;
      blocked += is_near ? 1 : 0;
      ASSERT_FALSE(has_point) << "block " << block << ", " << i;
    }
    if (pairs.count < 64) {
      ASSERT_EQ(beyond >> pairs.count, 0u);
    }
  }
  EXPECT_GT(left_out, 10000);
  EXPECT_GT(blocked, 1000);
  EXPECT_GT(points, 1000);
  EXPECT_LT(kept, 3 * points);
}

// Edges of two clusters that share cells are near unless they are beyond each other, whichever are listed.
TEST(NearEdges, AreThoseThatShareCellsAndAreNotBeyond) {
  Random random(13);
  std::int64_t near = 0, beyond = 0, apart = 0;
  for (int block = 0; block < 100; ++block) {
    const double reach = 0.05;
    ClusterPoints points[2] = {};
    FeatureBlock edges[2] = {};
    std::uint64_t some[2];
    for (int side = 0; side < 2; ++side) {
      const int count = 1 + random.below(64);
      points[side].count = 128;
      for (int i = 0; i < 128; ++i) {
        for (int axis = 0; axis < 3; ++axis) points[side].at[axis][i] = random.uniform(-0.5, 0.5);
        points[side].at[2][i] *= 0.1;
        for (int axis = 0; axis < 3; ++axis) points[side].together[4 * i + axis] = points[side].at[axis][i];
      }
      FeatureBlock& one = edges[side];
      one.count = one.cells.count = count;
      for (int i = 0; i < count; ++i) {
        for (int c = 0; c < 2; ++c) one.corner[c][i] = static_cast<std::uint8_t>(random.below(128));
        for (int axis = 0; axis < 3; ++axis) {
          one.cells.lower[axis][i] = static_cast<std::int16_t>(random.below(10));
          one.cells.upper[axis][i] = static_cast<std::int16_t>(one.cells.lower[axis][i] + random.below(20));
        }
      }
      some[side] = ~std::uint64_t{0} >> (64 - count);
      if (random.chance(0.5)) some[side] &= ~(std::uint64_t{1} << random.below(count));
    }
    for (const narrowphase::Kernels* kernels : available_kernels()) {
      std::uint64_t found[64], swapped[64];
      const std::uint64_t any =
          kernels->near_edges({points[0], edges[0], some[0]}, {points[1], edges[1], some[1]}, reach, nullptr, found);
      const std::uint64_t any_swapped =
          kernels->near_edges({points[1], edges[1], some[1]}, {points[0], edges[0], some[0]}, reach, nullptr, swapped);
      for (int i = 0; i < edges[0].count; ++i) {
        for (int k = 0; k < edges[1].count; ++k) {
          bool share = (some[0] >> i & 1) != 0 && (some[1] >> k & 1) != 0;
          for (int axis = 0; axis < 3; ++axis) {
            share = share && edges[0].cells.lower[axis][i] <= edges[1].cells.upper[axis][k] &&
                    edges[1].cells.lower[axis][k] <= edges[0].cells.upper[axis][i];
          }
          EdgePairs pair;
          const int e[2] = {edges[0].corner[0][i], edges[0].corner[1][i]};
          const int f[2] = {edges[1].corner[0][k], edges[1].corner[1][k]};
          add(pair, {e[0], e[1], e[0], e[0]}, {f[0], f[1], f[0], f[0]});
          fill_up(pair);
          const auto arrays = [&](int side) {
            return narrowphase::PointArrays{points[side].at[0], points[side].at[1], points[side].at[2]};
          };
          const bool is_beyond = narrowphase::scalar_kernels()->edges_beyond(pair, arrays(0), arrays(1), 1.0, reach,
                                                                             EdgeSide::before) != 0;
          const bool is_near = (any >> i & 1) != 0 && (found[i] >> k & 1) != 0;
          ASSERT_EQ(is_near, share && !is_beyond) << kernels->name << " " << block << ": " << i << ", " << k;
          ASSERT_EQ(is_near, (any_swapped >> k & 1) != 0 && (swapped[k] >> i & 1) != 0) << kernels->name;
          near += is_near ? 1 : 0;
          beyond += is_beyond ? 1 : 0;
          apart += share ? 0 : 1;
        }
      }
    }
  }
  EXPECT_GT(near, 1000);
  EXPECT_GT(beyond, 1000);
  EXPECT_GT(apart, 1000);
}

}  // namespace
}  // namespace tact::tests
