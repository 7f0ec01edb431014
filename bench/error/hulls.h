// The rows of hulls of the benchmark `error`: pairs of convex bodies, of which the second is shifted along a path.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "bench/error/truth.h"

namespace tact::bench {

// All coordinates are multiples of 2^-40 below 16 in size, so that a shift by a step or by a small whole number is
// exact.
struct HullPair {
  Mesh a;  // vertices and facets of a convex hull
  Mesh b;
  // Shifts of b, one a frame: in the first the hulls are apart by a fiftieth of the pair's size; then the second sinks
  // in, until the smallest separation is a fifth of it or the two are concentric.
  std::vector<Eigen::Vector3d> path;
  MinkowskiHeight height;  // without a shift
  MinkowskiFaces faces;
};

struct HullRow {
  std::string name;
  int frames = 0;
  std::vector<HullPair> pairs;
};

// Quick rows hold fewer pairs, and leave the largest hulls out.
std::vector<HullRow> hull_rows(bool quick);

}  // namespace tact::bench
