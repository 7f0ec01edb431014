// Pairs of hulls that the search for a contact direction finds hard: flat, thin, tiny beside large, regular, nearly
// equal points; deep, touching or nearly so, of any size and far from zero.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/vec3.h"

namespace tact::tests {

using base::Vec3;

struct HullPair {
  std::string kinds;
  std::vector<Vec3> a, b;
  std::vector<Vec3> b_before;  // where B was, a step ago
  Vec3 start;                  // unit
};

HullPair hostile_hull_pair(std::uint64_t seed);

// Finds the contact direction of both steps of a pair: from `start`, then from where the last ended. What is wrong with
// one of them: it is given up, its depth is not the height of the Minkowski difference, it is no local minimum or above
// its start. Empty if nothing is. Counts directions that were looked at.
std::string problem_of_directions(const HullPair& pair, std::int64_t& directions);

}  // namespace tact::tests
