// The smallest separation of two overlapping hulls: the face of M nearest to the origin.
#pragma once

#include <vector>

#include "narrowphase/depth/expanding_polytope.h"
#include "narrowphase/depth/star_surface.h"
#include "narrowphase/hull/gjk.h"

namespace tact::narrowphase {

// Where a search may start.
struct SmallestStart {
  Vec3 preferred;                 ///< of equally low directions the nearest to this one is wanted; any vector
  GjkSimplex hulls = {};          ///< where GJK on the hulls ended
  SurfaceShape* shape = nullptr;  ///< of the pair's last search, or empty; replaced by that of this search
  bool is_placed = false;         ///< memory.surface was started with the shape, and surrounds the origin
};

// What a search uses; lent to the next one, which then allocates little or nothing.
struct SmallestMemory {
  StarSurface surface;
  std::vector<OpenFace> open;
  QueriedDirections queried;
  PolytopeMemory polytope;
};

// The direction with the least w(n) over all unit n. See expanding_polytope.h for what it is if several are equally
// low, if M is flat, straight or a point, or if M does not hold the origin.
//
// A surface around the origin (star_surface.h) grows over its nearest face, as in van den Bergen's expanding polytope,
// until that face is one of M. It starts from the last search's surface, whose nearest face is often the answer after
// one support query, or from GJK's simplex. If M is flat or nearly so, or the origin lies on its border, plain doubles
// cannot keep the surface around the origin: then expanding_polytope, which is exact and slower, does the search.
SmallestSeparation smallest_separation(const MinkowskiDifference& m, const SmallestStart& start,
                                       SmallestMemory& memory);

}  // namespace tact::narrowphase
