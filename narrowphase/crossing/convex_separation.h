// The direction along which two convex bodies are parted whose vertices came out and in again.
//
// Convex bodies need no more than one, however they cross; a body that is not convex may grip another one from two
// sides, and has two. There is one if no more than a third of the vertices and edges that had negative gaps are past
// the other surface still, and other vertices are: the mean of the normals that had negative gaps, where these agree;
// or else the direction of the contact, which is carried from step to step.
#pragma once

#include <optional>

#include "narrowphase/crossing/crossing.h"

namespace tact::narrowphase {

class ConvexSeparation {
 public:
  /// Of two closed meshes, which stay as long as this is used.
  void find(const Crossing& crossing);
  /// None: nothing is led.
  void clear() { *this = {}; }
  /// Whether points of the last step led to and fro: their normals did not agree, and one of them was more than 60
  /// degrees from the direction of the contact. Then all vertices are led along that.
  bool leads_all() const { return leads_all_; }
  /// Whether a normal from a to b is against the direction; then a vertex that came in is led along that, too.
  bool is_against(Vec3 normal) { return dot(normal, direction_) < 0.0 && are_convex(); }
  /// From a to b, unit, for vertices that are led.
  Vec3 direction() const { return direction_; }

 private:
  bool are_convex();

  const Crossing* crossing_ = nullptr;
  Vec3 direction_;
  bool leads_all_ = false;
  std::optional<bool> are_convex_;  // found once, where it is needed
};

}  // namespace tact::narrowphase
