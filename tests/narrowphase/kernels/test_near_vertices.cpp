#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "narrowphase/distance/vertex_facet.h"
#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::tests {
namespace {

using narrowphase::ClusterPoints;
using narrowphase::FeatureBlock;

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

// Vertices, and a facet for each, all in one cell.
struct VerticesAndFacets {
  ClusterPoints vertex_points{}, facet_points{};
  FeatureBlock vertices{}, facets{};

  int count() const { return vertices.count; }
  void add(Vec3 vertex, const Vec3 (&corner)[3]) {
    const int i = vertices.count;
    const auto set = [](ClusterPoints& points, int at, Vec3 p) {
      for (int axis = 0; axis < 3; ++axis) points.at[axis][at] = points.together[4 * at + axis] = p[axis];
    };
    set(vertex_points, i, vertex);
    vertices.corner[0][i] = static_cast<std::uint8_t>(i);
    for (int c = 0; c < 3; ++c) {
      set(facet_points, 3 * i + c, corner[c]);
      facets.corner[c][i] = static_cast<std::uint8_t>(3 * i + c);
    }
    vertices.count = vertices.cells.count = facets.count = facets.cells.count = i + 1;
    vertex_points.count = i + 1;
    facet_points.count = 3 * i + 3;
  }
};

// Which vertices and facets are near each other.
struct NearVertices {
  std::uint64_t near[64] = {}, inside[64] = {};
  NearVertices(const narrowphase::Kernels& kernels, const VerticesAndFacets& all, double reach) {
    const std::uint64_t some = ~std::uint64_t{0} >> (64 - all.count());
    std::uint64_t found[64], found_inside[64];
    std::uint64_t any =
        kernels.near_vertices({all.vertex_points, all.vertices, some}, {all.facet_points, all.facets, some}, reach,
                              nullptr, found, found_inside);
    for (; any != 0; any &= any - 1) {
      const int i = std::countr_zero(any);
      near[i] = found[i];
      inside[i] = found_inside[i];
    }
  }
};

// Of near, far, flat and thin facets: nothing that is left out is nearer than the reach, nor has a point inside the
// facet by the function that decides; and every instruction set leaves out the same.
TEST(NearVertices, LeaveOutNothingThatIsNear) {
  Random random(11);
  std::int64_t beyond = 0, beside = 0, inside = 0, kept = 0, within = 0;
  for (int block = 0; block < 800; ++block) {
    const double reach = block % 3 == 0 ? 0.3 : block % 3 == 1 ? 0.02 : 1e-6;
    VerticesAndFacets all;
    for (int wanted = 1 + random.below(64); all.count() < wanted;) {
      Vec3 corner[3] = {random.in_cube(0.7), random.in_cube(0.7), random.in_cube(0.7)};
      if (random.chance(0.2)) corner[2] = corner[0] + random.uniform() * (corner[1] - corner[0]);  // no area, or nearly
      if (random.chance(0.1)) corner[2] = corner[random.below(2)];
      if (random.chance(0.2)) corner[1] = corner[0] + 1e-5 * random.in_cube(1.0);
      const double s = random.uniform(-0.3, 1.3), t = random.uniform(-0.3, 1.3 - s);
      Vec3 v = corner[0] + s * (corner[1] - corner[0]) + t * (corner[2] - corner[0]);
      v = v + random.uniform(0.0, 2.0 * reach) * random.direction();
      if (random.chance(0.1)) v = random.in_cube(1.0);
      if (random.chance(0.1)) v = corner[random.below(3)];
      all.add(v, corner);
    }
    const NearVertices found(*narrowphase::scalar_kernels(), all, reach);
    for (const narrowphase::Kernels* kernels : available_kernels()) {
      const NearVertices same(*kernels, all, reach);
      for (int i = 0; i < 64; ++i) {
        ASSERT_EQ(same.near[i], found.near[i]) << kernels->name;
        ASSERT_EQ(same.inside[i], found.inside[i]) << kernels->name;
      }
    }
    for (int i = 0; i < all.count(); ++i) {
      const auto point = [](const ClusterPoints& points, int at) {
        return Vec3{points.at[0][at], points.at[1][at], points.at[2][at]};
      };
      const Vec3 vertex = point(all.vertex_points, i);
      // Its own facet, and another one's.
      for (const int k : {i, random.below(all.count())}) {
        const Vec3 corner[3] = {point(all.facet_points, 3 * k), point(all.facet_points, 3 * k + 1),
                                point(all.facet_points, 3 * k + 2)};
        const bool is_beyond = (found.near[i] >> k & 1) == 0, is_beside = (found.inside[i] >> k & 1) == 0;
        if (is_beyond) {
          ++beyond;
          ASSERT_GE(distance(vertex, corner), static_cast<long double>(reach)) << "block " << block << ", " << i;
        }
        const auto nearest = narrowphase::nearest_inside_facet(vertex, corner, reach);
        if (is_beside) {
          ++beside;
          ASSERT_FALSE(nearest.has_value()) << "block " << block << ", " << i;
        }
        inside += nearest.has_value() ? 1 : 0;
        kept += is_beyond ? 0 : 1;
        within += distance(vertex, corner) < static_cast<long double>(reach) ? 1 : 0;
      }
      ASSERT_EQ(found.inside[i] & ~found.near[i], 0u);
    }
    for (int i = 0; i < 64; ++i) {
      const std::uint64_t others = all.count() < 64 ? ~std::uint64_t{0} << all.count() : 0;
      ASSERT_EQ(found.near[i] & others, 0u);
    }
  }
  EXPECT_LT(kept, 2 * within);  // little that is not near
  EXPECT_GT(beyond, 3000);
  EXPECT_GT(beside, 3000);
  EXPECT_GT(inside, 2000);
}

}  // namespace
}  // namespace tact::tests
