#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/box_arrays.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

// Boxes with corners on a grid: many touch the other box in a face, an edge or a corner, which counts.
TEST(SelectOverlapping, SelectsClosedBoxesThatOverlap) {
  tests::Random random(13);
  for (int repeat = 0; repeat < 1000; ++repeat) {
    const int count = random.below(40);
    BoxArrays boxes, ends;
    boxes.resize(count);
    ends.resize(count);
    const auto corner = [&] { return Vec3{random.below(7) - 3.0, random.below(7) - 3.0, random.below(7) - 3.0}; };
    const auto box = [&] {
      const Vec3 p = corner();
      return extended(Box{p, p}, corner());
    };
    const Box other = box();
    std::vector<std::int32_t> expected, expected_swept;
    for (int i = 0; i < count; ++i) {
      const Box one = box(), end = box();
      boxes.set(static_cast<std::size_t>(i), one);
      ends.set(static_cast<std::size_t>(i), end);
      if (overlaps(one, other)) expected.push_back(i);
      if (overlaps(merged(one, end), other)) expected_swept.push_back(i);
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      std::vector<std::int32_t> found(static_cast<std::size_t>(count) + kPadding);
      std::vector<std::int32_t> swept = found;
      found.resize(kernels->select_overlapping(boxes.pointers(), count, bounds_of(other), found.data()));
      EXPECT_EQ(found, expected) << kernels->name;
      swept.resize(kernels->select_swept(boxes.pointers(), ends.pointers(), count, bounds_of(other), swept.data()));
      EXPECT_EQ(swept, expected_swept) << kernels->name;
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
