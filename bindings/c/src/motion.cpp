#include <cstddef>
#include <type_traits>

#include "handles.h"

namespace tact::c {
namespace {

static_assert(std::is_standard_layout_v<Impact> && sizeof(tact_impact) == sizeof(Impact) &&
              offsetof(tact_impact, kind) == offsetof(Impact, kind) &&
              offsetof(tact_impact, time) == offsetof(Impact, time) &&
              offsetof(tact_impact, b_vertices) == offsetof(Impact, b_vertices) &&
              offsetof(tact_impact, stops) == offsetof(Impact, stops));

}  // namespace
}  // namespace tact::c

using tact::MotionReport;
using tact::c::at, tact::c::body_of, tact::c::check_not_null, tact::c::show, tact::c::with_motion,
    tact::c::write_struct;

extern "C" {

tact_error tact_motion_first_time(tact_world world, double* time) {
  return with_motion(world, [&](const MotionReport& motion) {
    check_not_null(time);
    *time = motion.first_time();
  });
}

tact_error tact_motion_impacts(tact_world world, const tact_impact** impacts, size_t* count) {
  return with_motion(world, [&](const MotionReport& motion) { show(motion.impacts(), impacts, count); });
}

tact_error tact_motion_pairs(tact_world world, size_t* count) {
  return with_motion(world, [&](const MotionReport& motion) {
    check_not_null(count);
    *count = motion.pairs().size();
  });
}

tact_error tact_motion_pair(tact_world world, size_t index, tact_impact_pair* pair) {
  return with_motion(world, [&](const MotionReport& motion) {
    check_not_null(pair);
    const tact::ImpactPair& found = at(motion.pairs(), index);
    tact_impact_pair value = TACT_IMPACT_PAIR_INIT;
    value.a = body_of(found.a);
    value.b = body_of(found.b);
    value.first_time = found.first_time;
    show(found.impacts, &value.impacts, &value.impact_count);
    write_struct(*pair, value);
  });
}

tact_error tact_motion_bounds(tact_world world, tact_body body, const double** bounds, size_t* count) {
  return with_motion(world,
                     [&](const MotionReport& motion) { show(motion.bounds(tact::c::id_of(body)), bounds, count); });
}

tact_error tact_motion_stats(tact_world world, tact_motion_statistics* statistics) {
  return with_motion(world, [&](const MotionReport& motion) {
    check_not_null(statistics);
    const tact::MotionStats& stats = motion.stats();
    tact_motion_statistics value = TACT_MOTION_STATISTICS_INIT;
    value.moved_bodies = stats.moved_bodies;
    value.body_pairs = stats.body_pairs;
    value.cluster_pairs = stats.cluster_pairs;
    value.candidates = stats.candidates;
    value.searched = stats.searched;
    value.spans = stats.spans;
    value.impacts = stats.impacts;
    value.sweep_ms = stats.sweep_ms;
    value.search_ms = stats.search_ms;
    write_struct(*statistics, value);
  });
}

}  // extern "C"
