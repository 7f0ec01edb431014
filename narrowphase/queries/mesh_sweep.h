// When a mesh that goes a turning way first meets another one, or a half-space.
#pragma once

#include <array>
#include <optional>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/motion/turning_way.h"
#include "narrowphase/plane/half_space.h"

namespace tact::narrowphase {

struct SweptHit {
  int facet_a = -1, facet_b = -1;  // the caller's numbers; of equal times the least of a, then of b
  double time = 0.0;               // 0 to 1; never later than the true one
  Vec3 normal{};                   // unit, from a to b; zero if they meet where the way begins
  std::array<double, 3> weight_a{}, weight_b{};
};

/// The first time at which a on its way meets b, if it is at most `latest`.
///
/// By conservative advancement (Mirtich, "Impulse-based Dynamic Simulation of Rigid Body Systems", 1996) with the plane
/// between the nearest places of two facets: a step ends where a corner, whose velocity along the normal and whose
/// acceleration are bounded, may reach that plane. It is quadratic in the time that is left, so that facets that pass
/// each other closely take a few dozen steps. Facets nearer than 2^-45 of their size and way meet.
std::optional<SweptHit> first_on_way(const ClusteredMesh& a, const TurningWay& way, const ClusteredMesh& b,
                                     double latest);
/// The same of a half-space, which is facet 0 and solid.
std::optional<SweptHit> first_on_way(const ClusteredMesh& a, const TurningWay& way, const HalfSpace& space,
                                     double latest);

/// A box of all places of what begins in a box.
Box box_of_way(const Box& begin, const TurningWay& way);

}  // namespace tact::narrowphase
