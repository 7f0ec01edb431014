#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/box_arrays.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

// Any number of boxes, zeros of both signs among them: the answer has one zero.
TEST(Bounds, IsTheBoxOfAllBoxes) {
  tests::Random random(9);
  for (int count = 1; count <= 70; ++count) {
    BoxArrays boxes;
    boxes.resize(70);  // those beyond `count` are larger, and are not to be counted
    for (std::size_t i = 0; i < 70; ++i) boxes.set(i, {{-99, -99, -99}, {99, 99, 99}});
    Box expected;
    for (int i = 0; i < count; ++i) {
      const auto coordinate = [&] { return random.chance(0.2) ? 0.0 * (random.below(3) - 1) : random.uniform(-9, 9); };
      const auto point = [&] { return Vec3{coordinate(), coordinate(), coordinate()}; };
      const Vec3 p = point();
      const Box box = extended(Box{p, p}, point());
      boxes.set(static_cast<std::size_t>(i), box);
      expected = merged(expected, box);
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      const Box found = to_box(kernels->bounds(boxes.pointers(), count));
      EXPECT_EQ(found, expected) << kernels->name << " of " << count;
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_FALSE(found.lower[axis] == 0.0 && std::signbit(found.lower[axis])) << kernels->name;
        EXPECT_FALSE(found.upper[axis] == 0.0 && std::signbit(found.upper[axis])) << kernels->name;
      }
    }
  }
}

TEST(Bounds, OfNothingIsEmpty) {
  BoxArrays boxes;
  boxes.resize(1);
  for (const Kernels* kernels : tests::available_kernels())
    EXPECT_TRUE(to_box(kernels->bounds(boxes.pointers(), 0)).empty()) << kernels->name;
}

}  // namespace
}  // namespace tact::narrowphase
