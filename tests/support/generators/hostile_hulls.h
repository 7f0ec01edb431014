// Pairs of hulls that GJK and the search for a contact direction find hard: flat, thin, tiny beside large, regular,
// nearly equal points; deep, touching or nearly so, of any size and far from zero.
#pragma once

#include <cstdint>
#include <span>
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
  std::vector<Vec3> b_parted;  // B, moved along `start` until it is apart: by 1e-14 to 10 of the size
};

HullPair hostile_hull_pair(std::uint64_t seed);

// Hulls of four points, each of whose coordinates has a size of its own, 2^-290 to 2^290 at most: some vertices lie in
// one place but for rounding, and some do not. Of B, half of the coordinates were others a step ago.
HullPair hull_pair_of_all_sizes(std::uint64_t seed);

// Finds the contact direction of both steps of a pair: from `start`, then from where the last ended. What is wrong with
// one of them: it is given up, its depth is not the height of the Minkowski difference, it is no local minimum or above
// its start. Empty if nothing is. Counts directions that were looked at.
std::string problem_of_directions(const HullPair& pair, std::int64_t& directions);

// What GJK said of pairs.
struct DistanceCounts {
  std::int64_t apart = 0;
  std::int64_t touching = 0;
  std::int64_t overlapping = 0;
};

// Asks GJK for the distance of the hulls of two point sets. What is wrong with its answer: its bounds are not closed,
// its direction does not part the hulls by the distance that it names, or hulls that it does not call apart are parted
// by a face of their difference; a closest point lies outside its hull, or the two are not the offset from each other.
// Empty if nothing is. Faces are looked at where there are at most 40 points.
std::string problem_of_distance(std::span<const Vec3> a, std::span<const Vec3> b, DistanceCounts& counts);

}  // namespace tact::tests
