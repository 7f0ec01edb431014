// The contact direction of two overlapping hulls (paper §4.1): a local minimum of the height w of M, found from a
// start.
#pragma once

#include "narrowphase/direction/minkowski_face.h"
#include "narrowphase/hull/gjk.h"

namespace tact::narrowphase {

struct DirectionSettings {
  GjkSettings gjk;
  int iteration_limit = 100;  // shifted calls of GJK
};

struct ContactDirection {
  Vec3 n;                      ///< unit, from A to B
  double height = 0.0;         ///< w(n), scaled; below -height_error() n separates the hulls
  int top_a = -1;              ///< the vertex of A farthest along n
  int top_b = -1;              ///< the vertex of B farthest along -n
  int iterations = 0;          ///< shifted calls of GJK
  int support_queries = 0;     ///< of these calls, and of the search for faces
  GjkSimplex face;             ///< vertices of the face of M that holds the projection: the start of the next step
  bool limit_reached = false;  ///< n is the best found
};

// Starts from the unit direction `start`. Ends when the *projection*, that of the origin on the supporting plane of n,
// lies in the face of M that n supports: then w(n) is a local minimum. An iteration shifts A back along n by a little
// more than the hulls overlap, finds the closest points by GJK, and turns n to them; w never increases. If the
// projection lies on an edge of M, the iteration repeats itself without being at a minimum: n is turned to the adjacent
// face with the smaller w. From a corner, n is turned to the lowest of the faces around it. The same is done where the
// projection lies in a face, but so near to its border that a small turn across it leads lower. n is computed from the
// vertices of the face, and does not depend on the path.
//
// `face` is the last step's. From it the search first walks a face at a time: over a side, or to a vertex that now lies
// above. If it reaches a face that holds the projection and is no higher than w(start), that is the answer, without an
// iteration. If M is flat, the height is zero and n is its normal on the side of `start`. If M is a segment or a point,
// n is the direction across it nearest to `start`. `faces` lends its memory.
ContactDirection contact_direction(const MinkowskiDifference& m, Vec3 start, const GjkSimplex& face,
                                   const DirectionSettings& settings, FaceFinder& faces);

}  // namespace tact::narrowphase
