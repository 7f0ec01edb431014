#include <algorithm>
#include <cstddef>

#include "handles.h"

namespace tact::c {
namespace {

static_assert(sizeof(tact_ray) == sizeof(Ray) && offsetof(tact_ray, to) == offsetof(Ray, to) &&
              offsetof(tact_ray, layer) == offsetof(Ray, filter));
static_assert(sizeof(tact_ray_hit) == sizeof(RayHit) && offsetof(tact_ray_hit, facet) == offsetof(RayHit, facet) &&
              offsetof(tact_ray_hit, fraction) == offsetof(RayHit, fraction) &&
              offsetof(tact_ray_hit, barycentric) == offsetof(RayHit, barycentric));
static_assert(sizeof(tact_point_query) == sizeof(PointQuery) &&
              offsetof(tact_point_query, within) == offsetof(PointQuery, within) &&
              offsetof(tact_point_query, layer) == offsetof(PointQuery, filter));
static_assert(sizeof(tact_closest_point) == sizeof(ClosestPoint) &&
              offsetof(tact_closest_point, distance) == offsetof(ClosestPoint, distance) &&
              offsetof(tact_closest_point, barycentric) == offsetof(ClosestPoint, barycentric));
static_assert(sizeof(tact_box_query) == sizeof(BoxQuery) &&
              offsetof(tact_box_query, layer) == offsetof(BoxQuery, filter));
static_assert(sizeof(tact_facet_of_body) == sizeof(FacetOfBody) &&
              offsetof(tact_facet_of_body, facet) == offsetof(FacetOfBody, facet));
static_assert(sizeof(tact_distance_query) == sizeof(DistanceQuery) &&
              offsetof(tact_distance_query, within) == offsetof(DistanceQuery, within));
static_assert(sizeof(tact_nearest_bodies_query) == sizeof(NearestBodiesQuery) &&
              offsetof(tact_nearest_bodies_query, within) == offsetof(NearestBodiesQuery, within) &&
              offsetof(tact_nearest_bodies_query, layer) == offsetof(NearestBodiesQuery, filter));
static_assert(sizeof(tact_body_distance) == sizeof(BodyDistance) &&
              offsetof(tact_body_distance, a_facet) == offsetof(BodyDistance, a_facet) &&
              offsetof(tact_body_distance, b_barycentric) == offsetof(BodyDistance, b_barycentric) &&
              offsetof(tact_body_distance, containment) == offsetof(BodyDistance, containment));
static_assert(sizeof(tact_sweep) == sizeof(Sweep) && offsetof(tact_sweep, axis) == offsetof(Sweep, axis) &&
              offsetof(tact_sweep, angle) == offsetof(Sweep, angle) &&
              offsetof(tact_sweep, layer) == offsetof(Sweep, filter));
static_assert(sizeof(tact_sweep_hit) == sizeof(SweepHit) &&
              offsetof(tact_sweep_hit, fraction) == offsetof(SweepHit, fraction) &&
              offsetof(tact_sweep_hit, normal) == offsetof(SweepHit, normal) &&
              offsetof(tact_sweep_hit, other_barycentric) == offsetof(SweepHit, other_barycentric));
static_assert(sizeof(tact_overlap) == sizeof(Overlap) && offsetof(tact_overlap, area) == offsetof(Overlap, area));

// The same bits under the name of C++.
template <class Cpp, class ForC>
std::span<Cpp> as_cpp(ForC* first, size_t count) {
  if (count > 0) check_not_null(first);
  return {reinterpret_cast<Cpp*>(first), count};
}

template <class ForC, class Answer>
void write(const std::vector<Answer>& answers, ForC* to, size_t capacity, size_t* count) {
  const std::span<Answer> room = as_cpp<Answer>(to, capacity);
  std::copy_n(answers.begin(), std::min(answers.size(), room.size()), room.begin());
  *count = answers.size();
}

// Calls ask(queries, answers) for lists of answers, and writes these one after the other, and where each ends.
template <class Query, class Answer, class QueryOfC, class AnswerOfC, class Ask>
void write_each(const QueryOfC* queries, size_t count, AnswerOfC* to, size_t capacity, size_t* ends, const Ask& ask) {
  if (count > 0) check_not_null(ends);
  std::vector<std::vector<Answer>> answers(count);
  ask(as_cpp<const Query>(queries, count), answers);
  const std::span<Answer> room = as_cpp<Answer>(to, capacity);
  size_t end = 0;
  for (size_t i = 0; i < answers.size(); ++i) {
    const size_t begin = std::min(end, capacity), fit = std::min(answers[i].size(), capacity - begin);
    std::copy_n(answers[i].begin(), fit, room.begin() + static_cast<std::ptrdiff_t>(begin));
    ends[i] = end += answers[i].size();
  }
}

}  // namespace
}  // namespace tact::c

using tact::c::as_cpp, tact::c::body_of, tact::c::check_not_null, tact::c::reading, tact::c::WorldEntry, tact::c::write,
    tact::c::write_each;

extern "C" {

tact_error tact_world_cast_ray(tact_world world, const tact_ray* ray, int32_t wanted, tact_ray_hit* hit) {
  return tact_world_cast_rays(world, ray, 1, wanted, hit);
}

tact_error tact_world_cast_rays(tact_world world, const tact_ray* rays, size_t count, int32_t wanted,
                                tact_ray_hit* hits) {
  return reading(world, [&](const WorldEntry& entry) {
    entry.world.cast_rays(as_cpp<const tact::Ray>(rays, count), as_cpp<tact::RayHit>(hits, count),
                          static_cast<tact::RayHits>(wanted));
  });
}

tact_error tact_world_cast_ray_all(tact_world world, const tact_ray* ray, tact_ray_hit* hits, size_t capacity,
                                   size_t* count) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(count);
    write(entry.world.cast_ray_all(as_cpp<const tact::Ray>(ray, 1)[0]), hits, capacity, count);
  });
}

tact_error tact_world_overlap_box(tact_world world, const tact_box_query* query, tact_facet_of_body* facets,
                                  size_t capacity, size_t* count) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(count);
    write(entry.world.overlap_box(as_cpp<const tact::BoxQuery>(query, 1)[0]), facets, capacity, count);
  });
}

tact_error tact_world_bodies_containing(tact_world world, const tact_point_query* query, tact_body* bodies,
                                        size_t capacity, size_t* count) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(count);
    write(entry.world.bodies_containing(as_cpp<const tact::PointQuery>(query, 1)[0]), bodies, capacity, count);
  });
}

tact_error tact_world_overlap_boxes(tact_world world, const tact_box_query* queries, size_t count,
                                    tact_facet_of_body* facets, size_t capacity, size_t* ends) {
  return reading(world, [&](const WorldEntry& entry) {
    write_each<tact::BoxQuery, tact::FacetOfBody>(
        queries, count, facets, capacity, ends,
        [&](const auto& asked, auto& answers) { entry.world.overlap_boxes(asked, answers); });
  });
}

tact_error tact_world_bodies_containing_each(tact_world world, const tact_point_query* queries, size_t count,
                                             tact_body* bodies, size_t capacity, size_t* ends) {
  return reading(world, [&](const WorldEntry& entry) {
    write_each<tact::PointQuery, tact::BodyId>(
        queries, count, bodies, capacity, ends,
        [&](const auto& asked, auto& answers) { entry.world.bodies_containing_each(asked, answers); });
  });
}

tact_error tact_world_closest_point(tact_world world, const tact_point_query* query, tact_closest_point* answer) {
  return tact_world_closest_points(world, query, 1, answer);
}

tact_error tact_world_closest_points(tact_world world, const tact_point_query* queries, size_t count,
                                     tact_closest_point* answers) {
  return reading(world, [&](const WorldEntry& entry) {
    entry.world.closest_points(as_cpp<const tact::PointQuery>(queries, count),
                               as_cpp<tact::ClosestPoint>(answers, count));
  });
}

tact_error tact_world_signed_distance(tact_world world, const tact_point_query* query, tact_closest_point* answer) {
  return tact_world_signed_distances(world, query, 1, answer);
}

tact_error tact_world_signed_distances(tact_world world, const tact_point_query* queries, size_t count,
                                       tact_closest_point* answers) {
  return reading(world, [&](const WorldEntry& entry) {
    entry.world.signed_distances(as_cpp<const tact::PointQuery>(queries, count),
                                 as_cpp<tact::ClosestPoint>(answers, count));
  });
}

tact_error tact_world_distance(tact_world world, const tact_distance_query* query, tact_body_distance* answer) {
  return reading(world, [&](const WorldEntry& entry) {
    as_cpp<tact::BodyDistance>(answer, 1)[0] = entry.world.distance(as_cpp<const tact::DistanceQuery>(query, 1)[0]);
  });
}

tact_error tact_world_distances(tact_world world, const tact_distance_query* queries, size_t count,
                                tact_body_distance* answers) {
  return reading(world, [&](const WorldEntry& entry) {
    entry.world.distances(as_cpp<const tact::DistanceQuery>(queries, count),
                          as_cpp<tact::BodyDistance>(answers, count));
  });
}

tact_error tact_world_nearest_bodies(tact_world world, const tact_nearest_bodies_query* query,
                                     tact_body_distance* answers, size_t capacity, size_t* count) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(count);
    write(entry.world.nearest_bodies(as_cpp<const tact::NearestBodiesQuery>(query, 1)[0]), answers, capacity, count);
  });
}

tact_error tact_world_sweep(tact_world world, const tact_sweep* sweep, tact_sweep_hit* hit) {
  return reading(world, [&](const WorldEntry& entry) {
    as_cpp<tact::SweepHit>(hit, 1)[0] = entry.world.sweep(as_cpp<const tact::Sweep>(sweep, 1)[0]);
  });
}

tact_error tact_world_sweeps(tact_world world, const tact_sweep* queries, size_t count, tact_sweep_hit* hits) {
  return reading(world, [&](const WorldEntry& entry) {
    entry.world.sweeps(as_cpp<const tact::Sweep>(queries, count), as_cpp<tact::SweepHit>(hits, count));
  });
}

tact_error tact_world_overlap(tact_world world, tact_body a, tact_body b, tact_overlap* overlap) {
  return reading(world, [&](const WorldEntry& entry) {
    as_cpp<tact::Overlap>(overlap, 1)[0] = entry.world.overlap(tact::c::id_of(a), tact::c::id_of(b));
  });
}

}  // extern "C"
