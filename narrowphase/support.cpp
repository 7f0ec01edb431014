#include "narrowphase/support.h"

#include <cassert>
#include <limits>

namespace tact::narrowphase {

namespace {

constexpr int kBlock = 256;  // groups whose bounds are looked at together

PointArrays from(PointArrays points, int first) { return {points.x + first, points.y + first, points.z + first}; }

class Search {
 public:
  Search(const ClusteredMesh& mesh, Vec3 n, Vec3 origin)
      : mesh_(mesh), axis_{n.x, n.y, n.z, origin.x, origin.y, origin.z} {}

  // Looks at the vertices that a cluster owns.
  void open(int cluster) {
    const int begin = mesh_.vertex_begin(cluster), count = mesh_.vertex_end(cluster) - begin;
    if (count == 0) return;
    const PointArrays points = from(mesh_.points(), begin);
    const HighestPoint top = kernels().highest_point(points, count, axis_);
    if (top.height < best_.height) return;
    const Support found{begin + top.index, top.height};
    if (top.height > best_.height || precedes(found)) best_ = found;
    if (top.several) lower_tie(points, cluster, top.index + 1);
  }

  void open_first(int cluster) {
    first_ = cluster;
    open(cluster);
  }

  // Looks at the clusters of a group that can hold the highest vertex, but for the first, which was looked at.
  void open_group(int group, PointArrays far_corners) {
    double bound[kGroupSize + kPadding];
    const int begin = mesh_.cluster_begin(group), count = mesh_.cluster_end(group) - begin;
    kernels().heights(from(far_corners, begin), count, axis_, bound);
    for (int i = 0; i < count; ++i) {
      if (bound[i] >= best_.height && begin + i != first_) open(begin + i);
    }
  }

  const Support& best() const { return best_; }
  const HeightAxis& axis() const { return axis_; }

 private:
  bool precedes(const Support& other) const {
    return best_.vertex < 0 || mesh_.source_vertex(other.vertex) < mesh_.source_vertex(best_.vertex);
  }

  // Of the cluster's vertices from `first` on that are as high as the best, the one with the lowest source vertex.
  void lower_tie(PointArrays points, int cluster, int first) {
    const int begin = mesh_.vertex_begin(cluster), count = mesh_.vertex_end(cluster) - begin;
    for (int i = first; i < count; ++i) {
      const double h = (axis_.nx * (points.x[i] - axis_.ox) + axis_.ny * (points.y[i] - axis_.oy)) +
                       axis_.nz * (points.z[i] - axis_.oz);
      const Support found{begin + i, h};
      if (h == best_.height && precedes(found)) best_ = found;
    }
  }

  const ClusteredMesh& mesh_;
  HeightAxis axis_;
  int first_ = -1;
  Support best_{-1, -std::numeric_limits<double>::infinity()};
};

}  // namespace

PointArrays far_corners(const BoxArrays& boxes, Vec3 n) {
  return {(n.x >= 0.0 ? boxes.upper[0] : boxes.lower[0]).data(), (n.y >= 0.0 ? boxes.upper[1] : boxes.lower[1]).data(),
          (n.z >= 0.0 ? boxes.upper[2] : boxes.lower[2]).data()};
}

Support support(const ClusteredMesh& mesh, Vec3 n, Vec3 origin) {
  assert(mesh.facet_count() > 0);
  Search search(mesh, n, origin);
  if (mesh.cluster_count() == 1) {
    search.open(0);
    return search.best();
  }
  const PointArrays groups = far_corners(mesh.group_boxes(), n), clusters = far_corners(mesh.cluster_boxes(), n);
  // The box that reaches farthest is the best first guess.
  const int first_group = kernels().highest_point(groups, mesh.group_count(), search.axis()).index;
  const int begin = mesh.cluster_begin(first_group), count = mesh.cluster_end(first_group) - begin;
  search.open_first(begin + kernels().highest_point(from(clusters, begin), count, search.axis()).index);
  double bound[kBlock + kPadding];
  for (int block = 0; block < mesh.group_count(); block += kBlock) {
    const int groups_left = std::min(kBlock, mesh.group_count() - block);
    kernels().heights(from(groups, block), groups_left, search.axis(), bound);
    for (int i = 0; i < groups_left; ++i) {
      if (bound[i] >= search.best().height) search.open_group(block + i, clusters);
    }
  }
  return search.best();
}

void select_clusters(const ClusteredMesh& mesh, const HeightAxis& axis, double height,
                     std::vector<std::int32_t>& found) {
  const Vec3 n{axis.nx, axis.ny, axis.nz};
  const PointArrays groups = far_corners(mesh.group_boxes(), n), clusters = far_corners(mesh.cluster_boxes(), n);
  found.clear();
  for (int block = 0; block < mesh.group_count(); block += kBlock) {
    std::int32_t chosen[kBlock], inside[kGroupSize];
    const int groups_left = std::min(kBlock, mesh.group_count() - block);
    const int count = kernels().select_heights(from(groups, block), groups_left, axis, height, chosen);
    for (int i = 0; i < count; ++i) {
      const int begin = mesh.cluster_begin(block + chosen[i]), end = mesh.cluster_end(block + chosen[i]);
      const int kept = kernels().select_heights(from(clusters, begin), end - begin, axis, height, inside);
      for (int k = 0; k < kept; ++k) found.push_back(begin + inside[k]);
    }
  }
}

Support support_by_full_scan(const ClusteredMesh& mesh, Vec3 n, Vec3 origin) {
  Search search(mesh, n, origin);
  for (int cluster = 0; cluster < mesh.cluster_count(); ++cluster) search.open(cluster);
  return search.best();
}

}  // namespace tact::narrowphase
