#include "narrowphase/crossing/vertex_winding.h"

#include <algorithm>

namespace tact::narrowphase {

namespace {

// Beyond the mesh, of which lengths are at most 2.
constexpr double kBeyond = 8.0;
// How far the half-line is turned each time that it meets an edge, as a part of its length, and how often: edges are
// lines, which a few directions miss.
constexpr double kPartOfATurn = 1e-3;
constexpr int kMostTurns = 16;

}  // namespace

bool is_closed(const FeaturedMesh& m) { return m.features->is_closed(); }

bool VertexWinding::is_inside(const ScaledMesh& mesh, int vertex, Vec3 outward) {
  if (outward == Vec3{}) return false;
  const Vec3 inward = -normalized(outward);
  for (int turn = 0; turn < kMostTurns; ++turn) {
    Vec3 direction = inward;
    direction[turn % 3] += kPartOfATurn * turn;
    direction[(turn + 1) % 3] -= 0.375 * kPartOfATurn * turn;
    const Side side = look_along(mesh, vertex, direction);
    if (side != Side::undecided) return side == Side::inside;
  }
  return false;
}

VertexWinding::Side VertexWinding::look_along(const ScaledMesh& mesh, int vertex, Vec3 direction) {
  const Vec3 from = mesh.mesh.position(vertex), to = (1.0 / mesh.scale) * (mesh.position(vertex) + kBeyond * direction);
  hits_.clear();
  append_hits(mesh.mesh, PreparedSegment({from, to}), hits_);
  int winding = 0;
  for (const FacetHit& hit : hits_) {
    const int facet = mesh.mesh.facet_of_source(hit.facet);
    const Corners& corners = mesh.features.corners(facet);
    if (std::ranges::find(corners, vertex) != corners.end()) continue;
    const Triangle t = mesh.mesh.triangle(facet);
    const int below = orient3d(t[0], t[1], t[2], from, counts_);
    if (below == 0) {
      // It begins on the facet, and leaves it.
      if (orient3d(t[0], t[1], t[2], to, counts_) != 0) continue;
      return Side::undecided;
    }
    bool meets_border = false;
    for (std::size_t k = 0; k < 3; ++k)
      meets_border = meets_border || orient3d(from, to, t[k], t[(k + 1) % 3], counts_) == 0;
    if (meets_border) return Side::undecided;
    winding += below;
  }
  return winding > 1 ? Side::inside : Side::outside;
}

}  // namespace tact::narrowphase
