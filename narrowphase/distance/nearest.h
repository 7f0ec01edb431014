// Where a surface is nearest to a vertex or an edge: the local minima of the distance, each on the smallest feature
// that holds it. A minimum is one if no facet at its feature comes nearer. As facets are convex, each facet's part in
// that is a sign:
//   inside a facet      the vertex lies on the inner side of all three edges;
//   inside an edge      it lies between the edge's ends, and on the inner side of no facet that has the edge;
//   in a vertex         no edge at that vertex leads nearer; then no facet there does, as it lies between two edges;
//   between two edges   the closest points of their lines lie inside both, and no facet at either edge has its third
//                       vertex on the other edge's side.
// A facet without area is on no side of anything: it is the edges that it has.
#pragma once

#include <span>

#include "engine/base/vec3.h"
#include "narrowphase/kernels/kernels.h"

namespace tact::narrowphase {

using base::Vec3;

/// Some vertices of a mesh, scaled by a power of two.
struct ScaledVertices {
  PointArrays points;
  std::span<const int> vertices;
  double scale = 1.0;

  std::size_t size() const { return vertices.size(); }
  Vec3 operator[](std::size_t i) const {
    const auto v = static_cast<std::size_t>(vertices[i]);
    return {scale * points.x[v], scale * points.y[v], scale * points.z[v]};
  }
};

/// A distance, in the unit of the points that were given.
struct Nearest {
  Vec3 normal;  // unit, from the vertex to the surface, or from the first edge to the second
  double distance = 0.0;
  double weight[3] = {};  // of the feature's vertices, in their order; between two edges the ends of the second
  double first[2] = {};   // between two edges: of the ends of the first
};

/// An edge.
struct EdgeEnds {
  Vec3 p, q;
};

}  // namespace tact::narrowphase
