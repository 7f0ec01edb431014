#include "broadphase/spatial_order.h"

#include <algorithm>
#include <array>

#include "engine/base/hash.h"
#include "engine/base/parallel.h"

namespace tact::broadphase {
namespace {

constexpr std::size_t kSample = 128;       // items looked at to choose an axis in a large range
constexpr std::size_t kLargeRange = 4096;  // from this size on, sampling costs nothing against the cut
constexpr std::size_t kPivotSample = 31;   // keys from which a pivot is chosen
constexpr std::size_t kSelectRange = 48;   // up to this size, plain selection is as fast
constexpr double kLargestExtent = 0x1p1000;
constexpr std::size_t kParallelRanges = 64;  // the work is split in up to this many parts

using Extent = std::array<double, 3>;  // mean size of the boxes, axis by axis

struct Range {
  std::size_t begin = 0;
  std::size_t end = 0;
  Extent extent{};
};

// The i-th of a fixed sequence of positions below `count` that shows no pattern (SplitMix64).
std::size_t scattered(std::size_t i, std::size_t count) {
  return static_cast<std::size_t>(base::mixed((i + 1) * base::kGoldenStep) % count);
}

// Between quantiles: one box far away must not decide on which axis the others are cut.
float sampled_spread(std::span<const OrderItem> items, int axis) {
  std::array<float, kSample> keys;
  for (std::size_t i = 0; i < kSample; ++i) keys[i] = items[scattered(i, items.size())].center[axis];
  std::nth_element(keys.begin(), keys.begin() + kSample / 8, keys.end());
  std::nth_element(keys.begin() + kSample / 8, keys.end() - kSample / 8, keys.end());
  return keys[kSample - kSample / 8] - keys[kSample / 8];
}

float full_spread(std::span<const OrderItem> items, int axis) {
  float lower = items[0].center[axis];
  float upper = lower;
  for (const OrderItem& item : items) {
    lower = item.center[axis] < lower ? item.center[axis] : lower;
    upper = upper < item.center[axis] ? item.center[axis] : upper;
  }
  return upper - lower;
}

Extent sampled_extent(std::span<const OrderItem> items, std::span<const Box> boxes) {
  Extent extent{};
  const std::size_t count = std::min(kSample, items.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Box& box = boxes[items[count == items.size() ? i : scattered(i, items.size())].index];
    for (int axis = 0; axis < 3; ++axis) {
      extent[axis] += std::min(box.upper[axis] - box.lower[axis], kLargestExtent) / static_cast<double>(count);
    }
  }
  return extent;
}

int cut_axis(std::span<const OrderItem> items, const Extent& extent) {
  int best = 0;
  double best_ratio = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double spread = items.size() >= kLargeRange ? sampled_spread(items, axis) : full_spread(items, axis);
    // The smallest normal number keeps 0 / 0 away: points have no size.
    const double ratio = spread / (extent[axis] + std::numeric_limits<double>::min());
    if (ratio > best_ratio) {
      best_ratio = ratio;
      best = axis;
    }
  }
  return best;
}

// Moves the items whose key is below `pivot` to the front; returns how many. Without branches: keys are random.
std::size_t partition(std::span<OrderItem> items, int axis, float pivot) {
  std::size_t below = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const OrderItem item = items[i];
    items[i] = items[below];
    items[below] = item;
    below += item.center[axis] < pivot;
  }
  return below;
}

// Reorders so that no key among the first `rank` items is above any among the others.
void select(std::span<OrderItem> items, std::size_t rank, int axis) {
  while (items.size() > kSelectRange) {
    std::array<float, kPivotSample> keys;
    const std::size_t sample = items.size() < 1024 ? kPivotSample / 4 : kPivotSample;
    for (std::size_t i = 0; i < sample; ++i) keys[i] = items[scattered(i, items.size())].center[axis];
    const auto end = keys.begin() + static_cast<std::ptrdiff_t>(sample);
    const std::size_t sample_rank = rank * sample / items.size();
    std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(sample_rank), end);
    const std::size_t below = partition(items, axis, keys[sample_rank]);
    if (below == rank) return;
    if (below == 0) break;  // many equal keys
    if (rank < below) {
      items = items.first(below);
    } else {
      items = items.subspan(below);
      rank -= below;
    }
  }
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(rank), items.end(),
                   [axis](const OrderItem& a, const OrderItem& b) { return a.center[axis] < b.center[axis]; });
}

// About half of `count` items, in whole runs of the largest 16^k * kLanes that is below `count`.
std::size_t front_size(std::size_t count) {
  std::size_t run = kLanes;
  while (run * kLanes < count) run *= kLanes;
  const std::size_t runs = (count + run - 1) / run;
  return runs / 2 * run;
}

// Cuts a range in two; the front one ends at the returned position.
std::size_t cut(std::span<OrderItem> items, std::span<const Box> boxes, Range& range) {
  const std::size_t count = range.end - range.begin;
  const auto part = items.subspan(range.begin, count);
  if (count >= kLargeRange) range.extent = sampled_extent(part, boxes);
  const std::size_t front = front_size(count);
  select(part, front, cut_axis(part, range.extent));
  return range.begin + front;
}

void order_range(std::span<OrderItem> items, std::span<const Box> boxes, Range range) {
  if (range.end - range.begin <= kLanes) return;
  const std::size_t middle = cut(items, boxes, range);
  order_range(items, boxes, {range.begin, middle, range.extent});
  order_range(items, boxes, {middle, range.end, range.extent});
}

}  // namespace

OrderItem order_item(const Box& box, std::uint32_t index, const Frame& frame) {
  OrderItem item;
  for (int axis = 0; axis < 3; ++axis) {
    item.center[axis] =
        0.5f * to_float(box.lower[axis], frame.origin[axis]) + 0.5f * to_float(box.upper[axis], frame.origin[axis]);
  }
  item.index = index;
  return item;
}

void order_spatially(std::span<OrderItem> items, std::span<const Box> boxes, int threads) {
  if (items.size() <= kLanes) return;
  const Range all{0, items.size(), sampled_extent(items, boxes)};
  if (threads <= 1 || items.size() < 2 * kLargeRange) {
    order_range(items, boxes, all);
    return;
  }
  // Every round cuts all ranges in two, side by side.
  std::array<Range, kParallelRanges> ranges;
  ranges[0] = all;
  std::size_t count = 1;
  while (2 * count <= kParallelRanges && items.size() / count >= kLargeRange) {
    const std::array<Range, kParallelRanges> whole = ranges;
    base::parallel_for(count, 1, threads, [&](std::size_t i) {
      Range range = whole[i];
      const std::size_t middle = range.end - range.begin > kLanes ? cut(items, boxes, range) : range.end;
      ranges[2 * i] = {range.begin, middle, range.extent};
      ranges[2 * i + 1] = {middle, range.end, range.extent};
    });
    count *= 2;
  }
  base::parallel_for(count, 1, threads, [&](std::size_t i) { order_range(items, boxes, ranges[i]); });
}

}  // namespace tact::broadphase
