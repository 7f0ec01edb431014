// Edges that are near each other anywhere are never left out, and few others are left.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::tests {
namespace {

using narrowphase::ClusterPoints;
using narrowphase::FeatureBlock;

struct LongPoint {
  long double x, y, z;
};
LongPoint operator-(const LongPoint& a, const LongPoint& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
LongPoint operator+(const LongPoint& a, const LongPoint& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
LongPoint operator*(long double s, const LongPoint& a) { return {s * a.x, s * a.y, s * a.z}; }
long double product(const LongPoint& a, const LongPoint& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LongPoint across(const LongPoint& a, const LongPoint& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
long double norm_of(const LongPoint& a) { return std::sqrt(product(a, a)); }

long double from_end(const LongPoint& v, const LongPoint& p, const LongPoint& q) {
  const LongPoint along = q - p;
  const long double square = product(along, along);
  const long double t = square > 0 ? std::clamp(product(v - p, along) / square, 0.0L, 1.0L) : 0.0L;
  return norm_of((p + t * along) - v);
}

long double distance_of_edges(const LongPoint (&e)[2], const LongPoint (&f)[2]) {
  const long double least = std::min(
      {from_end(e[0], f[0], f[1]), from_end(e[1], f[0], f[1]), from_end(f[0], e[0], e[1]), from_end(f[1], e[0], e[1])});
  const LongPoint u = e[1] - e[0], w = f[1] - f[0], r = f[0] - e[0], n = across(u, w);
  const long double square = product(n, n), s = product(across(r, w), n), t = product(across(r, u), n);
  if (!(square > 0) || s < 0 || s > square || t < 0 || t > square) return least;
  return std::min(least, std::abs(product(r, n)) / std::sqrt(square));
}

// One edge a side and place, all in one cell; of every third two are parallel, or nearly.
struct EdgesSideBySide {
  ClusterPoints points[2] = {};
  FeatureBlock edges[2] = {};
  LongPoint end[2][64][2] = {};

  explicit EdgesSideBySide(Random& random) {
    for (int i = 0; i < 64; ++i) {
      const Vec3 p = random.in_cube(0.5), along = random.in_cube(0.1 + 0.4 * random.uniform(0.0, 1.0));
      const double gap = std::pow(10.0, random.uniform(-6.0, -0.5)), turn = std::pow(10.0, random.uniform(-12.0, 0.0));
      const Vec3 other = i % 3 == 0 ? along + turn * random.in_cube(0.3) : random.in_cube(0.4);
      const Vec3 q =
          p + random.uniform(-0.5, 1.5) * along + gap * random.in_cube(1.0) - random.uniform(0.0, 1.0) * other;
      set(0, i, p, p + along);
      set(1, i, q, q + other);
    }
    for (FeatureBlock& block : edges) block.count = block.cells.count = 64;
  }
  void set(int side, int i, Vec3 from, Vec3 to) {
    for (const int k : {0, 1}) {
      const Vec3 at = k == 0 ? from : to;
      for (int axis = 0; axis < 3; ++axis)
        points[side].at[axis][2 * i + k] = points[side].together[4 * (2 * i + k) + axis] = at[axis];
      edges[side].corner[k][i] = static_cast<std::uint8_t>(2 * i + k);
      end[side][i][k] = {at.x, at.y, at.z};
    }
    points[side].count = 128;
  }
};

TEST(CloseEdges, HoldAllThatAreNearAndFewOthers) {
  Random random(5);
  std::int64_t near = 0, kept = 0;
  for (int block = 0; block < 25; ++block) {
    const EdgesSideBySide all(random);
    const double reach = std::pow(10.0, random.uniform(-4.0, -0.7));
    std::uint64_t left_out[64];
    for (std::uint64_t& mask : left_out) mask = random.chance(0.3) ? std::uint64_t{1} << random.below(64) : 0;
    for (const narrowphase::Kernels* kernels : available_kernels()) {
      std::uint64_t found[64];
      const std::uint64_t some = ~std::uint64_t{0};
      const std::uint64_t any = kernels->close_edges({all.points[0], all.edges[0], some},
                                                     {all.points[1], all.edges[1], some}, reach, left_out, found);
      for (int i = 0; i < 64; ++i) {
        for (int k = 0; k < 64; ++k) {
          const bool is_kept = (any >> i & 1) != 0 && (found[i] >> k & 1) != 0;
          const long double distance = distance_of_edges(all.end[0][i], all.end[1][k]);
          if ((left_out[i] >> k & 1) != 0) {
            ASSERT_FALSE(is_kept) << kernels->name;
            continue;
          }
          ASSERT_TRUE(is_kept || distance >= reach) << kernels->name << ", distance " << static_cast<double>(distance);
          near += distance < reach;
          kept += is_kept;
        }
      }
    }
  }
  EXPECT_GT(near, 1000);
  EXPECT_LT(kept, near + near / 10);
}

}  // namespace
}  // namespace tact::tests
