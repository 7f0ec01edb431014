#include "narrowphase/mesh/rigid_box.h"

#include <limits>

namespace tact::narrowphase {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The highest of what row . p + t is for the vertices p at rest, computed as placed() does. A sum of products rounds in
// the order of its terms, so the far corner of a box is never lower than what stands in it (pose.h): a cluster whose
// corner is not above the best vertex so far holds no higher one.
class HighestPlaced {
 public:
  HighestPlaced(const ClusteredMesh& mesh, Vec3 row, double translation)
      : mesh_(mesh), rest_(mesh.placements().before()), row_(row), translation_(translation) {}

  double find() {
    for (int g = 0; g < mesh_.group_count(); ++g) open_group(g);
    return best_;
  }

 private:
  double height(Vec3 p) const { return dot(row_, p) + translation_; }
  double highest_in(const Box& box) const {
    Vec3 corner;
    for (int k = 0; k < 3; ++k) corner[k] = row_[k] >= 0.0 ? box.upper[k] : box.lower[k];
    return height(corner);
  }

  // The cluster that reaches highest comes first: few others are left then.
  void open_group(int group) {
    double reach[kGroupSize] = {};
    const int begin = mesh_.cluster_begin(group), count = mesh_.cluster_end(group) - begin;
    int first = 0;
    for (int i = 0; i < count; ++i) {
      reach[i] = highest_in(rest_.cluster_boxes[begin + i]);
      if (reach[i] > reach[first]) first = i;
    }
    if (reach[first] > best_) open_cluster(begin + first);
    for (int i = 0; i < count; ++i) {
      if (i != first && reach[i] > best_) open_cluster(begin + i);
    }
  }

  void open_cluster(int cluster) {
    const PointArrays& p = rest_.points;
    const auto look_at = [&](int v) {
      const double h = height({p.x[v], p.y[v], p.z[v]});
      best_ = h > best_ ? h : best_;
    };
    for (int v = mesh_.vertex_begin(cluster); v < mesh_.vertex_end(cluster); ++v) look_at(v);
    const ClusterFacets facets = mesh_.facets_of(cluster);
    for (int k = 0; k < facets.borrowed_count; ++k) look_at(facets.borrowed[k]);
  }

  const ClusteredMesh& mesh_;
  Placement rest_;
  Vec3 row_;
  double translation_;
  double best_ = -kInfinity;
};

}  // namespace

Box box_at_pose(const ClusteredMesh& mesh, const Pose& pose) {
  Box box;
  if (mesh.facet_count() == 0) return box;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 row = pose.rows[axis];
    const double t = pose.translation[axis];
    // Rounding to nearest does not change with the sign. Adding zero turns -0 into +0, as a refit does.
    box.lower[axis] = -HighestPlaced(mesh, -1.0 * row, -t).find() + 0.0;
    box.upper[axis] = HighestPlaced(mesh, row, t).find() + 0.0;
  }
  return box;
}

}  // namespace tact::narrowphase
