#include <chrono>
#include <cstddef>
#include <type_traits>

#include "handles.h"

namespace tact::c {
namespace {

static_assert(sizeof(tact_body) == sizeof(BodyId) && offsetof(tact_body, generation) == offsetof(BodyId, generation) &&
              offsetof(tact_body, world) == offsetof(BodyId, world));
static_assert(sizeof(tact_facet_pair) == sizeof(FacetPair) && offsetof(tact_facet_pair, b) == offsetof(FacetPair, b));
static_assert(sizeof(tact_contact_event) == sizeof(ContactEvent) &&
              offsetof(tact_contact_event, b) == offsetof(ContactEvent, b));
static_assert(sizeof(tact_patch_event) == sizeof(PatchEvent) &&
              offsetof(tact_patch_event, kind) == offsetof(PatchEvent, kind) &&
              offsetof(tact_patch_event, other) == offsetof(PatchEvent, other));
static_assert(sizeof(tact_candidate_pair) == sizeof(CandidatePair) &&
              offsetof(tact_candidate_pair, hulls_overlap) == offsetof(CandidatePair, hulls_overlap));

static_assert(std::is_standard_layout_v<ContactPoint> && sizeof(tact_contact_point) == sizeof(ContactPoint) &&
              offsetof(tact_contact_point, b_vertices) == offsetof(ContactPoint, b_vertices) &&
              offsetof(tact_contact_point, normal) == offsetof(ContactPoint, normal) &&
              offsetof(tact_contact_point, id) == offsetof(ContactPoint, id) &&
              offsetof(tact_contact_point, minimum) == offsetof(ContactPoint, minimum));
static_assert(std::is_standard_layout_v<CurvePoint> && sizeof(tact_curve_point) == sizeof(CurvePoint) &&
              offsetof(tact_curve_point, fraction) == offsetof(CurvePoint, fraction) &&
              offsetof(tact_curve_point, edge) == offsetof(CurvePoint, edge) &&
              offsetof(tact_curve_point, facet) == offsetof(CurvePoint, facet) &&
              offsetof(tact_curve_point, facet_pair) == offsetof(CurvePoint, facet_pair) &&
              offsetof(tact_curve_point, edge_of_b) == offsetof(CurvePoint, edge_of_b));

static_assert(std::is_standard_layout_v<ReachPair> && sizeof(tact_reach_pair) == sizeof(ReachPair) &&
              offsetof(tact_reach_pair, b_vertices) == offsetof(ReachPair, b_vertices) &&
              offsetof(tact_reach_pair, b_weights) == offsetof(ReachPair, b_weights) &&
              offsetof(tact_reach_pair, normal) == offsetof(ReachPair, normal) &&
              offsetof(tact_reach_pair, distance) == offsetof(ReachPair, distance));

void put(const Eigen::Vector3d& from, double* to) { std::copy_n(from.data(), 3, to); }

tact_zone_disk disk_of(const ZoneDisk& disk) {
  tact_zone_disk result{};
  put(disk.center, result.center);
  result.radius = disk.radius;
  return result;
}

tact_contact contact_of(const Contact& contact) {
  tact_contact result = TACT_CONTACT_INIT;
  result.a = body_of(contact.a);
  result.b = body_of(contact.b);
  put(contact.direction, result.direction);
  result.depth = contact.depth;
  result.source = static_cast<int>(contact.source);
  result.iterations = contact.iterations;
  result.limit_reached = contact.limit_reached;
  result.touching = contact.touching();
  result.plane_a = contact.plane_a;
  result.plane_b = contact.plane_b;
  result.zone_a = disk_of(contact.zone_a);
  result.zone_b = disk_of(contact.zone_b);
  result.kept_facets_a = contact.kept_facets_a;
  result.kept_facets_b = contact.kept_facets_b;
  show(contact.facet_pairs(), &result.facet_pairs, &result.facet_pair_count);
  result.patch_count = contact.patches().size();
  result.containment = static_cast<int>(contact.containment);
  result.point_limit_reached = contact.point_limit_reached;
  result.curve_count = contact.curves().size();
  return result;
}

std::int64_t nanoseconds(TraceEvent::Time time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

}  // namespace
}  // namespace tact::c

using tact::Report;
using tact::c::at, tact::c::body_of, tact::c::check_not_null, tact::c::show, tact::c::with_report,
    tact::c::write_struct;

extern "C" {

tact_error tact_report_contacts(tact_world world, size_t* count) {
  return with_report(world, [&](const Report& report) {
    check_not_null(count);
    *count = report.contacts().size();
  });
}

tact_error tact_report_contact(tact_world world, size_t index, tact_contact* contact) {
  return with_report(world, [&](const Report& report) {
    check_not_null(contact);
    write_struct(*contact, tact::c::contact_of(at(report.contacts(), index)));
  });
}

tact_error tact_report_find_contact(tact_world world, tact_body a, tact_body b, size_t* index) {
  return with_report(world, [&](const Report& report) {
    check_not_null(index);
    const tact::Contact* found = report.find_contact(tact::c::id_of(a), tact::c::id_of(b));
    *index = found != nullptr ? static_cast<size_t>(found - report.contacts().data()) : report.contacts().size();
  });
}

tact_error tact_contact_patch(tact_world world, size_t index, size_t patch, tact_patch* result) {
  return with_report(world, [&](const Report& report) {
    check_not_null(result);
    const tact::Patch& found = at(at(report.contacts(), index).patches(), patch);
    tact_patch value = TACT_PATCH_INIT;
    tact::c::put(found.point, value.point);
    tact::c::put(found.direction, value.direction);
    value.depth = found.depth;
    value.facet_pairs = found.facet_pairs.data();
    value.facet_pair_count = found.facet_pairs.size();
    value.id = found.id;
    value.area = found.area;
    value.points = found.points.data();
    value.point_count = found.points.size();
    std::ranges::copy(found.spanning, value.spanning);
    write_struct(*result, value);
  });
}

tact_error tact_contact_curve(tact_world world, size_t index, size_t curve, tact_curve* result) {
  return with_report(world, [&](const Report& report) {
    check_not_null(result);
    const tact::IntersectionCurve& found = at(at(report.contacts(), index).curves(), curve);
    tact_curve value = TACT_CURVE_INIT;
    value.closed = found.closed;
    show(found.points, &value.points, &value.point_count);
    write_struct(*result, value);
  });
}

tact_error tact_contact_hash(tact_world world, size_t index, uint64_t* hash) {
  return with_report(world, [&](const Report& report) {
    check_not_null(hash);
    *hash = at(report.contacts(), index).hash();
  });
}

tact_error tact_contact_points(tact_world world, size_t index, const tact_contact_point** points, size_t* count) {
  return with_report(world, [&](const Report& report) { show(at(report.contacts(), index).points(), points, count); });
}

tact_error tact_contact_within_reach(tact_world world, size_t index, const tact_reach_pair** pairs, size_t* count) {
  return with_report(world,
                     [&](const Report& report) { show(at(report.contacts(), index).within_reach(), pairs, count); });
}

tact_error tact_report_candidate_pairs(tact_world world, const tact_candidate_pair** pairs, size_t* count) {
  return with_report(world, [&](const Report& report) { show(report.candidate_pairs(), pairs, count); });
}

tact_error tact_report_began(tact_world world, const tact_contact_event** events, size_t* count) {
  return with_report(world, [&](const Report& report) { show(report.began(), events, count); });
}

tact_error tact_report_ended(tact_world world, const tact_contact_event** events, size_t* count) {
  return with_report(world, [&](const Report& report) { show(report.ended(), events, count); });
}

tact_error tact_report_patch_events(tact_world world, const tact_patch_event** events, size_t* count) {
  return with_report(world, [&](const Report& report) { show(report.patch_events(), events, count); });
}

tact_error tact_report_stats(tact_world world, tact_statistic* statistics, size_t capacity, size_t* count) {
  return with_report(world, [&](const Report& report) {
    check_not_null(count);
    if (capacity > 0) check_not_null(statistics);
    size_t place = 0;
    const auto add = [&](const tact_statistic& statistic) {
      if (place < capacity) statistics[place] = statistic;
      ++place;
    };
    tact::for_each_count(report.stats(), [&](const char* name, const char* text, std::int64_t value) {
      add({name, text, false, value, 0.0});
    });
    tact::for_each_time(report.stats(), [&](const char* name, const char* text, double ms) {
      add({name, text, true, 0, ms});
    });
    *count = place;
  });
}

tact_error tact_report_trace(tact_world world, size_t* count) {
  return with_report(world, [&](const Report& report) {
    check_not_null(count);
    *count = report.trace().size();
  });
}

tact_error tact_report_trace_event(tact_world world, size_t index, tact_trace_event* event) {
  return with_report(world, [&](const Report& report) {
    check_not_null(event);
    const tact::TraceEvent& found = at(report.trace(), index);
    tact_trace_event value = TACT_TRACE_EVENT_INIT;
    value.kind = static_cast<int>(found.kind);
    value.thread = found.thread;
    value.begin_ns = tact::c::nanoseconds(found.begin);
    value.end_ns = tact::c::nanoseconds(found.end);
    value.a = body_of(found.a);
    value.b = body_of(found.b);
    value.count = found.count;
    write_struct(*event, value);
  });
}

tact_error tact_report_hash(tact_world world, uint64_t* hash) {
  return with_report(world, [&](const Report& report) {
    check_not_null(hash);
    *hash = report.hash();
  });
}

tact_error tact_report_keep(tact_world world, tact_world* kept) {
  return with_report(world, [&](const Report& report) {
    check_not_null(kept);
    if (kept->handle == 0) {
      const auto entry =
          std::make_shared<tact::c::WorldEntry>(std::make_shared<tact::World>(tact::Settings{.threads = 1}));
      entry->kept.emplace().keep(report);
      entry->report = &entry->kept->report();
      kept->handle = tact::c::add_entry(entry);
      return;
    }
    if (kept->handle == world.handle) return;
    const std::shared_ptr<tact::c::WorldEntry> entry = tact::c::entry_of(*kept);
    const std::unique_lock lock(entry->in_use, std::try_to_lock);
    if (!lock) throw tact::c::kBusy;
    if (!entry->kept) throw tact::c::Failure{TACT_ERROR_WRONG_ORDER, "kept is a world, not a report that was kept"};
    entry->report = nullptr;
    entry->kept->keep(report);
    entry->report = &entry->kept->report();
  });
}
}
