// The features of a cluster, or of some, that are near another mesh, side by side, for loops that compare many at once.
#pragma once

#include "narrowphase/contact_points/scaled_mesh.h"
#include "narrowphase/pairs/box_reach.h"

namespace tact::narrowphase {

/// A bit for each of `count` features.

struct OpenFeatures {
  static constexpr int kMostBlocks = 3;

  int cluster = -1;      // the last one
  ClusterPoints points;  // scaled, as all below
  FeatureBlock facets;
  FeatureBlock vertices[kMostBlocks];  // those that the clusters own
  FeatureBlock edges[kMostBlocks];     // those of which the first facet is in the clusters
  int vertex_blocks = 0, edge_blocks = 0;
  CellBox cells;  // of the facets, if there are any

  void clear();
  /// What of a cluster reaches into `box`, alone; their own boxes are widened by `widen` before they are put into the
  /// grid.
  void open(const ScaledMesh& m, int which, const Box& box, const Grid& grid, double widen);
  /// The same of one more cluster. False, and nothing has changed, if it has too many.
  bool append(const ScaledMesh& m, int which, const Box& box, const Grid& grid, double widen);
};

/// A grid of that box. Where it has no length, or next to none, all is in one cell.
Grid grid_over(const Box& box);

}  // namespace tact::narrowphase
