// Queries to all bodies: those whose box has to do with it, one after the other.
#pragma once

#include <tact/queries.h>

#include <cstddef>
#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "narrowphase/queries/line_block.h"

namespace tact {

/// Errors: non_finite_position, position_out_of_range, invalid_argument (a box whose lower corner is above its upper
/// one, a distance that is negative or not a number).
void check_query(const Ray& ray);
void check_query(const PointQuery& query);
void check_query(const BoxQuery& query);

RayHit find_hit(const Bodies& bodies, const Ray& ray, RayHits wanted);
/// Begins to ask for the first hits of many rays of the bodies as they are now.
void begin_rays(const Bodies& bodies, std::size_t rays, int threads, narrowphase::SegmentBatch& room);
/// Answers some of them, up to kLinesAtATime, each as find_hit().
void find_first_hits(const Bodies& bodies, std::span<const Ray> rays, std::span<RayHit> hits,
                     const narrowphase::SegmentBatch& room);
std::vector<RayHit> find_all_hits(const Bodies& bodies, const Ray& ray);
ClosestPoint find_closest_point(const Bodies& bodies, const PointQuery& query);
std::vector<FacetOfBody> find_in_box(const Bodies& bodies, const BoxQuery& query);
std::vector<BodyId> find_around(const Bodies& bodies, const PointQuery& query);

}  // namespace tact
