#include "broadphase/kernels/kernels.h"

namespace tact::broadphase {
namespace {

template <int kStride>
std::uint32_t lanes_overlapping(const Block& block, const double* lower, const double* upper) {
  std::uint32_t lanes = 0;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    bool overlaps = true;
    for (int axis = 0; axis < 3; ++axis) {
      overlaps &= block.lower[axis][lane] <= upper[axis * kStride];
      overlaps &= lower[axis * kStride] <= block.upper[axis][lane];
    }
    lanes |= static_cast<std::uint32_t>(overlaps) << lane;
  }
  return lanes;
}

#include "broadphase/kernels/overlap_columns.inl"

}  // namespace

OverlapKernel scalar_overlap_kernel() { return overlap_columns; }

}  // namespace tact::broadphase
