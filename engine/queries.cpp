#include "engine/queries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "engine/base/parallel.h"
#include "engine/base/text.h"
#include "engine/check_coordinate.h"
#include "narrowphase/queries/mesh_queries.h"

namespace tact {

namespace {

using base::Box;
using base::Vec3;
using narrowphase::FacetHit;

void check_point(const Eigen::Vector3d& point, const char* what) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(point[axis]) <= kLargestCoordinate)) refuse_coordinate(what, axis, point[axis]);
  }
}

Vec3 point_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
narrowphase::Segment segment_of(const Ray& ray) { return {point_of(ray.from), point_of(ray.to)}; }

// Calls visit(body) for the bodies that `filter` admits and whose box wants(box), until it returns false.
template <class Wants, class Visit>
void for_each_body(const Bodies& bodies, const QueryFilter& filter, const Wants& wants, const Visit& visit) {
  const broadphase::Filter of_query{filter.layer, filter.mask, false};
  const std::span<const Box> boxes = bodies.boxes();
  for (std::uint32_t slot = 0; slot < boxes.size(); ++slot) {
    if (boxes[slot].empty() || !wants(boxes[slot]) || !broadphase::tested(bodies.filters()[slot], of_query)) continue;
    if (!visit(bodies.placed(slot))) return;
  }
}

// The same for those whose box overlaps `box`.
template <class Visit>
void for_each_body_near(const Bodies& bodies, const QueryFilter& filter, const Box& box, const Visit& visit) {
  for_each_body(
      bodies, filter, [&](const Box& one) { return overlaps(one, box); }, visit);
}

Box box_of(const narrowphase::Segment& segment) { return extended({segment[0], segment[0]}, segment[1]); }

RayHit hit_of(const Body& body, const FacetHit& hit) { return {body.id, hit.facet, hit.time, hit.weight}; }

}  // namespace

void check_query(const Ray& ray) {
  check_point(ray.from, "the beginning of a ray");
  check_point(ray.to, "the end of a ray");
}

void check_query(const PointQuery& query) {
  check_point(query.point, "a point");
  if (!(query.within >= 0.0))
    throw Error(ErrorCode::invalid_argument, "within is " + base::text_of(query.within) + ", not at least 0");
}

void check_query(const BoxQuery& query) {
  check_point(query.lower, "the lower corner of a box");
  check_point(query.upper, "the upper corner of a box");
  if ((query.lower.array() > query.upper.array()).any())
    throw Error(ErrorCode::invalid_argument, "the lower corner of a box is above its upper one");
}

RayHit find_hit(const Bodies& bodies, const Ray& ray, RayHits wanted) {
  const narrowphase::Segment segment = segment_of(ray);
  const narrowphase::PreparedSegment line(segment);
  RayHit best;
  best.fraction = 1.0;
  for_each_body_near(bodies, ray.filter, box_of(segment), [&](const Body& body) {
    const auto hit = wanted == RayHits::any ? any_hit(body.mesh, line) : first_hit(body.mesh, line, best.fraction);
    if (hit && (best.facet < 0 || hit->time < best.fraction)) best = hit_of(body, *hit);
    return !(hit && wanted == RayHits::any);
  });
  return best.facet >= 0 ? best : RayHit{};
}

void begin_rays(const Bodies& bodies, std::size_t rays, int threads, narrowphase::SegmentBatch& room) {
  std::vector<int> clusters(bodies.boxes().size());
  for (std::uint32_t slot = 0; slot < clusters.size(); ++slot)
    clusters[slot] = bodies.boxes()[slot].empty() ? 0 : bodies.in_slot(slot).mesh.cluster_count();
  room.begin(clusters, rays);
  base::parallel_for(room.meshes().size(), 1, threads, [&](std::size_t k) {
    const std::size_t slot = room.meshes()[k];
    room.make_tree(bodies.placed(static_cast<std::uint32_t>(slot)).mesh, slot);
  });
  base::parallel_for(room.node_count(), 4, threads, [&](std::size_t i) { room.make_node(i); });
}

void find_first_hits(const Bodies& bodies, std::span<const Ray> rays, std::span<RayHit> hits,
                     const narrowphase::SegmentBatch& room) {
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
  for (std::uint32_t slot = 0; slot < bodies.boxes().size(); ++slot) {
    if (bodies.boxes()[slot].empty()) continue;
    std::array<narrowphase::FirstHitQuery*, narrowphase::kLinesAtATime> of_body;
    std::size_t count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const broadphase::Filter filter{rays[i].filter.layer, rays[i].filter.mask, false};
      if (overlaps(bodies.boxes()[slot], boxes[i]) && broadphase::tested(bodies.filters()[slot], filter))
        of_body[count++] = &queries[i];
    }
    if (count == 0) continue;
    const Body& body = bodies.placed(slot);
    narrowphase::ask_first_hits(body.mesh, room.tree(slot), {of_body.data(), count});
    // A hit is of the first body that has one as early.
    for (std::size_t k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(of_body[k] - queries.data());
      const auto& hit = of_body[k]->hit;
      if (hit && (hits[i].facet < 0 || hit->time < hits[i].fraction)) hits[i] = hit_of(body, *hit);
    }
  }
}

std::vector<RayHit> find_all_hits(const Bodies& bodies, const Ray& ray) {
  const narrowphase::Segment segment = segment_of(ray);
  const narrowphase::PreparedSegment line(segment);
  std::vector<RayHit> all;
  std::vector<FacetHit> hits;
  for_each_body_near(bodies, ray.filter, box_of(segment), [&](const Body& body) {
    hits.clear();
    append_hits(body.mesh, line, hits);
    for (const FacetHit& hit : hits) all.push_back(hit_of(body, hit));
    return true;
  });
  std::ranges::sort(all, {}, [](const RayHit& hit) { return std::tuple(hit.fraction, hit.body, hit.facet); });
  return all;
}

ClosestPoint find_closest_point(const Bodies& bodies, const PointQuery& query) {
  const Vec3 point = point_of(query.point);
  ClosestPoint best;
  double within = query.within;
  const auto wants = [&](const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
      // Rounded towards nearer, so that nothing is left out.
      const double away = std::max(box.lower[axis] - point[axis], point[axis] - box.upper[axis]);
      if (away - 0x1p-50 * std::abs(away) > within) return false;
    }
    return true;
  };
  for_each_body(bodies, query.filter, wants, [&](const Body& body) {
    const auto nearest = nearest_facet(body.mesh, point, within);
    if (!nearest || (best.facet >= 0 && nearest->distance >= best.distance)) return true;
    best = {body.id, nearest->facet, nearest->distance, nearest->weight};
    within = nearest->distance;
    return true;
  });
  return best;
}

std::vector<FacetOfBody> find_in_box(const Bodies& bodies, const BoxQuery& query) {
  const Box box{point_of(query.lower), point_of(query.upper)};
  std::vector<FacetOfBody> found;
  std::vector<int> facets;
  for_each_body_near(bodies, query.filter, box, [&](const Body& body) {
    facets.clear();
    append_facets_in_box(body.mesh, box, facets);
    std::ranges::sort(facets);
    for (const int facet : facets) found.push_back({body.id, facet});
    return true;
  });
  return found;
}

std::vector<BodyId> find_around(const Bodies& bodies, const PointQuery& query) {
  const Vec3 point = point_of(query.point);
  std::vector<BodyId> found;
  for_each_body_near(bodies, query.filter, {point, point}, [&](const Body& body) {
    if (body.surface == Surface::closed && contains(body.mesh, point)) found.push_back(body.id);
    return true;
  });
  return found;
}

}  // namespace tact
