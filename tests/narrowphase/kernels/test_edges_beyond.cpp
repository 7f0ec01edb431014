#include <gtest/gtest.h>

#include <cstdint>

#include "narrowphase/contact_points/nearest.h"
#include "narrowphase/kernels/kernels.h"
#include "tests/support/facet_filters.h"
#include "tests/support/random.h"

namespace tact::tests {
namespace {

using narrowphase::PointQuads;

// Nothing that is left out has a point by the function that decides, though no facet stands in its way; and every
// instruction set leaves out the same.
TEST(EdgesBeyond, LeaveOutNoPoint) {
  Random random(12);
  std::int64_t left_out = 0, points = 0;
  for (int block = 0; block < 800; ++block) {
    const double reach = block % 3 == 0 ? 0.3 : block % 3 == 1 ? 0.02 : 1e-6;
    PointQuads quads;
    const int wanted = 1 + random.below(64);
    for (; quads.count < wanted; ++quads.count) {
      const Vec3 along = random.in_cube(0.5);
      Vec3 across = random.in_cube(0.5);
      if (random.chance(0.2)) across = along + 1e-4 * random.in_cube(1.0);  // nearly parallel
      if (random.chance(0.05)) across = along;
      const double s = random.uniform(-0.3, 1.3), t = random.uniform(-0.3, 1.3);
      const Vec3 p = random.in_cube(0.5), way = random.uniform(0.0, 1.5 * reach) * normalized(cross(along, across));
      const bool has_way = norm(cross(along, across)) > 0.0;
      const Vec3 r = p + s * along - t * across + (has_way ? way : Vec3{});
      const Vec3 point[4] = {p, p + along, r, r + across};
      for (int k = 0; k < 4; ++k) {
        for (int axis = 0; axis < 3; ++axis) quads.at[k][axis][quads.count] = point[k][axis];
      }
    }
    const std::uint64_t beyond = narrowphase::scalar_kernels()->edges_beyond(quads, reach);
    for (const narrowphase::Kernels* kernels : available_kernels())
      ASSERT_EQ(kernels->edges_beyond(quads, reach), beyond) << kernels->name;
    for (int i = 0; i < quads.count; ++i) {
      Vec3 point[4];
      for (int k = 0; k < 4; ++k) point[k] = {quads.at[k][0][i], quads.at[k][1][i], quads.at[k][2][i]};
      const bool has_point =
          narrowphase::nearest_between_edges({point[0], point[1]}, {}, {point[2], point[3]}, {}, reach).has_value();
      points += has_point ? 1 : 0;
      if ((beyond >> i & 1) == 0) continue;
      ++left_out;
      ASSERT_FALSE(has_point) << "block " << block << ", " << i;
    }
    if (quads.count < 64) {
      ASSERT_EQ(beyond >> quads.count, 0u);
    }
  }
  EXPECT_GT(left_out, 5000);
  EXPECT_GT(points, 3000);
}

}  // namespace
}  // namespace tact::tests
