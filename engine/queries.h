// Queries of all bodies at once. Bodies are found by their boxes, in a tree (bodies/body_tree.h) or by a scan, and
// answers depend on neither. Any number of threads may call these.
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
void check_point(const Eigen::Vector3d& point, const char* what);
void check_within(double within);
void check_query(const Ray& ray);
void check_query(const PointQuery& query);
void check_query(const BoxQuery& query);

RayHit find_hit(const Bodies& bodies, const Ray& ray, RayHits wanted);
/// The first hits of up to kLinesAtATime rays, each as find_hit() has it.
void find_first_hits(const Bodies& bodies, std::span<const Ray> rays, std::span<RayHit> hits,
                     const narrowphase::SegmentBatch& trees);
std::vector<RayHit> find_all_hits(const Bodies& bodies, const Ray& ray);
ClosestPoint find_closest_point(const Bodies& bodies, const PointQuery& query);
ClosestPoint find_signed_distance(const Bodies& bodies, const PointQuery& query);
std::vector<FacetOfBody> find_in_box(const Bodies& bodies, const BoxQuery& query);
std::vector<BodyId> find_around(const Bodies& bodies, const PointQuery& query);

}  // namespace tact
