#include <tact/world.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/text.h"
#include "engine/check_name.h"
#include "engine/failed_step.h"
#include "engine/labels.h"
#include "engine/messages.h"
#include "engine/state/world_parts.h"
#include "engine/state/world_state.h"
#include "engine/surface_check.h"
#include "engine/world_implementation.h"
#include "engine/world_tuning.h"

namespace tact {

namespace {

// Tells the ids of one world from those of another. No answer depends on it.
std::uint32_t next_world() {
  static std::atomic<std::uint32_t> count{0};
  return ++count;
}

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_settings, what); }

Settings checked(Settings settings) {
  if (settings.threads < 0 || settings.threads > base::kMostThreads)
    refuse("threads is " + std::to_string(settings.threads) + ", not 0 to " + std::to_string(base::kMostThreads));
  if (!(settings.gjk_tolerance >= 1e-15 && settings.gjk_tolerance <= 0.1)) {
    refuse("gjk_tolerance is " + base::text_of(settings.gjk_tolerance) + ", not 1e-15 to 0.1");
  }
  if (settings.iteration_limit < 1)
    refuse("iteration_limit is " + std::to_string(settings.iteration_limit) + ", not at least 1");
  check_name(settings.accuracy, Accuracy::exact, "accuracy", ErrorCode::bad_settings);
  check_name(settings.direction, DirectionPolicy::smallest, "direction", ErrorCode::bad_settings);
  if (settings.threads == 0) settings.threads = base::default_threads();
  return settings;
}

}  // namespace

World::Implementation::Implementation(const Settings& given)
    : settings(checked(given)), workers(settings.executor), bodies(next_world(), tuning) {}

World::World(const Settings& settings)
    : implementation_(with_memory("making a world ran out of memory", [&] {
        const base::FloatingPointMode mode;
        return std::make_unique<Implementation>(settings);
      })) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

World::Implementation& World::implementation() const {
  if (implementation_ == nullptr)
    with_memory([] { throw Error(ErrorCode::wrong_order, "the world was moved to another"); });
  return *implementation_;
}

const Body& World::body_of(BodyId body) const {
  return with_memory([&]() -> const Body& { return implementation().bodies.at(body); });
}

void WorldTuning::set(const World& world, const base::Tuning& tuning) { world.implementation().tuning = tuning; }

const Settings& World::settings() const { return implementation().settings; }

WorldParts::WorldParts(World& world)
    : bodies_(world.implementation().bodies),
      step_(world.implementation().step),
      motion_(world.implementation().motion) {}

void World::set_settings(const Settings& settings) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  i.settings = with_memory([&] { return checked(settings); });
  if (i.workers.executor() != i.settings.executor.get()) i.workers.restart(i.settings.executor);
  i.step.look_at_all();
  i.observe([&](WorldObserver& observer) { observer.settings_changed(i.settings); });
}

BodyId World::add_body(const BodyDefinition& definition) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  const auto tell = [&](const Body& body) { tell_wrong_surface(body, i.settings.on_message); };
  const BodyId body = with_memory("adding a body ran out of memory", [&] { return i.bodies.add(definition, tell); });
  i.observe([&](WorldObserver& observer) { observer.body_added(body, definition); });
  return body;
}

BodyId World::add_plane(const PlaneDefinition& definition) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  const BodyId body = with_memory("adding a plane ran out of memory", [&] { return i.bodies.add(definition); });
  i.observe([&](WorldObserver& observer) { observer.plane_added(body, definition); });
  return body;
}

void World::remove_body(BodyId body) {
  Implementation& i = implementation();
  i.change([&] { i.bodies.remove(body); }, [&](WorldObserver& observer) { observer.body_removed(body); });
}

void World::set_positions(BodyId body, const Positions& positions) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  i.set_positions([&] { i.bodies.set_positions(body, positions, i.settings.threads); });
  i.observe([&](WorldObserver& observer) { observer.positions_set(std::array{PositionsUpdate{body, positions}}); });
}

void World::set_positions(std::span<const PositionsUpdate> updates) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  i.set_positions([&] { i.bodies.set_positions(updates, i.settings.threads); });
  i.observe([&](WorldObserver& observer) { observer.positions_set(updates); });
}

void World::set_facets(BodyId body, const Positions& positions, const Facets& facets, std::span<const int> vertex_map) {
  set_facets(body, {.positions = positions, .facets = facets, .vertex_map = vertex_map});
}

void World::set_facets(BodyId body, const MeshUpdate& update) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  i.forget_ways();
  i.set_positions([&] {
    Bodies::NewMesh made = i.bodies.make_mesh(body, update, i.settings.threads);
    // From publishing on nothing can fail.
    i.step.renumber(made.vertices, i.step.renumbering_of(made.vertices));
    i.bodies.set_mesh(std::move(made));
  });
  i.observe([&](WorldObserver& observer) { observer.facets_set(body, update); });
}

void World::set_pose(BodyId body, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  const PoseUpdate update{body, rotation, translation};
  i.set_positions([&] { i.bodies.set_pose(update); });
  i.observe([&](WorldObserver& observer) { observer.poses_set(std::span(&update, 1)); });
}

void World::set_poses(std::span<const PoseUpdate> updates) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  i.set_positions([&] { i.bodies.set_poses(updates, i.settings.threads); });
  i.observe([&](WorldObserver& observer) { observer.poses_set(updates); });
}

void World::set_layers(BodyId body, std::uint32_t layer, std::uint32_t mask) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  i.change([&] { i.bodies.set_layers(body, layer, mask); },
           [&](WorldObserver& observer) { observer.layers_set(body, layer, mask); });
}

void World::set_group(BodyId body, std::uint32_t group) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  i.change([&] { i.bodies.set_group(body, group); }, [&](WorldObserver& observer) { observer.group_set(body, group); });
}

void World::set_excluded(BodyId a, BodyId b, bool excluded) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  i.change([&] { i.bodies.set_excluded(a, b, excluded); },
           [&](WorldObserver& observer) { observer.excluded_set(a, b, excluded); });
}

void World::set_motion(BodyId body, Motion motion) {
  Implementation& i = implementation();
  i.change([&] { i.bodies.set_motion(body, motion); },
           [&](WorldObserver& observer) { observer.motion_set(body, motion); });
}

void World::set_margin(BodyId body, double margin) {
  Implementation& i = implementation();
  i.change([&] { i.bodies.set_margin(body, margin); },
           [&](WorldObserver& observer) { observer.margin_set(body, margin); });
}

void World::set_rest_offset(BodyId body, std::optional<double> rest_offset) {
  Implementation& i = implementation();
  i.change([&] { i.bodies.set_rest_offset(body, rest_offset); },
           [&](WorldObserver& observer) { observer.rest_offset_set(body, rest_offset); });
}

void World::set_feature_settings(BodyId body, const FeatureSettings& settings) {
  Implementation& i = implementation();
  i.change([&] { i.bodies.set_feature_settings(body, settings); },
           [&](WorldObserver& observer) {
             // what was given may be a view of what is gone
             observer.feature_settings_set(body, feature_settings(body));
           });
}

void World::set_self_contact(BodyId body, bool wanted) {
  Implementation& i = implementation();
  i.change([&] { i.bodies.set_self_contact(body, wanted); },
           [&](WorldObserver& observer) { observer.self_contact_set(body, wanted); });
}

void World::set_self_contact_filter(BodyId body, const SelfContactFilter& filter) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  i.change([&] { i.bodies.set_self_filter(body, filter, i.settings.threads); },
           [&](WorldObserver& observer) { observer.self_contact_filter_set(body, self_contact_filter(body)); });
}

void World::set_excluded_labels(const LabelPair& labels, bool excluded) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  i.change([&] { i.bodies.set_excluded_labels(labels, excluded); },
           [&](WorldObserver& observer) { observer.excluded_labels_set(labels, excluded); });
}

void World::set_observer(WorldObserver* observer) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  if (observer != nullptr && i.bodies.ever_held_any())
    with_memory([] {
      throw Error(ErrorCode::wrong_order, "an observer, or a recording, is to be set before the first body is added");
    });
  i.observer = observer;
  i.observe([&](WorldObserver& told) { told.settings_changed(i.settings); });
}

const Report& World::detect() {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  const Report& report = i.detect();
  i.observe([&](WorldObserver& observer) { observer.step_ended(report); });
  tell_limits(report, i.bodies, i.settings.on_message);
  return report;
}

const Report& FailedStep::play(World& world) {
  World::Implementation& i = world.implementation();
  i.step.discard();
  try {
    i.detect();
  } catch (const Step::Discarded&) {
  }
  return i.step.last_report();
}

const MotionReport& World::detect_motion(Impacts wanted) { return detect_motion(MotionOptions{.wanted = wanted}); }

const MotionReport& World::detect_motion(const MotionOptions& options) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  const base::Workers::Scope scope(i.workers);
  return with_memory("detect_motion ran out of memory", [&]() -> const MotionReport& {
    check_motion_options(options);
    if (i.motion == nullptr) i.motion = std::make_unique<MotionStage>();
    try {
      return i.motion->run(i.bodies, i.settings, options);
    } catch (...) {
      i.motion.reset();
      throw;
    }
  });
}

std::vector<std::byte> World::save() const {
  const base::FloatingPointMode mode;
  const Implementation& i = implementation();
  return with_memory("saving ran out of memory", [&] { return saved_world(i.settings, i.bodies, i.step); });
}

void World::restore(std::span<const std::byte> bytes) {
  const base::FloatingPointMode mode;
  Implementation& i = implementation();
  RestoredWorld restored = with_memory("restoring ran out of memory", [&] {
    RestoredWorld made = restored_world(bytes, i.settings, i.bodies);
    try {
      made.settings = checked(std::move(made.settings));
    } catch (const Error& error) {
      throw Error(ErrorCode::bad_state, error.what());
    }
    return made;
  });
  // From here on nothing can fail.
  i.settings = std::move(restored.settings);
  i.bodies = std::move(restored.bodies);
  i.step.restore(std::move(restored.step));
  i.motion.reset();
  i.refresh_ms = 0.0;
  i.observe([&](WorldObserver& observer) { observer.state_restored(bytes); });
}

bool World::contains(BodyId body) const noexcept { return implementation_ && implementation_->bodies.contains(body); }
std::size_t World::body_count() const noexcept { return implementation_ ? implementation_->bodies.count() : 0; }
std::vector<BodyId> World::bodies() const {
  return with_memory("listing the bodies ran out of memory", [&] { return implementation().bodies.ids(); });
}
const std::string& World::name(BodyId body) const { return body_of(body).name; }
Surface World::surface(BodyId body) const { return body_of(body).surface; }
Motion World::motion(BodyId body) const {
  const Body& asked = body_of(body);
  if (implementation().bodies.filters()[body.index].fixed) return Motion::fixed;
  return asked.mesh.is_rigid() ? Motion::rigid : Motion::deformable;
}
std::uint32_t World::group(BodyId body) const {
  return implementation().bodies.filters()[body_of(body).id.index].group;
}

bool World::excluded(BodyId a, BodyId b) const {
  return with_memory([&] { return implementation().bodies.excluded(a, b); });
}

std::uint32_t World::layer(BodyId body) const {
  return implementation().bodies.filters()[body_of(body).id.index].layer;
}
std::uint32_t World::mask(BodyId body) const { return implementation().bodies.filters()[body_of(body).id.index].mask; }
std::uint64_t World::external_id(BodyId body) const { return body_of(body).external_id; }
std::uint64_t World::key(BodyId body) const { return implementation().bodies.keys().of(body_of(body).id.index); }
double World::margin(BodyId body) const { return implementation().bodies.margin(body_of(body).id.index); }
double World::rest_offset(BodyId body) const { return implementation().bodies.rest_offset(body_of(body).id.index); }
FeatureSettings World::feature_settings(BodyId body) const {
  const FeatureArrays* const arrays = body_of(body).arrays.get();
  return arrays == nullptr ? FeatureSettings{} : arrays->view();
}
FeatureLabels World::labels(BodyId body, const std::array<int, 3>& vertices) const {
  return with_memory([&] { return labels_of(body_of(body), vertices); });
}
bool World::self_contact(BodyId body) const { return body_of(body).self_contact; }
SelfContactFilter World::self_contact_filter(BodyId body) const {
  const SelfFilter* const filter = body_of(body).self_filter.get();
  return filter == nullptr ? SelfContactFilter{} : filter->view();
}
bool World::excluded_labels(const LabelPair& labels) const {
  return with_memory([&] { return implementation().bodies.excluded_labels(labels); });
}
std::size_t World::vertex_count(BodyId body) const {
  return static_cast<std::size_t>(body_of(body).mesh.source_vertex_count());
}
std::size_t World::facet_count(BodyId body) const {
  return static_cast<std::size_t>(body_of(body).mesh.surface_facet_count());
}
std::size_t World::edge_count(BodyId body) const { return static_cast<std::size_t>(body_of(body).mesh.edge_count()); }
std::size_t World::point_count(BodyId body) const { return static_cast<std::size_t>(body_of(body).mesh.point_count()); }
std::optional<Plane> World::plane(BodyId body) const {
  const narrowphase::HalfSpace* const plane = body_of(body).plane.get();
  if (plane == nullptr) return {};
  return Plane{{plane->normal.x, plane->normal.y, plane->normal.z}, plane->offset};
}

namespace {

template <class Number>
void check_room(std::span<Number> room, std::size_t needed, const std::string& name) {
  if (room.size() == needed) return;
  with_memory([&] {
    throw Error(ErrorCode::wrong_size, "body '" + name + "': room for " + std::to_string(room.size()) +
                                           " numbers, not " + std::to_string(needed));
  });
}

}  // namespace

void World::copy_positions(BodyId body, std::span<double> coordinates) const {
  const base::FloatingPointMode mode;
  const Body& asked = body_of(body);
  check_room(coordinates, 3 * static_cast<std::size_t>(asked.mesh.source_vertex_count()), asked.name);
  std::ranges::fill(coordinates, std::numeric_limits<double>::quiet_NaN());
  for (int vertex = 0; vertex < asked.mesh.vertex_count(); ++vertex) {
    const base::Vec3 position = asked.mesh.position_by_pose(vertex);
    double* const to = &coordinates[3 * static_cast<std::size_t>(asked.mesh.source_vertex(vertex))];
    to[0] = position.x, to[1] = position.y, to[2] = position.z;
  }
}

namespace {

// Copies the first `width` vertices of some source facets, one after the other.
void copy_corners(const Body& body, int first, int count, std::size_t width, std::span<int> corners) {
  check_room(corners, width * static_cast<std::size_t>(count), body.name);
  for (int i = 0; i < count; ++i) {
    const narrowphase::Corners of_facet = body.mesh.corners(body.mesh.facet_of_source(first + i));
    for (std::size_t k = 0; k < width; ++k)
      corners[width * static_cast<std::size_t>(i) + k] = body.mesh.source_vertex(of_facet[k]);
  }
}

}  // namespace

void World::copy_facets(BodyId body, std::span<int> corners) const {
  const Body& asked = body_of(body);
  copy_corners(asked, 0, asked.mesh.surface_facet_count(), 3, corners);
}

void World::copy_edges(BodyId body, std::span<int> ends) const {
  const Body& asked = body_of(body);
  copy_corners(asked, asked.mesh.surface_facet_count(), asked.mesh.edge_count(), 2, ends);
}

void World::copy_points(BodyId body, std::span<int> vertices) const {
  const Body& asked = body_of(body);
  copy_corners(asked, asked.mesh.facet_count() - asked.mesh.point_count(), asked.mesh.point_count(), 1, vertices);
}

SurfaceCheck World::check_surface(BodyId body, double sliver) const {
  const base::FloatingPointMode mode;
  return with_memory("checking a surface ran out of memory", [&] {
    if (!(sliver >= 0.0 && sliver <= 1.0))
      throw Error(ErrorCode::invalid_argument, "sliver is " + base::text_of(sliver) + ", not 0 to 1");
    std::vector<base::Vec3> positions(vertex_count(body));
    std::vector<std::array<int, 3>> facets(facet_count(body));
    if (!positions.empty()) copy_positions(body, {&positions.front().x, 3 * positions.size()});
    if (!facets.empty()) copy_facets(body, {facets.front().data(), 3 * facets.size()});
    SurfaceCheck check = tact::check_surface(positions, facets, sliver, implementation().settings.threads);
    // Edges and points use vertices, too.
    std::erase_if(check.unused_vertices,
                  [&](int vertex) { return !std::isnan(positions[static_cast<std::size_t>(vertex)].x); });
    return check;
  });
}

Bounds World::bounds(BodyId body) const {
  const base::FloatingPointMode mode;
  if (body_of(body).plane != nullptr) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  }
  const base::Box box = implementation().bodies.exact_box(body.index);
  return {{box.lower.x, box.lower.y, box.lower.z}, {box.upper.x, box.upper.y, box.upper.z}};
}

}  // namespace tact
