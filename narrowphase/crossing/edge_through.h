// An edge through a closed mesh, both ends outside, and the edges of that mesh that may be nearest to its part inside.
#pragma once

#include <span>
#include <vector>

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

/// The part of an edge between the first and the last facet that it meets: beyond them it is outside. Nothing that lies
/// beside the ends of that part is nearest to its inside.
class EdgeThrough {
 public:
  explicit EdgeThrough(const EdgeEnds& ends)
      : from_(ends.p), to_(ends.q), along_(ends.q - ends.p), length_squared_(norm_squared(along_)) {}
  /// Takes a facet that the edge meets, in the same unit; all are to be given. The part is the whole edge where
  /// rounding may move the place in which one is met.
  void add_hit(const Triangle& facet);

  /// A box of the edge.
  Box box() const { return extended(Box{from_, from_}, to_); }
  /// Whether a box reaches between the ends of that part, and a thousandth of the edge more for rounding.
  bool reaches(const Box& box) const;
  /// How far along the edge a point is, times the edge's length, and between which such values that part lies.
  double height(double x, double y, double z) const {
    return along_.x * (x - from_.x) + along_.y * (y - from_.y) + along_.z * (z - from_.z);
  }
  double lowest() const { return (first_ - kMore) * length_squared_; }
  double highest() const { return (last_ + kMore) * length_squared_; }

 private:
  static constexpr double kMore = 0x1p-10;

  Vec3 from_, to_, along_;
  double length_squared_;
  bool is_whole_ = false;  // first_ and last_ are then 0 and 1
  double first_ = 1.0, last_ = 0.0;
};

/// Buffers are reused.
class EdgesBeside {
 public:
  /// The edges of `surface` that do not lie beside the ends of the part of `through`, and are at most `within` away
  /// from the whole of it along every axis, and a few more. Valid until the next call.
  std::span<const int> find(const EdgeThrough& through, const ScaledMesh& surface, double within);

 private:
  void append_from(int cluster, const EdgeThrough& through, const ScaledMesh& surface, const BoxBounds& near);

  ClusterPoints points_;
  std::vector<int> edges_;
};

}  // namespace tact::narrowphase
