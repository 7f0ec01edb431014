#include "narrowphase/queries/mesh_queries.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "narrowphase/distance/facet_distance.h"
#include "narrowphase/mesh/cluster_search.h"
#include "narrowphase/mesh/mesh_parts.h"
#include "narrowphase/mesh/open_in_box.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/queries/prepared_segment.h"

namespace tact::narrowphase {

namespace {

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
      if (!mesh.is_of_surface(mesh.source_facet(f))) continue;
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

bool are_inside(const ClusteredMesh& mesh, std::span<const int> vertices, const ClusteredMesh& outer) {
  return std::ranges::all_of(vertices, [&](int v) { return contains(outer, mesh.position(v)); });
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

namespace {

// The facet nearest to a point so far. Facets that doubles do not tell apart are compared by their exact distances,
// rounded once. Lengths are scaled, except where it says metres.
class NearestSoFar {
 public:
  NearestSoFar(const ClusteredMesh& mesh, Vec3 point, double scale, double within)
      : mesh_(mesh), point_(point), scale_(scale), within_(within) {
    set_limit(scale * within);
  }

  // Nothing that is farther by its square, or that of its box, is to be looked at.
  double most() const { return most_; }
  // In metres.
  std::optional<NearestFacet> nearest() {
    if (nearest_.facet < 0 || exact_distance() > within_) return std::nullopt;
    NearestFacet found = nearest_;
    found.weight = weights_of_source(mesh_, found.facet, found.weight);
    return found;
  }

  void look_at(int facet) {
    const Triangle triangle = mesh_.triangle(facet);
    Triangle about_point = triangle;
    for (Vec3& p : about_point) p = scale_ * (p - point_);
    const std::array<double, 3> weight = nearest_weights({}, about_point);
    const double square = norm_squared(place_of(about_point, weight));
    const int source = mesh_.source_facet(facet);
    double distance = kUnknown;
    if (square > most_ || (nearest_.facet >= 0 && !comes_before(square, triangle, weight, source, distance))) return;
    nearest_ = {source, distance, weight};
    triangle_ = triangle;
    square_ = square;
    set_limit(std::min(limit_, std::sqrt(square)));
  }

 private:
  static constexpr double kUnknown = -1.0;
  // Doubles tell distances apart by more than this: a place is wrong by some 2^-50.
  static constexpr double kOff = 0x1p-46;
  // The square of a distance at which a place that is wrong by 2^-48 along the facet is nearer by no rounding: there
  // the corner or the side on which doubles see the nearest place of two facets is that of both.
  static constexpr double kFarAway = 0x1p-30;

  void set_limit(double limit) {
    limit_ = std::min(limit, 16.0);
    most_ = (limit_ + kOff) * (limit_ + kOff);
  }

  double exact_distance() {
    if (nearest_.distance == kUnknown) nearest_.distance = rounded_distance(point_, triangle_);
    return nearest_.distance;
  }

  // Whether a facet is nearer than the nearest. Its exact distance is set where that has to be known.
  bool comes_before(double square, const Triangle& triangle, const std::array<double, 3>& weight, int facet,
                    double& distance) {
    if (std::sqrt(square) < std::sqrt(square_) - kOff) return true;
    if (square_ > kFarAway && have_one_place(triangle, weight, triangle_, nearest_.weight))
      return facet < nearest_.facet;
    distance = rounded_distance(point_, triangle);
    return distance < exact_distance() || (distance == exact_distance() && facet < nearest_.facet);
  }

  // Whether both places are on one corner or one side.
  static bool have_one_place(const Triangle& t, const std::array<double, 3>& weight_of_t, const Triangle& u,
                             const std::array<double, 3>& weight_of_u) {
    const auto is_corner_of = [](Vec3 p, const Triangle& of, const std::array<double, 3>& weight) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (weight[k] > 0.0 && of[k] == p) return true;
      }
      return false;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      if (weight_of_t[k] > 0.0 && !is_corner_of(t[k], u, weight_of_u)) return false;
      if (weight_of_u[k] > 0.0 && !is_corner_of(u[k], t, weight_of_t)) return false;
    }
    return true;
  }

  const ClusteredMesh& mesh_;
  const Vec3 point_;
  const double scale_, within_;  // metres
  double limit_ = 0.0, most_ = 0.0;
  NearestFacet nearest_;
  Triangle triangle_{};  // the nearest, metres
  double square_ = 0.0;  // of its distance
};

}  // namespace

std::array<double, 3> weights_of_source(const ClusteredMesh& mesh, int source_facet,
                                        const std::array<double, 3>& weight) {
  if (mesh.is_of_surface(source_facet)) return weight;
  const bool is_edge = source_facet < mesh.facet_count() - mesh.point_count();
  const double first = is_edge ? weight[0] : 1.0;
  return {first, 1.0 - first, 0.0};
}

std::optional<NearestFacet> nearest_facet(const ClusteredMesh& mesh, Vec3 point, double within) {
  if (mesh.facet_count() == 0) return std::nullopt;
  // Distances are squared in a unit in which the farthest is near 1.
  const Box& box = mesh.box();
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(point[axis] - box.lower[axis]), std::abs(point[axis] - box.upper[axis])});
  const double scale = unit_scale(largest);
  NearestSoFar nearest(mesh, point, scale, within);
  const double at[3] = {point.x, point.y, point.z};
  const auto rank = [&](const BoxPointers& boxes, int count, RankedBoxes& ranked) {
    kernels().rank_by_distance(boxes, count, at, scale, nearest.most(), &ranked);
  };
  const auto wants = [&](double square) { return square <= nearest.most(); };
  FacetDistances ranked;
  for_each_cluster_by_rank(mesh, rank, wants, [&](int cluster) {
    const ClusterFacets facets = mesh.facets_of(cluster);
    kernels().rank_facets(facets, at, scale, nearest.most(), &ranked);
    take_by_rank(ranked.least_squared, ranked.facet, ranked.count, wants,
                 [&](int i) { nearest.look_at(facets.facet_begin + i); });
  });
  return nearest.nearest();
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
  const Box half_line{point, {std::numeric_limits<double>::infinity(), point.y, point.z}};
  const CullPlanes along_ray = planes_of(half_line);
  FacetBlock facets;
  for_each_cluster_in(mesh, half_line, [&](int cluster) {
    facets.count = 0;
    kernels().open_cluster(mesh.facets_of(cluster), along_ray, &facets);
    for (int i = 0; i < facets.count && !on_surface; ++i) {
      if (!mesh.is_of_surface(mesh.source_facet(facets.facet[i]))) continue;
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

bool lies_inside(const ClusteredMesh& inner, const ClusteredMesh& outer) {
  return lies_in(inner.box(), outer.box()) && are_inside(inner, one_of_each_part(inner), outer);
}

bool lies_inside(const FeaturedMesh& inner, const ClusteredMesh& outer) {
  return lies_in(inner.mesh->box(), outer.box()) && are_inside(*inner.mesh, inner.features->one_of_each_part(), outer);
}

}  // namespace tact::narrowphase
