// Every function of the interface for C in each floating-point mode that a caller may have set.
#include <gtest/gtest.h>
#include <tact/tact_c.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "tests/c/header_of_c.h"
#include "tests/c/mesh_for_c.h"
#include "tests/support/environment/callers_mode.h"
#include "tests/support/environment/temporary_folder.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

class EveryCallOfC {
 public:
  EveryCallOfC(const FloatingPointSettings& mode, int threads) : mode_(mode) {
    settings_.threads = threads;
    settings_.zones = settings_.patches = settings_.points = settings_.curves = settings_.trace = true;
    settings_.within_reach = true;
    for (double& x : rotation_) x = 0.0;
    rotation_[1] = rotation_[5] = rotation_[6] = 1.0;
  }

  // What the calls give.
  std::vector<std::uint64_t> run() {
    call([&] { return tact_version() != nullptr ? TACT_OK : TACT_ERROR_INTERNAL; });
    call([&] { return tact_error_code_name(TACT_OK) != nullptr ? TACT_OK : TACT_ERROR_INTERNAL; });
    call([&] { return tact_world_create(&settings_, &world_); });
    call([&] { return tact_world_record(world_, path_.c_str()); });
    add_bodies();
    step();
    change();
    step();
    look();
    ask();
    solve();
    go_back();
    refuse();
    call([&] { return tact_world_remove_body(world_, bodies_[1]); });
    step();
    call([&] { return tact_world_record(world_, nullptr); });
    call([&] { return tact_world_destroy(world_); });
    play();
    return told_;
  }

 private:
  template <class Call>
  tact_error answer(const Call& one) {
    return in_mode(mode_, one);
  }
  template <class Call>
  void call(const Call& one) {
    const tact_error error = answer(one);
    EXPECT_EQ(error, TACT_OK) << mode_.name << ": " << tact_last_error_message();
  }
  void tell(std::uint64_t word) { told_.push_back(word); }
  void tell(std::span<const double> values) {
    for (const double value : values) tell(std::bit_cast<std::uint64_t>(value));
  }

  void add_bodies() {
    for (const Mesh* mesh : {&ball_, &other_, &floor_}) {
      tact_body_definition definition = definition_of(*mesh);
      definition.margin = 0.03;
      if (mesh == &floor_) definition.motion = TACT_MOTION_RIGID;
      call([&] { return tact_world_add_body(world_, &definition, &bodies_.emplace_back()); });
    }
    tact_plane_definition plane = TACT_PLANE_DEFINITION_INIT;
    plane.offset = -1.0 / 3.0;
    call([&] { return tact_world_add_plane(world_, &plane, &bodies_.emplace_back()); });
  }

  void step() {
    size_t count = 0, index = 0;
    uint64_t hash = 0;
    call([&] { return tact_world_detect(world_); });
    call([&] { return tact_report_hash(world_, &hash); });
    tell(hash);
    call([&] { return tact_report_find_contact(world_, bodies_[0], bodies_[2], &index); });
    call([&] { return tact_report_contacts(world_, &count); });
    for (size_t i = 0; i < count; ++i) tell_contact(i);
    const tact_candidate_pair* pairs = nullptr;
    const tact_contact_event* events = nullptr;
    const tact_patch_event* patch_events = nullptr;
    call([&] { return tact_report_candidate_pairs(world_, &pairs, &count); });
    tell(count);
    call([&] { return tact_report_began(world_, &events, &count); });
    tell(count);
    call([&] { return tact_report_ended(world_, &events, &count); });
    tell(count);
    call([&] { return tact_report_patch_events(world_, &patch_events, &count); });
    tell(count);
    std::vector<tact_statistic> statistics(200);
    call([&] { return tact_report_stats(world_, statistics.data(), statistics.size(), &count); });
    call([&] { return tact_report_trace(world_, &count); });
    tact_trace_event event = TACT_TRACE_EVENT_INIT;
    if (count > 0) call([&] { return tact_report_trace_event(world_, 0, &event); });
    draw();
  }

  void tell_contact(size_t i) {
    tact_contact contact = TACT_CONTACT_INIT;
    call([&] { return tact_report_contact(world_, i, &contact); });
    uint64_t hash = 0;
    call([&] { return tact_contact_hash(world_, i, &hash); });
    tell(hash);
    tell(contact.direction);
    const tact_contact_point* points = nullptr;
    size_t count = 0;
    call([&] { return tact_contact_points(world_, i, &points, &count); });
    for (size_t k = 0; k < count; ++k) tell(points[k].normal);
    const tact_reach_pair* pairs = nullptr;
    call([&] { return tact_contact_within_reach(world_, i, &pairs, &count); });
    for (size_t k = 0; k < count; ++k) tell(pairs[k].normal);
    for (size_t k = 0; k < contact.patch_count; ++k) {
      tact_patch patch = TACT_PATCH_INIT;
      call([&] { return tact_contact_patch(world_, i, k, &patch); });
      tell(patch.direction);
    }
    for (size_t k = 0; k < contact.curve_count; ++k) {
      tact_curve curve = TACT_CURVE_INIT;
      call([&] { return tact_contact_curve(world_, i, k, &curve); });
      tell(curve.points[0].position);
    }
  }

  void draw() {
    tact_debug_draw_options options;
    call([&] { return tact_debug_draw_defaults(&options); });
    options.surfaces = options.planes = options.kept_facets = true;
    const auto take = [](void* user, const double* at) {
      static_cast<EveryCallOfC*>(user)->tell(std::span(at, std::size_t{3}));
    };
    static constexpr auto kTake = take;
    const tact_debug_drawer drawer{
        [](void* user, const double* from, const double*, tact_debug_color) { kTake(user, from); },
        [](void* user, const double* p, const double*, const double*, tact_debug_color) { kTake(user, p); },
        [](void* user, const double* at, const char*, tact_debug_color) { kTake(user, at); }, this};
    call([&] { return tact_world_debug_draw(world_, &drawer, &options); });
    call([&] { return tact_world_debug_draw_sums(world_, nullptr, 0, &drawer, nullptr); });
    const tact_distance_query query{bodies_[0], bodies_[2], HUGE_VAL};
    tact_body_distance distance;
    call([&] { return tact_world_distance(world_, &query, &distance); });
    call([&] { return tact_world_debug_draw_distances(world_, &distance, 1, &drawer, nullptr); });
    const tact_stencil stencil{
        TACT_STENCIL_POINT_EDGE, true, {0, 1, 2, -1}, {1.0, -1.0 / 3.0, -2.0 / 3.0}, {0, 0, 1}, 0.1, 0};
    const double corners[9] = {0.1, 0.2, 0.3, 1.0 / 3.0, 0.0, 0.0, 1.0, 2.0, 0.7};
    call([&] { return tact_stencil_debug_draw(&stencil, 1, corners, 3, &drawer, {1.0f, 1.0f, 1.0f, 1.0f}); });
  }

  void change() {
    const Mesh there = translated(ball_, {0.1, 0.02, -0.1}), elsewhere = translated(other_, {-0.1, 0.0, -0.2});
    const tact_columns columns = columns_of(there.positions);
    const tact_positions_update update{bodies_[1], columns_of(elsewhere.positions)};
    const double translation[3] = {0.1, 0.0, 0.05};
    tact_pose_update pose{bodies_[2], {}, {0.1, 0.1, 0.05}};
    std::ranges::copy(rotation_, pose.rotation);
    call([&] { return tact_world_set_positions(world_, bodies_[0], &columns); });
    call([&] { return tact_world_set_positions_of_many(world_, &update, 1); });
    const tact_columns facets = definition_of(other_).facets;
    const std::vector<int32_t> map(static_cast<size_t>(other_.vertex_count()), -1);
    call([&] { return tact_world_set_facets(world_, bodies_[1], &update.positions, &facets, map.data(), map.size()); });
    tact_mesh_update mesh = TACT_MESH_UPDATE_INIT;
    mesh.positions = update.positions;
    mesh.facets = facets;
    mesh.vertex_map = map.data();
    mesh.vertex_map_count = map.size();
    call([&] { return tact_world_set_facets_by(world_, bodies_[1], &mesh); });
    call([&] { return tact_world_set_pose(world_, bodies_[2], rotation_, translation); });
    call([&] { return tact_world_set_poses(world_, &pose, 1); });
    call([&] { return tact_world_detect_motion(world_, 0); });
    tell_motion();
    tact_motion_options options = TACT_MOTION_OPTIONS_INIT;
    options.has_distance = options.bounds = true;
    call([&] { return tact_world_detect_motion_by(world_, &options); });
    const double* bounds = nullptr;
    size_t bound_count = 0;
    call([&] { return tact_motion_bounds(world_, bodies_[0], &bounds, &bound_count); });
    tell({bounds, bound_count});
    tell_motion();
    call([&] { return tact_world_set_settings(world_, &settings_); });
    call([&] { return tact_world_set_layers(world_, bodies_[0], 3, 0xff); });
    call([&] { return tact_world_set_group(world_, bodies_[1], 5); });
    call([&] { return tact_world_set_excluded(world_, bodies_[1], bodies_[2], true); });
    call([&] { return tact_world_set_motion(world_, bodies_[2], TACT_MOTION_FIXED); });
    call([&] { return tact_world_set_margin(world_, bodies_[0], 0.1 / 3.0); });
    const double rest_offset = 0.1 / 7.0;
    call([&] { return tact_world_set_rest_offset(world_, bodies_[0], &rest_offset); });
    const std::vector<double> offsets(static_cast<size_t>(ball_.vertex_count()), rest_offset);
    tact_feature_settings features = TACT_FEATURE_SETTINGS_INIT;
    features.rest_offsets = offsets.data();
    features.rest_offset_count = offsets.size();
    features.margins = offsets.data();
    features.margin_count = offsets.size();
    call([&] { return tact_world_set_feature_settings(world_, bodies_[0], &features); });
    call([&] { return tact_world_set_self_contact(world_, bodies_[0], true); });
    tact_self_contact_filter filter = TACT_SELF_CONTACT_FILTER_INIT;
    filter.rings = 1;
    filter.rest_distance = rest_offset;
    call([&] { return tact_world_set_self_contact_filter(world_, bodies_[0], &filter); });
    const tact_label_pair labels = {bodies_[0], 1, bodies_[1], 2, TACT_LABEL_FACET};
    call([&] { return tact_world_set_excluded_labels(world_, &labels, true); });
  }

  void tell_motion() {
    double first = 0.0;
    size_t count = 0;
    const tact_impact* impacts = nullptr;
    tact_impact_pair pair = TACT_IMPACT_PAIR_INIT;
    tact_motion_statistics statistics = TACT_MOTION_STATISTICS_INIT;
    call([&] { return tact_motion_first_time(world_, &first); });
    tell({&first, 1});
    call([&] { return tact_motion_impacts(world_, &impacts, &count); });
    for (size_t i = 0; i < count; ++i) tell({&impacts[i].time, 1});
    std::vector<double> times(count);
    tact_impact_arrays arrays = TACT_IMPACT_ARRAYS_INIT;
    arrays.times = times.data();
    call([&] { return tact_motion_copy_impacts(world_, &arrays, count); });
    tell(times);
    call([&] { return tact_motion_pairs(world_, &count); });
    if (count > 0) call([&] { return tact_motion_pair(world_, 0, &pair); });
    call([&] { return tact_motion_stats(world_, &statistics); });
  }

  void look() {
    size_t count = 0;
    tact_body bodies[3];
    call([&] { return tact_world_bodies(world_, bodies, 3, &count); });
    call([&] { return tact_world_body_count(world_, &count); });
    tact_settings settings = TACT_SETTINGS_INIT;
    call([&] { return tact_world_settings(world_, &settings); });
    for (const tact_body body : bodies_) {
      look_at_kind(body);
      look_at_distances(body);
      look_at_contact_rules(body);
      look_at_mesh(body);
    }
    bool excluded = false;
    call([&] { return tact_world_excluded(world_, bodies_[1], bodies_[2], &excluded); });
  }
  void look_at_kind(tact_body body) {
    bool flag = false, is_plane = false;
    const char* name = nullptr;
    tact_surface surface{};
    tact_motion motion{};
    uint64_t id = 0;
    tact_plane plane;
    call([&] { return tact_world_contains(world_, body, &flag); });
    call([&] { return tact_world_name(world_, body, &name); });
    call([&] { return tact_world_surface(world_, body, &surface); });
    call([&] { return tact_world_motion(world_, body, &motion); });
    call([&] { return tact_world_external_id(world_, body, &id); });
    call([&] { return tact_world_key(world_, body, &id); });
    call([&] { return tact_world_plane(world_, body, &is_plane, &plane); });
    tell(std::uint64_t{is_plane});
  }
  void look_at_distances(tact_body body) {
    double margin = 0.0, rest_offset = 0.0;
    tact_feature_settings features = TACT_FEATURE_SETTINGS_INIT;
    tact_bounds bounds{};
    call([&] { return tact_world_margin(world_, body, &margin); });
    tell({&margin, 1});
    call([&] { return tact_world_rest_offset(world_, body, &rest_offset); });
    tell({&rest_offset, 1});
    call([&] { return tact_world_feature_settings(world_, body, &features); });
    tell({features.rest_offsets, features.rest_offset_count});
    call([&] { return tact_world_bounds(world_, body, &bounds); });
    tell(bounds.lower);
    tell(bounds.upper);
  }
  void look_at_contact_rules(tact_body body) {
    bool flag = false;
    uint32_t bits = 0;
    call([&] { return tact_world_group(world_, body, &bits); });
    call([&] { return tact_world_layer(world_, body, &bits); });
    call([&] { return tact_world_mask(world_, body, &bits); });
    const int vertex[3] = {-1, -1, -1};
    tact_feature_labels labels{};
    call([&] { return tact_world_labels(world_, body, vertex, &labels); });
    tell(std::uint64_t{labels.facet});
    call([&] { return tact_world_self_contact(world_, body, &flag); });
    tact_self_contact_filter filter = TACT_SELF_CONTACT_FILTER_INIT;
    call([&] { return tact_world_self_contact_filter(world_, body, &filter); });
    tell({&filter.rest_distance, 1});
    const tact_label_pair pair = {bodies_[0], 1, bodies_[1], 2, TACT_LABEL_FACET};
    call([&] { return tact_world_excluded_labels(world_, &pair, &flag); });
  }
  void look_at_mesh(tact_body body) {
    size_t vertices = 0, facets = 0, edges = 1, points = 1, faults = 0;
    int unused = 0;
    call([&] { return tact_world_vertex_count(world_, body, &vertices); });
    call([&] { return tact_world_facet_count(world_, body, &facets); });
    std::vector<double> coordinates(3 * vertices);
    std::vector<int> corners(3 * facets);
    call([&] { return tact_world_copy_positions(world_, body, coordinates.data(), coordinates.size()); });
    call([&] { return tact_world_copy_facets(world_, body, corners.data(), corners.size()); });
    call([&] { return tact_world_edge_count(world_, body, &edges); });
    call([&] { return tact_world_point_count(world_, body, &points); });
    call([&] { return tact_world_copy_edges(world_, body, &unused, 0); });
    call([&] { return tact_world_copy_points(world_, body, &unused, 0); });
    call([&] { return tact_world_check_surface(world_, body, 1e-6, nullptr, nullptr, 0, &faults); });
    tell(edges + points);
    tell(faults);
    tell(coordinates);
  }

  void ask() {
    std::vector<tact_ray> rays(80, tact_ray TACT_RAY_INIT);
    std::vector<tact_point_query> points(80, tact_point_query TACT_POINT_QUERY_INIT);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double t = 0.1 * static_cast<double>(i);
      rays[i].from[0] = -3.0, rays[i].from[1] = 0.2 * std::sin(t), rays[i].to[0] = 3.0, rays[i].to[2] = std::cos(t);
      points[i].point[0] = std::sin(t), points[i].point[1] = 0.3, points[i].point[2] = 2.0 * std::cos(t);
    }
    std::vector<tact_ray_hit> hits(rays.size());
    std::vector<tact_closest_point> nearest(points.size());
    std::vector<tact_facet_of_body> facets(5000);
    std::vector<tact_body> around(500);
    std::vector<size_t> ends(points.size());
    tact_box_query box = TACT_BOX_QUERY_INIT;
    box.upper[0] = box.upper[1] = box.upper[2] = 0.7;
    size_t count = 0;
    call([&] { return tact_world_cast_rays(world_, rays.data(), rays.size(), TACT_RAY_FIRST, hits.data()); });
    call([&] { return tact_world_closest_points(world_, points.data(), points.size(), nearest.data()); });
    for (std::size_t i = 0; i < rays.size(); ++i) {
      tell({&hits[i].fraction, 1});
      tell({&nearest[i].distance, 1});
      call([&] { return tact_world_cast_ray(world_, &rays[i], TACT_RAY_ANY, &hits[i]); });
      call([&] { return tact_world_closest_point(world_, &points[i], &nearest[i]); });
      tell(nearest[i].barycentric);
    }
    call([&] { return tact_world_cast_ray_all(world_, &rays[0], hits.data(), hits.size(), &count); });
    tell(count);
    call([&] { return tact_world_overlap_box(world_, &box, facets.data(), facets.size(), &count); });
    tell(count);
    call([&] { return tact_world_bodies_containing(world_, &points[0], around.data(), around.size(), &count); });
    tell(count);
    call([&] { return tact_world_overlap_boxes(world_, &box, 1, facets.data(), facets.size(), ends.data()); });
    tell(ends[0]);
    call([&] {
      return tact_world_bodies_containing_each(world_, points.data(), points.size(), around.data(), around.size(),
                                               ends.data());
    });
    tell(ends.back());
    for (std::size_t i = 0; i < 5; ++i) {
      call([&] { return tact_world_signed_distance(world_, &points[i], &nearest[i]); });
      tell({&nearest[i].distance, 1});
    }
    call([&] { return tact_world_signed_distances(world_, points.data(), points.size(), nearest.data()); });
    for (const tact_closest_point& one : nearest) tell({&one.distance, 1});
    ask_of_bodies();
  }

  void ask_of_bodies() {
    tact_distance_query pair = TACT_DISTANCE_QUERY_INIT;
    pair.a = bodies_[0], pair.b = bodies_[1];
    tact_nearest_bodies_query near = TACT_NEAREST_BODIES_QUERY_INIT;
    near.body = bodies_[0], near.count = 2;
    tact_sweep way = TACT_SWEEP_INIT;
    way.body = bodies_[1], way.way[0] = -1.0 / 3.0, way.axis[0] = 0.7, way.angle = 0.9;
    std::array<tact_body_distance, 4> apart{};
    std::array<tact_sweep_hit, 2> hits{};
    tact_overlap both{};
    size_t count = 0;
    call([&] { return tact_world_distance(world_, &pair, &apart[0]); });
    call([&] { return tact_world_distances(world_, &pair, 1, &apart[1]); });
    call([&] { return tact_world_nearest_bodies(world_, &near, &apart[2], 2, &count); });
    call([&] { return tact_world_sweep(world_, &way, &hits[0]); });
    call([&] { return tact_world_sweeps(world_, &way, 1, &hits[1]); });
    call([&] { return tact_world_overlap(world_, bodies_[0], bodies_[1], &both); });
    for (const tact_body_distance& one : apart) tell({&one.distance, 1}), tell(one.a_barycentric);
    for (const tact_sweep_hit& hit : hits) tell({&hit.fraction, 1}), tell(hit.normal);
    tell({&both.volume, 1});
    tell({&both.area, 1});
    tell(count);
  }

  // Terms of all stencils of points, which it returns.
  std::vector<tact_stencil> terms_of_stencils(size_t points, size_t near) {
    size_t count = 0, vertices = 0;
    std::vector<int32_t> first_rows;
    std::vector<double> x;
    for (const tact_body body : bodies_) {
      first_rows.push_back(static_cast<int32_t>(x.size() / 3));
      call([&] { return tact_world_vertex_count(world_, body, &vertices); });
      x.resize(x.size() + 3 * vertices);
      double* const own = x.data() + 3 * static_cast<std::size_t>(first_rows.back());
      call([&] { return tact_world_copy_positions(world_, body, own, 3 * vertices); });
    }
    vertices = x.size() / 3;
    std::vector<tact_stencil> stencils(points);
    call([&] {
      return tact_report_stencils(world_, first_rows.data(), first_rows.size(), stencils.data(), points, &count);
    });
    stencils.resize(count);  // points with planes have none
    std::vector<double> values(count), gradients(12 * count), hessians(144 * count);
    const std::vector<double> limits(count, 2.0);
    const tact_terms terms{values.data(), gradients.data(), hessians.data()};
    const auto tell_terms = [&] {
      for (const std::vector<double>* numbers : {&values, &gradients, &hessians}) tell(*numbers);
    };
    call([&] { return tact_stencil_gaps(stencils.data(), count, x.data(), vertices, terms); });
    tell_terms();
    call([&] { return tact_stencil_barriers(stencils.data(), count, x.data(), x.data(), vertices, 0.05, terms); });
    tell_terms();
    call([&] { return tact_stencil_penalties(stencils.data(), count, x.data(), vertices, 0.05, terms); });
    tell_terms();
    call([&] { return tact_stencil_friction(stencils.data(), count, x.data(), vertices, limits.data(), 1e-3, terms); });
    tell_terms();
    call([&] { return tact_stencil_gap_rates(stencils.data(), count, x.data(), vertices, values.data()); });
    tell(values);
    std::vector<int32_t> colors(count);
    call([&] { return tact_stencil_colors(stencils.data(), count, vertices, colors.data()); });
    terms_of_other_stencils(first_rows, x, near);
    return stencils;
  }

  // Of pairs within reach and of impacts.
  void terms_of_other_stencils(const std::vector<int32_t>& first_rows, const std::vector<double>& x, size_t near) {
    const size_t vertices = x.size() / 3;
    std::vector<tact_stencil> whole(near), closest(near);
    call([&] {
      return tact_report_stencils_within_reach(world_, first_rows.data(), first_rows.size(), whole.data(),
                                               closest.data(), near, &near);
    });
    std::vector<double> barriers(near);
    call([&] {
      return tact_stencil_reach_barriers(whole.data(), closest.data(), near, x.data(), x.data(), vertices, 0.05,
                                         {barriers.data(), nullptr, nullptr});
    });
    tell(barriers);
    size_t meeting = 0;
    const tact_impact* impacts = nullptr;
    call([&] { return tact_motion_impacts(world_, &impacts, &meeting); });
    std::vector<tact_stencil> constraints(meeting);
    call([&] {
      return tact_motion_stencils(world_, first_rows.data(), first_rows.size(), x.data(), x.data(), vertices,
                                  constraints.data(), meeting, &meeting);
    });
  }

  // What solvers take.
  void solve() {
    size_t points = 0, pairs = 0;
    tact_world kept{};
    std::uint64_t hash = 0;
    call([&] { return tact_report_keep(world_, &kept); });
    call([&] { return tact_report_hash(kept, &hash); });
    call([&] { return tact_world_destroy(kept); });
    tell(hash);
    call([&] { return tact_report_point_count(world_, &points); });
    call([&] { return tact_report_facet_pair_count(world_, &pairs); });
    size_t near = 0;
    call([&] { return tact_report_reach_pair_count(world_, &near); });
    std::vector<double> distances(near);
    tact_reach_pair_arrays of_near = TACT_REACH_PAIR_ARRAYS_INIT;
    of_near.distances = distances.data();
    call([&] { return tact_report_copy_reach_pairs(world_, &of_near, near); });
    tell(distances);
    std::vector<double> gaps(points);
    std::vector<int> facets(2 * pairs);
    tact_point_arrays of_points = TACT_POINT_ARRAYS_INIT;
    tact_facet_pair_arrays of_pairs = TACT_FACET_PAIR_ARRAYS_INIT;
    of_points.gaps = gaps.data();
    of_pairs.facets = facets.data();
    call([&] { return tact_report_copy_points(world_, &of_points, points); });
    call([&] { return tact_report_copy_facet_pairs(world_, &of_pairs, pairs); });
    tell(gaps);
    std::vector<uint32_t> labels(points);
    tact_point_label_arrays of_labels = TACT_POINT_LABEL_ARRAYS_INIT;
    of_labels.a_facets = labels.data();
    call([&] { return tact_report_copy_point_labels(world_, &of_labels, points); });
    std::vector<uint8_t> minima(points);
    call([&] { return tact_report_joined_minima(world_, nullptr, minima.data(), points); });
    tell(static_cast<std::uint64_t>(std::count(minima.begin(), minima.end(), 1)));
    const std::vector<tact_stencil> stencils = terms_of_stencils(points, near);
    std::vector<tact_point_impulse> impulses;
    for (const tact_stencil& one : stencils) impulses.push_back({one.id, {1.0, one.gap, 2.0}});
    std::vector<tact_contact_sum> sums(100);
    tact_contact_sums room = TACT_CONTACT_SUMS_INIT;
    room.sums = sums.data();
    room.sum_capacity = sums.size();
    call([&] { return tact_report_sum_contacts(world_, impulses.data(), impulses.size(), &room); });
    tell(room.sum_count);
    double matrix[9] = {1.0, 1e-6, 0.0, 0.0, 1.0, 2e-6, 0.0, 0.0, 1.0}, rotation[9] = {};
    const double quaternion[4] = {0.1, 0.2, 0.3, std::sqrt(0.86)};
    call([&] { return tact_nearest_rotation(matrix, rotation); });
    tell(rotation);
    call([&] { return tact_rotation_of_quaternion(quaternion, rotation); });
    tell(rotation);
    const tact_body_definition ball = definition_of(ball_);
    tact_welded_mesh welded = TACT_WELDED_MESH_INIT;
    call([&] { return tact_weld(&ball.positions, &ball.facets, &welded); });
  }

  void go_back() {
    size_t count = 0;
    call([&] { return tact_world_save(world_, nullptr, 0, &count); });
    std::vector<unsigned char> bytes(count);
    call([&] { return tact_world_save(world_, bytes.data(), bytes.size(), &count); });
    for (const unsigned char byte : bytes) tell(std::uint64_t{byte});
    call([&] { return tact_world_restore(world_, bytes.data(), bytes.size()); });
  }

  void refuse() {
    tact_point_query query = TACT_POINT_QUERY_INIT;
    query.point[0] = std::numeric_limits<double>::quiet_NaN();
    tact_closest_point nearest{};
    EXPECT_EQ(answer([&] { return tact_world_closest_point(world_, &query, &nearest); }),
              TACT_ERROR_NON_FINITE_POSITION);
    EXPECT_EQ(answer([&] { return tact_world_set_margin(world_, bodies_[0], query.point[0]); }),
              TACT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(answer([&] { return tact_world_set_rest_offset(world_, bodies_[0], query.point); }),
              TACT_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(in_mode(mode_, [] { return tact_last_error_message(); }), nullptr);
  }

  void play() {
    tact_player player{};
    tact_world world{};
    const char* version = nullptr;
    bool cut = false, played = true;
    size_t byte = 0;
    call([&] { return tact_player_open(path_.c_str(), 2, &player); });
    call([&] { return tact_player_recorded_by(player, &version); });
    call([&] { return tact_player_world(player, &world); });
    for (;;) {
      tact_played_step step = TACT_PLAYED_STEP_INIT;
      call([&] { return tact_player_next(player, &step, &played); });
      if (!played) break;
      tell(step.now);
      EXPECT_EQ(step.now, step.recorded) << mode_.name;
    }
    call([&] { return tact_player_cut_at(player, &cut, &byte); });
    call([&] { return tact_player_close(player); });
  }

  const FloatingPointSettings mode_;
  tact_settings settings_ = TACT_SETTINGS_INIT;
  double rotation_[9];
  const Mesh ball_ = blob(1, 0.7, 0.2, 5), other_ = translated(ball_, {1.3, 0.1, 0.2}),
             floor_ = gridded_box({-2.0, -2.0, -1.5}, {2.0, 2.0, -0.4}, 4);
  TemporaryFolder folder_;
  const std::string path_ = (folder_.path() / "modes.tactrec").string();
  tact_world world_{};
  std::vector<tact_body> bodies_;
  std::vector<std::uint64_t> told_;
};

TEST(FloatingPointModesOfC, ChangeNoAnswerOfAnyFunction) {
  const std::vector<std::uint64_t> expected = EveryCallOfC({}, 1).run();
  EXPECT_GT(expected.size(), 1000u);
  for (const FloatingPointSettings& mode : callers_modes()) {
    for (int threads = 1; threads <= (mode.traps ? 2 : 1); ++threads) {
      const std::vector<std::uint64_t> told = EveryCallOfC(mode, threads).run();
      const auto [one, other] = std::ranges::mismatch(told, expected);
      EXPECT_TRUE(one == told.end() && other == expected.end())
          << mode.name << ", " << threads << " threads: word " << other - expected.begin();
    }
  }
}

TEST(FloatingPointModesOfC, AreTriedWithEachFunction) {
  const std::string own = contents(__FILE__), header = header_of_c();
  std::set<std::string> names;
  for (std::size_t at = header.find("TACT_C_API "); at != std::string::npos; at = header.find("TACT_C_API ", at + 1)) {
    const std::size_t end = header.find_first_of("(\n", at), begin = header.find_last_of(" *", end);
    const std::string name = header.substr(begin + 1, end - begin - 1);
    if (name.starts_with("tact_")) names.insert(name);
  }
  EXPECT_GT(names.size(), 70u);
  for (const std::string& name : names) EXPECT_NE(own.find(name + "("), std::string::npos) << name;
}

}  // namespace
}  // namespace tact::tests
