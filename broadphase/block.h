// Sixteen boxes side by side: what the hierarchy is made of, on every level, and what one SIMD loop compares.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/base/box.h"

namespace tact::broadphase {

using base::Box;

inline constexpr std::uint32_t kLanes = 16;
inline constexpr std::uint32_t kAllLanes = 0xffffu;  // one bit a lane

// A lane without a box has lower = +infinity and upper = -infinity on every axis, and so overlaps nothing.
struct alignas(64) Block {
  double lower[3][kLanes];
  double upper[3][kLanes];
  double bounds_lower[3];  // the box of all lanes
  double bounds_upper[3];
};

inline void set_lane(Block& block, std::uint32_t lane, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    block.lower[axis][lane] = box.lower[axis];
    block.upper[axis][lane] = box.upper[axis];
  }
}

inline Box lane_box(const Block& block, std::uint32_t lane) {
  return {{block.lower[0][lane], block.lower[1][lane], block.lower[2][lane]},
          {block.upper[0][lane], block.upper[1][lane], block.upper[2][lane]}};
}

inline Box bounds_box(const Block& block) {
  return {{block.bounds_lower[0], block.bounds_lower[1], block.bounds_lower[2]},
          {block.bounds_upper[0], block.bounds_upper[1], block.bounds_upper[2]}};
}

// Sets `bounds_lower` and `bounds_upper` from the lanes.
inline void refresh_bounds(Block& block) {
  for (int axis = 0; axis < 3; ++axis) {
    double lower = block.lower[axis][0];
    double upper = block.upper[axis][0];
    for (std::uint32_t lane = 1; lane < kLanes; ++lane) {
      lower = block.lower[axis][lane] < lower ? block.lower[axis][lane] : lower;
      upper = upper < block.upper[axis][lane] ? block.upper[axis][lane] : upper;
    }
    block.bounds_lower[axis] = lower;
    block.bounds_upper[axis] = upper;
  }
}

inline void clear_lanes(Block& block) {
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) set_lane(block, lane, Box{});
  refresh_bounds(block);
}

}  // namespace tact::broadphase
