#include "narrowphase/crossing/convex.h"

namespace tact::narrowphase {

namespace {

// So high above a neighbour's plane a corner may seem to be by rounding. Lengths are near 1.
constexpr double kFlatEdge = 1e-12;

}  // namespace

bool is_convex(const ScaledMesh& surface) {
  const Features& features = surface.features;
  if (!features.is_closed() || features.one_of_each_part().size() != 1) return false;
  for (int facet = 0; facet < surface.mesh.facet_count(); ++facet) {
    const Corners& corners = features.corners(facet);
    const Vec3 normal = surface.unit_normal(facet), corner = surface.position(corners[0]);
    for (int k = 0; k < 3; ++k) {
      const int edge = features.facet_edge(facet, k);
      if (edge < 0 || features.opposite(edge).size() != 2) return false;
      for (const int v : features.opposite(edge)) {
        if (dot(normal, surface.position(v) - corner) > kFlatEdge) return false;
      }
    }
  }
  return true;
}

}  // namespace tact::narrowphase
