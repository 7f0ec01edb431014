// What the loops over positions read and write: a refit, or a pose.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/boxes.h"

namespace tact::narrowphase {

// New positions for the clusters cluster_begin <= c < cluster_end. Those of source vertex s are source[3 s], source[3 s
// + 1], source[3 s + 2].
struct RefitInput {
  const double* source;
  std::int32_t cluster_begin, cluster_end;
  // For each cluster, and one more: the first vertex that it owns, the first that it borrows.
  const std::int32_t* ranges;
  const std::int32_t* owned;     // source vertices, copied to x, y, z in this order
  const std::int32_t* borrowed;  // source vertices that only widen the box
  std::int32_t ahead;            // how many owned vertices ahead positions are prefetched; 0: they are not
  PointArrays before;            // where the owned ones were
  double* x;
  double* y;
  double* z;
  double* boxes;  // of the clusters, see BoxPointers: one array after the other, each box_stride long
  std::int32_t box_stride;
  double* steps_squared;  // of each cluster, how far an owned vertex goes at most, squared; null: not asked for
};

// What a refit saw.
struct Refitted {
  BoxBounds box;      // of all these clusters
  bool changed;       // some owned coordinate is not what it was
  bool not_a_number;  // some owned coordinate is not a number: the boxes are of no use
};

// A pose of a rigid mesh, see mesh/pose.h, and all clusters of it: see RefitInput for what is not said here.
struct PlaceInput {
  double rotation[3][3];  // rows
  double translation[3];
  PointArrays rest;
  std::int32_t cluster_count;
  const std::int32_t* ranges;
  const std::int32_t* borrowed;  // vertices, not source vertices
  double* x;
  double* y;
  double* z;
  double* boxes;
};

}  // namespace tact::narrowphase
