// Whether surfaces with vertices at equal places part there, as the walls of a cut do that has just been made: decided
// by doubles alone, and left open where their rounding might matter.
//
// What is proved. Take each edge and each facet around two features that share a point when a step begins. If they meet
// from then on at most in vertices that stay together, the surfaces do not cross there: where two facets cross, an edge
// of the one meets the other, and at first it does so where it already touched. An edge and a facet meet in no other
// points if a plane goes between them:
//   - where one end of the edge stands at a corner of the facet, a plane through that corner with a normal that stays.
//     The gaps of all other vertices over it are linear in time: their signs at both ends of the span decide;
//   - where both ends stand at corners, as along the walls, a plane through these two corners and along a fixed
//     direction. The gap over it, times the length between them, is a quadratic; that of an end of the edge is a time
//     multiplied with what is linear.
// A vertex that leaves its corner must be on the side of its own edge; one that stays at it lies in the plane.
// The normal is as far from being across to any of these ways as doubles find (common_direction()): cuts that bend
// more than they open have one too, where no plane has all of a vertex's facets on one side.
#pragma once

#include <tact/feature_pair.h>

#include <span>

#include "narrowphase/motion/moving_mesh.h"

namespace tact::narrowphase {

/// A direction along which unit vectors all point forward, or zero if none is found: their mean, or about the point of
/// their hull that is nearest to zero (Gilbert, Johnson and Keerthi, 1988).
Vec3 common_direction(std::span<const Vec3> units);

/// Two features of two meshes, or of one, that share a point at time 0: until when the edges and facets around them
/// meet at most in vertices that stay together. Zero if that is not certain, or if the features touch elsewhere than in
/// vertices.
double walls_open_until(const MovingMesh& a, const MovingMesh& b, FeaturePair kind, int feature_a, int feature_b);

}  // namespace tact::narrowphase
