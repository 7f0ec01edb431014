// Stages 3 to 6 of a body and a plane: the plane's normal is the direction, and how far the body reaches down is the
// depth.
#pragma once

#include <tact/settings.h>

#include <vector>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_counts.h"
#include "engine/pair/pair_record.h"

namespace tact {

/// A body and a plane that it may touch.
struct BodyAndPlane {
  const Body* body = nullptr;
  const narrowphase::HalfSpace* plane = nullptr;  ///< null: neither of the two is a plane
  bool plane_is_a = false;

  explicit operator bool() const { return plane != nullptr; }
  std::uint32_t slot_of_plane(std::uint32_t a, std::uint32_t b) const { return plane_is_a ? a : b; }
  /// Unit, from a to b.
  base::Vec3 direction() const { return plane_is_a ? plane->normal : -plane->normal; }
};
BodyAndPlane find_body_and_plane(const Bodies& bodies, std::uint32_t a, std::uint32_t b);
inline BodyAndPlane body_and_plane(const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  return bodies.planes().empty() ? BodyAndPlane{} : find_body_and_plane(bodies, a, b);
}

/// Fills the record: whether they are in contact, its contact, the facets that share a point with the plane, and
/// whether all of the body is below it. `chosen` is memory.
void look_at_plane(const BodyAndPlane& pair, double reach, const Settings& settings, PairRecord& record,
                   std::vector<std::int32_t>& chosen, PairCounts& counts);

/// The vertices that are nearer to the plane than `reach`, on it, or below it: by the mesh's numbers, ascending in
/// blocks of clusters. Where doubles cannot tell, also others.
void find_near_vertices(const BodyAndPlane& pair, double reach, std::vector<std::int32_t>& found);

}  // namespace tact
