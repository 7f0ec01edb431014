#include "narrowphase/crossing/edge_through.h"

#include <algorithm>

#include "narrowphase/mesh/cluster_search.h"
#include "narrowphase/pairs/box_reach.h"

namespace tact::narrowphase {

namespace {

// Flags of a vertex that lies below or above the part of an edge, beside those for the sides of a box.
constexpr unsigned kBelow = 1u << 6, kAbove = 1u << 7;

// Where angles have such a sine at least, and the facet is at most so many times as long as the edge, the place in
// which the edge meets the facet's plane is wrong by some 2^-50 of the facet's size times the square of the inverse of
// the sine, which is 2^-17 of the edge.
constexpr double kSine = 0x1p-10, kLongest = 0x1p13;

}  // namespace

void EdgeThrough::add_hit(const Triangle& facet) {
  if (is_whole_) return;
  const Vec3 p = facet[1] - facet[0], q = facet[2] - facet[0], normal = cross(p, q);
  const double square = norm_squared(normal), slope = dot(normal, along_);
  const double p_squared = norm_squared(p), q_squared = norm_squared(q);
  is_whole_ =
      !(square > kSine * kSine * p_squared * q_squared && slope * slope > kSine * kSine * square * length_squared_ &&
        std::max(p_squared, q_squared) < kLongest * kLongest * length_squared_);
  const double place = dot(normal, facet[0] - from_) / slope;
  first_ = is_whole_ ? 0.0 : std::min(first_, place);
  last_ = is_whole_ ? 1.0 : std::max(last_, place);
}

bool EdgeThrough::reaches(const Box& box) const {
  double low = 0.0, high = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double x = along_[axis] * (box.lower[axis] - from_[axis]), y = along_[axis] * (box.upper[axis] - from_[axis]);
    low += std::min(x, y);
    high += std::max(x, y);
  }
  return low <= highest() && high >= lowest();
}

std::span<const int> EdgesBeside::find(const EdgeThrough& through, const ScaledMesh& surface, double within) {
  edges_.clear();
  const Box wide = grown(through.box(), within);
  const Box near = grown(wide, 0x1p-40 * within + 0x1p-50 * largest_coordinate(wide));
  const double back = 1.0 / surface.scale;
  for_each_cluster_in(surface.mesh, {back * near.lower, back * near.upper}, [&](int cluster) {
    const Box box = surface.mesh.cluster_boxes()[cluster];
    if (through.reaches({surface.scale * box.lower, surface.scale * box.upper}))
      append_from(cluster, through, surface, bounds_of(near));
  });
  return edges_;
}

void EdgesBeside::append_from(int cluster, const EdgeThrough& through, const ScaledMesh& surface,
                              const BoxBounds& near) {
  points_.count = 0;
  kernels().place_points(surface.mesh.facets_of(cluster), surface.scale, near, &points_);
  const double lowest = through.lowest(), highest = through.highest();
  for (int i = 0; i < points_.count; ++i) {
    const double height = through.height(points_.at[0][i], points_.at[1][i], points_.at[2][i]);
    const unsigned flags = (height < lowest ? kBelow : 0u) | (height > highest ? kAbove : 0u);
    points_.outside[i] = static_cast<std::uint8_t>(points_.outside[i] | flags);
  }
  const int first = surface.features.edge_begin(cluster), count = surface.features.edge_end(cluster) - first;
  const auto corners = surface.features.edge_corners(first);
  for (int i = 0; i < count; ++i) {
    if ((points_.outside[corners[0][i]] & points_.outside[corners[1][i]]) == 0) edges_.push_back(first + i);
  }
}

}  // namespace tact::narrowphase
