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
  Vec3 n;               // unit, from A to B
  double height = 0.0;  // w(n), scaled; negative beyond height_error(): n separates the hulls
  int top_a = -1;       // the vertex of A farthest along n, and that of B farthest against it
  int top_b = -1;
  int iterations = 0;          // shifted calls of GJK
  int support_queries = 0;     // of these calls, and of the search for faces
  GjkSimplex face;             // vertices of the face of M that holds the foot: the start of the next step
  bool limit_reached = false;  // n is the best found
};

// Starts from the unit direction `start`, and goes on until the foot of the origin lies in the face of M that the
// direction supports. Each iteration shifts A back along n by a little more than the hulls overlap, takes the closest
// points by GJK and turns n to them; w never increases. A foot on an edge or a corner of M repeats without being a
// minimum: from an edge n is turned to the adjacent face with the smaller w, from a corner to the lowest of the faces
// around it. So it is from a foot that lies in a face, but so near to its border that a small turn beyond leads lower.
// n is the normal of the face, computed from its vertices, and does not depend on the path.
//
// `face` is the last step's: from it the search goes over sides, and to vertices that have come up, a face at a time.
// If that ends at one that holds the foot, no higher than w(start), that is the answer, without an iteration. Where M
// is flat the height is zero and n its normal on the side of `start`; where M is a segment or a point, n is the
// direction across it nearest to `start`. `faces` lends its memory.
ContactDirection contact_direction(const MinkowskiDifference& m, Vec3 start, const GjkSimplex& face,
                                   const DirectionSettings& settings, FaceFinder& faces);

}  // namespace tact::narrowphase
