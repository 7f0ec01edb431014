// The queries of a world: check, and answer one or many in parallel.
#include <algorithm>
#include <string>

#include "engine/base/parallel.h"
#include "engine/body_queries.h"
#include "engine/check_name.h"
#include "engine/queries.h"
#include "engine/world_implementation.h"

namespace tact {

namespace {

constexpr const char* kNoMemoryForAnswers = "answering ran out of memory";

// Blocks of rays that a thread takes: some 40 microseconds, about what it takes another thread to wake up.
constexpr std::size_t kRayBlocksAtATime = 16;

template <class Query>
void check_one(const Bodies& bodies, const Query& query) {
  if constexpr (requires { check_query(bodies, query); }) {
    check_query(bodies, query);
  } else {
    check_query(query);
  }
}

// The message of an error tells which query it is of.
template <class Query>
void check_queries(const Bodies& bodies, std::span<const Query> queries, std::size_t answers) {
  if (queries.size() != answers) {
    throw Error(ErrorCode::wrong_size,
                std::to_string(queries.size()) + " queries, but room for " + std::to_string(answers) + " answers");
  }
  for (std::size_t i = 0; i < queries.size(); ++i) {
    try {
      check_one(bodies, queries[i]);
    } catch (const Error& error) {
      throw Error(error.code(), "query " + std::to_string(i) + ": " + error.what());
    }
  }
}

// Answers one query by find().
template <class OfWorld, class Query, class Find>
auto answer_one(const OfWorld& world, const Query& query, const Find& find) {
  const base::FloatingPointMode mode;
  return with_memory(kNoMemoryForAnswers, [&] {
    check_one(world.bodies, query);
    world.bodies.expect_queries(1);
    return find();
  });
}

// Answers each query by find(query), on all threads.
template <class OfWorld, class Query, class Answer, class Find>
void answer_all(OfWorld& world, std::span<const Query> queries, std::span<Answer> answers, const Find& find) {
  constexpr std::size_t kAtATime = 16;  // a query takes a microsecond or more
  const base::FloatingPointMode mode;
  const base::Workers::Scope scope(world.workers);
  with_memory(kNoMemoryForAnswers, [&] {
    check_queries(world.bodies, queries, answers.size());
    world.bodies.expect_queries(queries.size());
    base::parallel_for(queries.size(), kAtATime, world.settings.threads,
                       [&](std::size_t i) { answers[i] = find(queries[i]); });
  });
}

}  // namespace

RayHit World::cast_ray(const Ray& ray, RayHits wanted) const {
  const Implementation& i = implementation();
  check_name(wanted, RayHits::any, "hits");
  return answer_one(i, ray, [&] { return find_hit(i.bodies, ray, wanted); });
}

void World::cast_rays(std::span<const Ray> rays, std::span<RayHit> hits, RayHits wanted) const {
  Implementation& i = implementation();
  check_name(wanted, RayHits::any, "hits");
  // Fewer do not open the same clusters often enough, nor do rays of which not even one is for each body.
  const std::size_t fewest_together = std::max<std::size_t>(64, i.bodies.count());
  if (wanted != RayHits::first || rays.size() < fewest_together)
    return answer_all(i, rays, hits, [&](const Ray& ray) { return find_hit(i.bodies, ray, wanted); });
  const base::FloatingPointMode mode;
  const base::Workers::Scope scope(i.workers);
  with_memory(kNoMemoryForAnswers, [&] {
    check_queries(i.bodies, rays, hits.size());
    constexpr std::size_t kAtATime = narrowphase::kLinesAtATime;
    const base::Pool<RayTrees>::Loan loan(i.ray_trees);
    RayTrees& trees = *loan;
    i.bodies.expect_queries(rays.size());
    const std::size_t blocks = (rays.size() + kAtATime - 1) / kAtATime;
    const int threads = blocks > kRayBlocksAtATime ? i.settings.threads : 1;
    trees.begin(i.bodies, rays.size(), threads);
    base::parallel_for(blocks, kRayBlocksAtATime, threads, [&](std::size_t block, int thread) {
      const std::size_t begin = block * kAtATime, count = std::min(kAtATime, rays.size() - begin);
      find_first_hits(i.bodies, rays.subspan(begin, count), hits.subspan(begin, count),
                      trees.of_thread(i.bodies, thread));
    });
  });
}

std::vector<RayHit> World::cast_ray_all(const Ray& ray) const {
  const Implementation& i = implementation();
  return answer_one(i, ray, [&] { return find_all_hits(i.bodies, ray); });
}

ClosestPoint World::closest_point(const PointQuery& query) const {
  const Implementation& i = implementation();
  return answer_one(i, query, [&] { return find_closest_point(i.bodies, query); });
}

void World::closest_points(std::span<const PointQuery> queries, std::span<ClosestPoint> answers) const {
  Implementation& i = implementation();
  answer_all(i, queries, answers, [&](const PointQuery& query) { return find_closest_point(i.bodies, query); });
}

std::vector<FacetOfBody> World::overlap_box(const BoxQuery& query) const {
  const Implementation& i = implementation();
  return answer_one(i, query, [&] { return find_in_box(i.bodies, query); });
}

std::vector<BodyId> World::bodies_containing(const PointQuery& query) const {
  const Implementation& i = implementation();
  return answer_one(i, query, [&] { return find_around(i.bodies, query); });
}

void World::overlap_boxes(std::span<const BoxQuery> queries, std::span<std::vector<FacetOfBody>> answers) const {
  Implementation& i = implementation();
  answer_all(i, queries, answers, [&](const BoxQuery& query) { return find_in_box(i.bodies, query); });
}

void World::bodies_containing_each(std::span<const PointQuery> queries, std::span<std::vector<BodyId>> answers) const {
  Implementation& i = implementation();
  answer_all(i, queries, answers, [&](const PointQuery& query) { return find_around(i.bodies, query); });
}

ClosestPoint World::signed_distance(const PointQuery& query) const {
  const Implementation& i = implementation();
  return answer_one(i, query, [&] { return find_signed_distance(i.bodies, query); });
}

void World::signed_distances(std::span<const PointQuery> queries, std::span<ClosestPoint> answers) const {
  Implementation& i = implementation();
  answer_all(i, queries, answers, [&](const PointQuery& query) { return find_signed_distance(i.bodies, query); });
}

BodyDistance World::distance(const DistanceQuery& query) const {
  const Implementation& i = implementation();
  return answer_one(i, query, [&] { return find_distance(i.bodies, query); });
}

void World::distances(std::span<const DistanceQuery> queries, std::span<BodyDistance> answers) const {
  Implementation& i = implementation();
  answer_all(i, queries, answers, [&](const DistanceQuery& query) { return find_distance(i.bodies, query); });
}

std::vector<BodyDistance> World::nearest_bodies(const NearestBodiesQuery& query) const {
  const Implementation& i = implementation();
  return answer_one(i, query, [&] { return find_nearest_bodies(i.bodies, query); });
}

SweepHit World::sweep(const Sweep& sweep) const {
  const Implementation& i = implementation();
  return answer_one(i, sweep, [&] { return find_swept(i.bodies, sweep); });
}

void World::sweeps(std::span<const Sweep> queries, std::span<SweepHit> hits) const {
  Implementation& i = implementation();
  answer_all(i, queries, hits, [&](const Sweep& sweep) { return find_swept(i.bodies, sweep); });
}

Overlap World::overlap(BodyId a, BodyId b) const {
  const base::FloatingPointMode mode;
  return with_memory(kNoMemoryForAnswers, [&] { return find_overlap(implementation().bodies, a, b); });
}

}  // namespace tact
