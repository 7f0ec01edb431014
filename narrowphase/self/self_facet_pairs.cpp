#include "narrowphase/self/self_facet_pairs.h"

#include <algorithm>

#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

namespace {

// The facets of a cluster: corners, and boxes in arrays.
struct OpenFacets : FixedBoxes<kClusterSize> {
  int cluster = -1;
  Corners corners[kClusterSize];

  void open(const ClusteredMesh& mesh, int wanted) {
    cluster = wanted;
    count = 0;
    for (int f = mesh.facet_begin(wanted); f < mesh.facet_end(wanted); ++f) {
      corners[count] = mesh.corners(f);
      Box box;
      for (const int v : corners[count]) box = extended(box, mesh.position(v));
      set(count++, box);
    }
  }
};

bool share_a_vertex(const Corners& a, const Corners& b) { return std::ranges::find_first_of(a, b) != a.end(); }

// Does the plane of three points leave three others strictly on one side? Certain: the error of the dot product is at
// most 16 roundings of the sum of its products' sizes.
bool plane_separates(const Triangle& plane, const Triangle& other) {
  const Vec3 u = plane[1] - plane[0], v = plane[2] - plane[0], n = cross(u, v);
  const auto size = [](Vec3 p) { return Vec3{std::abs(p.x), std::abs(p.y), std::abs(p.z)}; };
  const Vec3 su = size(u), sv = size(v);
  const Vec3 sn{su.y * sv.z + su.z * sv.y, su.z * sv.x + su.x * sv.z, su.x * sv.y + su.y * sv.x};
  int above = 0, below = 0;
  for (const Vec3 p : other) {
    const Vec3 way = p - plane[0];
    const double height = dot(n, way), bound = 16 * 0x1p-53 * dot(sn, size(way));
    if (!(bound > 0x1p-900 && bound < 0x1p900)) return false;
    above += height > bound ? 1 : 0;
    below += height < -bound ? 1 : 0;
  }
  return above == 3 || below == 3;
}

}  // namespace

void find_self_facet_pairs(const ClusteredMesh& mesh, std::span<const ClusterPair> pairs,
                           std::vector<FacetPair>& found) {
  OpenFacets a, b;
  PredicateCounts counts;
  std::int32_t near[kClusterSize + kPadding];
  for (const ClusterPair& pair : pairs) {
    if (a.cluster != pair.a) a.open(mesh, pair.a);
    if (b.cluster != pair.b) b.open(mesh, pair.b);
    const Box other = mesh.cluster_boxes()[pair.b];
    for (int i = 0; i < a.count; ++i) {
      if (!overlaps(a.box(i), other)) continue;
      const int count = kernels().select_overlapping(b.pointers(), b.count, bounds_of(a.box(i)), near);
      for (int n = 0; n < count; ++n) {
        const int k = near[n];
        if ((pair.a == pair.b && k <= i) || share_a_vertex(a.corners[i], b.corners[k])) continue;
        const int f = mesh.facet_begin(pair.a) + i, g = mesh.facet_begin(pair.b) + k;
        const Triangle at_f = mesh.triangle(f), at_g = mesh.triangle(g);
        if (plane_separates(at_f, at_g) || plane_separates(at_g, at_f)) continue;
        if (!triangle_triangle_meet(at_f, at_g, counts)) continue;
        const auto [first, second] = std::minmax({mesh.source_facet(f), mesh.source_facet(g)});
        found.push_back({first, second});
      }
    }
  }
}

}  // namespace tact::narrowphase
