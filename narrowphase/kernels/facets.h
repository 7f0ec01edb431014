// What the loops over facets read and write: clusters, blocks of facets, pairs of them.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/boxes.h"

namespace tact::narrowphase {

// A determinant of differences of coordinates up to 2^300 is rounded by at most kRelativeRounding times the sum of the
// sizes of its products, and kAbsoluteRounding. See facets.inl.
inline constexpr double kRelativeRounding = 1e-15;
inline constexpr double kAbsoluteRounding = 1e-200;
// The relative rounding in double-double. See facet_pairs.inl.
inline constexpr double kWideRelativeRounding = 0x1p-100;

// A cluster's facets and vertices. The vertices that it owns stand next to each other in `points`; the others are
// borrowed. `corner` counts the owned ones first; 64 bytes of each of its arrays may be read.
struct ClusterFacets {
  PointArrays points;  // of all vertices
  std::int32_t owned_begin;
  std::int32_t owned_count;
  const std::int32_t* borrowed;
  std::int32_t borrowed_count;
  const std::uint8_t* corner[3];
  std::int32_t facet_begin;
  std::int32_t facet_count;
};

// A box cut into cells along each axis: x is at (x - origin) scale, which does not change the order of two coordinates,
// however it is rounded.
struct Grid {
  double origin[3];
  double scale[3];
};
inline constexpr double kLastCell = 0x7fff;

// The cells that a box reaches, from the lower to the upper along each axis.
struct CellBox {
  std::int16_t lower[3];
  std::int16_t upper[3];
};

// The cells that the boxes of facets reach.
struct alignas(64) FacetCells {
  static constexpr int kRoom = 64 + 32;
  std::int16_t lower[3][kRoom];  // cut off at 0 and kLastCell
  std::int16_t upper[3][kRoom];
  int count = 0;
};

// Facets of one or more clusters in separate arrays. Each starts at a cache line, and is longer by what a SIMD loop may
// write past the end.
struct alignas(64) FacetBlock {
  static constexpr int kCapacity = 64;
  static constexpr int kRoom = kCapacity + 8;
  FacetCells cells;  // of the first facets
  double lower[3][kRoom];
  double upper[3][kRoom];
  double corner[3][3][kRoom];  // corner, axis, facet
  double normal[3][kRoom];     // (c1 - c0) × (c2 - c0), as computed
  std::int32_t facet[kRoom];   // its number in the mesh
  int count = 0;
};

// The corners of facets along three axes, rounded to floats.
struct alignas(64) FloatCorners {
  static constexpr int kRoom = FacetBlock::kCapacity + 16;
  float corner[3][3][kRoom];  // corner, axis, facet
  double extent[3];           // of the largest facet
  double error;               // of any coordinate, at most
  int count;
};

// The vertices of a cluster as floats about a point near them: those that it owns, then those that it borrows. Each
// array is a whole number of runs, filled up with the first vertex, and 64 floats of it may be read.
struct LocalVertices {
  static constexpr int kRun = 16;
  static constexpr int kMost = 192 + kRun;
  float* x;
  float* y;
  float* z;
};

struct LocalRange {
  float lower, upper;
};

// Three axes, at most 1 in length each, and a grid along them. A vertex x is at axis · x + offset.
struct LocalFrame {
  float axis[3][3];
  float offset[3];
  float margin;          // by which boxes of facets are widened before they are put into cells
  float cell_origin[3];  // cells are cut off at 0 and kLastCell
  float cell_scale[3];
  double error;  // of any coordinate, at most
};

// Where the normals of facets point.
struct NormalSpread {
  double axis[3] = {};  // of their sum, a unit vector
  double least = 0.0;   // cosine between it and one of them, times its own size
};

// What facets are judged by.
struct CullPlanes {
  HeightAxis axis;
  double lowest;  // a facet whose highest corner is lower is left out
  BoxBounds box;  // so is one whose box misses this
};

// How many facets or boxes the planes leave, and how many of the others are too low.
struct Culled {
  std::int32_t left;
  std::int32_t low;
};

// Pairs of facets of two blocks. Beyond `count` there are indices that may be read, and room for what a SIMD loop may
// write past the end.
struct FacetPairList {
  static constexpr int kCapacity = 64;
  std::uint8_t a[2 * kCapacity] = {};
  std::uint8_t b[2 * kCapacity] = {};
  int count = 0;
};

// Which facets of a block share cells with some facet of another block, a bit each, and how many such pairs there are.
struct SharedCells {
  std::uint64_t facets;
  std::int64_t pairs;
};

inline constexpr int kMostSorted = 128;

// What became of a list of pairs, a bit each.
struct PairMatches {
  std::uint64_t meeting = 0;    // certainly
  std::uint64_t undecided = 0;  // for exact predicates
  std::uint64_t flat = 0;       // the facet of `a` certainly lies in the plane of the facet of `b`, if that has one
};

}  // namespace tact::narrowphase
