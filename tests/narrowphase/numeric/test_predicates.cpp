#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "narrowphase/numeric/predicates.h"
#include "tests/support/environment/floating_point_state.h"
#include "tests/support/generators/triangle_pairs.h"
#include "tests/support/oracles/triangle_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::hard_triangle_pair;
using tests::rational_orient2d;
using tests::rational_orient3d;
using tests::TrianglePair;

constexpr std::uint64_t kSeed = 20240517;
constexpr double kTiniest = std::numeric_limits<double>::denorm_min();
constexpr double kLargest = 0x1p300;

// The signs that a pair asks for: each plane against the corners of the other triangle, edges against edges, and the
// projections.
std::vector<int> signs_of(const TrianglePair& pair, PredicateCounts& counts) {
  const auto& [a, b, kind] = pair;
  std::vector<int> signs;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    signs.push_back(orient3d(a[0], a[1], a[2], b[i], counts));
    signs.push_back(orient3d(a[0], a[1], b[i], b[j], counts));
    signs.push_back(orient2d({a[0].x, a[0].y}, {a[1].x, a[1].y}, {b[i].x, b[i].y}, counts));
    signs.push_back(orient2d({a[0].y, a[0].z}, {b[j].y, b[j].z}, {b[i].y, b[i].z}, counts));
  }
  const auto sides = sides_of_plane(b[0], b[1], b[2], a, counts);
  signs.insert(signs.end(), sides.begin(), sides.end());
  return signs;
}

std::vector<int> rational_signs_of(const TrianglePair& pair) {
  const auto& [a, b, kind] = pair;
  std::vector<int> signs;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    signs.push_back(rational_orient3d(a[0], a[1], a[2], b[i]));
    signs.push_back(rational_orient3d(a[0], a[1], b[i], b[j]));
    signs.push_back(rational_orient2d({a[0].x, a[0].y}, {a[1].x, a[1].y}, {b[i].x, b[i].y}));
    signs.push_back(rational_orient2d({a[0].y, a[0].z}, {b[j].y, b[j].z}, {b[i].y, b[i].z}));
  }
  for (const Vec3& p : a) signs.push_back(rational_orient3d(b[0], b[1], b[2], p));
  return signs;
}

TEST(Orient3d, PointBelowACounterClockwiseTriangleIsPositive) {
  PredicateCounts counts;
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, -1}, counts), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, counts), -1);
  EXPECT_EQ(counts.exact, 0);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, -5, 0}, counts), 0);
  EXPECT_EQ(counts.exact, 1);
}

TEST(Orient2d, CounterClockwiseTurnIsPositive) {
  PredicateCounts counts;
  EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, 1}, counts), 1);
  EXPECT_EQ(orient2d({0, 0}, {0, 1}, {1, 0}, counts), -1);
  EXPECT_EQ(counts.exact, 0);
  EXPECT_EQ(orient2d({0.1, 0.1}, {0.2, 0.2}, {0.7, 0.7}, counts), 0);
  EXPECT_EQ(counts.exact, 1);
}

TEST(Orient3d, HardPairsHaveTheSignsOfRationals) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const TrianglePair pair = hard_triangle_pair(kSeed, i);
    PredicateCounts counts;
    ASSERT_EQ(signs_of(pair, counts), rational_signs_of(pair))
        << "seed " << kSeed << " pair " << i << ' ' << to_string(pair);
  }
}

// Points of the plane x + y + z = 3, and of the line x = y, within an ulp: the filter's bound is put to the test.
TEST(Orient3d, GridOfUlpsAroundAPlaneHasTheSignsOfRationals) {
  const Vec3 b{12.0, 12.0, -21.0};
  const Vec3 c{24.0, -3.0, -18.0};
  const Vec3 d{-7.0, 20.0, -10.0};
  for (int i = 0; i < 32; ++i) {
    for (int j = 0; j < 32; ++j) {
      for (int k = -1; k <= 1; ++k) {
        const Vec3 a{0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53, 2.0 + k * 0x1p-51};
        PredicateCounts counts;
        ASSERT_EQ(orient3d(a, b, c, d, counts), rational_orient3d(a, b, c, d)) << i << ' ' << j << ' ' << k;
        const Point2 p{a.x, a.y}, q{12.0, 12.0}, r{24.0, 24.0};
        ASSERT_EQ(orient2d(p, q, r, counts), rational_orient2d(p, q, r)) << i << ' ' << j;
      }
    }
  }
}

TEST(Orient3d, CoordinatesOfAnySizeHaveTheSignsOfRationals) {
  std::mt19937_64 random(kSeed);
  const auto any_size = [&] {
    double x = 0.0;
    do x = std::bit_cast<double>(random());
    while (!(std::abs(x) <= kLargest));
    return x;
  };
  for (int i = 0; i < 5000; ++i) {
    std::array<Vec3, 4> p;
    for (Vec3& v : p) v = {any_size(), any_size(), any_size()};
    if (i % 2 == 0) p[3].x = p[0].x, p[3].y = p[0].y;
    if (i % 4 == 0) p[2] = {p[0].x, p[0].y, any_size()};
    if (i % 3 == 0) {
      for (Vec3& v : p) v.y = v.x;
    }
    PredicateCounts counts;
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3], counts), rational_orient3d(p[0], p[1], p[2], p[3])) << "case " << i;
    const Point2 a{p[0].x, p[0].y}, b{p[1].x, p[1].y}, c{p[2].x, p[2].y};
    ASSERT_EQ(orient2d(a, b, c, counts), rational_orient2d(a, b, c)) << "case " << i;
  }
}

TEST(Orient3d, TiniestStepOffAPlaneOfTheLargestCoordinatesCounts) {
  const double m = kLargest;
  PredicateCounts counts;
  for (const double z : {-kTiniest, 0.0, kTiniest}) {
    const int expected = z < 0 ? 1 : z > 0 ? -1 : 0;
    EXPECT_EQ(orient3d({-m, -m, 0}, {m, -m, 0}, {0, m, 0}, {0, 0, z}, counts), expected);
    EXPECT_EQ(orient3d({-m, -m, -m}, {m, -m, -m}, {0, m, m}, {0, 0, z}, counts), expected);
    EXPECT_EQ(orient2d({-m, -m}, {m, m}, {0, z}, counts), -expected);
  }
  EXPECT_EQ(counts.exact, 9);
}

TEST(Orient3d, UnderflowDoesNotLookLikeAPlane) {
  const double s = 0x1p-600;  // its cube and its square are below the smallest number
  PredicateCounts counts;
  EXPECT_EQ(orient3d({0, 0, 0}, {s, 0, 0}, {0, s, 0}, {0, 0, s}, counts), -1);
  EXPECT_EQ(orient2d({0, 0}, {s, 0}, {0, s}, counts), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {kTiniest, 0, 0}, {0, kTiniest, 0}, {0, 0, kTiniest}, counts), -1);
  EXPECT_EQ(orient2d({0, 0}, {kTiniest, 0}, {0, kTiniest}, counts), 1);
}

TEST(Orient3d, OddPermutationsTurnTheSign) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const TrianglePair pair = hard_triangle_pair(kSeed + 1, i);
    const std::array<Vec3, 4> p{pair.a[0], pair.a[1], pair.b[0], pair.b[1]};
    PredicateCounts counts;
    const int sign = orient3d(p[0], p[1], p[2], p[3], counts);
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    do {
      int inversions = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t k = 0; k < j; ++k) inversions += order[k] > order[j];
      }
      const int expected = inversions % 2 == 0 ? sign : -sign;
      ASSERT_EQ(orient3d(p[order[0]], p[order[1]], p[order[2]], p[order[3]], counts), expected)
          << "seed " << kSeed + 1 << " pair " << i << ' ' << to_string(pair);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(Orient3d, PointsInGeneralPositionNeverNeedTheExactPath) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  PredicateCounts counts;
  for (int i = 0; i < 100000; ++i) {
    std::array<Vec3, 4> p;
    for (Vec3& v : p) v = {coordinate(random), coordinate(random), coordinate(random)};
    orient3d(p[0], p[1], p[2], p[3], counts);
  }
  EXPECT_LE(counts.exact, 1);
}

// The signs in another floating-point mode; back in the caller's mode afterwards.
template <class SetMode>
std::vector<int> signs_in_mode(const TrianglePair& pair, const SetMode& set_mode) {
  const tests::SavedFloatingPointState saved;
  set_mode();
  PredicateCounts counts;
  std::vector<int> signs = signs_of(pair, counts);
  signs.push_back(compare_lexicographically(pair.a[0], pair.b[0]));
  return signs;
}

TEST(Orient3d, RoundingModeAndFlushedSubnormalsChangeNothing) {
  for (std::uint64_t i = 0; i < 50000; ++i) {
    const TrianglePair pair = hard_triangle_pair(kSeed + 2, i);
    const std::vector<int> expected = signs_in_mode(pair, [] {});
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      ASSERT_EQ(signs_in_mode(pair, [&] { std::fesetround(mode); }), expected)
          << "mode " << mode << " seed " << kSeed + 2 << " pair " << i << ' ' << to_string(pair);
    }
    ASSERT_EQ(signs_in_mode(pair, tests::flush_subnormals), expected)
        << "seed " << kSeed + 2 << " pair " << i << ' ' << to_string(pair);
  }
}

TEST(CompareLexicographically, OrdersByXThenYThenZ) {
  EXPECT_EQ(compare_lexicographically({1, 5, 5}, {2, 0, 0}), -1);
  EXPECT_EQ(compare_lexicographically({1, 5, 5}, {1, 4, 9}), 1);
  EXPECT_EQ(compare_lexicographically({1, 5, 5}, {1, 5, 5}), 0);
  EXPECT_EQ(compare_lexicographically({1, 5, -kTiniest}, {1, 5, 0}), -1);
  EXPECT_EQ(compare_lexicographically({0.0, 0, 0}, {-0.0, 0, 0}), 0);
  EXPECT_EQ(compare_lexicographically({-kLargest, 0, 0}, {-1.0, 0, 0}), -1);
}

}  // namespace
}  // namespace tact::narrowphase
