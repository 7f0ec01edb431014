// The places of two features that are nearest to each other, wherever on them these lie.
#pragma once

#include <array>

#include "narrowphase/distance/nearest.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// The weights of both features' vertices: above zero are those of the smallest feature that holds a place.
struct ClosestPlaces {
  std::array<double, 3> first{}, second{};
  Vec3 normal{};          // unit, from the first to the second; zero where the distance is
  double distance = 0.0;  // in the unit of the points
};

/// Of a vertex, whose weight is 1, and a facet. Of equally near places of its border that of the first side counts.
ClosestPlaces closest_of_vertex_and_facet(Vec3 v, const Triangle& facet);

/// Of two edges. Where they are parallel, it is a place at an end. What is farther than `limit` may be found too far.
ClosestPlaces closest_of_edges(const EdgeEnds& e, const EdgeEnds& f, double limit);

}  // namespace tact::narrowphase
