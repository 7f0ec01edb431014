// Where a surface is nearest to a vertex or an edge: the local minima of the distance, each on the smallest feature
// that holds it. A minimum is one if no facet at its feature comes nearer. As facets are convex, each facet's part in
// that is a sign:
//   inside a facet      the vertex lies on the inner side of all three edges;
//   inside an edge      it lies between the edge's ends, and on the inner side of no facet that has the edge;
//   in a vertex         no edge at that vertex leads nearer; then no facet there does, as it lies between two edges;
//   between two edges   the closest points of their lines lie inside both, and no facet at either edge has its third
//                       vertex on the other edge's side.
// A facet without area is on no side of anything: it is the edges that it has.
//
// Signs are computed in doubles, with a bound of their rounding, and again in long doubles where the bound does not
// tell. What these cannot tell either counts as equal, and equal distances are a minimum.
#pragma once

#include <optional>
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

/// The minimum of the distance from `v` inside the facet with these corners, if there is one nearer than `limit`.
std::optional<Nearest> nearest_inside_facet(Vec3 v, const Vec3 (&corner)[3], double limit);

/// That inside the edge from `p` to `q`; `third` holds a third vertex for each facet that has the edge. A distance of
/// zero has no direction: `normal` is then zero.
std::optional<Nearest> nearest_inside_edge(Vec3 v, Vec3 p, Vec3 q, const ScaledVertices& third, double limit);

/// That in the vertex `w`; `neighbors` are the other ends of its edges. `normal` is zero where the distance is.
std::optional<Nearest> nearest_in_vertex(Vec3 v, Vec3 w, const ScaledVertices& neighbors, double limit);

/// That between the insides of two edges, which are not parallel; `third_e` and `third_f` as above.
struct EdgeEnds {
  Vec3 p, q;
};
std::optional<Nearest> nearest_between_edges(const EdgeEnds& e, const ScaledVertices& third_e, const EdgeEnds& f,
                                             const ScaledVertices& third_f, double limit);

/// The same of two edges that have passed each other: `normal` points from the second to the first, back along the way,
/// and the facets at the edges lie as they did before: those at e against `normal`, those at f along it.
std::optional<Nearest> crossing_between_edges(const EdgeEnds& e, const ScaledVertices& third_e, const EdgeEnds& f,
                                              const ScaledVertices& third_f, double limit);

}  // namespace tact::narrowphase
