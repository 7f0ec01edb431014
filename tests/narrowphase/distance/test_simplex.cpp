#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "narrowphase/distance/simplex.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/triangle_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::Random;

constexpr double kUnitRoundoff = 0x1p-53;

double power_of_ten(Random& random, double low, double high) { return std::pow(10.0, random.uniform(low, high)); }

double size_of(const SimplexPoints& simplex) {
  double size = 0.0;
  for (int i = 0; i < simplex.count; ++i) size = std::max(size, norm(simplex.point[i]));
  return size;
}

// On the same side of every face as the corner across from it, by rational numbers.
bool holds_origin_exactly(const SimplexPoints& simplex) {
  const auto& y = simplex.point;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 p = y[(i + 1) % 4], q = y[(i + 2) % 4], r = y[(i + 3) % 4];
    const int side = tests::rational_orient3d(p, q, r, {});
    if (side == 0 || side != tests::rational_orient3d(p, q, r, y[i])) return false;
  }
  return true;
}

// Three corners within `width` of a line through the origin, which lies as far inside the face between them as rounding
// lets it, and `depth` behind it.
SimplexPoints sliver(Random& random, double width, double depth) {
  const Vec3 along = random.direction(), across = normalized(cross(along, random.direction()));
  const Vec3 apex = 2.0 * random.direction();
  SimplexPoints points{.point = {-random.uniform(0.5, 1.5) * along, random.uniform(-0.4, 0.4) * along + width * across,
                                 random.uniform(0.5, 1.5) * along, apex},
                       .count = 4};
  const Vec3 inside = 0.3 * points.point[0] + 0.4 * points.point[1] + 0.3 * points.point[2] + depth * apex;
  for (Vec3& p : points.point) p = p - inside;
  return points;
}

// The normal of a sliver of sine 1e-9 is off by 1e-7 of itself: the plane may lie on either side of an origin that is
// 1e-16 from it. Near the smallest numbers products are off by all of themselves.
TEST(Simplex, ATetrahedronThatHoldsTheOriginForCertainDoesSo) {
  Random random(1);
  int certain = 0, exact = 0;
  for (int i = 0; i < 4000; ++i) {
    const double width = power_of_ten(random, -15, 0), depth = i % 2 == 0 ? 0.0 : power_of_ten(random, -20, -1);
    SimplexPoints points = sliver(random, width, depth);
    if (i % 4 == 3) {
      const double tiny = power_of_ten(random, -109, -100);
      for (Vec3& p : points.point) p = tiny * p;
    }
    const bool is_certain = tetrahedron_holds_origin(points), holds = holds_origin_exactly(points);
    EXPECT_TRUE(!is_certain || holds) << "case " << i << ", width " << width << ", depth " << depth;
    certain += is_certain ? 1 : 0;
    exact += holds ? 1 : 0;
    if (width > 1e-8 && depth > 1e-6 && i % 4 != 3) {
      EXPECT_TRUE(is_certain) << "case " << i << ", width " << width << ", depth " << depth;
    }
  }
  EXPECT_GT(certain, 200);
  EXPECT_GT(exact, certain + 300);
}

// Up to four points, of which some may coincide or lie on one line or in one plane, but for `width`.
SimplexPoints degenerate_simplex(Random& random, int count, double width) {
  const Vec3 base = power_of_ten(random, -8, 0) * random.direction(), e = random.direction(), f = random.direction();
  SimplexPoints points{.point = {}, .count = count};
  for (int i = 0; i < count; ++i) {
    Vec3& p = points.point[i];
    p = base + random.uniform(-1.0, 1.0) * e + width * random.in_ball();
    if (random.chance(0.3)) p = p + random.uniform(-1.0, 1.0) * f;
    if (i > 0 && random.chance(0.1)) p = points.point[random.below(i)];
  }
  return points;
}

// The point is the weighted sum, and no corner lies nearer than the plane through it.
TEST(Simplex, WeightsGiveTheNearestPoint) {
  Random random(2);
  int inside = 0, triangles = 0;
  for (int i = 0; i < 4000; ++i) {
    const SimplexPoints points = degenerate_simplex(random, 1 + i % 4, power_of_ten(random, -18, 0));
    const double size = size_of(points);
    for (const bool wide : {false, true}) {
      const SimplexClosest closest = wide ? simplex_closest_in_triple(points) : simplex_closest(points);
      if (closest.carrier_count == 4) {
        ++inside;
        continue;
      }
      triangles += closest.carrier_count == 3 ? 1 : 0;
      Vec3 sum;
      double weights = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        if (k >= static_cast<std::size_t>(closest.carrier_count)) {
          EXPECT_EQ(closest.weight[k], 0.0) << "case " << i;
          continue;
        }
        EXPECT_GE(closest.weight[k], 0.0) << "case " << i;
        weights += closest.weight[k];
        sum = sum + closest.weight[k] * points.point[closest.carrier[k]];
      }
      EXPECT_NEAR(weights, 1.0, 8.0 * kUnitRoundoff) << "case " << i;
      EXPECT_LE(norm(sum - closest.point), 16.0 * kUnitRoundoff * size) << "case " << i << ", wide " << wide;
      if (!wide) continue;  // plain doubles may lose the point of a thin simplex
      const double squared = norm_squared(closest.point);
      for (int k = 0; k < points.count; ++k) {
        EXPECT_GE(dot(closest.point, points.point[k]),
                  squared - 8.0 * kUnitRoundoff * size * norm(closest.point) - 1e-28 * size * size)
            << "case " << i;
      }
    }
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(triangles, 500);
}

void expect_weights_of_origin(const SimplexPoints& points, int number) {
  const std::array<double, 4> weight = origin_weights(points);
  Vec3 sum;
  double weights = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GE(weight[i], 0.0) << "case " << number;
    weights += weight[i];
    sum = sum + weight[i] * points.point[i];
  }
  EXPECT_NEAR(weights, 1.0, 8.0 * kUnitRoundoff) << "case " << number;
  EXPECT_LE(norm(sum), 16.0 * kUnitRoundoff * size_of(points)) << "case " << number;
}

// Slivers, needles, and four points in a plane or a line with the origin.
TEST(Simplex, WeightsOfAnOriginInsideGiveTheOrigin) {
  Random random(3);
  int count = 0;
  for (int i = 0; i < 3000; ++i) {
    SimplexPoints points = sliver(random, power_of_ten(random, -16, 0), power_of_ten(random, -18, -1));
    if (i % 2 == 0) {
      const double width = power_of_ten(random, -120, 0), height = i % 4 == 0 ? width : 1.0;
      for (Vec3& p : points.point) {
        p = random.in_cube(1.0);
        p = {p.x, height * p.y, width * p.z};
      }
    }
    if (!holds_origin_exactly(points)) continue;
    ++count;
    expect_weights_of_origin(points, i);
  }
  EXPECT_GT(count, 500);
  expect_weights_of_origin({.point = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}, .count = 4}, -1);
  expect_weights_of_origin({.point = {{{-1, -1, -1}, {2, 2, 2}, {2, 2, 2}, {3, 3, 3}}}, .count = 4}, -2);
}

}  // namespace
}  // namespace tact::narrowphase
