// Two facets that meet.
#pragma once

#include <compare>

namespace tact {

/// Two facets that share at least one point. Facets count from 0 in the order in which the body was added.
struct FacetPair {
  int a = -1;  ///< facet of the first body
  int b = -1;  ///< facet of the second
  friend constexpr auto operator<=>(const FacetPair&, const FacetPair&) = default;
};

}  // namespace tact
