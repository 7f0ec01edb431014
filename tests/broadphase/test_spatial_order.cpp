#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "broadphase/spatial_order.h"
#include "tests/support/generators/random.h"

namespace tact::broadphase {
namespace {

std::vector<OrderItem> ordered(const std::vector<Box>& boxes, int threads) {
  std::vector<OrderItem> items;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) items.push_back(order_item(boxes[i], i, Frame{}));
  order_spatially(items, boxes, threads);
  return items;
}

// The mean volume of the boxes of neighbouring runs of `run` items, but those that hold a box larger than all others.
double mean_volume(const std::vector<OrderItem>& items, const std::vector<Box>& boxes, std::size_t run) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t first = 0; first + run <= items.size(); first += run) {
    Box bounds;
    for (std::size_t i = first; i < first + run; ++i) bounds = base::merged(bounds, boxes[items[i].index]);
    const base::Vec3 size = bounds.upper - bounds.lower;
    if (size.x > 1e10) continue;
    sum += size.x * size.y * size.z;
    ++count;
  }
  return sum / count;
}

std::vector<Box> random_cubes(std::size_t count, double half_edge) {
  tests::Random random(2);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const base::Vec3 lower = random.in_cube(half_edge);
    boxes.push_back({lower, lower + base::Vec3{1, 1, 1}});
  }
  return boxes;
}

TEST(SpatialOrder, IsAPermutationWhateverTheThreads) {
  for (const std::size_t count : {0, 1, 16, 17, 255, 256, 257, 4097, 30000}) {
    const std::vector<Box> boxes = random_cubes(count, 20.0);
    const std::vector<OrderItem> items = ordered(boxes, 1);
    std::vector<std::uint32_t> indices;
    for (const OrderItem& item : items) indices.push_back(item.index);
    std::ranges::sort(indices);
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(indices[i], i) << count;
    const std::vector<OrderItem> other = ordered(boxes, 3);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(other[i].index, items[i].index) << count;
  }
}

// A run of r boxes in a cube of volume V n has at best a cube of V r, widened by the size of a box.
TEST(SpatialOrder, RunsAreCompact) {
  const std::vector<Box> boxes = random_cubes(32768, 32.0);
  const std::vector<OrderItem> items = ordered(boxes, 1);
  for (const std::size_t run : {16, 256, 4096}) {
    const double best = std::pow(std::cbrt(64.0 * 64.0 * 64.0 / 32768.0 * static_cast<double>(run)) + 1.0, 3.0);
    EXPECT_LT(mean_volume(items, boxes, run), 1.3 * best) << run;
  }
}

TEST(SpatialOrder, ABoxFarAwaySpoilsNothing) {
  std::vector<Box> boxes = random_cubes(32768, 32.0);
  boxes[77] = {{-0x1p300, 0x1p300, 0}, {0x1p300, 0x1p300, 1}};
  const std::vector<OrderItem> items = ordered(boxes, 1);
  const double without = mean_volume(ordered(random_cubes(32768, 32.0), 1), boxes, 16);
  EXPECT_LT(mean_volume(items, boxes, 16), 1.1 * without);
}

TEST(SpatialOrder, EqualCentresEndToo) {
  const std::vector<Box> boxes(20000, Box{{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(ordered(boxes, 1).size(), boxes.size());
}

}  // namespace
}  // namespace tact::broadphase
