// The tests of distances of the rivals for contact points: a copy of narrowphase/distance as it was in November 2026,
// so that the rivals keep their pace when the engine changes its own. What doubles do not tell is left to the engine.
#pragma once

#include <optional>

#include "narrowphase/distance/nearest.h"

namespace tact::bench {

using narrowphase::EdgeEnds;
using narrowphase::Nearest;
using narrowphase::ScaledVertices;

// As the functions of the same names there.
std::optional<Nearest> plain_nearest_inside_facet(base::Vec3 v, const base::Vec3 (&corner)[3], double limit);
std::optional<Nearest> plain_nearest_inside_edge(base::Vec3 v, base::Vec3 p, base::Vec3 q, const ScaledVertices& third,
                                                 double limit);
std::optional<Nearest> plain_nearest_in_vertex(base::Vec3 v, base::Vec3 w, const ScaledVertices& neighbors,
                                               double limit);
std::optional<Nearest> plain_nearest_between_edges(const EdgeEnds& e, const ScaledVertices& third_e, const EdgeEnds& f,
                                                   const ScaledVertices& third_f, double limit);

}  // namespace tact::bench
