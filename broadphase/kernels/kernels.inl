// All loops of kernels.h for one instruction set, and the table of them: included by one source file an instruction
// set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "broadphase/kernels/kernels.h"
#include "broadphase/kernels/vectors.h"

namespace tact::broadphase {
namespace {

struct LaneOverlap {
  std::uint32_t closed;    // lanes that overlap, or touch
  std::uint32_t interior;  // lanes that overlap by more than touching
};

// The lanes of `block` that overlap the box from lower[0], lower[kStride], lower[2 kStride] to upper[...].
template <int kStride>
LaneOverlap overlapping_lanes(const Block& block, const float* lower, const float* upper) {
  LaneOverlap found{0, 0};
  for (std::uint32_t first = 0; first < kLanes; first += kFloats) {
    // How far the boxes reach into each other along the axis where that is least; the sign of a difference is exact.
    Floats depth[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Floats below = upper[axis * kStride] - base::load_as<Floats>(&block.lower[axis][first]);
      const Floats above = base::load_as<Floats>(&block.upper[axis][first]) - lower[axis * kStride];
      depth[axis] = below < above ? below : above;
    }
    Floats least = depth[0] < depth[1] ? depth[0] : depth[1];
    least = least < depth[2] ? least : depth[2];
    found.closed |= bits_of(least >= 0.0f) << first;
    found.interior |= bits_of(least > 0.0f) << first;
  }
  return found;
}

std::uint32_t find_lanes(const Block& block, const FloatBox& box) {
  return overlapping_lanes<1>(block, box.lower, box.upper).closed;
}

void find_rows(const Block* blocks, const IndexPair* pairs, std::size_t count, std::uint16_t* rows) {
  for (std::size_t i = 0; i < count; ++i) {
    const FloatBox& bounds = blocks[pairs[i].b].bounds;
    rows[i] = static_cast<std::uint16_t>(overlapping_lanes<1>(blocks[pairs[i].a], bounds.lower, bounds.upper).closed);
  }
}

Overlaps find_overlaps(const BlockSide& a, const BlockSide& b, std::uint32_t rows, IndexPair* pairs) {
  const bool same = a.block == b.block;
  // First all comparisons, then all pairs: one loop of unknown length less for the branch prediction.
  std::uint8_t row_of[kLanes + 1];
  std::uint16_t lanes_of[kLanes + 1];
  std::size_t row_count = 0;
  std::uint32_t doubtful = 0;
  for (; rows != 0; rows &= rows - 1) {
    const auto row = static_cast<std::uint32_t>(__builtin_ctz(rows));
    const LaneOverlap found = overlapping_lanes<kLanes>(*b.block, &a.block->lower[0][row], &a.block->upper[0][row]);
    std::uint32_t lanes = found.closed & (a.active >> row & 1u ? kAllLanes : b.active);
    lanes &= same ? ~((2u << row) - 1) : kAllLanes;
    doubtful |= lanes & ~found.interior;
    row_of[row_count] = static_cast<std::uint8_t>(row);
    lanes_of[row_count] = static_cast<std::uint16_t>(lanes);
    row_count += lanes != 0;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < row_count; ++i) {
    const std::uint32_t name = a.names[row_of[i]];
    for (std::uint32_t lanes = lanes_of[i]; lanes != 0; lanes &= lanes - 1) {
      const std::uint32_t other = b.names[__builtin_ctz(lanes)];
      pairs[count].a = name < other ? name : other;
      pairs[count].b = name < other ? other : name;
      ++count;
    }
  }
  return {count, doubtful == 0};
}

// The least number of an array whose length is a power of two.
float least_of(const float* numbers) {
  Floats least = base::load_as<Floats>(numbers);
  for (std::uint32_t first = kFloats; first < kLanes; first += kFloats) {
    const Floats next = base::load_as<Floats>(numbers + first);
    least = next < least ? next : least;
  }
  float rest[kFloats];
  base::store_as(rest, least);
  for (std::uint32_t half = kFloats / 2; half > 0; half /= 2) {
    for (std::uint32_t i = 0; i < half; ++i) rest[i] = rest[i] < rest[i + half] ? rest[i] : rest[i + half];
  }
  return rest[0];
}

float largest_of(const float* numbers) {
  float opposite[kLanes];
  for (std::uint32_t first = 0; first < kLanes; first += kFloats)
    base::store_as(opposite + first, -base::load_as<Floats>(numbers + first));
  return -least_of(opposite);
}

void refit_bounds(Block& block) {
  for (int axis = 0; axis < 3; ++axis) {
    block.bounds.lower[axis] = least_of(block.lower[axis]);
    block.bounds.upper[axis] = largest_of(block.upper[axis]);
  }
}

// to_float of block.h, in as many lanes as doubles fit; `exact` is cleared where is_exact does not hold. These
// functions themselves may not be shared among files that are compiled for different machines.
HalfFloats convert(Doubles values, double origin, DoubleMask& exact) {
  Doubles offsets = values - origin;
  offsets = offsets < -kLargestFloat ? Doubles{} - kLargestFloat : offsets;
  offsets = offsets > kLargestFloat ? Doubles{} + kLargestFloat : offsets;
  const HalfFloats floats = __builtin_convertvector(offsets, HalfFloats);
  exact &= __builtin_convertvector(floats, Doubles) + origin == values;
  return floats;
}

// The boxes of sixteen lanes, not yet in their block.
struct Loaded {
  alignas(64) float lower[3][kLanes];
  alignas(64) float upper[3][kLanes];
  std::uint32_t ordered;  // lanes of boxes that are not empty
  std::uint32_t exact;
};

void load_boxes(const double* boxes, const std::uint32_t* members, std::uint32_t lanes, const Frame& frame,
                Loaded& loaded) {
  alignas(64) double lower[3][kLanes];
  alignas(64) double upper[3][kLanes];
  const std::uint32_t any_member = members[__builtin_ctz(lanes)];
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const double* box = boxes + std::size_t{6} * (lanes >> lane & 1u ? members[lane] : any_member);
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis][lane] = box[axis];
      upper[axis][lane] = box[3 + axis];
    }
  }
  loaded.ordered = 0;
  loaded.exact = 0;
  for (std::uint32_t first = 0; first < kLanes; first += kDoubles) {
    DoubleMask ordered = DoubleMask{} - 1;
    DoubleMask exact = DoubleMask{} - 1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto low = base::load_as<Doubles>(&lower[axis][first]);
      const auto high = base::load_as<Doubles>(&upper[axis][first]);
      ordered &= low <= high;
      base::store_as(&loaded.lower[axis][first], convert(low, frame.origin[axis], exact));
      base::store_as(&loaded.upper[axis][first], convert(high, frame.origin[axis], exact));
    }
    loaded.ordered |= bits_of(ordered) << first;
    loaded.exact |= bits_of(exact) << first;
  }
}

std::uint32_t lanes_inside(const Loaded& loaded, const FloatBox& region) {
  std::uint32_t lanes = 0;
  for (std::uint32_t first = 0; first < kLanes; first += kFloats) {
    FloatMask inside = FloatMask{} - 1;
    for (int axis = 0; axis < 3; ++axis) {
      inside &= base::load_as<Floats>(&loaded.lower[axis][first]) >= region.lower[axis];
      inside &= base::load_as<Floats>(&loaded.upper[axis][first]) <= region.upper[axis];
    }
    lanes |= bits_of(inside) << first;
  }
  return lanes;
}

// In each of `lanes`, the new number if the lane is also one of `stays`, else `none`.
void replace(float* numbers, const float* fresh, float none, std::uint32_t lanes, std::uint32_t stays) {
  for (std::uint32_t first = 0; first < kLanes; first += kFloats) {
    const Floats kept = mask_of(stays >> first) ? base::load_as<Floats>(fresh + first) : Floats{} + none;
    base::store_as(numbers + first, mask_of(lanes >> first) ? kept : base::load_as<Floats>(numbers + first));
  }
}

std::uint32_t refit_lanes(Block& block, const double* boxes, const std::uint32_t* members, std::uint32_t lanes,
                          const Frame& frame, const FloatBox& region) {
  std::uint32_t stays = 0;
  if (lanes != 0) {
    Loaded loaded;
    load_boxes(boxes, members, lanes, frame, loaded);
    stays = loaded.ordered & lanes_inside(loaded, region);
    for (int axis = 0; axis < 3; ++axis) {
      replace(block.lower[axis], loaded.lower[axis], kInfinity, lanes, stays);
      replace(block.upper[axis], loaded.upper[axis], -kInfinity, lanes, stays);
    }
    block.exact_lanes = (block.exact_lanes & ~lanes) | (lanes & (loaded.exact | ~stays));
  }
  refit_bounds(block);
  return lanes & ~stays;
}

constexpr Kernels all_kernels(const char* name) {
  return {.name = name,
          .find_lanes = find_lanes,
          .find_rows = find_rows,
          .find_overlaps = find_overlaps,
          .refit_lanes = refit_lanes};
}

}  // namespace
}  // namespace tact::broadphase
