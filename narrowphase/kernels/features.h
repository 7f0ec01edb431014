// What the loops over vertices, edges and facets read and write that may be near each other, or come near on their
// ways.
#pragma once

#include <cstdint>

#include "narrowphase/distance/rounding.h"
#include "narrowphase/kernels/facets.h"

namespace tact::narrowphase {

// Triangles, or parallelograms in the order of their outlines, whose corners move straight from time 0 to time 1;
// coordinates are at most 2 in size.
struct alignas(64) MovingPolygons {
  static constexpr int kCapacity = 64;
  static constexpr int kRoom = kCapacity + 8;
  double corner[2][4][3][kRoom];  // time, corner, axis, polygon
  int corners = 3;
  int count = 0;
};

// How near to the origin moving polygons count: `reach`, or where one begins nearer, that share of its distance then;
// and `wider` beyond that.
struct PolygonReach {
  double reach = 0.0, share_of_gap = 1.0, wider = 0.0;
};

// The vertices of some clusters, one cluster after the other, owned ones first, times a power of two, and what rules
// each out: a bit for each side of a box.
struct alignas(64) ClusterPoints {
  static constexpr int kMost = 256;
  static constexpr int kRoom = kMost + 64;
  double at[3][kRoom];
  double together[4 * kRoom];  // the same vertex by vertex; the fourth number of each has no meaning
  std::uint8_t outside[kRoom + 64];
  int count = 0;
};

// Between which coordinates each vertex of a cluster stays on its way, owned ones first.
struct alignas(64) VertexWays {
  static constexpr int kRoom = 192 + 64;
  double lower[3][kRoom], upper[3][kRoom];
  int count = 0;
};

// Some features of a cluster, in its own numbers of vertices: `corners` of them each. 64 bytes of each array that is
// used may be read.
struct FeatureCorners {
  const std::uint8_t* corner[3];
  int corners;
  int count;      // up to 64
  int first = 0;  // the number of the first feature, where numbers are wanted; they follow each other
};

// Features of some clusters, and the cells of their boxes.
struct alignas(64) FeatureBlock {
  static constexpr int kCapacity = 64;
  FacetCells cells;
  std::int32_t feature[2 * kCapacity];    // their numbers
  std::uint8_t corner[3][2 * kCapacity];  // as the clusters' points are counted
  int count = 0;

  void clear() { count = cells.count = 0; }
};

// Those of a block that have a bit, and the points of their cluster.
struct PlacedFeatures {
  const ClusterPoints& points;
  const FeatureBlock& block;
  std::uint64_t some;
};

// Features, and the boxes of their ways.
struct alignas(64) FeatureWays {
  static constexpr int kRoom = 192 + 64;
  double lower[3][kRoom], upper[3][kRoom];
  std::uint8_t feature[kRoom], corner[3][kRoom];
  int count = 0;
};

// Pairs of edges of two meshes, by the vertices of each: its ends, and the third vertices of two facets that have it,
// or of one twice, or an end instead.
struct alignas(64) EdgePairs {
  static constexpr int kCapacity = 64;
  static constexpr int kRoom = kCapacity + 8;
  std::int32_t vertex[2][4][kRoom];  // mesh
  int count = 0;
};

// The side that edges are on: see nearest_between_edges().
enum class EdgeSide { before, passed };

// Facets of two meshes that meet, by pairs.
struct alignas(64) TrianglePairs {
  static constexpr int kCapacity = 64;
  static constexpr int kRoom = kCapacity + 8;
  double corner[2][3][3][kRoom];  // mesh, corner, axis
  int count = 0;
};

// A bit for each pair. Edge k leads from corner k of the first facet to the next one, edge 3 + k from corner k of the
// second facet.
struct EdgesThrough {
  std::uint64_t meeting[6];  // it certainly meets the other facet
  std::uint64_t undecided[6];
};

}  // namespace tact::narrowphase
