// The features of a cluster that are near another mesh, side by side, for loops that compare many at once.
#pragma once

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

inline Box inflated(const Box& box, double by) { return {box.lower - Vec3{by, by, by}, box.upper + Vec3{by, by, by}}; }

/// A bit for each of `count` features.
inline std::uint64_t all_of(int count) { return count == 0 ? 0 : ~std::uint64_t{0} >> (64 - count); }

struct OpenFeatures {
  static constexpr int kMostBlocks = 3;

  int cluster = -1;
  ClusterPoints points;  // scaled, as all below
  int first_facet = 0, first_vertex = 0, first_edge = 0;
  FeatureBlock facets;
  FeatureBlock vertices[kMostBlocks];  // those that the cluster owns
  FeatureBlock edges[kMostBlocks];     // those of which the first facet is in the cluster
  int vertex_blocks = 0, edge_blocks = 0;
  CellBox cells;  // of the facets, if there are any

  /// Those that reach into `box`; their own boxes are widened by `widen` before they are put into the grid.
  void open(const ScaledMesh& m, int which, const Box& box, const Grid& grid, double widen);

  int facet(int i) const { return first_facet + facets.feature[i]; }
  int vertex(int block, int i) const { return first_vertex + 64 * block + vertices[block].feature[i]; }
  int edge(int block, int i) const { return first_edge + 64 * block + edges[block].feature[i]; }
};

/// A grid of that box. Where it has no length, or next to none, all is in one cell.
Grid grid_over(const Box& box);

}  // namespace tact::narrowphase
