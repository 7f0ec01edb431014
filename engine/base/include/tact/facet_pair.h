// Two facets that meet.
#pragma once

#include <compare>

namespace tact {

/// Two facets that share at least one point. Facets count from 0 in the order in which the body was added. Facets of
/// one body that name common vertices are a pair where they share more than these vertices and the edge between them.
/// A vertex that lies on the edge of another facet makes such pairs. A facet without area is the segment or point that
/// it is. Of a plane the surface is facet 0; edges and points are in no pair.
struct FacetPair {
  int a = -1;  ///< facet of the first body
  int b = -1;  ///< facet of the second
  friend constexpr auto operator<=>(const FacetPair&, const FacetPair&) = default;
};

}  // namespace tact
