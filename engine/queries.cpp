#include "engine/queries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

#include "engine/base/text.h"
#include "engine/body_search.h"
#include "engine/check_coordinate.h"
#include "engine/eigen_vectors.h"
#include "narrowphase/mesh/cluster_search.h"
#include "narrowphase/queries/mesh_queries.h"

namespace tact {

namespace {

using base::Box;
using base::Vec3;
using narrowphase::FacetHit;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Those that a ray enters, not later than `latest`.
struct RaySearch : Search {
  explicit RaySearch(const Ray& ray)
      : ends(extended({from_eigen(ray.from), from_eigen(ray.from)}, from_eigen(ray.to))),
        line({from_eigen(ray.from), from_eigen(ray.to)}) {}

  Box around() const { return ends; }
  double rank(const Box& box) const { return overlaps(box, ends) ? line.entry(box) : kInfinity; }
  bool wants(double entry) const { return entry <= latest; }

  Box ends;
  narrowphase::PreparedSegment line;
  double latest = 1.0;
};

// Those that are not farther from a point than `within`, metres, and along no axis than `most`.
struct PointSearch : Search {
  static constexpr bool kScansByRank = true;  // what is found early makes others too far away

  explicit PointSearch(const PointQuery& query) : point(from_eigen(query.point)), most(query.within), within(most) {}

  Box around() const {
    Box box{point, point};
    for (int axis = 0; axis < 3; ++axis) {
      const double by = most + 0x1p-48 * (most + std::abs(point[axis]));
      box.lower[axis] -= by;
      box.upper[axis] += by;
    }
    return grown(box, std::numeric_limits<double>::min());
  }
  double rank(const Box& box) const {
    const BoxDistance found = distance_below({point, point}, box);
    if (found.along_axis - 0x1p-50 * found.along_axis > most) return kInfinity;  // towards nearer: nothing is left out
    return found.least;
  }
  bool wants(double distance) const { return distance <= within; }

  Vec3 point;
  double most;
  double within;
};

// A ray's hit of a plane, whose surface is facet 0.
std::optional<FacetHit> hit_of_plane(const narrowphase::HalfSpace& plane, const Ray& ray) {
  const auto time = narrowphase::meeting_place(plane, from_eigen(ray.from), from_eigen(ray.to));
  return time ? std::optional(FacetHit{0, *time, {}}) : std::nullopt;
}

// Sorts slots by the keys of their bodies.
void sort_by_key(const Bodies& bodies, std::span<std::uint32_t> slots) {
  std::ranges::sort(slots, {}, [&](std::uint32_t slot) { return bodies.keys().of(slot); });
}

// The slots of planes, and of bodies whose box overlaps `box`, ascending by key.
std::vector<std::uint32_t> slots_near(const Bodies& bodies, const QueryFilter& filter, const Box& box) {
  std::vector<std::uint32_t> slots;
  BoxSearch search(box);
  for_each_body(bodies, filter, search, [&](std::uint32_t slot) { slots.push_back(slot); });
  for_each_plane(bodies, filter, [&](std::uint32_t slot, const narrowphase::HalfSpace&) { slots.push_back(slot); });
  sort_by_key(bodies, slots);
  return slots;
}

// Whether a box has points on the plane.
bool meets_plane(const narrowphase::HalfSpace& plane, const Box& box) {
  const narrowphase::HalfSpace other_side{-plane.normal, -plane.offset};
  return narrowphase::height_over(plane, lowest_corner(plane, box)) <= 0.0 &&
         narrowphase::height_over(plane, lowest_corner(other_side, box)) >= 0.0;
}

RayHit hit_of(const Body& body, const FacetHit& hit) { return {body.id, hit.facet, hit.time, hit.weight}; }

// Whether a hit of a body is before the best one so far. Of equal times that of the lower key is.
bool is_before(const Bodies& bodies, const FacetHit& hit, std::uint32_t slot, const RayHit& best) {
  const BodyKeys& keys = bodies.keys();
  return best.facet < 0 || std::tuple(hit.time, keys.of(slot)) < std::tuple(best.fraction, keys.of(best.body.index));
}

// Replaces `best` by the first hit of a ray, if that is before it, of the bodies that have no tree in `batch`.
void find_first_hit(const Bodies& bodies, const Ray& ray, const narrowphase::SegmentBatch* batch, RayHit& best) {
  RaySearch search(ray);
  if (best.facet >= 0) search.latest = best.fraction;
  for_each_body(bodies, ray.filter, search, [&](std::uint32_t slot) {
    if (batch != nullptr && batch->tree(slot) != nullptr) return;
    const Body& body = bodies.placed(slot);
    const auto hit = first_hit(body.mesh, search.line, search.latest);
    if (!hit || !is_before(bodies, *hit, slot, best)) return;
    best = hit_of(body, *hit);
    search.latest = best.fraction;
  });
  for_each_plane(bodies, ray.filter, [&](std::uint32_t slot, const narrowphase::HalfSpace& plane) {
    const auto hit = hit_of_plane(plane, ray);
    if (hit && is_before(bodies, *hit, slot, best)) best = hit_of(bodies.in_slot(slot), *hit);
  });
}

// A hit of the body with the lowest key that has one. Bodies are collected first, as the tree has them in no such
// order.
RayHit find_any_hit(const Bodies& bodies, const Ray& ray) {
  constexpr std::size_t kMost = 256;                                     // more than a ray meets in most worlds
  const std::size_t at_a_time = bodies.tree().is_current() ? kMost : 1;  // a scan has them in that order
  std::array<std::uint32_t, kMost> slots;
  std::size_t count = 0;
  RaySearch search(ray);
  RayHit found;
  const auto look_at_collected = [&] {
    sort_by_key(bodies, std::span(slots).first(count));
    for (std::size_t i = 0; i < count && (!search.end || bodies.keys().of(slots[i]) < *search.end); ++i) {
      const Body& body = bodies.placed(slots[i]);
      const auto hit = any_hit(body.mesh, search.line);
      if (!hit) continue;
      found = hit_of(body, *hit);
      search.end = bodies.keys().of(slots[i]);
    }
    count = 0;
  };
  for_each_body(bodies, ray.filter, search, [&](std::uint32_t slot) {
    slots[count++] = slot;
    if (count == at_a_time) look_at_collected();
  });
  look_at_collected();
  for_each_plane(bodies, ray.filter, [&](std::uint32_t slot, const narrowphase::HalfSpace& plane) {
    if (search.end && *search.end < bodies.keys().of(slot)) return;
    const auto hit = hit_of_plane(plane, ray);
    if (!hit) return;
    found = hit_of(bodies.in_slot(slot), *hit);
    search.end = bodies.keys().of(slot);
  });
  return found;
}

}  // namespace

void check_point(const Eigen::Vector3d& point, const char* what) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(point[axis]) <= kLargestCoordinate)) refuse_coordinate(what, axis, point[axis]);
  }
}

void check_within(double within) {
  if (!(within >= 0.0))
    throw Error(ErrorCode::invalid_argument, "within is " + base::text_of(within) + ", not at least 0");
}

void check_query(const Ray& ray) {
  check_point(ray.from, "the beginning of a ray");
  check_point(ray.to, "the end of a ray");
}

void check_query(const PointQuery& query) {
  check_point(query.point, "a point");
  check_within(query.within);
}

void check_query(const BoxQuery& query) {
  check_point(query.lower, "the lower corner of a box");
  check_point(query.upper, "the upper corner of a box");
  if ((query.lower.array() > query.upper.array()).any())
    throw Error(ErrorCode::invalid_argument, "the lower corner of a box is above its upper one");
}

RayHit find_hit(const Bodies& bodies, const Ray& ray, RayHits wanted) {
  if (wanted == RayHits::any) return find_any_hit(bodies, ray);
  RayHit best;
  find_first_hit(bodies, ray, nullptr, best);
  return best;
}

void find_first_hits(const Bodies& bodies, std::span<const Ray> rays, std::span<RayHit> hits,
                     const narrowphase::SegmentBatch& trees) {
  std::array<narrowphase::FirstHitQuery, narrowphase::kLinesAtATime> queries;
  std::array<Box, narrowphase::kLinesAtATime> boxes;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (int axis = 0; axis < 3;
         ++axis) {  // number by number: what was written as such cannot be read at once in pairs
      queries[i].segment[0][axis] = rays[i].from[axis];
      queries[i].segment[1][axis] = rays[i].to[axis];
      boxes[i].lower[axis] = std::min(rays[i].from[axis], rays[i].to[axis]);
      boxes[i].upper[axis] = std::max(rays[i].from[axis], rays[i].to[axis]);
    }
    hits[i] = {};
  }
  for (const std::size_t mesh : trees.meshes()) {
    const auto slot = static_cast<std::uint32_t>(mesh);
    std::array<narrowphase::FirstHitQuery*, narrowphase::kLinesAtATime> asked;
    std::size_t count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const broadphase::Filter filter{rays[i].filter.layer, rays[i].filter.mask, false};
      if (overlaps(bodies.boxes()[slot], boxes[i]) && broadphase::tested(bodies.filters()[slot], filter))
        asked[count++] = &queries[i];
    }
    if (count == 0) continue;
    const Body& body = bodies.placed(slot);
    narrowphase::ask_first_hits(body.mesh, trees.tree(slot), {asked.data(), count});
    for (std::size_t k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(asked[k] - queries.data());
      const auto& hit = asked[k]->hit;
      if (hit && is_before(bodies, *hit, slot, hits[i])) hits[i] = hit_of(body, *hit);
    }
  }
  if (trees.meshes().size() == bodies.count()) return;
  for (std::size_t i = 0; i < rays.size(); ++i) find_first_hit(bodies, rays[i], &trees, hits[i]);
}

std::vector<RayHit> find_all_hits(const Bodies& bodies, const Ray& ray) {
  RaySearch search(ray);
  std::vector<RayHit> all;
  std::vector<FacetHit> hits;
  for_each_body(bodies, ray.filter, search, [&](std::uint32_t slot) {
    const Body& body = bodies.placed(slot);
    hits.clear();
    append_hits(body.mesh, search.line, hits);
    for (const FacetHit& hit : hits) all.push_back(hit_of(body, hit));
  });
  for_each_plane(bodies, ray.filter, [&](std::uint32_t slot, const narrowphase::HalfSpace& plane) {
    if (const auto hit = hit_of_plane(plane, ray)) all.push_back(hit_of(bodies.in_slot(slot), *hit));
  });
  std::ranges::sort(all, {}, [&](const RayHit& hit) {
    return std::tuple(hit.fraction, bodies.keys().of(hit.body.index), hit.facet);
  });
  return all;
}

namespace {

// Whether a body has an inside: see find_around().
bool is_solid(const Bodies& bodies, std::uint32_t slot) {
  const Body& body = bodies.in_slot(slot);
  return body.plane != nullptr || body.has_inside;
}

// The nearest place of those bodies for which wants(slot).
template <class Wants>
ClosestPoint closest_point_of(const Bodies& bodies, const PointQuery& query, const Wants& wants) {
  // What is as near as the best so far is not lost by rounding.
  constexpr double kAsNear = 1.0 + 0x1p-40;
  PointSearch search(query);
  ClosestPoint best;
  const auto take = [&](std::uint32_t slot, const narrowphase::NearestFacet& nearest) {
    const auto order = [&](double distance, std::uint32_t of_slot) {
      return std::tuple(distance, bodies.keys().of(of_slot));
    };
    if (best.facet >= 0 && order(nearest.distance, slot) >= order(best.distance, best.body.index)) return;
    best = {bodies.in_slot(slot).id, nearest.facet, nearest.distance, nearest.weight};
    search.within = std::min(search.within, kAsNear * best.distance);
  };
  for_each_plane(bodies, query.filter, [&](std::uint32_t slot, const narrowphase::HalfSpace& plane) {
    const double distance = std::abs(narrowphase::height_over(plane, search.point));
    if (distance <= query.within) take(slot, {0, distance, {}});
  });
  const auto look_at = [&](std::uint32_t slot) {
    if (!wants(slot)) return;
    if (const auto nearest = nearest_facet(bodies.placed(slot).mesh, search.point, search.within)) take(slot, *nearest);
  };
  for_each_body(bodies, query.filter, search, look_at);
  return best;
}

// How far a point inside a body is from its surface.
narrowphase::NearestFacet depth_in(const Body& body, Vec3 point) {
  if (body.plane != nullptr) return {0, -narrowphase::height_over(*body.plane, point), {}};
  return *nearest_facet(body.mesh, point, kInfinity);
}

}  // namespace

ClosestPoint find_closest_point(const Bodies& bodies, const PointQuery& query) {
  return closest_point_of(bodies, query, [](std::uint32_t) { return true; });
}

ClosestPoint find_signed_distance(const Bodies& bodies, const PointQuery& query) {
  ClosestPoint deepest;
  for (const BodyId body : find_around(bodies, query)) {
    const narrowphase::NearestFacet depth = depth_in(bodies.in_slot(body.index), from_eigen(query.point));
    if (deepest.facet >= 0 && -depth.distance >= deepest.distance) continue;
    deepest = {body, depth.facet, depth.distance == 0.0 ? 0.0 : -depth.distance, depth.weight};
  }
  if (deepest.facet >= 0) return deepest;
  return closest_point_of(bodies, query, [&](std::uint32_t slot) { return is_solid(bodies, slot); });
}

std::vector<FacetOfBody> find_in_box(const Bodies& bodies, const BoxQuery& query) {
  const Box box{from_eigen(query.lower), from_eigen(query.upper)};
  std::vector<FacetOfBody> found;
  std::vector<int> facets;
  for (const std::uint32_t slot : slots_near(bodies, query.filter, box)) {
    const Body& body = bodies.placed(slot);
    facets.clear();
    if (body.plane != nullptr) {
      if (meets_plane(*body.plane, box)) facets.push_back(0);
    } else {
      append_facets_in_box(body.mesh, box, facets);
    }
    std::ranges::sort(facets);
    for (const int facet : facets) found.push_back({body.id, facet});
  }
  return found;
}

std::vector<BodyId> find_around(const Bodies& bodies, const PointQuery& query) {
  const Vec3 point = from_eigen(query.point);
  std::vector<BodyId> found;
  for (const std::uint32_t slot : slots_near(bodies, query.filter, {point, point})) {
    const Body& body = bodies.placed(slot);
    const bool is_inside = body.plane != nullptr ? narrowphase::height_over(*body.plane, point) <= 0.0
                                                 : is_solid(bodies, slot) && contains(body.mesh, point);
    if (is_inside) found.push_back(body.id);
  }
  return found;
}

}  // namespace tact
