#include "narrowphase/crossing/facing_clusters.h"

#include <algorithm>

namespace tact::narrowphase {

namespace {

// Rounding turns a normal, however it is computed, by less than 2^-44 times the size of the facet's box over its
// length: see FacingTest in kernels/queries.inl.
constexpr double kTurn = 0x1p-43;

}  // namespace

void FacingClusters::add(const FacetBlock& facets, double scale) {
  Box normals;
  for (int i = 0; i < facets.count; ++i) {
    Vec3 normal;
    double size = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      normal[axis] = scale * scale * facets.normal[axis][i];
      size += scale * (facets.upper[axis][i] - facets.lower[axis][i]);
    }
    const double length = norm(normal), turn = kTurn * size / length + 0x1p-40;
    const bool is_any = !(length > 0.0 && turn < 1.0);
    const Box one = is_any ? Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}}
                           : grown(Box{(1.0 / length) * normal, (1.0 / length) * normal}, turn);
    normals = merged(normals, one);
  }
  clusters_.push_back(normals);
}

void FacingClusters::merge_groups(const ClusteredMesh& mesh) {
  groups_.assign(mesh.group_count(), {});
  for (int group = 0; group < mesh.group_count(); ++group) {
    for (int c = mesh.cluster_begin(group); c < mesh.cluster_end(group); ++c)
      groups_[group] = merged(groups_[group], clusters_[c]);
  }
}

bool FacingClusters::turned_away(const Box& normals, const FacingNormals& facing) {
  double most = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = facing.direction[axis];
    most += std::max(along * normals.lower[axis], along * normals.upper[axis]);
  }
  return most < facing.cosine - 0x1p-40;
}

}  // namespace tact::narrowphase
