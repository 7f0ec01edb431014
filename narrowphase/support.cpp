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

  // Looks at vertices begin <= v < end.
  void open(int begin, int end) {
    if (begin == end) return;
    std::int32_t index = 0;
    const PointArrays points = from(mesh_.points(), begin);
    const double height = kernels().max_height(points, end - begin, axis_, &index);
    if (height > best_.height) {
      best_ = {begin + index, height};
      lower_tie(points, begin, end - begin, index + 1);
    } else if (height == best_.height) {
      lower_tie(points, begin, end - begin, index);
    }
  }

  void open_cluster(int cluster) { open(mesh_.vertex_begin(cluster), mesh_.vertex_end(cluster)); }

  const Support& best() const { return best_; }
  const HeightAxis& axis() const { return axis_; }

 private:
  // Of the vertices from `first` on that are as high as the best, the one with the lowest source vertex.
  void lower_tie(PointArrays points, int begin, int count, int first) {
    for (int i = first; i < count; ++i) {
      const double h = (axis_.nx * (points.x[i] - axis_.ox) + axis_.ny * (points.y[i] - axis_.oy)) +
                       axis_.nz * (points.z[i] - axis_.oz);
      if (h == best_.height && mesh_.source_vertex(begin + i) < mesh_.source_vertex(best_.vertex)) best_.vertex = begin + i;
    }
  }

  const ClusteredMesh& mesh_;
  HeightAxis axis_;
  Support best_{-1, -std::numeric_limits<double>::infinity()};
};

// The corners of the cluster boxes that lie farthest along n.
PointArrays far_corners(const BoxArrays& boxes, Vec3 n) {
  return {(n.x >= 0.0 ? boxes.upper[0] : boxes.lower[0]).data(), (n.y >= 0.0 ? boxes.upper[1] : boxes.lower[1]).data(),
          (n.z >= 0.0 ? boxes.upper[2] : boxes.lower[2]).data()};
}

}  // namespace

Support support(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, int first_cluster) {
  assert(mesh.facet_count() > 0);
  Search search(mesh, n, origin);
  search.open_cluster(first_cluster);
  const PointArrays bounds = far_corners(mesh.cluster_boxes(), n);
  std::int32_t chosen[kBlock];
  for (int begin = 0; begin < mesh.cluster_count(); begin += kBlock) {
    const PointArrays block = from(bounds, begin);
    const int count = std::min(kBlock, mesh.cluster_count() - begin);
    const int found = kernels().select_heights(block, count, search.axis(), search.best().height, chosen);
    for (int i = 0; i < found; ++i) {
      std::int32_t ignored = 0;
      const double bound = kernels().max_height(from(block, chosen[i]), 1, search.axis(), &ignored);
      if (begin + chosen[i] != first_cluster && bound >= search.best().height) search.open_cluster(begin + chosen[i]);
    }
  }
  return search.best();
}

Support support_by_full_scan(const ClusteredMesh& mesh, Vec3 n, Vec3 origin) {
  Search search(mesh, n, origin);
  search.open(0, mesh.vertex_count());
  return search.best();
}

}  // namespace tact::narrowphase
