// What became of a facet on its way through the criteria.
#pragma once

#include <cstdint>
#include <vector>

namespace tact {

/// What became of a facet of one of two bodies whose hulls overlap: the first thing that ruled it out. All but the last
/// two are dropped; what is kept is tested against the facets of the other body.
enum class FacetOutcome : std::uint8_t {
  outside_box,   ///< it, or its whole cluster, lies outside the box of what is left of the other body
  outside_slab,  ///< criterion 2: it, or its whole cluster, lies before the other's contact plane
  far,           ///< no cluster of the other body is near its cluster
  facing_away,   ///< criterion 1 (Accuracy::paper only)
  outside_zone,  ///< criterion 3: its projection misses the disk around the other's impact zone
  kept,          ///< left after the criteria; meets no facet
  meets          ///< left after the criteria, and meets a facet
};
inline constexpr int kFacetOutcomes = 7;

/// Of every facet of two bodies, in the order in which each was added.
struct FacetOutcomes {
  std::vector<FacetOutcome> a;
  std::vector<FacetOutcome> b;
};

}  // namespace tact
