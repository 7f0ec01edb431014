#include <algorithm>
#include <climits>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "handles.h"

namespace tact::c {
namespace {

// An executor of C: a function and what it is called with.
class CExecutor : public Executor {
 public:
  explicit CExecutor(const tact_executor& executor) : executor_(executor) {}
  const tact_executor& given() const { return executor_; }
  void run(int count, const Task& task) noexcept override {
    const auto call = [](void* data, int index) { (*static_cast<const Task*>(data))(index); };
    executor_.run(executor_.user, count, call, const_cast<Task*>(&task));  // C passes no const on
  }

 private:
  tact_executor executor_;
};

// A function of C that takes messages.
struct CMessages {
  tact_message_function function;
  void* user;

  void operator()(const Message& message) const {
    // A view of a std::string: it ends in a zero.
    const tact_message told{static_cast<int>(message.kind), body_of(message.a), body_of(message.b),
                            message.text.data()};
    function(user, &told);
  }
};

MessageFunction messages_of(const tact_settings& s) {
  if (s.on_message == nullptr) return {};
  return CMessages{s.on_message, s.message_user};
}

Settings settings_of(const tact_settings& given) {
  const tact_settings s = read_struct(given, tact_settings TACT_SETTINGS_INIT);
  return {.threads = s.threads,
          .accuracy = static_cast<Accuracy>(s.accuracy),
          .direction = static_cast<DirectionPolicy>(s.direction),
          .gjk_tolerance = s.gjk_tolerance,
          .iteration_limit = s.iteration_limit,
          .outputs = {.zones = s.zones,
                      .patches = s.patches,
                      .points = s.points,
                      .curves = s.curves,
                      .trace = s.trace,
                      .within_reach = s.within_reach},
          .executor = s.executor.run != nullptr ? std::make_shared<CExecutor>(s.executor) : nullptr,
          .on_message = messages_of(s)};
}

tact_settings settings_for_c(const Settings& s) {
  tact_settings result = TACT_SETTINGS_INIT;
  result.threads = s.threads;
  result.accuracy = static_cast<int>(s.accuracy);
  result.direction = static_cast<int>(s.direction);
  result.gjk_tolerance = s.gjk_tolerance;
  result.iteration_limit = s.iteration_limit;
  result.zones = s.outputs.zones;
  result.patches = s.outputs.patches;
  result.trace = s.outputs.trace;
  result.points = s.outputs.points;
  result.curves = s.outputs.curves;
  result.within_reach = s.outputs.within_reach;
  if (s.executor != nullptr) result.executor = static_cast<const CExecutor&>(*s.executor).given();
  if (const CMessages* const messages = s.on_message.target<CMessages>()) {
    result.on_message = messages->function;
    result.message_user = messages->user;
  }
  return result;
}

NumberKind kind_of(int kind) { return kind >= 0 && kind <= TACT_UINT16 ? NumberKind(kind) : NumberKind{UCHAR_MAX}; }

template <class Columns>
Columns columns_of(const tact_columns& given) {
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max() / 4;  // so that the sign of none is lost
  if (given.count > kMost || given.stride_bytes > kMost)
    throw Failure{TACT_ERROR_WRONG_SIZE, "a count or a stride is larger than any memory"};
  return Columns::of_kind(kind_of(given.kind), given.first, given.count, given.stride_bytes);
}

PoseUpdate pose_of(tact_body body, const double* rotation, const double* translation) {
  return {id_of(body), Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation),
          Eigen::Map<const Eigen::Vector3d>(translation)};
}

LabelPair label_pair_of(const tact_label_pair& labels) {
  return {.a = id_of(labels.a),
          .label_a = labels.label_a,
          .b = id_of(labels.b),
          .label_b = labels.label_b,
          .kind = static_cast<LabelKind>(labels.kind)};
}

std::optional<double> given_if(bool is_given, double value) { return is_given ? std::optional(value) : std::nullopt; }

// An array that may be null where it is empty.
template <class Number>
std::span<const Number> array_of(const Number* numbers, size_t count) {
  if (count > 0) check_not_null(numbers);
  return {numbers, count};
}

// Calls get(world) and hands its result out.
template <class Value, class Get>
tact_error get(tact_world world, Value* value, const Get& get_from) noexcept {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(value);
    *value = static_cast<Value>(get_from(entry.world));
  });
}

// Copies what a body has into `numbers`, which has this room.
template <class Number>
tact_error copy_of_body(tact_world world, tact_body body, Number* numbers, size_t room,
                        void (tact::World::*copy)(tact::BodyId, std::span<Number>) const) noexcept {
  return reading(world, [&](const WorldEntry& entry) {
    if (room > 0) check_not_null(numbers);
    (entry.world.*copy)(id_of(body), {numbers, room});
  });
}

}  // namespace
}  // namespace tact::c

using tact::World;
using tact::c::array_of, tact::c::given_if;
using tact::c::body_of, tact::c::changing, tact::c::check_not_null, tact::c::columns_of, tact::c::get, tact::c::guarded,
    tact::c::copy_of_body, tact::c::id_of, tact::c::reading, tact::c::WorldEntry;

extern "C" {

tact_error tact_world_create(const tact_settings* settings, tact_world* world) {
  return guarded([&] {
    check_not_null(world);
    const tact::Settings given = settings != nullptr ? tact::c::settings_of(*settings) : tact::Settings{};
    world->handle = tact::c::add_entry(std::make_shared<WorldEntry>(std::make_shared<World>(given)));
  });
}

tact_error tact_world_destroy(tact_world world) {
  return changing(world, [&](WorldEntry&) { tact::c::remove_entry(world.handle); });
}

tact_error tact_world_settings(tact_world world, tact_settings* settings) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(settings);
    tact::c::write_struct(*settings, tact::c::settings_for_c(entry.world.settings()));
  });
}

tact_error tact_world_set_settings(tact_world world, const tact_settings* settings) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(settings);
    entry.world.set_settings(tact::c::settings_of(*settings));
    entry.report = nullptr;
  });
}

tact_error tact_world_add_body(tact_world world, const tact_body_definition* definition, tact_body* body) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(definition, body);
    const tact_body_definition d = tact::c::read_struct(*definition, tact_body_definition TACT_BODY_DEFINITION_INIT);
    if (d.point_count > 0) check_not_null(d.points);
    const std::span<const int> points{d.points, d.point_count};
    *body = body_of(entry.world.add_body({.positions = columns_of<tact::Positions>(d.positions),
                                          .facets = columns_of<tact::Facets>(d.facets),
                                          .edges = columns_of<tact::Edges>(d.edges),
                                          .points = points,
                                          .surface = static_cast<tact::Surface>(d.surface),
                                          .motion = static_cast<tact::Motion>(d.motion),
                                          .name = d.name != nullptr ? d.name : "",
                                          .layer = d.layer,
                                          .mask = d.mask,
                                          .group = d.group,
                                          .external_id = d.external_id,
                                          .key = d.has_key ? std::optional(d.key) : std::nullopt,
                                          .margin = d.margin,
                                          .self_contact = d.self_contact,
                                          .rest_offset = given_if(d.has_rest_offset, d.rest_offset)}));
  });
}

tact_error tact_world_add_plane(tact_world world, const tact_plane_definition* definition, tact_body* body) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(definition, body);
    const tact_plane_definition d = tact::c::read_struct(*definition, tact_plane_definition TACT_PLANE_DEFINITION_INIT);
    *body = body_of(entry.world.add_plane({.normal = Eigen::Map<const Eigen::Vector3d>(d.normal),
                                           .offset = d.offset,
                                           .name = d.name != nullptr ? d.name : "",
                                           .layer = d.layer,
                                           .mask = d.mask,
                                           .group = d.group,
                                           .external_id = d.external_id,
                                           .key = d.has_key ? std::optional(d.key) : std::nullopt,
                                           .margin = d.margin,
                                           .rest_offset = given_if(d.has_rest_offset, d.rest_offset)}));
  });
}

tact_error tact_world_remove_body(tact_world world, tact_body body) {
  return changing(world, [&](WorldEntry& entry) { entry.world.remove_body(id_of(body)); });
}

tact_error tact_world_set_positions(tact_world world, tact_body body, const tact_columns* positions) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(positions);
    entry.world.set_positions(id_of(body), columns_of<tact::Positions>(*positions));
  });
}

tact_error tact_world_set_positions_of_many(tact_world world, const tact_positions_update* updates, size_t count) {
  return changing(world, [&](WorldEntry& entry) {
    if (count > 0) check_not_null(updates);
    std::vector<tact::PositionsUpdate>& all = entry.updates;
    all.clear();
    all.reserve(count);
    for (size_t i = 0; i < count; ++i) {
      all.push_back({id_of(updates[i].body), columns_of<tact::Positions>(updates[i].positions)});
    }
    entry.world.set_positions(all);
  });
}

tact_error tact_world_set_facets(tact_world world, tact_body body, const tact_columns* positions,
                                 const tact_columns* facets, const int32_t* vertex_map, size_t count) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(positions, facets);
    if (count > 0) check_not_null(vertex_map);
    entry.world.set_facets(id_of(body), columns_of<tact::Positions>(*positions), columns_of<tact::Facets>(*facets),
                           {vertex_map, count});
  });
}

tact_error tact_world_set_facets_by(tact_world world, tact_body body, const tact_mesh_update* update) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(update);
    const tact_mesh_update u = tact::c::read_struct(*update, tact_mesh_update TACT_MESH_UPDATE_INIT);
    entry.world.set_facets(id_of(body), {.positions = columns_of<tact::Positions>(u.positions),
                                         .facets = columns_of<tact::Facets>(u.facets),
                                         .edges = columns_of<tact::Edges>(u.edges),
                                         .points = array_of(u.points, u.point_count),
                                         .vertex_map = array_of(u.vertex_map, u.vertex_map_count),
                                         .facet_map = array_of(u.facet_map, u.facet_map_count)});
  });
}

tact_error tact_world_set_pose(tact_world world, tact_body body, const double* rotation, const double* translation) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(rotation, translation);
    const tact::PoseUpdate pose = tact::c::pose_of(body, rotation, translation);
    entry.world.set_pose(pose.body, pose.rotation, pose.translation);
  });
}

tact_error tact_world_set_poses(tact_world world, const tact_pose_update* updates, size_t count) {
  return changing(world, [&](WorldEntry& entry) {
    if (count > 0) check_not_null(updates);
    std::vector<tact::PoseUpdate>& all = entry.poses;
    all.clear();
    all.reserve(count);
    for (size_t i = 0; i < count; ++i)
      all.push_back(tact::c::pose_of(updates[i].body, updates[i].rotation, updates[i].translation));
    entry.world.set_poses(all);
  });
}

tact_error tact_world_set_layers(tact_world world, tact_body body, uint32_t layer, uint32_t mask) {
  return changing(world, [&](WorldEntry& entry) { entry.world.set_layers(id_of(body), layer, mask); });
}

tact_error tact_world_set_group(tact_world world, tact_body body, uint32_t group) {
  return changing(world, [&](WorldEntry& entry) { entry.world.set_group(id_of(body), group); });
}

tact_error tact_world_set_excluded(tact_world world, tact_body a, tact_body b, bool excluded) {
  return changing(world, [&](WorldEntry& entry) { entry.world.set_excluded(id_of(a), id_of(b), excluded); });
}

tact_error tact_world_set_motion(tact_world world, tact_body body, int32_t motion) {
  return changing(world,
                  [&](WorldEntry& entry) { entry.world.set_motion(id_of(body), static_cast<tact::Motion>(motion)); });
}

tact_error tact_world_set_margin(tact_world world, tact_body body, double margin) {
  return changing(world, [&](WorldEntry& entry) { entry.world.set_margin(id_of(body), margin); });
}

tact_error tact_world_set_rest_offset(tact_world world, tact_body body, const double* rest_offset) {
  return changing(world, [&](WorldEntry& entry) {
    entry.world.set_rest_offset(id_of(body), rest_offset != nullptr ? std::optional(*rest_offset) : std::nullopt);
  });
}

tact_error tact_world_set_feature_settings(tact_world world, tact_body body, const tact_feature_settings* settings) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(settings);
    const tact_feature_settings s = tact::c::read_struct(*settings, tact_feature_settings TACT_FEATURE_SETTINGS_INIT);
    entry.world.set_feature_settings(id_of(body), {.rest_offsets = array_of(s.rest_offsets, s.rest_offset_count),
                                                   .vertex_labels = array_of(s.vertex_labels, s.vertex_label_count),
                                                   .facet_labels = array_of(s.facet_labels, s.facet_label_count),
                                                   .vertex_layers = array_of(s.vertex_layers, s.vertex_layer_count),
                                                   .vertex_masks = array_of(s.vertex_masks, s.vertex_mask_count),
                                                   .facet_layers = array_of(s.facet_layers, s.facet_layer_count),
                                                   .facet_masks = array_of(s.facet_masks, s.facet_mask_count),
                                                   .margins = array_of(s.margins, s.margin_count)});
  });
}

tact_error tact_world_set_self_contact(tact_world world, tact_body body, bool wanted) {
  return changing(world, [&](WorldEntry& entry) { entry.world.set_self_contact(id_of(body), wanted); });
}

tact_error tact_world_set_self_contact_filter(tact_world world, tact_body body,
                                              const tact_self_contact_filter* filter) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(filter);
    const tact_self_contact_filter f =
        tact::c::read_struct(*filter, tact_self_contact_filter TACT_SELF_CONTACT_FILTER_INIT);
    entry.world.set_self_contact_filter(id_of(body), {.rings = f.rings,
                                                      .rest_distance = f.rest_distance,
                                                      .rest_positions = columns_of<tact::Positions>(f.rest_positions)});
  });
}

tact_error tact_world_set_excluded_labels(tact_world world, const tact_label_pair* labels, bool excluded) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(labels);
    entry.world.set_excluded_labels(tact::c::label_pair_of(*labels), excluded);
  });
}

tact_error tact_world_detect(tact_world world) {
  return changing(world, [&](WorldEntry& entry) {
    entry.report = nullptr;
    entry.report = &entry.world.detect();
  });
}

tact_error tact_world_detect_motion(tact_world world, int32_t wanted) {
  return changing(world, [&](WorldEntry& entry) {
    entry.motion = nullptr;
    entry.motion = &entry.world.detect_motion(static_cast<tact::Impacts>(wanted));
  });
}

tact_error tact_world_detect_motion_by(tact_world world, const tact_motion_options* options) {
  return changing(world, [&](WorldEntry& entry) {
    check_not_null(options);
    const tact_motion_options given = tact::c::read_struct(*options, tact_motion_options TACT_MOTION_OPTIONS_INIT);
    entry.motion = nullptr;
    entry.motion = &entry.world.detect_motion(
        tact::MotionOptions{.wanted = static_cast<tact::Impacts>(given.wanted),
                            .distance = given.has_distance ? std::optional<double>(given.distance) : std::nullopt,
                            .bounds = given.bounds});
  });
}

tact_error tact_world_save(tact_world world, void* bytes, size_t capacity, size_t* count) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(count);
    if (capacity > 0) check_not_null(bytes);
    const std::vector<std::byte> saved = entry.world.save();
    std::copy_n(saved.data(), std::min(capacity, saved.size()), static_cast<std::byte*>(bytes));
    *count = saved.size();
  });
}

tact_error tact_world_restore(tact_world world, const void* bytes, size_t count) {
  return changing(world, [&](WorldEntry& entry) {
    if (count > 0) check_not_null(bytes);
    entry.world.restore({static_cast<const std::byte*>(bytes), count});
    entry.report = nullptr;
    entry.motion = nullptr;
  });
}

tact_error tact_world_contains(tact_world world, tact_body body, bool* contains) {
  return get(world, contains, [&](const World& w) { return w.contains(id_of(body)); });
}

tact_error tact_world_body_count(tact_world world, size_t* count) {
  return get(world, count, [](const World& w) { return w.body_count(); });
}

tact_error tact_world_bodies(tact_world world, tact_body* bodies, size_t capacity, size_t* count) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(count);
    if (capacity > 0) check_not_null(bodies);
    const std::vector<tact::BodyId> all = entry.world.bodies();
    for (size_t i = 0; i < std::min(capacity, all.size()); ++i) bodies[i] = body_of(all[i]);
    *count = all.size();
  });
}

tact_error tact_world_name(tact_world world, tact_body body, const char** name) {
  return get(world, name, [&](const World& w) { return w.name(id_of(body)).c_str(); });
}

tact_error tact_world_surface(tact_world world, tact_body body, tact_surface* surface) {
  return get(world, surface, [&](const World& w) { return w.surface(id_of(body)); });
}

tact_error tact_world_motion(tact_world world, tact_body body, tact_motion* motion) {
  return get(world, motion, [&](const World& w) { return w.motion(id_of(body)); });
}

tact_error tact_world_layer(tact_world world, tact_body body, uint32_t* layer) {
  return get(world, layer, [&](const World& w) { return w.layer(id_of(body)); });
}

tact_error tact_world_mask(tact_world world, tact_body body, uint32_t* mask) {
  return get(world, mask, [&](const World& w) { return w.mask(id_of(body)); });
}

tact_error tact_world_group(tact_world world, tact_body body, uint32_t* group) {
  return get(world, group, [&](const World& w) { return w.group(id_of(body)); });
}

tact_error tact_world_excluded(tact_world world, tact_body a, tact_body b, bool* excluded) {
  return get(world, excluded, [&](const World& w) { return w.excluded(id_of(a), id_of(b)); });
}

tact_error tact_world_external_id(tact_world world, tact_body body, uint64_t* external_id) {
  return get(world, external_id, [&](const World& w) { return w.external_id(id_of(body)); });
}

tact_error tact_world_key(tact_world world, tact_body body, uint64_t* key) {
  return get(world, key, [&](const World& w) { return w.key(id_of(body)); });
}

tact_error tact_world_margin(tact_world world, tact_body body, double* margin) {
  return get(world, margin, [&](const World& w) { return w.margin(id_of(body)); });
}

tact_error tact_world_rest_offset(tact_world world, tact_body body, double* rest_offset) {
  return get(world, rest_offset, [&](const World& w) { return w.rest_offset(id_of(body)); });
}

tact_error tact_world_feature_settings(tact_world world, tact_body body, tact_feature_settings* settings) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(settings);
    const tact::FeatureSettings found = entry.world.feature_settings(id_of(body));
    tact_feature_settings result = TACT_FEATURE_SETTINGS_INIT;
    result.rest_offsets = found.rest_offsets.data();
    result.rest_offset_count = found.rest_offsets.size();
    result.vertex_labels = found.vertex_labels.data();
    result.vertex_label_count = found.vertex_labels.size();
    result.facet_labels = found.facet_labels.data();
    result.facet_label_count = found.facet_labels.size();
    result.vertex_layers = found.vertex_layers.data();
    result.vertex_layer_count = found.vertex_layers.size();
    result.vertex_masks = found.vertex_masks.data();
    result.vertex_mask_count = found.vertex_masks.size();
    result.facet_layers = found.facet_layers.data();
    result.facet_layer_count = found.facet_layers.size();
    result.facet_masks = found.facet_masks.data();
    result.facet_mask_count = found.facet_masks.size();
    result.margins = found.margins.data();
    result.margin_count = found.margins.size();
    tact::c::write_struct(*settings, result);
  });
}

tact_error tact_world_self_contact_filter(tact_world world, tact_body body, tact_self_contact_filter* filter) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(filter);
    const tact::SelfContactFilter found = entry.world.self_contact_filter(id_of(body));
    tact_self_contact_filter result = TACT_SELF_CONTACT_FILTER_INIT;
    result.rings = found.rings;
    result.rest_distance = found.rest_distance;
    result.rest_positions.first = found.rest_positions.first();
    result.rest_positions.count = static_cast<size_t>(found.rest_positions.cols());
    tact::c::write_struct(*filter, result);
  });
}

tact_error tact_world_excluded_labels(tact_world world, const tact_label_pair* labels, bool* excluded) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(labels, excluded);
    *excluded = entry.world.excluded_labels(tact::c::label_pair_of(*labels));
  });
}

tact_error tact_world_labels(tact_world world, tact_body body, const int* vertices, tact_feature_labels* labels) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(vertices, labels);
    const tact::FeatureLabels found = entry.world.labels(id_of(body), {vertices[0], vertices[1], vertices[2]});
    std::copy_n(found.vertices.begin(), 3, labels->vertices);
    labels->facet = found.facet;
  });
}

tact_error tact_world_self_contact(tact_world world, tact_body body, bool* wanted) {
  return get(world, wanted, [&](const World& w) { return w.self_contact(id_of(body)); });
}

tact_error tact_world_vertex_count(tact_world world, tact_body body, size_t* count) {
  return get(world, count, [&](const World& w) { return w.vertex_count(id_of(body)); });
}

tact_error tact_world_facet_count(tact_world world, tact_body body, size_t* count) {
  return get(world, count, [&](const World& w) { return w.facet_count(id_of(body)); });
}
tact_error tact_world_edge_count(tact_world world, tact_body body, size_t* count) {
  return get(world, count, [&](const World& w) { return w.edge_count(id_of(body)); });
}
tact_error tact_world_point_count(tact_world world, tact_body body, size_t* count) {
  return get(world, count, [&](const World& w) { return w.point_count(id_of(body)); });
}

tact_error tact_world_plane(tact_world world, tact_body body, bool* is_plane, tact_plane* plane) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(is_plane, plane);
    const std::optional<tact::Plane> found = entry.world.plane(id_of(body));
    *is_plane = found.has_value();
    if (!found) return;
    for (int axis = 0; axis < 3; ++axis) plane->normal[axis] = found->normal[axis];
    plane->offset = found->offset;
  });
}

tact_error tact_world_copy_positions(tact_world world, tact_body body, double* coordinates, size_t room) {
  return copy_of_body(world, body, coordinates, room, &tact::World::copy_positions);
}

tact_error tact_world_copy_facets(tact_world world, tact_body body, int* corners, size_t room) {
  return copy_of_body(world, body, corners, room, &tact::World::copy_facets);
}

tact_error tact_world_copy_edges(tact_world world, tact_body body, int* ends, size_t room) {
  return copy_of_body(world, body, ends, room, &tact::World::copy_edges);
}

tact_error tact_world_copy_points(tact_world world, tact_body body, int* vertices, size_t room) {
  return copy_of_body(world, body, vertices, room, &tact::World::copy_points);
}

tact_error tact_world_bounds(tact_world world, tact_body body, tact_bounds* bounds) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(bounds);
    const tact::Bounds found = entry.world.bounds(id_of(body));
    std::ranges::copy(found.lower, bounds->lower);
    std::ranges::copy(found.upper, bounds->upper);
  });
}

tact_error tact_weld(const tact_columns* positions, const tact_columns* facets, tact_welded_mesh* mesh) {
  return guarded([&] {
    check_not_null(positions, facets, mesh);
    tact::c::check_struct_size(*mesh);
    const tact::WeldedArrays welded =
        tact::weld_arrays(columns_of<tact::Positions>(*positions), columns_of<tact::Facets>(*facets));
    if (mesh->positions != nullptr) std::ranges::copy(welded.positions, mesh->positions);
    if (mesh->facets != nullptr) std::ranges::copy(welded.facets, mesh->facets);
    if (mesh->vertex_of != nullptr) std::ranges::copy(welded.vertex_of, mesh->vertex_of);
    mesh->vertices = static_cast<int32_t>(welded.positions.size() / 3);
    mesh->merged_vertices = welded.merged_vertices;
    mesh->collapsed_facets = welded.collapsed_facets;
  });
}
}
