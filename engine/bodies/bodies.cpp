#include "engine/bodies/bodies.h"

#include <iterator>
#include <limits>
#include <utility>

#include "engine/base/hash.h"
#include "engine/base/parallel.h"
#include "engine/base/text.h"
#include "engine/bodies/checks.h"
#include "engine/bodies/encloses.h"
#include "engine/bodies/given_mesh.h"
#include "engine/bodies/plane_pairs.h"
#include "engine/bodies/room.h"
#include "engine/check_name.h"
#include "narrowphase/mesh/cluster_quality.h"
#include "narrowphase/mesh/source_mesh.h"

namespace tact {

namespace {

constexpr auto kIdOfRemoved = [](const auto& removed) { return removed.id; };

// The body of a definition that is good, not placed in any world.
std::unique_ptr<Body> make_body(const BodyDefinition& definition, const std::string& name) {
  const GivenMesh given(arguments_of(definition), name);
  // What has no facets has no inside.
  return std::make_unique<Body>(Body{.mesh = {given.positions(), given.facets(), given.last()},
                                     .id = {},
                                     .name = name,
                                     .surface = given.is_bare() ? Surface::sheet : definition.surface,
                                     .has_inside = !given.is_bare() && definition.surface == Surface::closed &&
                                                   encloses(given.positions(), given.surface()),
                                     .external_id = definition.external_id,
                                     .self_contact = definition.self_contact});
}

// See Body::birth. Of what the mesh keeps: a vertex that no facet uses is no part of it.
std::uint64_t birth_of(std::uint32_t slot, std::uint64_t key, std::uint64_t step, const Body& body) {
  const narrowphase::ClusteredMesh& mesh = body.mesh;
  base::Hash hash;
  for (const std::uint64_t word : {std::uint64_t{slot}, key, step, body.external_id}) hash.add(word);
  hash.add(static_cast<std::uint64_t>(mesh.source_vertex_count()));
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const base::Vec3 position = mesh.position(v);
    for (int axis = 0; axis < 3; ++axis) hash.add(position[axis]);
  }
  for (int f = 0; f < mesh.facet_count(); ++f) {
    for (const int v : mesh.corners(f)) hash.add(static_cast<std::uint64_t>(mesh.source_vertex(v)));
    hash.add(static_cast<std::uint64_t>(mesh.source_facet(f)));
  }
  if (!mesh.has_surface_alone()) {
    hash.add(static_cast<std::uint64_t>(mesh.edge_count()));
    hash.add(static_cast<std::uint64_t>(mesh.point_count()));
  }
  if (body.plane != nullptr) {
    for (int axis = 0; axis < 3; ++axis) hash.add(body.plane->normal[axis]);
    hash.add(body.plane->offset);
  }
  return hash.value();
}

}  // namespace

void Bodies::check_key(std::uint64_t key, const std::string& name) const {
  if (const auto other = keys_.find(key))
    throw Error(ErrorCode::invalid_argument,
                quoted(name) + ": key " + std::to_string(key) + " is that of " + quoted(in_slot(*other).name));
}

std::string Bodies::checked_name(const BodyDefinition& definition) const {
  std::string name = name_of_next(definition.name);
  check_name(definition.surface, Surface::sheet, quoted(name) + ": surface");
  check_name(definition.motion, Motion::rigid, quoted(name) + ": motion");
  check_margin(definition.margin, name);
  check_rest_offset(definition.rest_offset, definition.margin, name);
  check_shape(arguments_of(definition), slots_.size(), name);
  return name;
}

std::string Bodies::checked_name(const PlaneDefinition& definition) const {
  std::string name = name_of_next(definition.name);
  check_plane(definition.normal, definition.offset, name);
  check_margin(definition.margin, name);
  check_rest_offset(definition.rest_offset, definition.margin, name);
  check_counts(0, 0, slots_.size(), name);
  return name;
}

void Bodies::check(const BodyDefinition& definition) const {
  GivenMesh(arguments_of(definition), checked_name(definition));
}

void Bodies::check(const PlaneDefinition& definition) const { checked_name(definition); }

BodyId Bodies::add(const BodyDefinition& definition, const std::function<void(const Body&)>& told) {
  const std::string name = checked_name(definition);
  const std::uint32_t slot = next_slot();
  check_key(definition.key.value_or(slot), name);
  std::unique_ptr<Body> body = make_body(definition, name);
  body->id = id_of_next(slot);
  if (told) told(*body);
  return add_made(std::move(body), definition, slot, definition.motion);
}

BodyId Bodies::add(const PlaneDefinition& definition) {
  const std::string name = checked_name(definition);
  const std::uint32_t slot = next_slot();
  check_key(definition.key.value_or(slot), name);
  auto body = std::make_unique<Body>(Body{.mesh = {{}, {}},
                                          .id = id_of_next(slot),
                                          .name = name,
                                          .surface = Surface::closed,
                                          .external_id = definition.external_id});
  const Eigen::Vector3d& n = definition.normal;
  body->plane =
      std::make_unique<const narrowphase::HalfSpace>(narrowphase::HalfSpace{{n.x(), n.y(), n.z()}, definition.offset});
  return add_made(std::move(body), definition, slot, Motion::fixed);
}

std::string Bodies::name_of_next(const std::string& given) const {
  return given.empty() ? "body " + std::to_string(next_slot()) : given;
}

BodyId Bodies::id_of_next(std::uint32_t slot) const {
  return {slot, (slot < generations_.size() ? generations_[slot] : 0) + 1, world_};
}

// Nothing can fail half-way: all that may allocate comes first.
template <class Definition>
BodyId Bodies::add_made(std::unique_ptr<Body> body, const Definition& definition, std::uint32_t slot, Motion motion) {
  const Place place{.filter = {definition.layer, definition.mask, motion == Motion::fixed, definition.group},
                    .margin = definition.margin,
                    .rest_offset = definition.rest_offset.value_or(kAsMargin),
                    .key = definition.key.value_or(slot),
                    .is_rigid = motion == Motion::rigid};
  body->birth = birth_of(slot, place.key, steps_, *body);
  body->is_outward = body->has_inside && is_outward(body->mesh);
  make_room_for(slot, place);
  slot < slots_.size() ? free_.pop_back() : add_slot();
  generations_[slot] = body->id.generation;
  put(slot, std::move(body), place);
  return slots_[slot].body->id;
}

void Bodies::put(std::uint32_t slot, std::unique_ptr<Body> body, const Place& place) {
  keys_.start(slot, place.key);
  margins_[slot] = place.margin;
  rest_offsets_[slot] = place.rest_offset;
  boxes_[slot] = base::grown(body->mesh.box(), place.margin);
  kdops_.start(slot, body->mesh);
  groupings_.start(slot, cluster_quality(body->mesh));
  filters_[slot] = place.filter;
  Slot put;
  put.rigid = place.is_rigid ? rigid_states_.take() : nullptr;
  put.generation = body->id.generation;
  put.vertex_count = body->mesh.source_vertex_count();
  put.fixed = place.filter.fixed;
  put.changed = slots_[slot].changed;
  slots_[slot] = std::move(put);
  if (place.is_rigid) make_rigid(body->mesh, *slots_[slot].rigid);
  rigid_count_ += place.is_rigid ? 1 : 0;
  self_count_ += body->self_contact ? 1 : 0;
  filter_count_ += body->filters_features() ? 1 : 0;
  if (body->plane != nullptr) planes_.insert(std::ranges::lower_bound(planes_, slot), slot);
  slots_[slot].body = std::move(body);
  packed_meshes_.add(slots_[slot].body->mesh);
  mark_changed(slot);
  ++count_;
  vertices_ += slots_[slot].vertex_count;
  moved_vertices_ += slots_[slot].vertex_count;
}

void Bodies::make_room_for(std::uint32_t slot, const Place& place) {
  const std::size_t slots = std::max<std::size_t>(slots_.size(), slot + 1);
  make_room(slots_, slots), make_room(boxes_, slots), make_room(filters_, slots), make_room(margins_, slots);
  make_room(rest_offsets_, slots);
  kdops_.make_room(slots), groupings_.make_room(slots), tree_->make_room(slots), keys_.make_room(slots);
  make_room(changed_, slots), make_room(free_, slots), make_room(generations_, slots);
  make_room(removed_, removed_.size() + count_ + 1), make_room(former_, former_.size() + count_ + 1);
  if (place.is_rigid) rigid_states_.make_room();
  make_room(planes_, planes_.size() + 1);
  keys_.keep_given(slot, place.key);
}

void Bodies::add_slot() {
  const std::size_t slots = slots_.size() + 1;
  slots_.resize(slots), boxes_.resize(slots), filters_.resize(slots), margins_.resize(slots);
  rest_offsets_.resize(slots);
  kdops_.resize(slots), groupings_.resize(slots), tree_->resize(slots), keys_.resize(slots);
  if (generations_.size() < slots) generations_.resize(slots);
}

void Bodies::remove(BodyId id) {
  const auto vertices = at(id).mesh.source_vertex_count();
  vertices_ -= vertices;
  if (moved(id.index)) moved_vertices_ -= vertices;
  packed_meshes_.remove(slots_[id.index].body->mesh);
  const std::uint64_t birth = slots_[id.index].body->birth;
  removed_.push_back({id, keys_.of(id.index), birth});
  former_.push_back({birth, id.index, id.generation});
  keys_.forget(id.index);
  rigid_count_ -= is_rigid(id.index) ? 1 : 0;
  self_count_ -= slots_[id.index].body->self_contact ? 1 : 0;
  filter_count_ -= slots_[id.index].body->filters_features() ? 1 : 0;
  if (slots_[id.index].body->plane != nullptr) std::erase(planes_, id.index);
  slots_[id.index].body.reset();
  if (is_rigid(id.index)) rigid_states_.give_back(std::exchange(slots_[id.index].rigid, nullptr));
  boxes_[id.index] = base::Box{};
  excluded_.remove_all_of(id.index);
  excluded_labels_.remove_all_of(id.index);
  // No id is given out twice: a slot whose generations are used up stays empty.
  if (id.generation < std::numeric_limits<std::uint32_t>::max()) free_.push_back(id.index);
  groupings_.forget(id.index);
  mark_changed(id.index);
  --count_;
}

narrowphase::Placement Bodies::begin_of(std::uint32_t slot) const {
  const Body& body = in_slot(slot);
  const narrowphase::MeshPlacements& placements = body.mesh.placements();
  const Begin begin = slots_[slot].begin;
  return begin == Begin::here     ? placements.now()
         : begin == Begin::before ? placements.before()
                                  : placements.in(body.begin.data());
}

narrowphase::MovingMesh Bodies::moving(std::uint32_t slot) const {
  const Body& body = in_slot(slot);
  return {&body.mesh, body.features.get(), begin_of(slot), body.mesh.placements().now()};
}

bool Bodies::boxes_meet(broadphase::IndexPair pair) const {
  if (plane(pair.a) != nullptr) return reaches_plane(*this, pair.a, exact_box(pair.b));
  if (plane(pair.b) != nullptr) return reaches_plane(*this, pair.b, exact_box(pair.a));
  return base::overlaps(exact_box(pair.a), exact_box(pair.b));
}

void Bodies::set_layers(BodyId id, std::uint32_t layer, std::uint32_t mask) {
  broadphase::Filter changed = filter(id);
  changed.layer = layer;
  changed.mask = mask;
  set_filter(id, changed);
}

void Bodies::set_motion(BodyId id, Motion motion) {
  const Body& body = at(id);
  check_name(motion, Motion::rigid, quoted(body.name) + ": motion");
  if (motion != Motion::fixed && (motion == Motion::rigid) != body.mesh.is_rigid())
    throw Error(ErrorCode::wrong_motion, quoted(body.name) + (body.mesh.is_rigid() ? " was" : " was not") +
                                             " added as rigid: its motion cannot be " +
                                             (motion == Motion::rigid ? "rigid" : "deformable"));
  if (body.plane != nullptr && motion != Motion::fixed)
    throw Error(ErrorCode::wrong_motion, quoted(body.name) + " is a plane: it is fixed");
  broadphase::Filter changed = filter(id);
  changed.fixed = motion == Motion::fixed;
  set_filter(id, changed);
}

void Bodies::set_group(BodyId id, std::uint32_t group) {
  broadphase::Filter changed = filter(id);
  changed.group = group;
  set_filter(id, changed);
}

void Bodies::set_excluded(BodyId a, BodyId b, bool excluded) {
  if (this->excluded(a, b) == excluded) return;
  const broadphase::IndexPair pair = slots_of(a, b);
  excluded ? excluded_.add(pair) : excluded_.remove(pair);
  mark_moved(pair.a);
  mark_moved(pair.b);
}

bool Bodies::excluded(BodyId a, BodyId b) const {
  at(a), at(b);
  if (a == b)
    throw Error(ErrorCode::invalid_argument, quoted(at(a).name) + ": a pair is of two bodies; see self_contact");
  return excluded_.contains(slots_of(a, b));
}

void Bodies::set_margin(BodyId id, double margin) {
  const Body& body = at(id);
  check_margin(margin, body.name);
  const double least = std::max(rest_offsets_[id.index], body.arrays ? body.arrays->largest_rest_offset : 0.0);
  if (margin < least)
    throw Error(ErrorCode::invalid_argument, quoted(body.name) + ": margin is " + base::text_of(margin) +
                                                 ", less than a rest offset of " + base::text_of(least) +
                                                 "; set that first");
  if (body.arrays != nullptr && margin < body.arrays->largest_margin)
    throw Error(ErrorCode::invalid_argument, quoted(body.name) + ": margin is " + base::text_of(margin) +
                                                 ", less than that of a vertex, " +
                                                 base::text_of(body.arrays->largest_margin));
  if (margins_[id.index] == margin) return;
  margins_[id.index] = margin;
  boxes_[id.index] = base::grown(body.mesh.rough_box(), margin);
  slots_[id.index].knows_box = false;
  mark_moved(id.index);
}

void Bodies::set_rest_offset(BodyId id, std::optional<double> rest_offset) {
  const FeatureArrays* const arrays = at(id).arrays.get();
  const bool is_of_vertices = arrays != nullptr && arrays->rest_offsets.empty();
  check_rest_offset(rest_offset,
                    is_of_vertices ? std::min(margins_[id.index], arrays->least_margin) : margins_[id.index],
                    at(id).name);
  const double value = rest_offset.value_or(kAsMargin);
  if (rest_offsets_[id.index] == value) return;
  rest_offsets_[id.index] = value;
  mark_moved(id.index);
}

void Bodies::set_feature_settings(BodyId id, const FeatureSettings& settings) {
  const narrowphase::ClusteredMesh& mesh = at(id).mesh;
  check_feature_settings(settings, static_cast<std::size_t>(mesh.source_vertex_count()),
                         static_cast<std::size_t>(mesh.surface_facet_count()),
                         {margins_[id.index], given_rest_offset(id.index)}, at(id).name);
  Body& body = *slots_[id.index].body;
  std::unique_ptr<FeatureArrays> made = copy_of(settings);
  const FeatureSettings last = body.arrays == nullptr ? FeatureSettings{} : body.arrays->view();
  if (!answer_alike(last, settings, excluded_labels_.has_any_of(id.index))) mark_moved(id.index);
  filter_count_ -= body.filters_features() ? 1 : 0;
  body.arrays = std::move(made);
  filter_count_ += body.filters_features() ? 1 : 0;
}

narrowphase::SurfaceOffset Bodies::offset_of(std::uint32_t slot) const {
  const FeatureArrays* const arrays = in_slot(slot).arrays.get();
  if (arrays != nullptr && !arrays->rest_offsets.empty()) return {arrays->largest_rest_offset, arrays->rest_offsets};
  return rest_offsets_[slot] == kAsMargin ? margin_of(slot)
                                          : narrowphase::SurfaceOffset{.largest = rest_offsets_[slot]};
}

narrowphase::SurfaceOffset Bodies::margin_of(std::uint32_t slot) const {
  const FeatureArrays* const arrays = in_slot(slot).arrays.get();
  if (arrays == nullptr || arrays->margins.empty()) return {.largest = margins_[slot]};
  return {arrays->largest_margin, arrays->margins};
}

narrowphase::FeatureFilter Bodies::feature_filter(std::uint32_t a, std::uint32_t b) const {
  const ExcludedLabels::OfBodies* const labels = excluded_labels_.empty() ? nullptr : excluded_labels_.find(a, b);
  narrowphase::FeatureFilter filter{.a = surface_filter(a, labels != nullptr),
                                    .b = surface_filter(b, labels != nullptr)};
  if (labels != nullptr) {
    filter.excluded_of_facets = labels->of_facets;
    filter.excluded_of_vertices = labels->of_vertices;
  }
  if (a == b && in_slot(a).self_filter != nullptr) filter.neighbors = in_slot(a).self_filter->neighbors.get();
  return filter;
}

narrowphase::SurfaceFilter Bodies::surface_filter(std::uint32_t slot, bool by_labels) const {
  narrowphase::SurfaceFilter filter{
      .layer = filters_[slot].layer, .mask = filters_[slot].mask, .surface = featured(slot)};
  if (const FeatureArrays* const arrays = in_slot(slot).arrays.get(); arrays != nullptr) {
    filter.of_vertices = {.layers = arrays->vertex_layers, .masks = arrays->vertex_masks};
    filter.of_facets = {.layers = arrays->facet_layers, .masks = arrays->facet_masks};
    if (by_labels) {
      filter.of_vertices.labels = arrays->vertex_labels;
      filter.of_facets.labels = arrays->facet_labels;
    }
  }
  return filter;
}

void Bodies::set_self_contact(BodyId id, bool wanted) {
  if (at(id).self_contact == wanted) return;
  slots_[id.index].body->self_contact = wanted;
  self_count_ += wanted ? 1 : std::size_t{0} - 1;
  mark_moved(id.index);
}

void Bodies::set_self_filter(BodyId id, const SelfContactFilter& filter, int threads) {
  const std::uint32_t slot = at(id).id.index;
  const narrowphase::ClusteredMesh& mesh = placed(slot).mesh;
  std::unique_ptr<SelfFilter> made = made_of(filter, source_positions(mesh, mesh.points()), at(id).name);
  if (are_same(made.get(), in_slot(slot).self_filter.get())) return;
  if (made != nullptr) {
    make_features({&slot, 1}, threads);
    find_neighbors(*made, featured(slot));
  }
  Body& body = *slots_[slot].body;
  filter_count_ -= body.filters_features() ? 1 : 0;
  body.self_filter = std::move(made);
  filter_count_ += body.filters_features() ? 1 : 0;
  mark_moved(slot);
}

void Bodies::check_labels(const LabelPair& labels) const {
  for (const BodyId id : {labels.a, labels.b}) {
    if (at(id).plane != nullptr)
      throw Error(ErrorCode::invalid_argument, quoted(at(id).name) + " is a plane: nothing of it has a label");
  }
  check_name(labels.kind, LabelKind::vertex, quoted(at(labels.a).name) + ": kind of labels");
  if (labels.label_a == 0 || labels.label_b == 0)
    throw Error(ErrorCode::invalid_argument, quoted(at(labels.a).name) + ": label 0 is that of what has none");
}

void Bodies::set_excluded_labels(const LabelPair& labels, bool excluded) {
  if (this->excluded_labels(labels) == excluded) return;
  excluded_labels_.set(labels, excluded);
  mark_moved(labels.a.index);
  mark_moved(labels.b.index);
}

bool Bodies::excluded_labels(const LabelPair& labels) const {
  check_labels(labels);
  return excluded_labels_.contains(labels);
}

void Bodies::find_kdops(int threads) {
  const std::span<const std::uint32_t> missing = kdops_.missing();
  base::parallel_for(missing.size(), 1, threads,
                     [&](std::size_t i) { kdops_.find(missing[i], in_slot(missing[i]).mesh); });
  kdops_.clear_missing();
}

void Bodies::make_neighbors(std::span<const std::uint32_t> slots, int threads) {
  make_features(slots, threads);
  base::parallel_for(slots.size(), 1, threads, [&](std::size_t i) {
    Body& body = *slots_[slots[i]].body;
    if (body.neighbors == nullptr)
      body.neighbors = std::make_unique<const narrowphase::ClusterNeighbors>(body.mesh, *body.features);
  });
}

void Bodies::set_filter(BodyId id, const broadphase::Filter& filter) {
  if (filters_[id.index] == filter) return;
  filters_[id.index] = filter;
  slots_[id.index].fixed = filter.fixed;
  mark_moved(id.index);
}

template <class OfBody>
void Bodies::check_named_once(std::span<const OfBody> updates) {
  named_.assign(slots_.size(), 0);
  for (const OfBody& update : updates) {
    if (named_[update.body.index]++)
      throw Error(ErrorCode::wrong_order, quoted(at(update.body).name) + " is named twice in one batch");
  }
}
template void Bodies::check_named_once(std::span<const PoseUpdate> updates);
template void Bodies::check_named_once(std::span<const PositionsUpdate> updates);

bool Bodies::contains(BodyId id) const noexcept {
  return id.world == world_ && id.index < slots_.size() && slots_[id.index].body != nullptr &&
         slots_[id.index].generation == id.generation;
}

const Body& Bodies::at(BodyId id) const {
  const auto text = [&] {
    return "id (" + std::to_string(id.index) + ", generation " + std::to_string(id.generation) + ")";
  };
  if (id.generation == 0) throw Error(ErrorCode::stale_body, text() + " names no body");
  if (id.world != world_) throw Error(ErrorCode::foreign_body, text() + " was given out by another world");
  if (!contains(id)) {
    const bool was_given = id.index < generations_.size() && id.generation <= generations_[id.index];
    throw Error(ErrorCode::stale_body,
                text() + (was_given ? " names a body that was removed, or added after the state that was restored"
                                    : " was never given out"));
  }
  return *slots_[id.index].body;
}

std::vector<BodyId> Bodies::ids() const {
  std::vector<BodyId> ids;
  for (const Slot& slot : slots_) {
    if (slot.body) ids.push_back(slot.body->id);
  }
  return ids;
}

void Bodies::update_order() {
  keys_.update_order();
  std::ranges::sort(removed_, {}, kIdOfRemoved);
}

std::uint64_t Bodies::key(BodyId id) const {
  if (contains(id)) return keys_.of(id.index);
  return std::ranges::lower_bound(removed_, id, {}, kIdOfRemoved)->key;
}

void Bodies::mark_moved(std::uint32_t slot) {
  if (!moved(slot)) moved_vertices_ += slots_[slot].vertex_count;
  mark_changed(slot);
}

void Bodies::mark_changed(std::uint32_t slot) {
  tree_->note_change(slot);
  if (slots_[slot].changed) return;
  slots_[slot].changed = true;
  changed_.push_back(slot);
}

void Bodies::end_step() {
  for (const std::uint32_t slot : changed_) {
    slots_[slot].changed = false;
    slots_[slot].begin = Begin::here;
    slots_[slot].seen = true;
  }
  changed_.clear();
  excluded_.end_step();
  removed_.clear();
  ++steps_;
  moved_vertices_ = 0;
  placed_count_ = 0;
}

void Bodies::mark_all_changed() {
  kdops_.clear_missing();
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) mark_changed(slot);
  moved_vertices_ = vertices_;
}

}  // namespace tact
