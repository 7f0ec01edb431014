#include "narrowphase/contact_points/open_features.h"

#include <algorithm>
#include <array>

namespace tact::narrowphase {

namespace {

static_assert(OpenFeatures::kMostBlocks * FeatureBlock::kCapacity + 64 <= kEachVertex.size());

int blocks_of(int count) { return (count + FeatureBlock::kCapacity - 1) / FeatureBlock::kCapacity; }

}  // namespace

void OpenFeatures::open(const ScaledMesh& m, int which, const Box& box, const Grid& grid, double widen) {
  const ClusterFacets all = m.mesh.facets_of(which);
  cluster = which;
  first_facet = all.facet_begin;
  first_vertex = all.owned_begin;
  first_edge = m.features.edge_begin(which);
  kernels().place_points(all, m.scale, bounds_of(box), &points);
  vertex_blocks = edge_blocks = 0;
  kernels().place_features(points, {{all.corner[0], all.corner[1], all.corner[2]}, 3, all.facet_count}, grid, widen,
                           &facets);
  if (facets.count == 0) return;  // then nothing else is near
  cells = kernels().cells_of(facets.cells, all_of(facets.count));
  vertex_blocks = blocks_of(all.owned_count);
  for (int k = 0; k < vertex_blocks; ++k) {
    const int first = k * FeatureBlock::kCapacity;
    const int count = std::min(all.owned_count - first, FeatureBlock::kCapacity);
    kernels().place_features(points, {{kEachVertex.data() + first}, 1, count}, grid, widen, &vertices[k]);
  }
  const int edges_in_all = m.features.edge_end(which) - first_edge;
  edge_blocks = blocks_of(edges_in_all);
  for (int k = 0; k < edge_blocks; ++k) {
    const int first = k * FeatureBlock::kCapacity;
    const auto corners = m.features.edge_corners(first_edge + first);
    const int count = std::min(edges_in_all - first, FeatureBlock::kCapacity);
    kernels().place_features(points, {{corners[0], corners[1]}, 2, count}, grid, widen, &edges[k]);
  }
}

Grid grid_over(const Box& box) {
  Grid grid{};
  for (int axis = 0; axis < 3; ++axis) {
    const double scale = kLastCell / (box.upper[axis] - box.lower[axis]);
    grid.origin[axis] = box.lower[axis];
    grid.scale[axis] = scale > 0.0 && scale < 0x1p900 ? scale : 0.0;
  }
  return grid;
}

}  // namespace tact::narrowphase
