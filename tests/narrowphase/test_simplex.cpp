#include <gtest/gtest.h>

#include <cmath>

#include "narrowphase/simplex.h"
#include "tests/support/random.h"
#include "tests/support/triangle_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::Random;

double power_of_ten(Random& random, double low, double high) { return std::pow(10.0, random.uniform(low, high)); }

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

}  // namespace
}  // namespace tact::narrowphase
