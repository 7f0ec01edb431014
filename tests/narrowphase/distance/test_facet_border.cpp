#include <gtest/gtest.h>

#include <array>

#include "narrowphase/distance/facet_border.h"
#include "tests/support/generators/random.h"

namespace tact::narrowphase {
namespace {

using tests::Random;

// Some points as a mesh gives them.
struct CornerArrays {
  explicit CornerArrays(const Vec3 (&corner)[3]) {
    for (int k = 0; k < 3; ++k) x[k] = corner[k].x, y[k] = corner[k].y, z[k] = corner[k].z;
  }
  PointArrays arrays() const { return {x.data(), y.data(), z.data()}; }
  std::array<double, 3> x{}, y{}, z{};
};

// Vertices above facets of many shapes, near their borders and exactly on what parts the regions: a bit that is missing
// is a point that there is not, by the functions that decide, from whichever end an edge is counted; most that are
// there are points.
TEST(FacetBorder, LeavesOutNoPoint) {
  Random random(21);
  int missing = 0, kept = 0, points = 0;
  for (int trial = 0; trial < 100'000; ++trial) {
    const double flat = trial % 5 == 0 ? 1e-7 : 1.0;
    Vec3 corner[3] = {random.in_cube(1.0), random.in_cube(1.0), {}};
    corner[2] = corner[0] + flat * random.in_cube(1.0) + random.uniform() * (corner[1] - corner[0]);
    if (trial % 97 == 0) corner[2] = corner[trial % 2];
    const double limit = trial % 3 == 0 ? 0.02 : 0.5;
    const Vec3 p = corner[trial % 3], q = corner[(trial + 1) % 3], r = corner[(trial + 2) % 3];
    const Vec3 normal = cross(q - p, r - p);
    const double t = trial % 4 == 0 ? 0.0 : random.uniform(-0.2, 1.2);
    Vec3 v = p + t * (q - p) + random.uniform(-1.2, 1.2) * limit * (norm(normal) > 0.0 ? normalized(normal) : Vec3{});
    if (trial % 7 != 0) v = v + random.uniform(-1.0, 1.0) * limit * random.in_cube(1.0);
    const CornerArrays of(corner);
    const unsigned border = border_of(v, corner, limit);
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3, last = (k + 2) % 3, others[2] = {next, last};
      const ScaledVertices third{of.arrays(), {&last, 1}, 1.0}, neighbors{of.arrays(), others, 1.0};
      const bool on_edge = nearest_inside_edge(v, corner[k], corner[next], third, limit).has_value() ||
                           nearest_inside_edge(v, corner[next], corner[k], third, limit).has_value();
      const bool in_corner = nearest_in_vertex(v, corner[k], neighbors, limit).has_value();
      const bool has[2] = {on_edge, in_corner};
      for (int kind = 0; kind < 2; ++kind) {
        const bool bit = (border >> (3 * kind + k) & 1) != 0;
        EXPECT_TRUE(bit || !has[kind]) << "trial " << trial << " kind " << kind << " corner " << k;
        missing += !bit;
        kept += bit;
        points += has[kind];
      }
    }
  }
  EXPECT_GT(points, 20'000);
  EXPECT_LT(kept, points + points / 4);
  EXPECT_GT(missing, 5 * kept);
}

}  // namespace
}  // namespace tact::narrowphase
