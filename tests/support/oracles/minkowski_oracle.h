// The heights w(n) of a Minkowski difference by brute force, in long double: slow, short and independent of the engine.
#pragma once

#include <span>
#include <vector>

#include "engine/base/vec3.h"

namespace tact::tests {

using base::Vec3;

// The overlap of the hulls of two point sets along n: max n · a - min n · b over all points, divided by |n|. Metres.
long double minkowski_height(std::span<const Vec3> a, std::span<const Vec3> b, Vec3 n);

// The least height over all directions, and those that have it.
struct SmallestHeight {
  long double height = 0.0L;
  std::vector<Vec3> directions;  // unit, at least 1e-6 apart; never empty
};

// The least w(n) over all unit n, and every face normal of the difference with w(n) <= least + `tie_tolerance`
// (metres). The difference must hold the origin: then w is least at a face normal, which is a facet's of A, the
// opposite of a facet's of B, or a cross product of an edge of A and one of B. All of these are tried, with both signs,
// without asking which are faces: any other direction only gives a larger w. Flat, straight and point-like sets are
// welcome. Sets of up to 8 points, and flat ones, try all pairs and triples of points; larger ones the hull that CGAL
// finds.
SmallestHeight smallest_height(std::span<const Vec3> a, std::span<const Vec3> b, double tie_tolerance);

// Is w at n not larger by more than `tolerance` (metres) than at any of 64 turns of n by each of 1e-2, 1e-3, ... 1e-7
// radians? The turns are the same for the same n.
bool is_local_minimum(std::span<const Vec3> a, std::span<const Vec3> b, Vec3 n, double tolerance);

}  // namespace tact::tests
