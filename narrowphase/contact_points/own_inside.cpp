#include "narrowphase/contact_points/own_inside.h"

#include <algorithm>

namespace tact::narrowphase {

namespace {

// What is turned by less is level: coordinates of meshes that were turned and rounded are off by that much.
constexpr double kLevelSine = 0x1p-30;

// 1 if the way leads to the outer side of a facet, -1 to its inner side, 0 if it is level.
int side_of_way(const ClusteredMesh& mesh, const Corners& c, Vec3 way) {
  const Vec3 from = mesh.position(c[0]),
             normal = moderate_cross(mesh.position(c[1]) - from, mesh.position(c[2]) - from);
  const double along = dot(normal, way);
  if (along * along <= kLevelSine * kLevelSine * norm_squared(normal)) return 0;
  return along > 0.0 ? 1 : -1;
}

}  // namespace

bool leads_inside(const FeaturedMesh& m, std::span<const int> feature, Vec3 way) {
  if (feature.size() == 3) return side_of_way(*m.mesh, {feature[0], feature[1], feature[2]}, way) < 0;
  bool any_inside = false;
  for (const int facet : m.features->facets_at(feature[0])) {
    const Corners& corners = m.features->corners(facet);
    const auto has = [&](int vertex) { return std::ranges::find(corners, vertex) != corners.end(); };
    if (!std::ranges::all_of(feature.subspan(1), has)) continue;
    const int side = side_of_way(*m.mesh, corners, way);
    if (side > 0) return false;
    any_inside |= side < 0;
  }
  return any_inside;
}

}  // namespace tact::narrowphase
