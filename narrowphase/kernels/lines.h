// What the loops over a batch of rays read and write: a tree over the facets of a mesh, and sixteen
// segments that descend it. Floats are about the middle of the mesh, in a unit in which no coordinate of it exceeds 1.
#pragma once

#include <cstdint>

namespace tact::narrowphase {

// Boxes: lower x, y, z, upper x, y, z, an array each. Of what is read at once 64 bytes more can be read.
struct LinedBoxes {
  const float* bounds[6];
};

// Sixteen facets or fewer, by the coordinates of their corners, and which vertices these are; the last one is repeated.
struct alignas(64) LineLeaf {
  static constexpr int kFacets = 16;
  float corner[3][3][kFacets];
  std::int32_t vertex[3][kFacets];
};

// The boxes of the leaves of four clusters that stand one after the other, or of fewer.
struct alignas(64) LineNode {
  static constexpr int kClusters = 4, kLeavesOfCluster = 4, kLeaves = kClusters * kLeavesOfCluster;
  float bounds[6][kLeaves];
};

// Groups, as the mesh has them, hold up to eight nodes, nodes up to sixteen leaves. A coordinate x of the mesh is at
// (x - origin) scale; the scale is a power of two.
struct LineTree {
  LinedBoxes groups, nodes;
  const LineNode* node;
  const LineLeaf* leaf;
  std::int32_t group_count, node_count, facet_count;
  double origin[3], scale;
};

// Up to sixteen segments, and for each the boxes of a tree that it enters, with when at the earliest.
struct alignas(64) LineBlock {
  static constexpr int kLines = 16, kEntries = 128;

  // The beginning, the way and what its rounding took, and what SegmentSlabs and LineOfSight have; the axis along which
  // the way is longest comes last, and `way` is that along it.
  double from[3][kLines], direction[3][kLines], direction_tail[3][kLines], inverse[3][kLines], slope[2][kLines],
      way[kLines], longest[kLines];

  // In the tree's unit: of an axis x is passed at x rate - enter_at at the earliest, and at x rate - leave_at at the
  // latest.
  float rate[3][kLines], enter_at[3][kLines], leave_at[3][kLines], latest[kLines];
  // Seen along the segment, which is at zero, a point is at coordinate k + tilt[k] the last coordinate + shift[k],
  // k < 2. There twice an area between the segment and two points is wrong by at most `error` times their largest
  // coordinate, and by `least_error`.
  float tilt[2][kLines], shift[2][kLines], error[kLines], least_error[kLines];

  // A list for each segment. The last bits of a key, as many as kEntries has, tell the place in the list, the others
  // the time, rounded down; after the last one it is infinite. An entry is the number of a leaf, or ~ that of a group.
  float key[kLines][kEntries + 16];
  std::int32_t entry[kLines][kEntries + 16];
  std::int32_t entries[kLines];

  // Of enter_all_nodes(): a bit for each node that a segment enters after it has left another one; and when it enters
  // the first of them, or infinity.
  std::uint64_t later[kLines];
  float later_from[kLines];

  // By find_facets(): a leaf, and a bit for each facet of it that the segment may meet; or ~ a group, or what there is
  // instead.
  std::int32_t taken[kLines];
  std::uint32_t facets[kLines];
  static constexpr std::int32_t kNothing = INT32_MIN, kLaterNodes = INT32_MIN + 1;

  std::uint32_t overflowing;  // a bit for each segment that had no room for what it enters
  int count = 0;
};

// What prepare_segments() knows of segments, a bit for each: those that are for doubles alone, and those that pass the
// mesh.
struct LinesApart {
  std::uint32_t alone, past;
};

// Pairs of a segment of a block and a triangle, of which coordinates are in the segment's order of axes. What they have
// in common is where `meets` has a bit: when, as a part of the segment, and the weights of the triangle's corners
// there. Where `uncertain` has a bit doubles cannot tell.
struct alignas(64) LinePairs {
  static constexpr int kMost = 16;
  double corner[3][3][kMost];
  double time[kMost], weight[3][kMost];
  std::int32_t line[kMost];
  std::uint32_t meets, uncertain;
  int count = 0;
};

}  // namespace tact::narrowphase
