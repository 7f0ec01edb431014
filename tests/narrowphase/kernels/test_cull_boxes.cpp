#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/box_arrays.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

// Boxes with corners on a grid, some of them exactly at the planes: which are left, and which of the others were too
// low.
TEST(CullBoxes, ByTheirFarCornersAndByABox) {
  tests::Random random(6);
  for (int repeat = 0; repeat < 3000; ++repeat) {
    const int count = random.below(kPadding * 4);
    BoxArrays boxes;
    boxes.resize(count);
    const auto corner = [&] { return Vec3{random.below(9) - 4.0, random.below(9) - 4.0, random.below(9) - 4.0}; };
    const auto box = [&](Vec3 p, Vec3 q) { return base::extended(Box{p, p}, q); };
    for (int i = 0; i < count; ++i) boxes.set(static_cast<std::size_t>(i), box(corner(), corner()));
    const Vec3 n = corner(), o = corner();
    const Box other = box(corner(), corner());
    const CullPlanes planes{{n.x, n.y, n.z, o.x, o.y, o.z}, random.below(60) - 10.0, narrowphase::bounds_of(other)};
    std::vector<std::int32_t> expected;
    int low = 0;
    for (int i = 0; i < count; ++i) {
      const Box one = boxes[i];
      if (!overlaps(one, other)) continue;
      double highest = -std::numeric_limits<double>::infinity();
      for (const double x : {one.lower.x, one.upper.x}) {
        for (const double y : {one.lower.y, one.upper.y}) {
          for (const double z : {one.lower.z, one.upper.z}) highest = std::max(highest, dot(n, Vec3{x, y, z} - o));
        }
      }
      if (highest >= planes.lowest) expected.push_back(i);
      if (highest < planes.lowest) ++low;
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      std::vector<std::int32_t> left(static_cast<std::size_t>(count));
      const Culled culled = kernels->cull_boxes(boxes.pointers(), count, planes, left.data());
      left.resize(culled.left);
      EXPECT_EQ(left, expected) << kernels->name;
      EXPECT_EQ(culled.low, low) << kernels->name;
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
