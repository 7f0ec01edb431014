// The vertices of a rigid mesh, placed cluster by cluster with the box of each.
#pragma once

#include "narrowphase/kernels/boxes.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

struct PlaceLoop {
  explicit PlaceLoop(const PlaceInput& input) : in(input), to{input.x, input.y, input.z} {
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 3; ++k) rotation[axis][k] = spread(in.rotation[axis][k]);
      translation[axis] = spread(in.translation[axis]);
    }
  }

  const PlaceInput& in;
  double* to[3];
  Pack rotation[3][3], translation[3];

  // See Pose.
  void place(int i, Pack (&placed)[3]) const {
    const Pack x = load(in.rest.x + i), y = load(in.rest.y + i), z = load(in.rest.z + i);
    for (int axis = 0; axis < 3; ++axis) {
      const Pack turned = add(add(mul(rotation[axis][0], x), mul(rotation[axis][1], y)), mul(rotation[axis][2], z));
      placed[axis] = add(turned, translation[axis]);
    }
  }

  // The vertices that the cluster owns. What a pack has beyond the last is not written: another cluster owns it.
  LaneBoxes place_owned(int begin, int end) const {
    LaneBoxes box;
    Pack placed[3];
    int i = begin;
    for (; i + kWidth <= end; i += kWidth) {
      place(i, placed);
      for (int axis = 0; axis < 3; ++axis) store(to[axis] + i, placed[axis]);
      box.widen(placed, mask_of(kAllLanes));
    }
    if (i == end) return box;
    place(i, placed);
    box.widen(placed, mask_of(lanes_left(end - i)));
    for (int axis = 0; axis < 3; ++axis) {
      double few[kWidth];
      store(few, placed[axis]);
      for (int k = 0; i + k < end; ++k) to[axis][i + k] = few[k];
    }
    return box;
  }

  // Those that it borrows are placed: earlier clusters own them.
  void borrow(int begin, int end, BoxBounds& box) const {
    for (int k = begin; k < end; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        const double at = to[axis][in.borrowed[k]];
        box.lower[axis] = at < box.lower[axis] ? at : box.lower[axis];
        box.upper[axis] = at > box.upper[axis] ? at : box.upper[axis];
      }
    }
  }
};

BoxBounds place_clusters(const PlaceInput& in) {
  const PlaceLoop loop(in);
  constexpr double kInfinity = __builtin_inf();
  BoxBounds all{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (int c = 0; c < in.cluster_count; ++c) {
    const std::int32_t* range = in.ranges + 2 * c;
    BoxBounds box = loop.place_owned(range[0], range[2]).all();
    loop.borrow(range[1], range[3], box);
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t stride = in.cluster_count;
      // Adding zero turns -0 into +0, as a refit does.
      const double lower = in.boxes[axis * stride + c] = box.lower[axis] + 0.0;
      const double upper = in.boxes[(axis + 3) * stride + c] = box.upper[axis] + 0.0;
      all.lower[axis] = lower < all.lower[axis] ? lower : all.lower[axis];
      all.upper[axis] = upper > all.upper[axis] ? upper : all.upper[axis];
    }
  }
  return all;
}

}  // namespace
}  // namespace tact::narrowphase
