// Do two hulls share a point? Exactly, for all coordinates up to 2^300 in size: GJK once more, its signs those of
// integers.
//
// Doubles decide wherever the bounds of their rounding allow it, see gjk.h. This is for the rest: hulls that touch, or
// that are apart or overlap by some 1e-15 of their size.
#pragma once

#include "narrowphase/hull/gjk.h"
#include "narrowphase/hull/minkowski_difference.h"

namespace tact::narrowphase {

struct HullVerdict {
  bool apart = false;  // false: they share a point; touching counts
  // Of hulls that are apart: unit, from A to B. Parts them but for its own rounding, which may be more than the gap.
  Vec3 direction;
  // Vertices of M that hold the origin, in them or on their border; or, of hulls that are apart, those around the
  // point that `direction` leads to.
  GjkSimplex simplex;
  int support_queries = 0;
};

// `start` is where GJK ended, or nothing. It makes the search short and changes no verdict.
HullVerdict hull_verdict(const MinkowskiDifference& m, const GjkSimplex& start);

}  // namespace tact::narrowphase
