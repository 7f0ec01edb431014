// Which contact points are minima where several surfaces are one: a floor of unwelded facets, or of many bodies.
#pragma once

#include <tact/report.h>
#include <tact/world.h>

#include <cstdint>
#include <vector>

namespace tact {

/// Which surfaces are one. Facets of one body are, whether or not they share vertices, and bodies that are not tested
/// against each other: fixed ones, those of one group or excluded.
struct JoinedSurfaces {
  double within = 0.0;       ///< metres, at least 0: facets that are no farther from a place are there, too
  std::uint32_t layers = 0;  ///< bodies on these layers are one surface as well, though they are tested
};

/// Returns for each contact point of a world's last report, in the order of copy_points(), 1 if it is a minimum also of
/// joined surfaces, else 0. It is one if ContactPoint::minimum is set, no joined facet at either of its places leads
/// nearer along its normal, and no joined body lies behind the facet. A normal across a facet of its own body is kept
/// whatever leads nearer. Errors: invalid_argument, stale_body (a body of the report was removed), wrong_order
/// (set_facets() took a vertex of a point away), out_of_memory.
TACT_API std::vector<std::uint8_t> joined_minima(const World& world, const Report& report,
                                                 const JoinedSurfaces& joined = {});

}  // namespace tact
