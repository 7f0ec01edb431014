// A contact point between two features: where it is, its normal and its gap.
#pragma once

#include <tact/feature_pair.h>

#include <array>
#include <tuple>

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

/// A point on each surface. Vertices have the caller's numbers; those of an edge ascend, those of a facet stand in its
/// own order; -1 fills up.
struct FeaturePoint {
  FeaturePair kind = FeaturePair::vertex_facet;
  std::array<int, 3> a{-1, -1, -1};
  std::array<int, 3> b{-1, -1, -1};
  std::array<double, 3> weight_a{};  // of the vertices of `a`; their sum is 1
  std::array<double, 3> weight_b{};
  Vec3 normal;       // unit, from the point of a to that of b; zero where they are one point in a vertex or an edge
  double gap = 0.0;  // metres
  int edge_a = -1, edge_b = -1;  // between two edges: these, as Features counts them

  /// Which features these are, whatever lies between them.
  auto features() const { return std::tie(kind, a, b); }
};

/// A place on a surface: the vertices of the smallest feature that holds it, by the mesh's numbers, and their weights.
struct PlaceOnFeature {
  std::array<int, 3> vertices{-1, -1, -1};  // -1 fills up
  std::array<double, 3> weight{};

  std::span<const int> used() const {
    return std::span(vertices).first(vertices[2] >= 0 ? 3 : vertices[1] >= 0 ? 2 : 1);
  }
};

/// The point of a vertex of `m`, by the mesh's number, with a place of `surface`. `kind` tells which of them is a's;
/// `way` leads from the vertex towards the surface.
inline FeaturePoint point_of_vertex(FeaturePair kind, const ClusteredMesh& m, int vertex, const ClusteredMesh& surface,
                                    const PlaceOnFeature& place, Vec3 way, double gap) {
  FeaturePoint point{.kind = kind, .normal = kind == FeaturePair::vertex_facet ? way : -way, .gap = gap};
  const bool of_a = kind == FeaturePair::vertex_facet;
  (of_a ? point.a : point.b) = {m.source_vertex(vertex), -1, -1};
  (of_a ? point.weight_a : point.weight_b) = {1.0, 0.0, 0.0};
  (of_a ? point.b : point.a) = source_vertices(surface, place.used());
  (of_a ? point.weight_b : point.weight_a) = place.weight;
  return point;
}

/// The point of two edges, by Features' numbers, at their nearest places.
inline FeaturePoint point_of_edges(const Nearest& nearest, const ScaledMesh& a, int edge_a, const ScaledMesh& b,
                                   int edge_b, double gap) {
  return {.kind = FeaturePair::edge_edge,
          .a = source_vertices(a.mesh, a.features.edge(edge_a)),
          .b = source_vertices(b.mesh, b.features.edge(edge_b)),
          .weight_a = {nearest.first[0], nearest.first[1], 0.0},
          .weight_b = {nearest.weight[0], nearest.weight[1], 0.0},
          .normal = nearest.normal,
          .gap = gap,
          .edge_a = edge_a,
          .edge_b = edge_b};
}

}  // namespace tact::narrowphase
