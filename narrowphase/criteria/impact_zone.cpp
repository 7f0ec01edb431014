#include "narrowphase/criteria/impact_zone.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "narrowphase/numeric/frame.h"
#include "narrowphase/numeric/unit_roundoff.h"

namespace tact::narrowphase {

// Why the disk encloses. Write H(x) for the real n · (x - origin), h(x) for the computed one; |H - h| <= e, the slab's
// error, at every vertex.
//
// - The planes of the clip are L <= lower - 2e and U >= upper + 2e, rounded outward.
//
// - Along an edge from p to q let h(t) = h(p) + t (h(q) - h(p)), a function of the computed heights taken as exact. The
//   real height of the same point is within e of it, for both are linear in t and the ends are. So the part of the edge
//   in the true slab, wider than the given one by e, lies in the part with L <= h(t) <= U. That part ends at p, at q or
//   at t = (L - h(p)) / (h(q) - h(p)), likewise for U.
//
// - A facet's part of the slab is the hull of its edges' parts. So the true zone lies in the hull of the projections of
//   such ends, in real arithmetic, and it is enough that each of them is near a point of the disk.
//
// - h(p) and h(q) being exact here, t has three roundings (two differences, one quotient), each relative to its result:
//   the computed t is off by at most 3.1 u, u = 2^-53, for t <= 1, however close h(p) and h(q) are. Where they are
//   close, L is not between them unless it is within rounding of both, and the widening of the planes has paid for
//   that.
//
// - A coordinate of a computed end is P + t (Q - P) from computed projections P and Q, off by e each, so their mean is
//   too. With R >= |P|, |Q|: the error of t gives 3.1 u 2R, the difference, the product and the sum u 2R, u 2R and u 3R
//   at most. Together less than e + 14 u R a coordinate, and less than 1.5 (e + 14 u R) in the plane.
//
// - The disk holds the computed ends in real arithmetic.
namespace {

double height_along(Vec3 axis, double x, double y, double z) { return (axis.x * x + axis.y * y) + axis.z * z; }

// The clip planes, in computed heights.
struct Planes {
  double low;
  double high;
};

Planes widened_planes(const Slab& slab) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {std::nextafter(slab.lower - 2.0 * slab.error, -infinity),
          std::nextafter(slab.upper + 2.0 * slab.error, infinity)};
}

// Computed heights of every vertex in a box lie between these: rounding is monotone, and the operations are the same.
Planes heights_of_box(BoxView boxes, std::size_t i, const Slab& slab) {
  Vec3 near, far;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = boxes.lower(axis)[i] - slab.origin[axis];
    const double upper = boxes.upper(axis)[i] - slab.origin[axis];
    near[axis] = slab.n[axis] >= 0.0 ? lower : upper;
    far[axis] = slab.n[axis] >= 0.0 ? upper : lower;
  }
  return {height_along(slab.n, near.x, near.y, near.z), height_along(slab.n, far.x, far.y, far.z)};
}

struct ProjectedVertex {
  Point2 point;
  double height = 0.0;
};

class Projection {
 public:
  Projection(const ClusteredMesh& mesh, const Slab& slab) : points_(mesh.points()), slab_(slab) {}

  double height(int vertex) const { return along(slab_.n, vertex); }
  Point2 point(int vertex) const { return {along(slab_.u, vertex), along(slab_.v, vertex)}; }

 private:
  double along(Vec3 axis, int vertex) const {
    return height_along(axis, points_.x[vertex] - slab_.origin.x, points_.y[vertex] - slab_.origin.y,
                        points_.z[vertex] - slab_.origin.z);
  }

  PointArrays points_;
  const Slab& slab_;
};

// The point where an edge crosses a plane strictly between its ends. Seen from the lower end, whichever facet asks.
void take_crossing(const ProjectedVertex& p, const ProjectedVertex& q, double plane, std::vector<Point2>& points) {
  const bool p_is_lower = p.height < q.height;
  const ProjectedVertex& low = p_is_lower ? p : q;
  const ProjectedVertex& high = p_is_lower ? q : p;
  if (!(low.height < plane && plane < high.height)) return;
  const double t = (plane - low.height) / (high.height - low.height);
  points.push_back({low.point.x + t * (high.point.x - low.point.x), low.point.y + t * (high.point.y - low.point.y)});
}

// The vertices between the planes that a cluster owns, and, if it `crosses` them, the points where edges of its facets
// do. A borrowed vertex between the planes is taken by its owner, whose box then reaches between them too.
void take_cluster(const ClusteredMesh& mesh, int cluster, const Projection& projection, Planes planes, bool crosses,
                  std::vector<Point2>& points) {
  const ClusterFacets facets = mesh.facets_of(cluster);
  const auto vertex = [&](int local) {
    return local < facets.owned_count ? facets.owned_begin + local : facets.borrowed[local - facets.owned_count];
  };
  double height[3 * kClusterSize];  // of each vertex of its facets, those that it owns first
  for (int i = 0; i < facets.owned_count; ++i) height[i] = projection.height(vertex(i));
  for (int i = 0; i < facets.owned_count; ++i) {
    if (planes.low <= height[i] && height[i] <= planes.high) points.push_back(projection.point(vertex(i)));
  }
  if (!crosses) return;
  const int count = facets.owned_count + facets.borrowed_count;
  for (int i = facets.owned_count; i < count; ++i) height[i] = projection.height(vertex(i));
  for (int f = 0; f < facets.facet_count; ++f) {
    const int corner[3] = {facets.corner[0][f], facets.corner[1][f], facets.corner[2][f]};
    const auto [lowest, highest] = std::minmax({height[corner[0]], height[corner[1]], height[corner[2]]});
    if (lowest > planes.high || highest < planes.low || (lowest >= planes.low && highest <= planes.high)) continue;
    ProjectedVertex p[3];
    for (int k = 0; k < 3; ++k) p[k] = {projection.point(vertex(corner[k])), height[corner[k]]};
    for (int k = 0; k < 3; ++k) {
      take_crossing(p[k], p[(k + 1) % 3], planes.low, points);
      take_crossing(p[k], p[(k + 1) % 3], planes.high, points);
    }
  }
}

// No vertex is farther from the origin than this, nor is any projection of it, computed or not, but for one part in
// 2^50.
double reach(const Box& box, Vec3 origin) {
  const Vec3 far = farthest_from(origin, box);
  return (far.x + far.y) + far.z;
}

}  // namespace

Slab make_slab(Vec3 n, Vec3 origin, double lower, double upper, double error) {
  const Frame frame = frame_across(n);
  return {n, frame.u, frame.v, origin, lower, upper, error};
}

ImpactZone impact_zone(const ClusteredMesh& mesh, const Slab& slab, std::vector<Point2>& scratch) {
  scratch.clear();
  const Projection projection(mesh, slab);
  const Planes planes = widened_planes(slab);
  for (int cluster = 0; cluster < mesh.cluster_count(); ++cluster) {
    const Planes heights = heights_of_box(mesh.cluster_boxes(), static_cast<std::size_t>(cluster), slab);
    if (heights.low > planes.high || heights.high < planes.low) continue;
    const bool crosses = heights.low < planes.low || heights.high > planes.high;
    take_cluster(mesh, cluster, projection, planes, crosses, scratch);
  }
  if (scratch.empty()) return {};
  constexpr double kUnderflow = 16.0 * std::numeric_limits<double>::denorm_min();  // of coordinates below 1e-290
  const double error = 1.5 * (slab.error + 16.0 * kUnitRoundoff * reach(mesh.box(), slab.origin)) + kUnderflow;
  return {smallest_enclosing_disk(scratch), error};
}

}  // namespace tact::narrowphase
