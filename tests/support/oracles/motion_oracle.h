// When features that move straight first meet, in rational arithmetic: an oracle that has nothing in common with the
// engine's bounds. It isolates the roots of the polynomials that can vanish at a first meeting, and decides at each, by
// the signs of other polynomials there, whether the features share a point.
#pragma once

#include <optional>

#include "narrowphase/motion/moving_polygon.h"
#include "tests/support/mesh.h"

namespace tact::tests {

/// The first time, enclosed to 2^-60 of the step, at which a vertex and a facet, or two edges, share a point. Exact for
/// the doubles given: whatever is coplanar, parallel, without area or at rest.
struct TimeEnclosure {
  double low = 0.0;   // rounded down
  double high = 0.0;  // rounded up
};
std::optional<TimeEnclosure> first_time_of_vertex_and_facet(const narrowphase::MovingVertex& vertex,
                                                            const narrowphase::MovingVertex (&facet)[3]);
std::optional<TimeEnclosure> first_time_of_edges(const narrowphase::MovingVertex (&edge)[2],
                                                 const narrowphase::MovingVertex (&other)[2]);

/// The first time at which they are at most `reach` apart, a double that is not negative: the square of the distance to
/// a corner, the line of a side and the plane are quotients of polynomials, and a first time is a root of one of them
/// less the square of the reach, where the nearest place is in that corner, side or plane.
std::optional<TimeEnclosure> first_time_within(const narrowphase::MovingVertex& vertex,
                                               const narrowphase::MovingVertex (&facet)[3], double reach);
std::optional<TimeEnclosure> first_time_within(const narrowphase::MovingVertex (&edge)[2],
                                               const narrowphase::MovingVertex (&other)[2], double reach);

}  // namespace tact::tests
