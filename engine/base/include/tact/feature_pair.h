// Which features of two surfaces a contact point or an impact is of.
#pragma once

namespace tact {

/// The features of bodies a and b that are nearest, or that meet. Of the last five either feature is of no facet.
enum class FeaturePair {
  vertex_facet,   ///< a vertex of a, a facet of b
  facet_vertex,   ///< a facet of a, a vertex of b
  edge_edge,      ///< an edge of each
  vertex_edge,    ///< a vertex of a, an edge of b
  edge_vertex,    ///< an edge of a, a vertex of b
  vertex_vertex,  ///< a vertex of each
  vertex_plane,   ///< a vertex of a, b is a plane
  plane_vertex,   ///< a is a plane, a vertex of b
};

}  // namespace tact
