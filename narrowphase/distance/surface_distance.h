// How far it is from one point of a mesh to another along its edges.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

/// A point of a surface, and the vertices of the feature that holds it.
struct PointOnSurface {
  std::span<const int> vertices;
  Vec3 point;
};

/// Memory of the search, used again.
struct SurfaceWays {
  std::vector<std::pair<double, int>> reached;  // length of the way, vertex
};

/// True if a path shorter than `limit` leads from one point to a vertex of its feature, along edges, and from a vertex
/// of the other's feature to the other point. Lengths and points are scaled by `scale`. After Dijkstra, 1959,
/// with a plain list, as a reach is a few edges.
bool surface_distance_below(double limit, const ClusteredMesh& mesh, const Features& features, double scale,
                            const PointOnSurface& from, const PointOnSurface& to, SurfaceWays& ways);

/// Whether two places of one mesh are too near along it to have a contact: nearer than the places that are one `reach`
/// apart on a sheet folded as tightly as its thickness lets it. False for a reach of zero.
bool too_near_along(const ScaledMesh& mesh, double reach, const PointOnSurface& from, const PointOnSurface& to,
                    SurfaceWays& ways);

}  // namespace tact::narrowphase
