#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "narrowphase/contact_points/nearest.h"
#include "narrowphase/kernels/kernels.h"
#include "tests/support/facet_filters.h"
#include "tests/support/random.h"

namespace tact::tests {
namespace {

using narrowphase::FacetsBeyond;
using narrowphase::PointQuads;

using Wide = std::array<long double, 3>;
Wide wide(Vec3 p) { return {p.x, p.y, p.z}; }
Wide operator-(const Wide& a, const Wide& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Wide operator+(const Wide& a, const Wide& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Wide operator*(long double s, const Wide& a) { return {s * a[0], s * a[1], s * a[2]}; }
long double dot(const Wide& a, const Wide& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The distance of a vertex from a triangle: the least from its edges, and from the foot on its plane where that lies
// inside.
long double distance(Vec3 vertex, const Vec3 (&corner)[3]) {
  const Wide v = wide(vertex), a = wide(corner[0]), e = wide(corner[1]) - a, f = wide(corner[2]) - a;
  long double least = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const Wide p = wide(corner[k]), along = wide(corner[(k + 1) % 3]) - p;
    const long double length = dot(along, along);
    const long double t = length > 0 ? std::clamp(dot(v - p, along) / length, 0.0L, 1.0L) : 0.0L;
    const Wide way = v - (p + t * along);
    least = std::min(least, std::sqrt(dot(way, way)));
  }
  const long double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), ve = dot(v - a, e), vf = dot(v - a, f);
  const long double area = ee * ff - ef * ef;
  const long double s = (ff * ve - ef * vf) / area, t = (ee * vf - ef * ve) / area;
  if (area > 0 && s > 0 && t > 0 && s + t < 1) {
    const Wide way = v - (a + (s * e + t * f));
    least = std::min(least, std::sqrt(dot(way, way)));
  }
  return least;
}

// Of near, far, flat and thin facets: nothing that is left out is nearer than the reach, nor has a point inside the
// facet by the function that decides; and every instruction set leaves out the same.
TEST(FacetsBeyond, LeaveOutNothingThatIsNear) {
  Random random(11);
  std::int64_t beyond = 0, beside = 0, inside = 0;
  for (int block = 0; block < 800; ++block) {
    const double reach = block % 3 == 0 ? 0.3 : block % 3 == 1 ? 0.02 : 1e-6;
    PointQuads quads;
    const int wanted = 1 + random.below(64);
    for (; quads.count < wanted; ++quads.count) {
      Vec3 corner[3] = {random.in_cube(0.7), random.in_cube(0.7), random.in_cube(0.7)};
      if (random.chance(0.2)) corner[2] = corner[0] + random.uniform() * (corner[1] - corner[0]);  // no area, or nearly
      if (random.chance(0.1)) corner[2] = corner[random.below(2)];
      if (random.chance(0.2)) corner[1] = corner[0] + 1e-5 * random.in_cube(1.0);
      const double s = random.uniform(-0.3, 1.3), t = random.uniform(-0.3, 1.3 - s);
      Vec3 v = corner[0] + s * (corner[1] - corner[0]) + t * (corner[2] - corner[0]);
      v = v + random.uniform(0.0, 2.0 * reach) * random.direction();
      if (random.chance(0.1)) v = random.in_cube(1.0);
      if (random.chance(0.1)) v = corner[random.below(3)];
      for (int axis = 0; axis < 3; ++axis) {
        quads.at[0][axis][quads.count] = v[axis];
        for (int c = 0; c < 3; ++c) quads.at[1 + c][axis][quads.count] = corner[c][axis];
      }
    }
    const FacetsBeyond all = narrowphase::scalar_kernels()->facets_beyond(quads, reach);
    for (const narrowphase::Kernels* kernels : available_kernels()) {
      const FacetsBeyond same = kernels->facets_beyond(quads, reach);
      ASSERT_EQ(same.beyond, all.beyond) << kernels->name;
      ASSERT_EQ(same.beside, all.beside) << kernels->name;
    }
    for (int i = 0; i < quads.count; ++i) {
      Vec3 point[4];
      for (int k = 0; k < 4; ++k) point[k] = {quads.at[k][0][i], quads.at[k][1][i], quads.at[k][2][i]};
      const Vec3 corner[3] = {point[1], point[2], point[3]};
      const bool is_beyond = (all.beyond >> i & 1) != 0, is_beside = (all.beside >> i & 1) != 0;
      if (is_beyond) {
        ++beyond;
        ASSERT_GE(distance(point[0], corner), static_cast<long double>(reach)) << "block " << block << ", " << i;
      }
      const auto nearest = narrowphase::nearest_inside_facet(point[0], corner, reach);
      if (is_beside) {
        ++beside;
        ASSERT_FALSE(nearest.has_value()) << "block " << block << ", " << i;
      }
      inside += nearest.has_value() ? 1 : 0;
    }
    if (quads.count < 64) {
      ASSERT_EQ((all.beyond | all.beside) >> quads.count, 0u);
    }
  }
  EXPECT_GT(beyond, 3000);
  EXPECT_GT(beside, 3000);
  EXPECT_GT(inside, 2000);
}

}  // namespace
}  // namespace tact::tests
