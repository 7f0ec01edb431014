// The loops over features that move: which come near a box, and the boxes of their ways.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/bytes.inl"
#include "narrowphase/kernels/features.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

void flag_ways(const VertexWays& vertices, const BoxBounds& box, std::uint8_t* outside) {
  const double* const lower[3] = {vertices.lower[0], vertices.lower[1], vertices.lower[2]};
  const double* const upper[3] = {vertices.upper[0], vertices.upper[1], vertices.upper[2]};
  flag_outside(lower, upper, vertices.count, box, outside);
}

void append_near_ways(const VertexWays& vertices, const std::uint8_t* outside, const FeatureCorners& in, int first,
                      FeatureWays* near) {
  if (in.count == 0) return;
  const std::uint64_t left = left_of(in, outside, vertices.count);
  if (left == 0) return;
  const int begin = near->count, end = begin + __builtin_popcountll(left);
  write_places(left, near->feature + begin);
  for (int n = begin; first != 0 && n < end; ++n)
    near->feature[n] = static_cast<std::uint8_t>(near->feature[n] + first);
  for (int k = 0; k < in.corners; ++k) {
    compress(left, in.corner[k], near->corner[k] + begin);
    for (int n = end; n < end + kWidth; ++n) near->corner[k][n] = 0;
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int n = begin; n < end; n += kWidth) {
      Pack low = gather(vertices.lower[axis], near->corner[0] + n),
           high = gather(vertices.upper[axis], near->corner[0] + n);
      for (int k = 1; k < in.corners; ++k) {
        low = min(low, gather(vertices.lower[axis], near->corner[k] + n));
        high = max(high, gather(vertices.upper[axis], near->corner[k] + n));
      }
      store(near->lower[axis] + n, low);
      store(near->upper[axis] + n, high);
    }
  }
  near->count = end;
}

}  // namespace
}  // namespace tact::narrowphase
