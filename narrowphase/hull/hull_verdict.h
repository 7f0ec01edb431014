// Whether two hulls share a point, exactly, for all coordinates up to 2^300 in size: GJK once more, with certain signs.
//
// Doubles decide wherever the bounds of their rounding allow it, see gjk.h. This is for the rest: hulls that touch, and
// hulls that overlap or are apart by some 1e-15 of their size. Signs come from integers of 128 bits where coordinates
// are so short, else from double-doubles that know their error, else from integers of any size. A step of a wall of
// bricks on a lattice takes 1.06 times as long with it, one of a wall turned by any angle, where every contact depends
// on the last bit, 1.6 times (tact-bench rivals; with integers of any size alone 1.24 and 2.0).
#pragma once

#include <cstdint>
#include <vector>

#include "narrowphase/hull/gjk.h"
#include "narrowphase/hull/minkowski_difference.h"

namespace tact::narrowphase {

struct HullVerdict {
  bool apart = false;  // false: they share a point; touching counts
  // Of hulls that are apart: unit, from A to B. It separates them but for its own rounding, which may exceed the gap.
  Vec3 direction;
  // Vertices of M whose hull holds the origin, inside or on its border. Of hulls that are apart, the vertices of M
  // around its point nearest to the origin.
  GjkSimplex simplex;
  int support_queries = 0;
};

// `start` is where GJK ended, or nothing. It shortens the search and changes no verdict. `scratch` is memory.
HullVerdict hull_verdict(const MinkowskiDifference& m, const GjkSimplex& start, std::vector<std::int32_t>& scratch);

}  // namespace tact::narrowphase
