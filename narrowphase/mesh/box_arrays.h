// Boxes in separate arrays, one entry a cluster (or a facet), for loops that compare many at once.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/vec3.h"
#include "narrowphase/kernels/kernels.h"

namespace tact::narrowphase {

using base::Box;
using base::Vec3;

/// The most doubles, or as many bytes, that a SIMD loop reads past the end of an array: arrays are longer by so many.
inline constexpr int kPadding = 8;

/// A box as the kernels take it.
inline BoxBounds bounds_of(const Box& box) {
  return {{box.lower.x, box.lower.y, box.lower.z}, {box.upper.x, box.upper.y, box.upper.z}};
}
inline Box to_box(const BoxBounds& b) {
  return {{b.lower[0], b.lower[1], b.lower[2]}, {b.upper[0], b.upper[1], b.upper[2]}};
}

/// Boxes in memory of somebody else, in one block: lower x, y, z, upper x, y, z, each `stride` long.
class BoxView {
 public:
  BoxView() = default;
  BoxView(const double* bounds, std::size_t stride) : bounds_(bounds), stride_(stride) {}
  const double* lower(int axis) const { return bounds_ + static_cast<std::size_t>(axis) * stride_; }
  const double* upper(int axis) const { return lower(axis + 3); }
  BoxPointers pointers(int first = 0) const {
    return {{lower(0) + first, lower(1) + first, lower(2) + first},
            {upper(0) + first, upper(1) + first, upper(2) + first}};
  }
  Box operator[](std::size_t i) const {
    return {{lower(0)[i], lower(1)[i], lower(2)[i]}, {upper(0)[i], upper(1)[i], upper(2)[i]}};
  }

 private:
  const double* bounds_ = nullptr;
  std::size_t stride_ = 0;
};

/// Writes an entry of what a BoxView shows.
inline void set_box(double* bounds, std::size_t stride, std::size_t i, const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bounds[axis * stride + i] = box.lower[static_cast<int>(axis)];
    bounds[(axis + 3) * stride + i] = box.upper[static_cast<int>(axis)];
  }
}

/// Boxes with memory of their own.
class BoxArrays {
 public:
  /// The boxes are undefined afterwards.
  void resize(std::size_t count) {
    stride_ = count;
    if (bounds_.size() < 6 * count + kPadding) bounds_.resize(6 * count + kPadding);
  }
  void set(std::size_t i, const Box& box) { set_box(bounds_.data(), stride_, i, box); }
  BoxView view() const { return {bounds_.data(), stride_}; }
  BoxPointers pointers() const { return view().pointers(); }
  Box operator[](std::size_t i) const { return view()[i]; }
  BoxBounds bounds(std::size_t i) const {
    const BoxPointers p = pointers();
    return {{p.lower[0][i], p.lower[1][i], p.lower[2][i]}, {p.upper[0][i], p.upper[1][i], p.upper[2][i]}};
  }

 private:
  std::vector<double> bounds_;  // and kPadding more
  std::size_t stride_ = 0;
};

}  // namespace tact::narrowphase
