// The loops over boxes.
#pragma once

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"
#include "narrowphase/kernels/points.inl"

namespace tact::narrowphase {
namespace {

// The box of some lanes of boxes, or of points.
struct LaneBoxes {
  Pack lower[3], opposite_upper[3];

  LaneBoxes() {
    for (int axis = 0; axis < 3; ++axis) lower[axis] = opposite_upper[axis] = spread(__builtin_inf());
  }
  void widen(const BoxPointers& boxes, int i, Mask lanes) {
    const Pack infinite = spread(__builtin_inf()), zero = spread(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const Pack low = load(boxes.lower[axis] + i), opposite_high = sub(zero, load(boxes.upper[axis] + i));
      lower[axis] = min(lower[axis], select(lanes, low, infinite));
      opposite_upper[axis] = min(opposite_upper[axis], select(lanes, opposite_high, infinite));
    }
  }
  void widen(const Pack (&points)[3], Mask lanes) {
    const Pack infinite = spread(__builtin_inf()), zero = spread(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = min(lower[axis], select(lanes, points[axis], infinite));
      opposite_upper[axis] = min(opposite_upper[axis], select(lanes, sub(zero, points[axis]), infinite));
    }
  }
  BoxBounds all() const {
    BoxBounds box;
    for (int axis = 0; axis < 3; ++axis) {
      // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
      box.lower[axis] = -largest_lane(sub(spread(0.0), lower[axis])) + 0.0;
      box.upper[axis] = largest_lane(sub(spread(0.0), opposite_upper[axis])) + 0.0;
    }
    return box;
  }
};

BoxBounds bounds(const BoxPointers& boxes, int count) {
  LaneBoxes lanes;
  for (int i = 0; i < count; i += kWidth) lanes.widen(boxes, i, mask_of(lanes_left(count - i)));
  return lanes.all();
}

struct BoxPack {
  Pack lower[3], upper[3];
  explicit BoxPack(const BoxBounds& box) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = spread(box.lower[axis]);
      upper[axis] = spread(box.upper[axis]);
    }
  }
  Mask overlap(int axis, Pack low, Pack high) const {
    return both(less_equal(low, upper[axis]), less_equal(lower[axis], high));
  }
  unsigned overlap(const BoxPointers& boxes, int i) const {
    const auto along = [&](int axis) {
      return overlap(axis, load(boxes.lower[axis] + i), load(boxes.upper[axis] + i));
    };
    return bits(both(both(along(0), along(1)), along(2)));
  }
  unsigned overlap_swept(const BoxPointers& begin, const BoxPointers& end, int i) const {
    const auto along = [&](int axis) {
      return overlap(axis, min(load(begin.lower[axis] + i), load(end.lower[axis] + i)),
                     max(load(begin.upper[axis] + i), load(end.upper[axis] + i)));
    };
    return bits(both(both(along(0), along(1)), along(2)));
  }
};

int select_overlapping(const BoxPointers& boxes, int count, const BoxBounds& box, std::int32_t* indices) {
  const BoxPack pack(box);
  int found = 0;
  for (int i = 0; i < count; i += kWidth) {
    found = append(pack.overlap(boxes, i) & lanes_left(count - i), i, indices, found);
  }
  return found;
}

int select_swept(const BoxPointers& begin, const BoxPointers& end, int count, const BoxBounds& box,
                 std::int32_t* indices) {
  const BoxPack pack(box);
  int found = 0;
  for (int i = 0; i < count; i += kWidth)
    found = append(pack.overlap_swept(begin, end, i) & lanes_left(count - i), i, indices, found);
  return found;
}

Culled cull_boxes(const BoxPointers& boxes, int count, const CullPlanes& planes, std::int32_t* indices) {
  const BoxPack box(planes.box);
  const HeightPack height(planes.axis);
  const Pack lowest = spread(planes.lowest);
  const auto far_corner = [&](double n, int axis) { return n >= 0.0 ? boxes.upper[axis] : boxes.lower[axis]; };
  const PointArrays far_corners{far_corner(planes.axis.nx, 0), far_corner(planes.axis.ny, 1),
                                far_corner(planes.axis.nz, 2)};
  Culled culled{0, 0};
  for (int i = 0; i < count; i += kWidth) {
    const unsigned meeting = box.overlap(boxes, i) & lanes_left(count - i);
    const unsigned low = meeting & bits(less(height(far_corners, i), lowest));
    culled.left = append(meeting & ~low, i, indices, culled.left);
    culled.low += __builtin_popcount(low);
  }
  return culled;
}

}  // namespace
}  // namespace tact::narrowphase
