#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "engine/base/vec3.h"
#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/point_soup.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

using base::Vec3;

// Points of whole numbers, many of them exactly as high as the threshold; the same sum of products, in the same order.
TEST(SelectHeights, SelectsThoseAtOrAboveTheThreshold) {
  tests::Random random(12);
  for (int count = 0; count <= 70; ++count) {
    tests::PointSoup points;
    for (int i = 0; i < count; ++i) points.add(random.below(5), random.below(5), random.below(5));
    const HeightAxis axis{random.below(5) - 2.0, random.below(5) - 2.0, random.below(5) - 2.0, 1.0, 2.0, 3.0};
    const double threshold = random.below(9) - 4.0;
    const PointArrays p = points.arrays();
    std::vector<std::int32_t> expected;
    for (int i = 0; i < count; ++i) {
      const double height =
          (axis.nx * (p.x[i] - axis.ox) + axis.ny * (p.y[i] - axis.oy)) + axis.nz * (p.z[i] - axis.oz);
      if (height >= threshold) expected.push_back(i);
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      std::vector<std::int32_t> selected(static_cast<std::size_t>(count));
      selected.resize(kernels->select_heights(p, count, axis, threshold, selected.data()));
      EXPECT_EQ(selected, expected) << kernels->name << " of " << count;
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
