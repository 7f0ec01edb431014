// Queries of whole bodies: distances, sweeps, overlaps. Any number of threads may call these.
#pragma once

#include <tact/body_queries.h>

#include <vector>

#include "engine/bodies/bodies.h"

namespace tact {

/// Errors: stale_body, foreign_body, non_finite_position, position_out_of_range, invalid_argument.
void check_query(const Bodies& bodies, const DistanceQuery& query);
void check_query(const Bodies& bodies, const NearestBodiesQuery& query);
void check_query(const Bodies& bodies, const Sweep& sweep);

BodyDistance find_distance(const Bodies& bodies, const DistanceQuery& query);
std::vector<BodyDistance> find_nearest_bodies(const Bodies& bodies, const NearestBodiesQuery& query);
SweepHit find_swept(const Bodies& bodies, const Sweep& sweep);
/// Errors: stale_body, foreign_body, invalid_argument.
Overlap find_overlap(const Bodies& bodies, BodyId a, BodyId b);

}  // namespace tact
