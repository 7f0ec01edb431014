// The way apart of two surfaces that cross, from the facets that meet and the vertices past the other surface alone: of
// plates through each other, say, whose vertices are all outside the other one.
//
// The way is the least translation that parts the hulls of these: the face of their Minkowski difference that is
// nearest to the origin (van den Bergen, 2001). These hulls know what has crossed, and nothing of the rest of the
// bodies. Where the last step tells from where they came, the way is the local minimum that is reached from there, as
// the contact direction is. Where the moved facets would meet others that are connected to them, those join, and the
// way is sought again. If that does not end, or is longer than the bodies' way, it is theirs.
//
// Its points are where the surfaces touch last on that way.
#pragma once

#include <vector>

#include "narrowphase/contact_points/feature_point.h"
#include "narrowphase/crossing/hull_points.h"
#include "narrowphase/crossing/last_touch.h"
#include "narrowphase/crossing/surface_part.h"
#include "narrowphase/depth/smallest_separation.h"
#include "narrowphase/direction/contact_direction.h"

namespace tact::narrowphase {

/// Bodies that are no deeper in each other are moved along their contact direction: no other is much shorter. Lengths
/// are near 1, so these are some micrometres of a metre.
inline constexpr double kHardlyDeep = 0x1p-18;

/// Parts of two surfaces whose facets meet.
struct WayApartInput {
  const ScaledMesh &a, &b;
  const PartOfSurface &part_a, &part_b;
  Vec3 came;           // from a to b, unit, as the last step tells; zero: it does not
  Vec3 direction;      // of the bodies' contact, unit, from a to b
  double depth = 0.0;  // of the bodies along it, scaled
};

/// Buffers are reused.
class WayApart {
 public:
  /// A unit vector from a to b.
  Vec3 direction(const WayApartInput& input) { return find(input).direction; }
  /// Appends at least one point.
  void append_points(const WayApartInput& input, std::vector<FeaturePoint>& found);

 private:
  struct Way {
    Vec3 direction;
    double length = 0.0;  // scaled
  };
  Way find(const WayApartInput& input);
  Way part_hulls(Vec3 came, Vec3 preferred);

  SurfacePart a_, b_;
  HullPoints hull_a_, hull_b_;
  LastTouch last_touch_;
  SmallestMemory smallest_;
  FaceFinder faces_;
};

}  // namespace tact::narrowphase
