#include "narrowphase/support.h"

#include <cassert>
#include <limits>

namespace tact::narrowphase {

namespace {

constexpr int kBlock = 256;  // clusters whose bounds are looked at together

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
    const Support found{begin + top.index, cluster, top.height};
    if (top.height > best_.height || precedes(found)) best_ = found;
    if (top.several) lower_tie(points, cluster, top.index + 1);
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
      const Support found{begin + i, cluster, h};
      if (h == best_.height && precedes(found)) best_ = found;
    }
  }

  const ClusteredMesh& mesh_;
  HeightAxis axis_;
  Support best_{-1, 0, -std::numeric_limits<double>::infinity()};
};

}  // namespace

PointArrays far_corners(const BoxArrays& boxes, Vec3 n) {
  return {(n.x >= 0.0 ? boxes.upper[0] : boxes.lower[0]).data(), (n.y >= 0.0 ? boxes.upper[1] : boxes.lower[1]).data(),
          (n.z >= 0.0 ? boxes.upper[2] : boxes.lower[2]).data()};
}

Support support(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, int first_cluster) {
  assert(mesh.facet_count() > 0);
  Search search(mesh, n, origin);
  const PointArrays bounds = far_corners(mesh.cluster_boxes(), n);
  double bound[kBlock + kPadding];
  // The box that reaches farthest is the best first guess, but asking for it costs a pass over all boxes.
  if (mesh.cluster_count() <= kBlock) first_cluster = kernels().highest_point(bounds, mesh.cluster_count(), search.axis()).index;
  search.open(first_cluster);
  for (int begin = 0; begin < mesh.cluster_count(); begin += kBlock) {
    const int count = std::min(kBlock, mesh.cluster_count() - begin);
    kernels().heights(from(bounds, begin), count, search.axis(), bound);
    for (int i = 0; i < count; ++i) {
      if (bound[i] >= search.best().height && begin + i != first_cluster) search.open(begin + i);
    }
  }
  return search.best();
}

Support support_by_full_scan(const ClusteredMesh& mesh, Vec3 n, Vec3 origin) {
  Search search(mesh, n, origin);
  for (int cluster = 0; cluster < mesh.cluster_count(); ++cluster) search.open(cluster);
  return search.best();
}

}  // namespace tact::narrowphase
