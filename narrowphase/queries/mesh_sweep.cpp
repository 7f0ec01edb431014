#include "narrowphase/queries/mesh_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "narrowphase/distance/facet_facet.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/queries/facet_pair_descent.h"
#include "narrowphase/queries/mesh_queries.h"
#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Of lengths up to 4, which is what they are scaled to.
constexpr double kMeet = 0x1p-45;      // facets that are nearer meet, unless they part
constexpr double kRounding = 0x1p-48;  // a height, and a place on the way, are off by less
constexpr double kSkin = 0x1p-42;      // by which boxes are taken as nearer: more than kMeet of any facets in them
// Facets that are so near and may go on for no longer meet.
constexpr double kShortest = 0x1p-24;

double largest_from(Vec3 center, const Box& box) { return largest_coordinate(farthest_from(center, box)); }

// How long no corner passes the plane at `height` along `normal`.
double free_time(std::span<const TurningPoint> corners, Vec3 normal, double height, double time,
                 const SineCosine& turn) {
  double least = kNever;
  for (const TurningPoint& corner : corners) {
    const double gap = height - dot(normal, corner.at(time, turn)) - kRounding;
    least = std::min(least, time_of_fall(gap, dot(normal, corner.velocity(turn)), corner.acceleration()));
  }
  return least;
}

// Normals across features of two facets: of each facet, of an edge of each. Unit vectors, or zero.
std::array<Vec3, 11> normals_across(const Triangle& t, const Triangle& u) {
  std::array<Vec3, 11> normals;
  std::size_t count = 0;
  const auto add = [&](Vec3 p, Vec3 q) {
    const Vec3 normal = cross(p, q);
    const double length = norm(normal);
    normals[count++] = length > 0.0 ? (1.0 / length) * normal : Vec3{};
  };
  add(t[1] - t[0], t[2] - t[0]);
  add(u[1] - u[0], u[2] - u[0]);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) add(t[(i + 1) % 3] - t[i], u[(k + 1) % 3] - u[k]);
  return normals;
}

class SweepSearch {
 public:
  SweepSearch(const ClusteredMesh& a, const TurningWay& way, const ClusteredMesh& b, double latest)
      : a_(a), b_(b), way_(way) {
    scale_ = unit_scale(
        std::max({largest_from(way.center, a.box()), largest_from(way.center, b.box()), largest_coordinate(way.way)}));
    scaled_way_ = way.scaled(scale_);
    best_.value = latest;
  }

  // A time before which nothing in a box on the way is as near to another box as kSkin: a ball is around the former.
  double rank(const Box& box_a, const Box& box_b) const {
    const Vec3 half = (0.5 * scale_) * (box_a.upper - box_a.lower);
    const TurningPoint middle(scaled_way_, scale_ * (box_a.lower - way_.center) + half);
    const double radius = norm(half) + kSkin;
    const double speed = norm(scaled_way_.way) + std::abs(way_.angle) * middle.radius();
    double time = 0.0;
    for (int step = 0; step < kMostSteps; ++step) {
      const Vec3 at = middle.at(time, sine_cosine(time * way_.angle));
      double square = 0.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double below = scale_ * (box_b.lower[axis] - way_.center[axis]) - at[axis],
                     above = at[axis] - scale_ * (box_b.upper[axis] - way_.center[axis]);
        const double away = std::max(std::max(below, above), 0.0);
        square += away * away;
      }
      const double gap = std::sqrt(square) - radius;
      if (!(gap > 0.0)) return time;
      time += gap / speed;
      if (!(time <= best_.value)) return kNever;
    }
    return time;
  }
  bool wants(double rank, int a, int b) const { return rank <= 1.0 && best_.wants(rank, a, b); }

  void look_at(int facet_a, int facet_b, double rank) {
    const Triangle t = a_.triangle(facet_a), u = b_.triangle(facet_b);
    SweptHit hit{.facet_a = a_.source_facet(facet_a), .facet_b = b_.source_facet(facet_b), .time = rank};
    if (rank == 0.0 && overlaps(box_of(t), box_of(u)) && triangle_triangle_meet(t, u, counts_)) {
      const NearestOfFacets place = common_place(t, u);
      hit.weight_a = place.first, hit.weight_b = place.second;
    } else if (!advance(t, u, hit)) {
      return;
    }
    if (!best_.wants(hit.time, hit.facet_a, hit.facet_b)) return;
    best_ = {hit.time, hit.facet_a, hit.facet_b};
    hit_ = hit;
  }

  std::optional<SweptHit> found() const {
    if (best_.a < 0) return {};
    SweptHit hit = hit_;
    hit.weight_a = weights_of_source(a_, hit.facet_a, hit.weight_a);
    hit.weight_b = weights_of_source(b_, hit.facet_b, hit.weight_b);
    return hit;
  }

 private:
  static constexpr int kMostSteps = 12;  // a time that is too early costs a look at what is inside

  // From hit.time to where two facets meet; false if they do not, as early as is wanted.
  bool advance(const Triangle& t, const Triangle& u, SweptHit& hit) const {
    double size = largest_coordinate(way_.way);
    for (std::size_t k = 0; k < 3; ++k)
      size = std::max({size, largest_coordinate(t[k] - way_.center), largest_coordinate(u[k] - way_.center)});
    const double scale = unit_scale(size);
    const TurningWay way = way_.scaled(scale);
    const auto from_center = [&](Vec3 p) { return scale * (p - way_.center); };
    const std::array<TurningPoint, 3> corners{
        TurningPoint(way, from_center(t[0])), {way, from_center(t[1])}, {way, from_center(t[2])}};
    const Triangle other{from_center(u[0]), from_center(u[1]), from_center(u[2])};
    for (;;) {
      const SineCosine turn = sine_cosine(hit.time * way.angle);
      const Triangle now{corners[0].at(hit.time, turn), corners[1].at(hit.time, turn), corners[2].at(hit.time, turn)};
      const NearestOfFacets nearest = nearest_of_facets(now, other);
      hit.weight_a = nearest.first, hit.weight_b = nearest.second;
      if (!(nearest.distance > 0.0)) return true;
      double free = -1.0;
      const auto try_normal = [&](Vec3 normal) {
        const double height = std::min({dot(normal, other[0]), dot(normal, other[1]), dot(normal, other[2])});
        if (const double along = free_time(corners, normal, height, hit.time, turn); along > free)
          free = along, hit.normal = normal;
      };
      try_normal((1.0 / nearest.distance) * nearest.way);
      // Between places that are very near, rounding turns that normal: of parallel facets some corner is then beyond.
      if (free <= kShortest) {
        for (const Vec3 normal : normals_across(now, other))
          if (normal != Vec3{}) try_normal(dot(normal, nearest.way) < 0.0 ? -normal : normal);
      }
      if (nearest.distance <= kMeet && free <= kShortest) return true;
      if (hit.time + free == hit.time) return true;
      hit.time += free;
      if (!(hit.time <= best_.value)) return false;
    }
  }

  const ClusteredMesh &a_, &b_;
  const TurningWay way_;
  TurningWay scaled_way_;
  double scale_ = 1.0;
  BestFacetPair best_{};
  SweptHit hit_;
  PredicateCounts counts_;
};

// When a vertex reaches a half-space, or later than `latest`.
double time_to_plane(const TurningWay& way, Vec3 begin, const HalfSpace& space, double latest) {
  if (height_over(space, begin) <= 0.0) return 0.0;
  const double above_center = height_over(space, way.center);
  const double scale = unit_scale(
      std::max({largest_coordinate(begin - way.center), largest_coordinate(way.way), std::abs(above_center)}));
  const TurningWay scaled = way.scaled(scale);
  const TurningPoint point(scaled, scale * (begin - way.center));
  for (double time = 0.0;;) {
    const SineCosine turn = sine_cosine(time * way.angle);
    const double height = scale * above_center + dot(space.normal, point.at(time, turn));
    const double free =
        time_of_fall(height - kRounding, -dot(space.normal, point.velocity(turn)), point.acceleration());
    if ((height <= kMeet && free <= kShortest) || time + free == time) return time;
    time += free;
    if (!(time <= latest)) return kNever;
  }
}

}  // namespace

std::optional<SweptHit> first_on_way(const ClusteredMesh& a, const TurningWay& way, const ClusteredMesh& b,
                                     double latest) {
  if (a.facet_count() == 0 || b.facet_count() == 0) return {};
  SweepSearch search(a, way, b, latest);
  descend_to_facet_pairs(a, b, search);
  return search.found();
}

std::optional<SweptHit> first_on_way(const ClusteredMesh& a, const TurningWay& way, const HalfSpace& space,
                                     double latest) {
  std::vector<double> times(static_cast<std::size_t>(a.vertex_count()));
  double first = kNever;
  for (int v = 0; v < a.vertex_count(); ++v)
    first = std::min(
        first, times[static_cast<std::size_t>(v)] = time_to_plane(way, a.position(v), space, std::min(latest, first)));
  if (!(first <= latest)) return {};
  SweptHit hit{.facet_a = std::numeric_limits<int>::max(), .facet_b = 0, .time = first};
  for (int f = 0; f < a.facet_count(); ++f) {
    const Corners corners = a.corners(f);
    const auto at = std::ranges::find(corners, first, [&](int v) { return times[static_cast<std::size_t>(v)]; });
    if (at == corners.end() || a.source_facet(f) > hit.facet_a) continue;
    hit.facet_a = a.source_facet(f);
    hit.weight_a = {};
    hit.weight_a[static_cast<std::size_t>(at - corners.begin())] = 1.0;
  }
  hit.weight_a = weights_of_source(a, hit.facet_a, hit.weight_a);
  if (first > 0.0) hit.normal = -space.normal;
  return hit;
}

Box box_of_way(const Box& begin, const TurningWay& way) {
  const Box end{begin.lower + way.way, begin.upper + way.way};
  // Rounded outwards.
  if (way.angle == 0.0) return grown(merged(begin, end), 0x1p-50 * largest_from({}, merged(begin, end)));
  const double radius = 2.0 * largest_from(way.center, begin);  // the root of 3, and roundings
  return grown(extended(Box{way.center, way.center}, way.center + way.way), radius);
}

}  // namespace tact::narrowphase
