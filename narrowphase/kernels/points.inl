// The loops over points.
#pragma once

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

struct HeightPack {
  Pack nx, ny, nz, ox, oy, oz;
  explicit HeightPack(const HeightAxis& axis)
      : nx(spread(axis.nx)),
        ny(spread(axis.ny)),
        nz(spread(axis.nz)),
        ox(spread(axis.ox)),
        oy(spread(axis.oy)),
        oz(spread(axis.oz)) {}
  Pack operator()(PointArrays points, int i) const {
    const Pack x = mul(nx, sub(load(points.x + i), ox));
    const Pack y = mul(ny, sub(load(points.y + i), oy));
    const Pack z = mul(nz, sub(load(points.z + i), oz));
    return add(add(x, y), z);
  }
};

// Calls work(i, heights) for the packs of points in some ranges. Lanes beyond the end of a range are lower than any
// point.
template <class Work>
inline void for_heights(PointArrays points, const IndexRange* ranges, int range_count, const HeightPack& height,
                        const Work& work) {
  for (const IndexRange* range = ranges; range != ranges + range_count; ++range) {
    for (int i = range->begin; i < range->end; i += kWidth) {
      Pack h = height(points, i);
      if (range->end - i < kWidth) h = select(mask_of(lanes_left(range->end - i)), h, spread(-__builtin_inf()));
      work(i, h);
    }
  }
}

// Each lane keeps the first and the last of its highest points. Where these differ, all points are looked at again.
// Tried: a loop that skips packs below `least`. It is faster where the same few packs reach it in every step, and
// slower in piles.
HighestPoint highest_point(PointArrays points, const std::int32_t* number, const IndexRange* ranges, int range_count,
                           const HeightAxis& axis, double least) {
  const HeightPack height(axis);
  Pack high = spread(-__builtin_inf()), first = spread(0.0), last = first;
  for_heights(points, ranges, range_count, height, [&](int i, Pack h) {
    const Pack here = spread(static_cast<double>(i));
    first = select(less(high, h), here, first);
    last = select(less_equal(high, h), here, last);
    high = max(high, h);
  });
  HighestPoint top{largest_lane(high), -1};
  if (!(top.height > -__builtin_inf() && top.height >= least)) return {-__builtin_inf(), -1};
  const Pack highest = spread(top.height);
  const auto precedes = [&](std::int32_t i, std::int32_t j) { return number ? number[i] < number[j] : i < j; };
  const auto take = [&](int begin, unsigned lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::int32_t i = begin + __builtin_ctz(lanes);
      if (top.index < 0 || precedes(i, top.index)) top.index = i;
    }
  };
  const Mask as_high = less_equal(highest, high);
  if (bits(both(as_high, not_equal(first, last))) != 0) {
    for_heights(points, ranges, range_count, height, [&](int i, Pack h) { take(i, bits(less_equal(highest, h))); });
  } else {
    alignas(64) double first_of[kWidth];
    store(first_of, first);
    for (unsigned left = bits(as_high); left != 0; left &= left - 1)
      take(static_cast<int>(first_of[__builtin_ctz(left)]), left & -left);
  }
  top.height += 0.0;  // one zero: which of the two comes first depends on the order
  return top;
}

int select_heights(PointArrays points, int count, const HeightAxis& axis, double threshold, std::int32_t* indices) {
  const HeightPack height(axis);
  const Pack least = spread(threshold);
  int found = 0;
  for (int i = 0; i < count; i += kWidth) {
    found = append(bits(less_equal(least, height(points, i))) & lanes_left(count - i), i, indices, found);
  }
  return found;
}

Kdop kdop(PointArrays points, int count) {
  Pack lower[kDiagonals], upper[kDiagonals];
  for (int k = 0; k < kDiagonals; ++k) {
    lower[k] = spread(__builtin_inf());
    upper[k] = spread(-__builtin_inf());
  }
  for (int i = 0; i < count; i += kWidth) {
    Pack x = load(points.x + i), y = load(points.y + i), z = load(points.z + i);
    if (count - i < kWidth) {
      const Mask points_left = mask_of(lanes_left(count - i));
      x = select(points_left, x, spread(points.x[0]));
      y = select(points_left, y, spread(points.y[0]));
      z = select(points_left, z, spread(points.z[0]));
    }
    const Pack reach[kDiagonals] = {add(y, z), add(z, x), add(x, y), sub(y, z), sub(z, x), sub(x, y)};
    for (int k = 0; k < kDiagonals; ++k) {
      lower[k] = min(lower[k], reach[k]);
      upper[k] = max(upper[k], reach[k]);
    }
  }
  Kdop all;
  for (int k = 0; k < kDiagonals; ++k) {
    // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
    all.lower[k] = -largest_lane(sub(spread(0.0), lower[k])) + 0.0;
    all.upper[k] = largest_lane(upper[k]) + 0.0;
  }
  return all;
}

}  // namespace
}  // namespace tact::narrowphase
