// The heights w(n) of a Minkowski difference by brute force, in long double: slow, short and independent of the engine.
#pragma once

#include <span>
#include <vector>

#include "engine/base/vec3.h"

namespace tact::tests {

using base::Vec3;

// In long double, whatever the platform makes of it.
struct Long3 {
  long double x = 0.0L;
  long double y = 0.0L;
  long double z = 0.0L;
};

// The overlap w(n) of the hulls of two sets of points, neither empty: max n · a - min n · b over all points, divided by
// |n|.
class MinkowskiHeight {
 public:
  MinkowskiHeight(std::span<const Vec3> a, std::span<const Vec3> b);

  // w(n), metres, with b shifted by `shift`. n need not be of unit length and must not be zero.
  long double operator()(Vec3 n, Vec3 shift = {}) const;
  // The largest edge of the box around both, metres; 0 if all points are one.
  double size() const;
  // Is w at n not larger by more than `tolerance` (metres) than at any of 64 turns of n by each of 1e-2, 1e-3, ... 1e-7
  // radians? The turns are the same for the same n.
  bool is_local_minimum(Vec3 n, double tolerance, Vec3 shift = {}) const;

 private:
  long double along(const Long3& n, const Long3& shift) const;

  std::vector<Long3> a_, b_;  // less the first point of a
};

// w(n) of points that are asked once.
long double minkowski_height(std::span<const Vec3> a, std::span<const Vec3> b, Vec3 n);
bool is_local_minimum(std::span<const Vec3> a, std::span<const Vec3> b, Vec3 n, double tolerance);

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

}  // namespace tact::tests
