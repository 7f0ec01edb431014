// Which features of two surfaces a contact point or an impact is of.
#pragma once

namespace tact {

/// The features of bodies a and b that are nearest, or that meet.
enum class FeaturePair {
  vertex_facet,  ///< a vertex of a, a facet of b
  facet_vertex,  ///< a facet of a, a vertex of b
  edge_edge,     ///< an edge of each
};

}  // namespace tact
