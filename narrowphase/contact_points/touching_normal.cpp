#include "narrowphase/contact_points/touching_normal.h"

#include <algorithm>
#include <cmath>

namespace tact::narrowphase {

Vec3 touching_normal(const ScaledMesh& surface, std::span<const int> feature, Vec3 along, Turned turned) {
  Vec3 best;
  double most = 0.0;
  int first = -1;  // by the caller's number
  for (const int facet : surface.features.facets_at(feature[0])) {
    const Corners& corners = surface.features.corners(facet);
    if (!std::ranges::all_of(feature, [&](int v) { return std::ranges::find(corners, v) != corners.end(); })) continue;
    const Vec3 normal = surface.unit_normal(facet);
    if (normal == Vec3{}) continue;
    const double part = turned == Turned::either_way ? std::abs(dot(normal, along)) : dot(normal, along);
    const int source = surface.mesh.source_facet(facet);
    if (first >= 0 && (part < most || (part == most && source > first))) continue;
    best = normal, most = part, first = source;
  }
  return best;
}

}  // namespace tact::narrowphase
