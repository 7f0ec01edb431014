#include "narrowphase/crossing/crossing.h"

namespace tact::narrowphase {

void CrossedSurface::begin(const FeaturedMesh& of, SurfaceKind kind, double sign_of_exits, double unit) {
  mesh = of;
  surface = kind;
  sign = sign_of_exits;
  scale = unit;
  exits.clear(mesh.mesh->source_vertex_count());
  kept.clear();
  without_near_points.clear();
}

EdgeVertices CrossedSurface::source_ends(int edge) const {
  const EdgeVertices ends = mesh.features->edge(edge);
  return {mesh.mesh->source_vertex(ends[0]), mesh.mesh->source_vertex(ends[1])};
}

int CrossedSurface::source_corner(int source_facet) const {
  return mesh.mesh->source_vertex(mesh.features->corners(mesh.mesh->facet_of_source(source_facet))[0]);
}

Vec3 CrossedSurface::exits_of(int edge) const {
  Vec3 sum;
  for (const int v : source_ends(edge)) {
    if (const NearestExit* exit = exits.find(v)) sum = sum + exit->direction;
  }
  return sum;
}

Vec3 CrossedSurface::kept_by(int source_vertex) const {
  const int patch = kept.empty() ? -1 : cut.patch_of(source_vertex);
  return patch < 0 ? Vec3{} : kept[static_cast<std::size_t>(patch)];
}

}  // namespace tact::narrowphase
