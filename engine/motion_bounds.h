// How far along its way each vertex may go, so that all may at once and nothing meets.
//
// Features that stop within a step keep their vertices: each goes at most 0.45 of the distance that the features have
// when it begins, so that they cannot meet any more, however the others go. What such a vertex meets then, or what
// meets it, is found by another search, until nothing is: the last one is the proof. Each search lowers a bound of a
// vertex that had another one from this pair of features before, so there is a last one. Vertices near which nothing
// comes keep the whole way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "narrowphase/motion/impacts.h"

namespace tact {

class MotionBounds {
 public:
  /// Forgets all bounds.
  void begin(std::size_t slots);
  /// A body on its way as far as its vertices may go, as of the last place().
  narrowphase::MovingMesh moving(const Bodies& bodies, std::uint32_t slot) const;
  /// Whether a vertex of a body has a bound below 1.
  bool is_bounded(std::uint32_t slot) const { return slot < ends_.size() && ends_[slot].is_bounded; }
  /// Whether place() changed where a body goes, or one of its clusters.
  bool changed(std::uint32_t slot) const { return slot < ends_.size() && ends_[slot].changed; }
  bool changed(std::uint32_t slot, int cluster) const { return changed(slot) && ends_[slot].of_cluster[cluster] != 0; }

  /// Lowers the bounds of the vertices that an impact of two bodies stops. Returns whether it lowered any.
  bool lower(const Bodies& bodies, std::uint32_t a, std::uint32_t b, const narrowphase::FeatureImpact& impact);
  /// Places what was lowered since the last call.
  void place(const Bodies& bodies);
  /// Of each vertex of a body, in the caller's numbers.
  void copy(const Bodies& bodies, std::uint32_t slot, std::vector<double>& bounds) const;

 private:
  // Of a body with a bound below 1.
  struct End {
    bool is_bounded = false, lowered = false, changed = false;
    std::vector<double> bound;                // of each vertex of the mesh
    std::vector<double> placement;            // as far as they go
    std::vector<char> of_vertex, of_cluster;  // whether it was lowered
  };

  bool lower(const Bodies& bodies, std::uint32_t slot, std::span<const int> vertices, double distance);
  void place_boxes(const narrowphase::ClusteredMesh& mesh, End& end) const;

  std::vector<End> ends_;  // an entry a slot
  narrowphase::MeetingSearch search_;
};

}  // namespace tact
