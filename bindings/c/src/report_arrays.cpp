#include <tact/joined_minima.h>
#include <tact/report_arrays.h>

#include "handles.h"

namespace tact::c {
namespace {

// An array that is not left out has `rows` rows, which the library holds against the number of answers.
template <class Number>
std::span<Number> array_of(Number* first, size_t rows, size_t width) {
  return first == nullptr ? std::span<Number>() : std::span(first, rows * width);
}

void check_rows(size_t rows, size_t answers) {
  if (rows != answers)
    throw Failure{TACT_ERROR_WRONG_SIZE,
                  "rows is " + std::to_string(rows) + ", but there are " + std::to_string(answers) + " answers"};
}

}  // namespace
}  // namespace tact::c

using tact::c::array_of, tact::c::check_not_null, tact::c::check_rows, tact::c::read_struct, tact::c::with_motion,
    tact::c::with_report;

extern "C" {

tact_error tact_report_point_count(tact_world world, size_t* count) {
  return with_report(world, [&](const tact::Report& report) {
    check_not_null(count);
    *count = point_count(report);
  });
}

tact_error tact_report_reach_pair_count(tact_world world, size_t* count) {
  return with_report(world, [&](const tact::Report& report) {
    check_not_null(count);
    *count = reach_pair_count(report);
  });
}

tact_error tact_report_facet_pair_count(tact_world world, size_t* count) {
  return with_report(world, [&](const tact::Report& report) {
    check_not_null(count);
    *count = facet_pair_count(report);
  });
}

tact_error tact_report_copy_points(tact_world world, const tact_point_arrays* arrays, size_t rows) {
  return with_report(world, [&](const tact::Report& report) {
    check_not_null(arrays);
    check_rows(rows, point_count(report));
    const tact_point_arrays to = read_struct(*arrays, tact_point_arrays TACT_POINT_ARRAYS_INIT);
    copy_points(report, {.bodies = array_of(to.bodies, rows, 2),
                         .contacts = array_of(to.contacts, rows, 1),
                         .kinds = array_of(to.kinds, rows, 1),
                         .a_vertices = array_of(to.a_vertices, rows, 3),
                         .b_vertices = array_of(to.b_vertices, rows, 3),
                         .a_weights = array_of(to.a_weights, rows, 3),
                         .b_weights = array_of(to.b_weights, rows, 3),
                         .normals = array_of(to.normals, rows, 3),
                         .gaps = array_of(to.gaps, rows, 1),
                         .ids = array_of(to.ids, rows, 1),
                         .patch_ids = array_of(to.patch_ids, rows, 1),
                         .minima = array_of(to.minima, rows, 1)});
  });
}

tact_error tact_report_copy_point_labels(tact_world world, const tact_point_label_arrays* arrays, size_t rows) {
  return tact::c::reading(world, [&](const tact::c::WorldEntry& entry) {
    check_not_null(arrays);
    const tact::Report& report = tact::c::report_of(entry);
    check_rows(rows, point_count(report));
    const tact_point_label_arrays to = read_struct(*arrays, tact_point_label_arrays TACT_POINT_LABEL_ARRAYS_INIT);
    copy_point_labels(entry.world, report,
                      {array_of(to.a_facets, rows, 1), array_of(to.b_facets, rows, 1), array_of(to.a_vertices, rows, 3),
                       array_of(to.b_vertices, rows, 3)});
  });
}

tact_error tact_report_copy_reach_pairs(tact_world world, const tact_reach_pair_arrays* arrays, size_t rows) {
  return with_report(world, [&](const tact::Report& report) {
    check_not_null(arrays);
    check_rows(rows, reach_pair_count(report));
    const tact_reach_pair_arrays to = read_struct(*arrays, tact_reach_pair_arrays TACT_REACH_PAIR_ARRAYS_INIT);
    copy_reach_pairs(report, {.bodies = array_of(to.bodies, rows, 2),
                              .contacts = array_of(to.contacts, rows, 1),
                              .kinds = array_of(to.kinds, rows, 1),
                              .a_vertices = array_of(to.a_vertices, rows, 3),
                              .b_vertices = array_of(to.b_vertices, rows, 3),
                              .a_weights = array_of(to.a_weights, rows, 3),
                              .b_weights = array_of(to.b_weights, rows, 3),
                              .normals = array_of(to.normals, rows, 3),
                              .distances = array_of(to.distances, rows, 1)});
  });
}

tact_error tact_report_copy_facet_pairs(tact_world world, const tact_facet_pair_arrays* arrays, size_t rows) {
  return with_report(world, [&](const tact::Report& report) {
    check_not_null(arrays);
    check_rows(rows, facet_pair_count(report));
    const tact_facet_pair_arrays to = read_struct(*arrays, tact_facet_pair_arrays TACT_FACET_PAIR_ARRAYS_INIT);
    copy_facet_pairs(report, {.bodies = array_of(to.bodies, rows, 2),
                              .contacts = array_of(to.contacts, rows, 1),
                              .facets = array_of(to.facets, rows, 2)});
  });
}

tact_error tact_motion_copy_impacts(tact_world world, const tact_impact_arrays* arrays, size_t rows) {
  return with_motion(world, [&](const tact::MotionReport& report) {
    check_not_null(arrays);
    check_rows(rows, report.impacts().size());
    const tact_impact_arrays to = read_struct(*arrays, tact_impact_arrays TACT_IMPACT_ARRAYS_INIT);
    copy_impacts(report, {.bodies = array_of(to.bodies, rows, 2),
                          .kinds = array_of(to.kinds, rows, 1),
                          .times = array_of(to.times, rows, 1),
                          .a_vertices = array_of(to.a_vertices, rows, 3),
                          .b_vertices = array_of(to.b_vertices, rows, 3),
                          .stops = array_of(to.stops, rows, 1)});
  });
}

tact_error tact_report_joined_minima(tact_world world, const tact_joined_surfaces* joined, uint8_t* minima,
                                     size_t rows) {
  return tact::c::reading(world, [&](const tact::c::WorldEntry& entry) {
    if (rows > 0) check_not_null(minima);
    tact_joined_surfaces given = TACT_JOINED_SURFACES_INIT;
    if (joined != nullptr) given = read_struct(*joined, given);
    const tact::Report& report = tact::c::report_of(entry);
    check_rows(rows, point_count(report));
    std::ranges::copy(joined_minima(entry.world, report, {given.within, given.layers}), minima);
  });
}
}
