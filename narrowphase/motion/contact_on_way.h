// Whether two features of one mesh on its way are in contact where they come within a reach of each other.
//
// Self-contact leaves out what is near only as the surface goes on: places from which it leads nearer (nearest.h), and
// places that are near along it (contact_points.h). Where a flat sheet shrinks in its plane that is all that comes
// within a reach. Such features are no contact; they meet only where they share a point.
#pragma once

#include "narrowphase/distance/surface_distance.h"
#include "narrowphase/motion/moving_mesh.h"

namespace tact::narrowphase {

/// One for each thread; its memory is reused. Lengths are times `scale`, as `reach` is.
class ContactOnWay {
 public:
  /// A vertex and a facet at a time between 0 and 1.
  bool of_vertex(const MovingMesh& mesh, double scale, double time, double reach, int vertex, int facet);
  /// Two edges.
  bool of_edges(const MovingMesh& mesh, double scale, double time, double reach, int edge, int other);

 private:
  SurfaceWays ways_;
};

}  // namespace tact::narrowphase
