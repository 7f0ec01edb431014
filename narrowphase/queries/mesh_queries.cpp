#include "narrowphase/queries/mesh_queries.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "narrowphase/mesh/cluster_search.h"
#include "narrowphase/mesh/open_in_box.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/queries/prepared_segment.h"

namespace tact::narrowphase {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Boxes are opened while they may hold something as near as what was found: to the rounding of the square of the
// distance. Then the answer does not depend on their order.
constexpr double kSquareRounding = 1.0 + 0x1p-40;

Box box_of(const Triangle& triangle) {
  Box box;
  for (const Vec3& p : triangle) box = extended(box, p);
  return box;
}

Triangle triangle_in(const FacetBlock& facets, int i) {
  const auto corner = [&](int k) {
    const auto& at = facets.corner[k];
    return Vec3{at[0][i], at[1][i], at[2][i]};
  };
  return {corner(0), corner(1), corner(2)};
}

// Calls visit(hit) for each facet that the segment meets, in clusters that it may reach by `latest`, which visit may
// lower.
template <class Visit>
void for_each_hit(const ClusteredMesh& mesh, const PreparedSegment& line, const double& latest, const Visit& visit) {
  if (mesh.facet_count() == 0) return;
  PredicateCounts counts;
  const auto rank = [&](const BoxPointers& boxes, int count, RankedBoxes& ranked) {
    kernels().rank_by_entry(boxes, count, line.slabs(), latest, &ranked);
  };
  const auto wants = [&](double entry) { return entry <= latest; };
  for_each_cluster_by_rank(mesh, rank, wants, [&](int cluster) {
    for (std::uint64_t left = line.facets_seen(mesh, cluster); left != 0; left &= left - 1) {
      const int f = mesh.facet_begin(cluster) + std::countr_zero(left);
      if (const auto place = line.meet(mesh.triangle(f), counts))
        visit(FacetHit{mesh.source_facet(f), place->time, place->weight});
    }
  });
}

// The turn of a, b, c in the plane of y and z, where c is moved off all lines.
int turn(const Vec3& a, const Vec3& b, const Vec3& c, PredicateCounts& counts) {
  const int sign = orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}, counts);
  if (sign != 0) return sign;
  // c moves by more along y than along z: the derivatives of (a - c) × (b - c).
  if (a.z != b.z) return a.z > b.z ? 1 : -1;
  if (a.y != b.y) return a.y < b.y ? 1 : -1;
  return 0;
}

}  // namespace

std::optional<FacetHit> first_hit(const ClusteredMesh& mesh, const PreparedSegment& line, double latest) {
  std::optional<FacetHit> first;
  for_each_hit(mesh, line, latest, [&](const FacetHit& hit) {
    if (hit.time > latest || (first && !(hit < *first))) return;
    first = hit;
    latest = hit.time;
  });
  return first;
}

std::optional<FacetHit> any_hit(const ClusteredMesh& mesh, const PreparedSegment& line) {
  std::optional<FacetHit> any;
  double latest = 1.0;
  for_each_hit(mesh, line, latest, [&](const FacetHit& hit) {
    if (!any) any = hit;
    latest = -1.0;
  });
  return any;
}

void append_hits(const ClusteredMesh& mesh, const PreparedSegment& line, std::vector<FacetHit>& hits) {
  const double latest = 1.0;
  for_each_hit(mesh, line, latest, [&](const FacetHit& hit) { hits.push_back(hit); });
}

std::optional<NearestFacet> nearest_facet(const ClusteredMesh& mesh, Vec3 point, double within) {
  if (mesh.facet_count() == 0) return std::nullopt;
  // Distances are squared in a unit in which the farthest is near 1.
  const Box& box = mesh.box();
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(point[axis] - box.lower[axis]), std::abs(point[axis] - box.upper[axis])});
  const double scale = unit_scale(largest);
  double least = scale * within < 16.0 ? (scale * within) * (scale * within) : kInfinity;
  std::optional<NearestFacet> nearest;
  const double at[3] = {point.x, point.y, point.z};
  const auto rank = [&](const BoxPointers& boxes, int count, RankedBoxes& ranked) {
    kernels().rank_by_distance(boxes, count, at, scale, least * kSquareRounding, &ranked);
  };
  const auto wants = [&](double square) { return square <= least * kSquareRounding; };
  FacetDistances ranked;
  for_each_cluster_by_rank(mesh, rank, wants, [&](int cluster) {
    const ClusterFacets facets = mesh.facets_of(cluster);
    kernels().rank_facets(facets, at, scale, least * kSquareRounding, &ranked);
    take_by_rank(ranked.least_squared, ranked.facet, ranked.count, wants, [&](int i) {
      const int f = facets.facet_begin + i;
      Triangle triangle = mesh.triangle(f);
      for (Vec3& p : triangle) p = scale * (p - point);
      const std::array<double, 3> weight = nearest_weights({}, triangle);
      const double distance2 = norm_squared(place_of(triangle, weight));
      const int facet = mesh.source_facet(f);
      if (distance2 > least || (nearest && distance2 == least && facet > nearest->facet)) return;
      least = distance2;
      nearest = {facet, std::sqrt(distance2) / scale, weight};
    });
  });
  return nearest;
}

void append_facets_in_box(const ClusteredMesh& mesh, const Box& box, std::vector<int>& facets) {
  // The sides of the box, two triangles each.
  std::array<Triangle, 12> sides;
  std::size_t count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const Vec3& from : {box.lower, box.upper}) {
      Vec3 corner[4];
      for (int k = 0; k < 4; ++k) {
        corner[k] = from;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        corner[k][u] = (k == 1 || k == 2 ? box.upper : box.lower)[u];
        corner[k][v] = (k >= 2 ? box.upper : box.lower)[v];
      }
      sides[count++] = {corner[0], corner[1], corner[2]};
      sides[count++] = {corner[0], corner[2], corner[3]};
    }
  }
  PredicateCounts counts;
  for_each_cluster_in(mesh, box, [&](int cluster) {
    for (int f = mesh.facet_begin(cluster); f < mesh.facet_end(cluster); ++f) {
      const Triangle triangle = mesh.triangle(f);
      if (!overlaps(box_of(triangle), box)) continue;
      const bool meets = std::ranges::any_of(triangle, [&](const Vec3& p) { return contains(box, p); }) ||
                         std::ranges::any_of(sides, [&](const Triangle& side) {
                           return triangle_triangle_meet(triangle, side, counts);
                         });
      if (meets) facets.push_back(mesh.source_facet(f));
    }
  });
}

bool contains(const ClusteredMesh& mesh, Vec3 point) {
  PredicateCounts counts;
  int winding = 0;
  bool on_surface = false;
  const Box half_line{point, {kInfinity, point.y, point.z}};
  const CullPlanes along_ray = planes_of(half_line);
  FacetBlock facets;
  for_each_cluster_in(mesh, half_line, [&](int cluster) {
    facets.count = 0;
    kernels().open_cluster(mesh.facets_of(cluster), along_ray, &facets);
    for (int i = 0; i < facets.count && !on_surface; ++i) {
      const Triangle t = triangle_in(facets, i);
      if (contains(box_of(t), point) && triangle_triangle_meet(t, {point, point, point}, counts)) {
        on_surface = true;
        continue;
      }
      const int side = turn(t[0], t[1], point, counts);
      if (side == 0 || turn(t[1], t[2], point, counts) != side || turn(t[2], t[0], point, counts) != side) continue;
      // The facet is met if the point is on the side of its plane that lies towards -x.
      if (orient3d(t[0], t[1], t[2], point, counts) == side) winding += side;
    }
  });
  return on_surface || winding != 0;
}

}  // namespace tact::narrowphase
