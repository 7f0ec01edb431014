#include "narrowphase/contact_points/open_features.h"

#include <algorithm>
#include <bit>

#include "engine/base/lowest_bits.h"

namespace tact::narrowphase {

namespace {

static_assert(OpenFeatures::kMostBlocks * FeatureBlock::kCapacity + 64 <= kEachVertex.size());

// The first of the bits, as many as there is room for.
std::uint64_t first_bits(std::uint64_t bits, int room) {
  if (std::popcount(bits) <= room) return bits;
  std::uint64_t first = 0;
  for (; room > 0; --room, bits &= bits - 1) first |= bits & -bits;
  return first;
}

// A cluster as it is put among others.
struct PlacedCluster {
  const ClusterPoints& points;
  int first_point;
  const Grid& grid;
  double widen;

  std::uint64_t left(const FeatureCorners& features) const {
    return kernels().features_left(points, first_point, features);
  }
  void place(const FeatureCorners& features, std::uint64_t some, FeatureBlock& block) const {
    kernels().place_features(points, first_point, features, some, grid, widen, &block);
  }
  // Into the last block, and then into new ones.
  void append(const FeatureCorners& features, FeatureBlock* block, int& blocks) const {
    for (std::uint64_t rest = left(features); rest != 0;) {
      if (blocks == 0 || block[blocks - 1].count == FeatureBlock::kCapacity) block[blocks++].clear();
      FeatureBlock& last = block[blocks - 1];
      const std::uint64_t some = first_bits(rest, FeatureBlock::kCapacity - last.count);
      place(features, some, last);
      rest ^= some;
    }
  }
};

}  // namespace

void OpenFeatures::clear() {
  cluster = -1;
  points.count = vertex_blocks = edge_blocks = 0;
  facets.clear();
}

void OpenFeatures::open(const ScaledMesh& m, int which, const Box& box, const Grid& grid, double widen) {
  clear();
  append(m, which, box, grid, widen);
}

// A vertex or an edge that reaches into the box is of a facet that does: there are at most three times as many.
bool OpenFeatures::append(const ScaledMesh& m, int which, const Box& box, const Grid& grid, double widen) {
  const ClusterFacets all = m.mesh.facets_of(which);
  const PlacedCluster placed{points, points.count, grid, widen};
  if (points.count + all.owned_count + all.borrowed_count > ClusterPoints::kMost) return false;
  kernels().place_points(all, m.scale, bounds_of(box), &points);
  const FeatureCorners of_facets{{all.corner[0], all.corner[1], all.corner[2]}, 3, all.facet_count, all.facet_begin};
  const std::uint64_t near = placed.left(of_facets);
  const bool fits = facets.count + std::popcount(near) <= FeatureBlock::kCapacity;
  if (fits) cluster = which;
  if (!fits || near == 0) {
    points.count = placed.first_point;
    return fits;
  }
  placed.place(of_facets, near, facets);
  cells = kernels().cells_of(facets.cells, base::lowest_bits(facets.count));
  for (int first = 0; first < all.owned_count; first += FeatureBlock::kCapacity) {
    const int count = std::min(all.owned_count - first, FeatureBlock::kCapacity);
    placed.append({{kEachVertex.data() + first}, 1, count, all.owned_begin + first}, vertices, vertex_blocks);
  }
  const int end = m.features.edge_end(which);
  for (int first = m.features.edge_begin(which); first < end; first += FeatureBlock::kCapacity) {
    const auto corners = m.features.edge_corners(first);
    placed.append({{corners[0], corners[1]}, 2, std::min(end - first, FeatureBlock::kCapacity), first}, edges,
                  edge_blocks);
  }
  return true;
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
