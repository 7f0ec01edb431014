// Where two edges are nearest.
#pragma once

#include <optional>

#include "narrowphase/distance/nearest.h"

namespace tact::narrowphase {

/// The minimum of the distance between the insides of two edges, which are not parallel, if there is one nearer than
/// `limit`; `third_e` and `third_f` hold a third vertex for each facet that has the edge. Of edges that have passed
/// each other `normal` points from the second to the first, back along the way, and the facets at the edges lie as they
/// did before: those at e against `normal`, those at f along it.
std::optional<Nearest> nearest_between_edges(const EdgeEnds& e, const ScaledVertices& third_e, const EdgeEnds& f,
                                             const ScaledVertices& third_f, double limit,
                                             EdgeSide side = EdgeSide::before);

/// The same whatever facets are at the edges. `normal` is perpendicular to both, either way.
std::optional<Nearest> nearest_inside_edges(const EdgeEnds& e, const EdgeEnds& f, double limit);

}  // namespace tact::narrowphase
