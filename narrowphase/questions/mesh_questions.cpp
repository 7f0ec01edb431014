#include "narrowphase/questions/mesh_questions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "narrowphase/mesh/cluster_search.h"
#include "narrowphase/mesh/open_in_box.h"
#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/unit_scale.h"

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

// A segment as the kernels take it.
class SeenSegment {
 public:
  SeenSegment(const Segment& segment, const Box& seen) : segment_(segment) {
    const Vec3 from = segment[0], way = segment[1] - from;
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double inverse = 1.0 / way[axis];
      slabs_.from[axis] = line_.from[axis] = from[axis];
      slabs_.inverse[axis] = std::isfinite(inverse) ? inverse : 0.0;
      slabs_.stays[axis] = way[axis] == 0.0;  // then the ends are equal: the difference of no others is zero
      largest = std::max({largest, std::abs(seen.lower[axis] - from[axis]), std::abs(seen.upper[axis] - from[axis])});
    }
    const Vec3 length{std::abs(way.x), std::abs(way.y), std::abs(way.z)};
    const int z = length.x >= length.y && length.x >= length.z ? 0 : length.y >= length.z ? 1 : 2;
    for (int k = 0; k < 3; ++k) line_.axis[k] = (z + 1 + k) % 3;
    is_point_ = way[z] == 0.0;
    for (int k = 0; k < 2 && !is_point_; ++k) line_.slope[k] = way[line_.axis[k]] / way[z];
    // Eight roundings of at most `largest`, and products that vanish.
    line_.error = 0x1p-48 * largest + 0x1p-1000;
  }

  const SegmentSlabs& slabs() const { return slabs_; }

  // When it enters a box, as in rank_by_entry(): not earlier than any box around that one, rounding included.
  double entry(const Box& box) const {
    double first = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double inverse = slabs_.inverse[axis];
      if (inverse == 0.0) continue;
      first = std::max(first, ((inverse > 0.0 ? box.lower : box.upper)[axis] - slabs_.from[axis]) * inverse);
    }
    return first;
  }

  // A bit for each facet of a cluster that it may meet.
  std::uint64_t sight(const ClusterFacets& cluster) {
    if (is_point_) return ~std::uint64_t{0} >> (64 - cluster.facet_count);
    return kernels().sight_facets(cluster, line_, &points_);
  }
  // Whether it meets one of these, exactly.
  bool meets(const ClusterFacets& cluster, int facet, const Triangle& triangle, PredicateCounts& counts) const {
    if (is_point_) {
      return contains(box_of(triangle), segment_[0]) && segment_triangle_meet(segment_, triangle, counts);
    }
    const int sides = passes(cluster, facet);
    if (sides == 0) return segment_triangle_meet(segment_, triangle, counts);
    // Its line passes inside all sides, so it is not in the plane, or outside one.
    const auto& [a, b, c] = triangle;
    return sides > 0 && orient3d(a, b, c, segment_[0], counts) * orient3d(a, b, c, segment_[1], counts) <= 0;
  }

 private:
  // 1: the line certainly passes inside all sides of a facet; -1: outside one; 0: rounding may tell.
  int passes(const ClusterFacets& cluster, int facet) const {
    double u[3], v[3];
    for (int k = 0; k < 3; ++k) {
      u[k] = points_.at[0][cluster.corner[k][facet]];
      v[k] = points_.at[1][cluster.corner[k][facet]];
    }
    int positive = 0, negative = 0;
    for (int k = 0; k < 3; ++k) {
      const int m = (k + 1) % 3;
      const double turn = u[k] * v[m] - u[m] * v[k], error = line_.error;
      const double bound =
          4.0 * error * (std::abs(u[k]) + std::abs(v[k]) + std::abs(u[m]) + std::abs(v[m]) + 4.0 * error) + 0x1p-900;
      positive += turn > bound;
      negative += turn < -bound;
    }
    if (positive + negative < 3) return positive > 0 && negative > 0 ? -1 : 0;
    return positive == 3 || negative == 3 ? 1 : -1;
  }

  Segment segment_;
  SegmentSlabs slabs_;
  LineOfSight line_;
  bool is_point_ = false;
  SightedPoints points_;
};

Triangle triangle_in(const FacetBlock& facets, int i) {
  const auto corner = [&](int k) {
    const auto& at = facets.corner[k];
    return Vec3{at[0][i], at[1][i], at[2][i]};
  };
  return {corner(0), corner(1), corner(2)};
}

Vec3 place(const Triangle& t, const std::array<double, 3>& w) { return w[0] * t[0] + w[1] * t[1] + w[2] * t[2]; }

Vec3 normal_of(const Triangle& t) {
  return double_double_cross(double_double_difference(t[1], t[0]), double_double_difference(t[2], t[0]));
}

// First how far the point is from the longest side, of which the corner c is the farthest, then along that side: what
// is rounded moves the place by roundings of the distance, however narrow the triangle is. Areas beside each side, one
// by one, would move it by so many times that as the triangle is longer than wide.
std::array<double, 3> nearest_weights(Vec3 p, const Triangle& t, Vec3 normal) {
  const double area2 = norm_squared(normal);
  if (!(area2 > 0.0)) return nearest_weights_on_sides(p, t);
  std::size_t c = 0;
  double length2 = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double one = norm_squared(t[(i + 2) % 3] - t[(i + 1) % 3]);
    if (one > length2) length2 = one, c = i;
  }
  const std::size_t a = (c + 1) % 3, b = (c + 2) % 3;
  const Vec3 side = t[b] - t[a], from_a = p - t[a];
  std::array<double, 3> w;
  w[c] = dot(from_a, cross(normal, side)) / area2;
  w[b] = (dot(from_a, side) - w[c] * dot(t[c] - t[a], side)) / length2;
  w[a] = 1.0 - w[b] - w[c];
  // By a side, and at a corner above all, the place on the sides may be the nearer one, and exact.
  const double least = std::min({w[0], w[1], w[2]});
  if (least > 0x1p-30) return w;
  const std::array<double, 3> beside = nearest_weights_on_sides(p, t);
  const bool takes_sides = least < 0.0 || norm_squared(place(t, beside) - p) <= norm_squared(place(t, w) - p);
  return takes_sides ? beside : w;
}

// Where a segment first is in a triangle that it is known to meet. A ray at an angle of 2^-40 with a facet meets it at
// a time that is wrong by 2^-12, though its place is not. So the time is held against `entry`, into the facet's box:
// then no facet of a box that is entered later is hit earlier.
FacetHit hit_at(const Segment& segment, const Triangle& given, int facet, double entry) {
  // About the beginning and near length 1, so that nothing overflows.
  double largest = 0.0;
  const auto note = [&](Vec3 p) { largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)}); };
  const Vec3 whole = segment[1] - segment[0];
  note(whole);
  Triangle t;
  for (std::size_t i = 0; i < 3; ++i) note(t[i] = given[i] - segment[0]);
  const double scale = unit_scale(largest);
  for (Vec3& p : t) p = scale * p;
  const Vec3 way = scale * whole;
  const Vec3 normal = normal_of(t);
  const double along = dot(normal, way), above = dot(normal, t[0]);
  double time = 0.0;
  if (std::abs(along) > 0x1p-40 * norm(normal) * norm(way)) {
    time = std::clamp(above / along, 0.0, 1.0);
  } else if (norm_squared(way) > 0.0) {
    // In the plane: where it enters, which is where it is nearest to a side, or at its beginning.
    const auto away = [&](double s) {
      const Vec3 p = s * way;
      return norm(place(t, nearest_weights(p, t, normal)) - p);
    };
    double low = 0.0, high = 1.0;
    if (away(0.0) > 0x1p-45) {
      // The distance falls to zero and stays there for a while: thirds find where it is least, halves where it begins.
      for (int k = 0; k < 100 && high - low > 0x1p-52; ++k) {
        const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
        (away(a) > away(b) ? low : high) = away(a) > away(b) ? a : b;
      }
      time = high;
      const double least = away(time) + 0x1p-46;
      for (double before = 0.0, after = time; after - before > 0x1p-52;) {
        const double middle = 0.5 * (before + after);
        (away(middle) > least ? before : after) = middle;
        time = after;
      }
    }
  }
  time = std::min(std::max(time, entry), 1.0);
  return {facet, time, nearest_weights(time * way, t, normal)};
}

// Calls visit(hit) for each facet that the segment meets, in clusters that it may reach by `latest`, which visit may
// lower.
template <class Visit>
void for_each_hit(const ClusteredMesh& mesh, const Segment& segment, const double& latest, const Visit& visit) {
  if (mesh.facet_count() == 0) return;
  SeenSegment seen(segment, mesh.box());
  PredicateCounts counts;
  const auto rank = [&](const BoxPointers& boxes, int count, RankedBoxes& ranked) {
    kernels().rank_by_entry(boxes, count, seen.slabs(), latest, &ranked);
  };
  const auto wants = [&](double entry) { return entry <= latest; };
  for_each_cluster_by_rank(mesh, rank, wants, [&](int cluster) {
    const ClusterFacets facets = mesh.facets_of(cluster);
    for (std::uint64_t left = seen.sight(facets); left != 0; left &= left - 1) {
      const int i = std::countr_zero(left), f = facets.facet_begin + i;
      const Triangle triangle = mesh.triangle(f);
      if (seen.meets(facets, i, triangle, counts))
        visit(hit_at(segment, triangle, mesh.source_facet(f), seen.entry(box_of(triangle))));
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

std::array<double, 3> nearest_weights(Vec3 p, const Triangle& t) { return nearest_weights(p, t, normal_of(t)); }

std::array<double, 3> nearest_weights_on_sides(Vec3 p, const Triangle& t) {
  std::array<double, 3> best{1.0, 0.0, 0.0};
  double least = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    const Vec3 side = t[k] - t[i];
    const double length2 = norm_squared(side);
    const double s = length2 > 0.0 ? std::clamp(dot(p - t[i], side) / length2, 0.0, 1.0) : 0.0;
    const double distance2 = norm_squared(t[i] + s * side - p);
    if (distance2 >= least) continue;
    least = distance2;
    best = {0.0, 0.0, 0.0};
    best[i] = 1.0 - s;
    best[k] += s;
  }
  return best;
}

std::optional<FacetHit> first_hit(const ClusteredMesh& mesh, const Segment& segment, double latest) {
  std::optional<FacetHit> first;
  for_each_hit(mesh, segment, latest, [&](const FacetHit& hit) {
    if (hit.time > latest || (first && !(hit < *first))) return;
    first = hit;
    latest = hit.time;
  });
  return first;
}

std::optional<FacetHit> any_hit(const ClusteredMesh& mesh, const Segment& segment) {
  std::optional<FacetHit> any;
  double latest = 1.0;
  for_each_hit(mesh, segment, latest, [&](const FacetHit& hit) {
    if (!any) any = hit;
    latest = -1.0;
  });
  return any;
}

void append_hits(const ClusteredMesh& mesh, const Segment& segment, std::vector<FacetHit>& hits) {
  const double latest = 1.0;
  for_each_hit(mesh, segment, latest, [&](const FacetHit& hit) { hits.push_back(hit); });
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
      const double distance2 = norm_squared(place(triangle, weight));
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
