// Moving features, random and hard, and whether the engine is right about them.
#pragma once

#include <optional>
#include <string>

#include "narrowphase/motion/meeting.h"
#include "tests/support/data/unit_queries.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/motion_oracle.h"

namespace tact::tests {

using MotionQuery = UnitQuery;
/// In rational arithmetic.
std::optional<TimeEnclosure> exact_time(const MotionQuery& query);
/// The time at which the two are at most `reach` apart.
std::optional<TimeEnclosure> exact_time_within(const MotionQuery& query, double reach);

/// Coplanar, parallel, equal, at rest and rigid ones among others, of any size, near to zero and far from it.
MotionQuery random_query(Random& random);
/// At half-way a vertex lies in a corner, on a side or inside the other feature, but for rounding.
MotionQuery grazing_query(Random& random);
/// Edges of two layers of cloth on one grid, that move along the vertical: they stay in one plane.
MotionQuery query_in_plane(Random& random);
/// Features of two layers on one grid, in all places of it, that move along an axis: corners meet exactly.
MotionQuery query_of_layers(Random& random);

/// Features of two boxes on a grid that pass each other, corner to corner most often.
MotionQuery query_past_corner(Random& random);
/// A reach for a query: of any size up to that of the features, or so that they just come that near.
double reach_for(const MotionQuery& query, Random& random);

enum class QueryAnswer { meets, misses, misses_but_counts };  // the last: by next to nothing
struct CheckedQuery {
  QueryAnswer answer = QueryAnswer::misses;
  std::string failure;  // empty: the engine is right
};
/// Is what the engine says of the query right? Never missed, never late, at most 1e-6 early unless the two come within
/// 1e-11 of their size and way then; and what misses by more than that is never reported.
CheckedQuery check(const MotionQuery& query, narrowphase::MeetingSearch& search);
/// The same with a reach: against the true times of the reach that counts and of one that is larger by 1e-11 of size
/// and way.
CheckedQuery check_within(const MotionQuery& query, double reach, narrowphase::MeetingSearch& search);

}  // namespace tact::tests
