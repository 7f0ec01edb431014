// The kernels that look for what is nearest to a point: boxes and facets with distances that are never too large.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/open_in_box.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/inside/local_clusters.h"

namespace tact::narrowphase {
namespace {

using tests::Random;
using Vector = std::array<long double, 3>;

long double product(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross_product(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector difference(const Vec3& a, const Vec3& b) {
  return {static_cast<long double>(a.x) - b.x, static_cast<long double>(a.y) - b.y,
          static_cast<long double>(a.z) - b.z};
}

long double distance_squared(const Vec3& p, const Triangle& t) {
  long double least = std::numeric_limits<long double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector from = difference(t[i], p), side = difference(t[(i + 1) % 3], t[i]);
    const long double length = product(side, side);
    const long double s = length > 0 ? std::clamp(-product(from, side) / length, 0.0L, 1.0L) : 0.0L;
    const Vector at{from[0] + s * side[0], from[1] + s * side[1], from[2] + s * side[2]};
    least = std::min(least, product(at, at));
  }
  const Vector normal = cross_product(difference(t[1], t[0]), difference(t[2], t[0]));
  const long double square = product(normal, normal);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector turn = cross_product(difference(t[i], p), difference(t[(i + 1) % 3], p));
    if (!(square > 0 && product(turn, normal) >= 0)) return least;
  }
  const long double height = product(normal, difference(t[0], p));
  return std::min(least, height * height / square);
}

TEST(RankFacets, NeverSaysTooFarAndKeepsTheNearest) {
  Random random(1);
  int listed = 0, facets = 0;
  tests::for_clusters([&](const ClusteredMesh& mesh, int c) {
    const ClusterFacets cluster = mesh.facets_of(c);
    for (int trial = 0; trial < 30; ++trial) {
      const Triangle target = mesh.triangle(cluster.facet_begin + random.below(cluster.facet_count));
      const Vec3 middle = 0.25 * target[0] + 0.25 * target[1] + 0.5 * target[2];
      // Far and near, and on the surface to rounding.
      const Vec3 point = trial % 3 == 0   ? random.in_cube(3.0)
                         : trial % 3 == 1 ? middle + 0.1 * random.in_cube(1.0)
                                          : middle;
      std::vector<double> squares;
      for (int f = 0; f < cluster.facet_count; ++f)
        squares.push_back(static_cast<double>(distance_squared(point, mesh.triangle(cluster.facet_begin + f))));
      const double nearest = *std::ranges::min_element(squares);
      const double most = trial % 2 == 0 ? std::numeric_limits<double>::infinity() : 1.5 * nearest;
      const double at[3] = {point.x, point.y, point.z};
      FacetDistances expected;
      scalar_kernels()->rank_facets(cluster, at, 0.5, 0.25 * most, &expected);
      bool has_nearest = false;
      for (int i = 0; i < expected.count; ++i) {
        const double exact = 0.25 * squares[expected.facet[i]];
        EXPECT_LE(expected.least_squared[i], exact) << "facet " << int{expected.facet[i]};
        has_nearest = has_nearest || 4.0 * exact <= nearest;
        if (trial % 3 == 0) {
          EXPECT_GT(expected.least_squared[i], exact - 1e-3) << "facet " << int{expected.facet[i]};
        }
      }
      EXPECT_TRUE(has_nearest) << "trial " << trial;
      for (const Kernels* kernels : tests::available_kernels()) {
        FacetDistances found;
        kernels->rank_facets(cluster, at, 0.5, 0.25 * most, &found);
        ASSERT_EQ(found.count, expected.count) << kernels->name;
        for (int i = 0; i < found.count; ++i) {
          EXPECT_EQ(found.facet[i], expected.facet[i]) << kernels->name;
          EXPECT_EQ(found.least_squared[i], expected.least_squared[i]) << kernels->name;
        }
      }
      listed += expected.count;
      facets += cluster.facet_count;
    }
  });
  EXPECT_LT(listed, facets / 2);
}

// Of all facets some lie a little nearer, as they are larger.
TEST(RankFacets, FromTheMiddleOfABallListsThoseWhosePlanesAreNear) {
  const ClusteredMesh mesh = tests::clustered(tests::icosphere(4));
  for (const Vec3 point : {Vec3{}, Vec3{1e-3, 2e-3, -1e-3}}) {
    std::vector<double> squares;
    for (int f = 0; f < mesh.facet_count(); ++f)
      squares.push_back(static_cast<double>(distance_squared(point, mesh.triangle(f))));
    const double nearest = *std::ranges::min_element(squares), most = nearest * (1.0 + 0x1p-40);
    const double at[3] = {point.x, point.y, point.z};
    int listed = 0;
    for (int c = 0; c < mesh.cluster_count(); ++c) {
      const ClusterFacets cluster = mesh.facets_of(c);
      FacetDistances expected;
      scalar_kernels()->rank_facets(cluster, at, 1.0, most, &expected);
      listed += expected.count;
      for (int f = 0; f < cluster.facet_count; ++f) {
        if (squares[cluster.facet_begin + f] == nearest) {
          EXPECT_NE(std::find(expected.facet, expected.facet + expected.count, f), expected.facet + expected.count);
        }
      }
      for (const Kernels* kernels : tests::available_kernels()) {
        FacetDistances found;
        kernels->rank_facets(cluster, at, 1.0, most, &found);
        ASSERT_EQ(found.count, expected.count) << kernels->name;
        EXPECT_TRUE(std::equal(found.facet, found.facet + found.count, expected.facet)) << kernels->name;
        EXPECT_TRUE(std::equal(found.least_squared, found.least_squared + found.count, expected.least_squared));
      }
    }
    EXPECT_LT(listed, mesh.facet_count() / 4);
  }
}

TEST(RankBlock, HoldsTheFacetsWithinReachAndNeverSaysTooFar) {
  Random random(3);
  int listed = 0, facets = 0;
  tests::for_clusters([&](const ClusteredMesh& mesh, int c) {
    FacetBlock block;
    block.count = 0;
    kernels().open_cluster(mesh.facets_of(c), planes_of(everywhere()), &block);
    for (int trial = 0; trial < 30; ++trial) {
      const Triangle target = mesh.triangle(block.facet[random.below(block.count)]);
      const Vec3 point = 0.5 * target[0] + 0.5 * target[1] + (trial % 2 == 0 ? 0.3 : 0.0) * random.in_cube(1.0);
      std::vector<double> squares;
      for (int i = 0; i < block.count; ++i)
        squares.push_back(static_cast<double>(distance_squared(point, mesh.triangle(block.facet[i]))));
      const double most = 1.5 * *std::ranges::min_element(squares) + 1e-4;
      const double at[3] = {point.x, point.y, point.z};
      FacetDistances expected;
      scalar_kernels()->rank_block(block, at, 0.5, 0.25 * most, nullptr, &expected);
      std::vector<bool> is_listed(squares.size(), false);
      for (int i = 0; i < expected.count; ++i) {
        const std::size_t place = expected.facet[i];
        is_listed[place] = true;
        EXPECT_LE(expected.least_squared[i], 0.25 * squares[place]) << "facet " << place;
        EXPECT_GT(expected.least_squared[i], 0.25 * squares[place] - 1e-3) << "facet " << place;
      }
      for (std::size_t i = 0; i < squares.size(); ++i)
        EXPECT_TRUE(is_listed[i] || squares[i] > most) << "facet " << i << " trial " << trial;
      for (const Kernels* kernels : tests::available_kernels()) {
        FacetDistances found;
        kernels->rank_block(block, at, 0.5, 0.25 * most, nullptr, &found);
        ASSERT_EQ(found.count, expected.count) << kernels->name;
        for (int i = 0; i < found.count; ++i) {
          EXPECT_EQ(found.facet[i], expected.facet[i]) << kernels->name;
          EXPECT_EQ(found.least_squared[i], expected.least_squared[i]) << kernels->name;
        }
      }
      listed += expected.count;
      facets += block.count;
    }
  });
  EXPECT_LT(listed, facets / 2);
}

// What is left out is not nearer to the direction than the angle of the cosine, and is all that is farther by rounding.
TEST(RankBlock, LeavesOutWhatDoesNotFaceADirection) {
  Random random(4);
  int left_out = 0, kept = 0;
  tests::for_clusters([&](const ClusteredMesh& mesh, int c) {
    FacetBlock block;
    block.count = 0;
    kernels().open_cluster(mesh.facets_of(c), planes_of(everywhere()), &block);
    for (int trial = 0; trial < 30; ++trial) {
      const Vec3 direction = normalized(random.in_cube(1.0));
      const FacingNormals facing{{direction.x, direction.y, direction.z}, trial % 2 == 0 ? 0.5 : 0.05};
      const double at[3] = {0.0, 0.0, 0.0}, most = std::numeric_limits<double>::infinity();
      FacetDistances expected;
      scalar_kernels()->rank_block(block, at, 0.5, most, &facing, &expected);
      std::vector<bool> is_listed(FacetBlock::kCapacity, false);
      for (int i = 0; i < expected.count; ++i) is_listed[expected.facet[i]] = true;
      for (int i = 0; i < block.count; ++i) {
        const Triangle t = mesh.triangle(block.facet[i]);
        const Vector normal = cross_product(difference(t[1], t[0]), difference(t[2], t[0]));
        const long double along =
            product(normal, difference(direction, {})) - facing.cosine * std::sqrt(product(normal, normal));
        if (along > 0 || along < -1e-12L) {
          EXPECT_EQ(is_listed[i], along > 0) << "facet " << i << " trial " << trial;
        }
      }
      for (const Kernels* kernels : tests::available_kernels()) {
        FacetDistances found;
        kernels->rank_block(block, at, 0.5, most, &facing, &found);
        ASSERT_EQ(found.count, expected.count) << kernels->name;
        for (int i = 0; i < found.count; ++i) EXPECT_EQ(found.facet[i], expected.facet[i]) << kernels->name;
      }
      kept += expected.count;
      left_out += block.count - expected.count;
    }
  });
  EXPECT_GT(kept, 1000);
  EXPECT_GT(left_out, 1000);
}

TEST(RankByDistance, HoldsTheBoxesWithinReach) {
  Random random(2);
  BoxArrays boxes;
  constexpr int kCount = 45;
  boxes.resize(kCount);
  for (int trial = 0; trial < 100; ++trial) {
    for (int i = 0; i < kCount; ++i) {
      const Vec3 p = random.in_cube(1.5);
      boxes.set(i, {p, p + Vec3{0.2, 0.3, 0.1}});
    }
    const Vec3 point = random.in_cube(2.0);
    const double at[3] = {point.x, point.y, point.z}, most = random.uniform(), scale = 0.25;
    for (const Kernels* kernels : tests::available_kernels()) {
      RankedBoxes ranked;
      kernels->rank_by_distance(boxes.pointers(), kCount, at, scale, scale * scale * most, &ranked);
      int next = 0;
      for (int i = 0; i < kCount; ++i) {
        const Box box = boxes[i];
        double square = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
          const double away = std::max({box.lower[axis] - at[axis], at[axis] - box.upper[axis], 0.0});
          square += away * away;
        }
        if (square > most) continue;
        ASSERT_LT(next, ranked.count) << kernels->name;
        EXPECT_EQ(ranked.index[next], i) << kernels->name;
        EXPECT_EQ(ranked.rank[next++], scale * scale * square) << kernels->name;
      }
      EXPECT_EQ(next, ranked.count) << kernels->name;
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
