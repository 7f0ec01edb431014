#include "narrowphase/hull/support.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "narrowphase/mesh/chosen_groups.h"

namespace tact::narrowphase {

namespace {

constexpr int kFew = 8;  // clusters

PointArrays from(PointArrays points, int first) { return {points.x + first, points.y + first, points.z + first}; }

// The clusters of a group whose box reaches up to `height`, ascending; how many, at most kGroupSize.
int reaching_clusters(const ClusteredMesh& mesh, int group, const PointArrays& far_corners, const HeightAxis& axis,
                      double height, std::int32_t* found) {
  const int begin = mesh.cluster_begin(group), count = mesh.cluster_end(group) - begin;
  const int reaching = kernels().select_heights(from(far_corners, begin), count, axis, height, found);
  if (begin > 0) std::for_each_n(found, reaching, [begin](std::int32_t& cluster) { cluster += begin; });
  return reaching;
}

// The highest of the vertices that some clusters own, at most kGroupSize of them, ascending.
HighestPoint highest_vertex(const ClusteredMesh& mesh, const std::int32_t* clusters, int count, const HeightAxis& axis,
                            double least) {
  IndexRange ranges[kGroupSize];
  int last = -1;
  for (int k = 0; k < count; ++k) {
    const int begin = mesh.vertex_begin(clusters[k]), end = mesh.vertex_end(clusters[k]);
    if (last >= 0 && ranges[last].end == begin) {
      ranges[last].end = end;
    } else {
      ranges[++last] = {begin, end};
    }
  }
  return kernels().highest_point(mesh.points(), mesh.source_vertices(), ranges, last + 1, axis, least);
}

// Calls work(g) for the groups whose box reaches up to `height`.
template <class Work>
void for_reaching_groups(const ClusteredMesh& mesh, const HeightAxis& axis, double height, const Work& work) {
  const PointArrays groups = far_corners(mesh.group_boxes(), {axis.nx, axis.ny, axis.nz});
  const auto select = [&](int begin, int count, std::int32_t* chosen) {
    return kernels().select_heights(from(groups, begin), count, axis, height, chosen);
  };
  for_chosen_groups(mesh, select, work);
}

class SupportSearch {
 public:
  SupportSearch(const ClusteredMesh& mesh, Vec3 n, Vec3 origin)
      : mesh_(mesh), axis_{n.x, n.y, n.z, origin.x, origin.y, origin.z} {}

  // Looks at one vertex.
  void start_at(int vertex) {
    const Vec3 p = mesh_.position(vertex);
    best_ = {vertex, height_of(p.x, p.y, p.z) + 0.0};
  }

  // Looks at the vertices that some clusters own, given in ascending order.
  void open(const std::int32_t* clusters, int count) {
    const HighestPoint top = highest_vertex(mesh_, clusters, count, axis_, best_.height);
    if (top.index < 0) return;
    if (top.height > best_.height || precedes(top.index)) best_ = {top.index, top.height};
  }

  // Looks at the clusters of a group that can hold the highest vertex: all that reach above the best so far if these
  // are few, else the one that reaches farthest first.
  void open_group(int group, const PointArrays& far_corners) {
    std::int32_t reaching[kGroupSize];
    const auto select = [&] { return reaching_clusters(mesh_, group, far_corners, axis_, best_.height, reaching); };
    int found = select();
    if (found > kFew) {
      const IndexRange clusters{mesh_.cluster_begin(group), mesh_.cluster_end(group)};
      const std::int32_t first = kernels().highest_point(far_corners, nullptr, &clusters, 1, axis_, best_.height).index;
      open(&first, 1);
      found = select();
    }
    if (found > 0) open(reaching, found);
  }

  const Support& best() const { return best_; }
  const HeightAxis& axis() const { return axis_; }

 private:
  bool precedes(int vertex) const {
    return best_.vertex < 0 || mesh_.source_vertex(vertex) < mesh_.source_vertex(best_.vertex);
  }

  double height_of(double x, double y, double z) const {
    return (axis_.nx * (x - axis_.ox) + axis_.ny * (y - axis_.oy)) + axis_.nz * (z - axis_.oz);
  }

  const ClusteredMesh& mesh_;
  HeightAxis axis_;
  Support best_{-1, -std::numeric_limits<double>::infinity()};
};

}  // namespace

PointArrays far_corners(BoxView boxes, Vec3 n) {
  return {n.x >= 0.0 ? boxes.upper(0) : boxes.lower(0), n.y >= 0.0 ? boxes.upper(1) : boxes.lower(1),
          n.z >= 0.0 ? boxes.upper(2) : boxes.lower(2)};
}

Support support(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, int near) {
  assert(mesh.facet_count() > 0);
  if (mesh.cluster_count() == 1) return support_by_full_scan(mesh, n, origin);
  SupportSearch search(mesh, n, origin);
  if (near >= 0) search.start_at(near);
  const PointArrays groups = far_corners(mesh.group_boxes(), n), clusters = far_corners(mesh.cluster_boxes(), n);
  int first = -1;
  if (mesh.group_count() > 1) {
    const IndexRange all{0, mesh.group_count()};
    first = kernels()
                .highest_point(groups, nullptr, &all, 1, search.axis(), -std::numeric_limits<double>::infinity())
                .index;
    search.open_group(first, clusters);
  }
  const auto higher = [&](int begin, int count, std::int32_t* chosen) {
    return kernels().select_heights(from(groups, begin), count, search.axis(), search.best().height, chosen);
  };
  for_chosen_groups(mesh, higher, [&](int group) {
    if (group != first) search.open_group(group, clusters);
  });
  return search.best();
}

bool stays_below(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, double height) {
  const HeightAxis axis{n.x, n.y, n.z, origin.x, origin.y, origin.z};
  const PointArrays clusters = far_corners(mesh.cluster_boxes(), n);
  bool reached = false;
  for_reaching_groups(mesh, axis, height, [&](int group) {
    if (reached) return;
    std::int32_t near[kGroupSize];
    const int found = reaching_clusters(mesh, group, clusters, axis, height, near);
    reached = found > 0 && highest_vertex(mesh, near, found, axis, height).index >= 0;
  });
  return !reached;
}

void select_vertices(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, double height, std::vector<std::int32_t>& found) {
  const HeightAxis axis{n.x, n.y, n.z, origin.x, origin.y, origin.z};
  const PointArrays clusters = far_corners(mesh.cluster_boxes(), n);
  found.clear();
  for_reaching_groups(mesh, axis, height, [&](int group) {
    std::int32_t inside[kGroupSize];
    const int kept = reaching_clusters(mesh, group, clusters, axis, height, inside);
    for (int k = 0; k < kept; ++k) {
      const int begin = mesh.vertex_begin(inside[k]), count = mesh.vertex_end(inside[k]) - begin;
      const std::size_t before = found.size();
      found.resize(before + static_cast<std::size_t>(count));
      std::int32_t* const chosen = found.data() + before;
      const int high = kernels().select_heights(from(mesh.points(), begin), count, axis, height, chosen);
      std::for_each_n(chosen, high, [begin](std::int32_t& vertex) { vertex += begin; });
      found.resize(before + static_cast<std::size_t>(high));
    }
  });
}

Support support_by_full_scan(const ClusteredMesh& mesh, Vec3 n, Vec3 origin) {
  const HeightAxis axis{n.x, n.y, n.z, origin.x, origin.y, origin.z};
  const IndexRange all{0, mesh.vertex_count()};
  const HighestPoint top = kernels().highest_point(mesh.points(), mesh.source_vertices(), &all, 1, axis,
                                                   -std::numeric_limits<double>::infinity());
  return {top.index, top.height};
}

}  // namespace tact::narrowphase
