// A mesh in a unit of length in which distances neither vanish nor overflow.
#pragma once

#include "narrowphase/distance/nearest.h"
#include "narrowphase/mesh/features.h"
#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/pairs/box_reach.h"

namespace tact::narrowphase {

/// Scales the longest side of a box to between 1 and 2.
inline double unit_scale_of(const Box& box) { return unit_scale(longest_side(box)); }

struct ScaledMesh {
  const ClusteredMesh& mesh;
  const Features& features;
  double scale;  // a power of two

  Vec3 position(int vertex) const { return scale * mesh.position(vertex); }
  Triangle triangle(int facet) const {
    const Corners& c = features.corners(facet);
    return {position(c[0]), position(c[1]), position(c[2])};
  }
  /// Along the normal of a facet, of any length; zero if it has no area.
  Vec3 normal(int facet) const {
    const Triangle t = triangle(facet);
    return moderate_cross(t[1] - t[0], t[2] - t[0]);
  }
  Vec3 unit_normal(int facet) const {
    const Vec3 normal = this->normal(facet);
    const double length = norm(normal);
    return length > 0.0 ? (1.0 / length) * normal : Vec3{};
  }
  EdgeEnds ends(int edge) const {
    const EdgeVertices vertices = features.edge(edge);
    return {position(vertices[0]), position(vertices[1])};
  }
  /// The third vertices of the facets that have an edge.
  ScaledVertices beside(int edge) const { return around(features.opposite(edge)); }
  ScaledVertices around(std::span<const int> vertices) const { return {mesh.points(), vertices, scale}; }
};

}  // namespace tact::narrowphase
