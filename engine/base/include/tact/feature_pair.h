// Which kinds of features meet.
#pragma once

#include <cstdint>

namespace tact {

/// A feature of body a and one of body b between which a contact point or an impact lies.
enum class FeaturePair : std::uint8_t {
  vertex_facet,  ///< a vertex of a; a facet of b, an edge of it or a corner of it
  facet_vertex,  ///< a facet of a, an edge of it or a corner of it; a vertex of b
  edge_edge,     ///< an edge of a and one of b
};

}  // namespace tact
