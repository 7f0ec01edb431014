#include "engine/bodies.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/text.h"
#include "engine/check_coordinate.h"
#include "engine/check_name.h"
#include "engine/columns.h"
#include "narrowphase/hull/kdop.h"
#include "narrowphase/mesh/cluster_quality.h"
#include "narrowphase/mesh/position_problem.h"
#include "narrowphase/mesh/prefetch.h"

namespace tact {

namespace {

using narrowphase::PositionProblem;
using narrowphase::Refit;

constexpr std::ptrdiff_t kLargestCount = std::numeric_limits<int>::max() / 4;
constexpr std::size_t kPrefetchDistance = 8;                                // bodies
constexpr std::size_t kPublishedAtATime = 1024;                             // bodies
constexpr std::size_t kRefittedBytes = sizeof(narrowphase::ClusteredMesh);  // of a Body, its first: what stage 1 reads
// A body of so many facets is refitted by all threads: one among many, or one of a few that would not keep them busy.
constexpr int kLargeBody = 32768, kLargeOfFew = 8192;  // facets
constexpr std::size_t kFewPerThread = 4;
constexpr int kMostWithKdop = 4096;  // vertices: to look how far more of them reach takes longer than it saves
constexpr int kMostDoublings = 8;    // of the moves until the clusters of a body are looked at

void check_positions(const double* positions, std::size_t count, const std::string& name) {
  const PositionProblem problem = narrowphase::find_position_problem(positions, count, kLargestCoordinate);
  if (problem.kind == PositionProblem::none) return;
  const double value =
      positions[3 * static_cast<std::size_t>(problem.source_vertex) + static_cast<std::size_t>(problem.axis)];
  refuse_coordinate(quoted(name) + ": vertex " + std::to_string(problem.source_vertex), problem.axis, value);
}

void check_facets(std::span<const int> corner, const Facets& given, std::ptrdiff_t vertices, const std::string& name) {
  for (std::size_t i = 0; i < corner.size(); ++i) {
    if (corner[i] >= 0 && corner[i] < vertices) continue;
    throw Error(ErrorCode::facet_out_of_range,
                quoted(name) + ": facet " + std::to_string(i / 3) + " names vertex " +
                    std::to_string(index_at(given, static_cast<std::ptrdiff_t>(i / 3), static_cast<int>(i % 3))) +
                    ", but there are " + std::to_string(vertices) + " vertices");
  }
}

void check_margin(double margin, const std::string& name) {
  if (margin >= 0.0 && margin <= kLargestCoordinate) return;
  throw Error(ErrorCode::bad_settings, quoted(name) + ": margin is " + base::text_of(margin) + ", not 0 to 2^300");
}

bool has_kdop(const narrowphase::ClusteredMesh& mesh) {
  return mesh.vertex_count() > 0 && mesh.vertex_count() <= kMostWithKdop;
}

template <class T>
void make_room(std::vector<T>& vector, std::size_t count) {
  if (vector.capacity() < count) vector.reserve(2 * count);
}

template <class Scalar>
void check_rows(const Columns<Scalar>& m, const char* what, const std::string& name) {
  constexpr bool kCoordinates = std::is_same_v<Scalar, double>;
  const bool known = m.kind() <= NumberKind::uint16 && (m.kind() <= NumberKind::float64) == kCoordinates;
  if (!known || (m.first() == nullptr && m.cols() > 0)) {
    throw Error(ErrorCode::wrong_size, quoted(name) + ": the array of " + what +
                                           (known          ? " is null"
                                            : kCoordinates ? " holds no float32 or float64"
                                                           : " holds no int32, uint32 or uint16"));
  }
  if (m.rows() == 3) return;
  throw Error(ErrorCode::wrong_size, quoted(name) + ": the matrix of " + what + " is " + std::to_string(m.rows()) +
                                         " x " + std::to_string(m.cols()) + ", not 3 x N");
}

// Makes room for the columns where they are not read where they are.
template <class Scalar>
void make_copy_room(const Columns<Scalar>& m, std::vector<Scalar>& copy) {
  if (!is_packed(m)) copy.resize(3 * m.cols());
}

}  // namespace

BodyId Bodies::add(const BodyDefinition& definition) {
  const auto slot = free_.empty() ? static_cast<std::uint32_t>(slots_.size()) : free_.back();
  const std::string name = definition.name.empty() ? "body " + std::to_string(slot) : definition.name;
  check_name(definition.surface, Surface::sheet, quoted(name) + ": surface");
  check_name(definition.motion, Motion::rigid, quoted(name) + ": motion");
  check_margin(definition.margin, name);
  check_rows(definition.positions, "positions", name);
  check_rows(definition.facets, "facets", name);
  if (slots_.size() >= std::numeric_limits<std::uint32_t>::max() || definition.positions.cols() > kLargestCount ||
      definition.facets.cols() > kLargestCount) {
    throw Error(ErrorCode::too_large,
                quoted(name) + ": a body has up to 536870911 vertices and facets, a world up to 4294967295 bodies");
  }
  std::vector<double> position_copy;
  std::vector<int> facet_copy;
  make_copy_room(definition.positions, position_copy);
  make_copy_room(definition.facets, facet_copy);
  const std::span<const double> positions = packed(definition.positions, std::span(position_copy));
  const std::span<const int> facets = packed(definition.facets, std::span(facet_copy));
  check_positions(positions.data(), positions.size() / 3, name);
  check_facets(facets, definition.facets, definition.positions.cols(), name);
  auto body = std::make_unique<Body>(Body{.mesh = {positions, facets},
                                          .id = {},
                                          .name = name,
                                          .surface = definition.surface,
                                          .external_id = definition.external_id,
                                          .self_contact = definition.self_contact});
  const bool rigid = definition.motion == Motion::rigid;
  // Nothing can fail half-way: all that may allocate comes first.
  const std::size_t slots = std::max<std::size_t>(slots_.size(), slot + 1);
  const auto on_all = [&](const auto& grow) {
    grow(boxes_), grow(filters_), grow(margins_), grow(kdops_), grow(knows_kdop_), grow(wants_kdop_), grow(groupings_),
        grow(slots_);
  };
  on_all([&](auto& vector) { make_room(vector, slots); });
  make_room(changed_, slots);
  make_room(free_, slots);
  make_room(decayed_, slots);
  make_room(unknown_, slots);
  if (rigid) rigid_states_.make_room();
  if (slot < slots_.size()) free_.pop_back();
  on_all([&](auto& vector) { vector.resize(slots); });
  body->id = {slot, ++slots_[slot].generation, world_};
  margins_[slot] = definition.margin;
  boxes_[slot] = base::grown(body->mesh.box(), definition.margin);
  find_kdops(slot, body->mesh);
  wants_kdop_[slot] = 1;
  groupings_[slot] = {.quality = cluster_quality(body->mesh)};
  filters_[slot] = {definition.layer, definition.mask, definition.motion == Motion::fixed, definition.group};
  slots_[slot].vertex_count = body->mesh.source_vertex_count();
  slots_[slot].fixed = definition.motion == Motion::fixed;
  slots_[slot].rigid = rigid ? rigid_states_.take() : nullptr;
  if (rigid) {
    const base::Box box = body->mesh.box();
    for (int axis = 0; axis < 3 && !box.empty(); ++axis)
      farthest_rest_ = std::max({farthest_rest_, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
    body->mesh.make_rigid(&slots_[slot].rigid->pose);
    body->mesh.place();
  }
  slots_[slot].knows_box = slots_[slot].to_place = false;
  rigid_count_ += rigid ? 1 : 0;
  self_count_ += definition.self_contact ? 1 : 0;
  slots_[slot].begin = Begin::here;
  slots_[slot].seen = false;
  slots_[slot].body = std::move(body);
  packed_meshes_.add(slots_[slot].body->mesh);
  mark_changed(slot);
  ++count_;
  vertices_ += slots_[slot].vertex_count;
  moved_vertices_ += slots_[slot].vertex_count;
  return slots_[slot].body->id;
}

void Bodies::remove(BodyId id) {
  const auto vertices = at(id).mesh.source_vertex_count();
  vertices_ -= vertices;
  if (moved(id.index)) moved_vertices_ -= vertices;
  packed_meshes_.remove(slots_[id.index].body->mesh);
  rigid_count_ -= is_rigid(id.index) ? 1 : 0;
  self_count_ -= slots_[id.index].body->self_contact ? 1 : 0;
  slots_[id.index].body.reset();
  if (is_rigid(id.index)) rigid_states_.give_back(std::exchange(slots_[id.index].rigid, nullptr));
  boxes_[id.index] = base::Box{};
  std::erase_if(excluded_, [&](const broadphase::IndexPair& pair) { return pair.a == id.index || pair.b == id.index; });
  // No id is given out twice: a slot whose generations are used up stays empty.
  if (id.generation < std::numeric_limits<std::uint32_t>::max()) free_.push_back(id.index);
  std::erase(decayed_, id.index);
  mark_changed(id.index);
  removed_any_ = true;
  --count_;
}

// Where memory is short the meshes stay where they are.
void Bodies::pack_meshes(int threads) try {
  std::vector<narrowphase::ClusteredMesh*> meshes;
  meshes.reserve(count_);
  for (const Slot& slot : slots_) {
    if (slot.body) meshes.push_back(&slot.body->mesh);
  }
  packed_meshes_.pack(meshes, threads);
} catch (const std::bad_alloc&) {
  packed_meshes_.put_off();
}

void Bodies::make_updates(std::size_t count) {
  if (new_kdops_.size() < count) new_kdops_.resize(count);
  if (updates_.size() < count) updates_.resize(count);
}

void Bodies::prepare(Update& update, BodyId id, const Positions& positions) {
  const Body& body = at(id);
  const Slot& slot = slots_[id.index];
  if (slot.fixed) throw Error(ErrorCode::fixed_body, quoted(body.name) + " is fixed: its positions cannot be set");
  if (slot.rigid)
    throw Error(ErrorCode::wrong_motion,
                quoted(body.name) + " is rigid: set_pose() moves it, its positions cannot be set");
  check_rows(positions, "positions", body.name);
  if (positions.cols() != slot.vertex_count) {
    throw Error(ErrorCode::wrong_size, quoted(body.name) + " has " + std::to_string(slot.vertex_count) +
                                           " vertices, but " + std::to_string(positions.cols()) +
                                           " positions were given");
  }
  make_copy_room(positions, update.copy);
  update.given = &positions;
  update.body = slot.body.get();
  update.slot = id.index;
  if (slot.begin == Begin::before) update.body->begin.resize(body.mesh.placements().size());
}

// The refresh that follows writes where the positions of the last step are.
void Bodies::keep_begin(Body& body, Slot& slot) {
  body.mesh.placements().keep_before(body.begin.data());
  slot.begin = Begin::kept;
}

narrowphase::MovingMesh Bodies::moving(std::uint32_t slot) const {
  const Body& body = in_slot(slot);
  const narrowphase::MeshPlacements& placements = body.mesh.placements();
  const Begin begin = slots_[slot].begin;
  return {&body.mesh, body.features.get(),
          begin == Begin::here     ? placements.now()
          : begin == Begin::before ? placements.before()
                                   : placements.in(body.begin.data())};
}

// Asks for the memory of a body that is looked at soon: small bodies are scattered.
void Bodies::prefetch(BodyId id) const {
  if (id.index < slots_.size())
    narrowphase::prefetch_lines(reinterpret_cast<const char*>(slots_[id.index].body.get()), kRefittedBytes);
}

void Bodies::refresh(std::size_t i, int threads) {
  Update& update = updates_[i];
  narrowphase::ClusteredMesh& mesh = update.body->mesh;
  update.positions = packed(*update.given, std::span(update.copy));
  if (slots_[update.slot].begin == Begin::before) keep_begin(*update.body, slots_[update.slot]);
  update.refitted = refit(mesh, update.positions.data(),
                          {.largest = kLargestCoordinate, .threads = threads, .prefetch = !stay_in_cache()});
  const bool changed = update.refitted == Refit::changed;
  update.box = mesh.box();
  update.knows_kdop = changed && wants_kdop_[update.slot] != 0 && has_kdop(mesh);
  if (update.knows_kdop) new_kdops_[i] = narrowphase::kdop_of(mesh);
  const Grouping& grouping = groupings_[update.slot];
  const bool looks = changed && grouping.moves + 1 == moves_to_look(grouping) &&
                     static_cast<std::size_t>(mesh.cluster_count()) >= tuning_->fewest_regrouped;
  update.quality = looks ? cluster_quality(mesh) : 0.0;
}

void Bodies::find_kdops(int threads) {
  base::parallel_for(unknown_.size(), 1, threads,
                     [&](std::size_t i) { find_kdops(unknown_[i], in_slot(unknown_[i]).mesh); });
  unknown_.clear();
}

void Bodies::find_kdops(std::uint32_t slot, const narrowphase::ClusteredMesh& mesh) {
  knows_kdop_[slot] = has_kdop(mesh) ? 1 : 0;
  if (has_kdop(mesh)) kdops_[slot] = narrowphase::kdop_of(mesh);
}

// Takes all bodies back and says what is wrong if the positions of any cannot be taken.
void Bodies::take_back_if_bad(std::size_t count) {
  const std::span<Update> updates = std::span(updates_).first(count);
  const auto bad = std::ranges::find(updates, Refit::bad, &Update::refitted);
  if (bad == updates.end()) return;
  for (const Update& update : updates) {
    if (update.refitted == Refit::changed) undo_refit(update.body->mesh);
  }
  check_positions(bad->positions.data(), bad->positions.size() / 3, bad->body->name);
}

void Bodies::publish(std::size_t i) {
  const Update& update = updates_[i];
  if (update.refitted != Refit::changed) return;
  const std::uint32_t slot = update.slot;
  boxes_[slot] = base::grown(update.box, margins_[slot]);
  knows_kdop_[slot] = update.knows_kdop ? 1 : 0;
  if (update.knows_kdop) kdops_[slot] = new_kdops_[i];
  Grouping& grouping = groupings_[slot];
  grouping.moves = static_cast<std::uint16_t>((grouping.moves + 1) % moves_to_look(grouping));
}

void Bodies::note_change(const Update& update) {
  if (update.refitted != Refit::changed) return;
  mark_moved(update.slot);
  Slot& slot = slots_[update.slot];
  if (slot.begin == Begin::here && slot.seen) slot.begin = Begin::before;
  if (update.quality == 0.0) return;  // most often: nothing of the grouping is read
  Grouping& grouping = groupings_[update.slot];
  if (grouping.decayed || !has_decayed(grouping, update.quality)) return;
  grouping.decayed = true;
  decayed_.push_back(update.slot);
}

bool Bodies::has_decayed(const Grouping& grouping, double quality) const {
  return tuning_->decayed * quality < grouping.quality;
}

int Bodies::moves_to_look(const Grouping& grouping) const { return tuning_->moves_to_look << grouping.tries; }

std::vector<Bodies::Regrouped> Bodies::regroup(int threads) {
  std::ranges::sort(decayed_);
  std::vector<Regrouped> all(decayed_.size());
  std::vector<std::optional<narrowphase::ClusteredMesh>> meshes(decayed_.size());
  base::parallel_for(decayed_.size(), 1, threads, [&](std::size_t i) {
    const narrowphase::ClusteredMesh& mesh = in_slot(decayed_[i]).mesh;
    if (!has_decayed(groupings_[decayed_[i]], cluster_quality(mesh))) return;  // it was, when it was looked at
    meshes[i] = clustered_anew(mesh);
    all[i] = {in_slot(decayed_[i]).id, vertex_numbers_in(*meshes[i], mesh)};
  });
  // From here on nothing can fail.
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!meshes[i]) continue;
    Body& body = *slots_[decayed_[i]].body;
    Grouping& grouping = groupings_[decayed_[i]];
    if (cluster_spread(*meshes[i]) <= tuning_->worth_regrouping * cluster_spread(body.mesh)) {
      packed_meshes_.remove(body.mesh);
      body.mesh = std::move(*meshes[i]);
      body.features.reset();
      body.neighbors.reset();
      slots_[decayed_[i]].begin = Begin::here;
      packed_meshes_.add(body.mesh);
    } else {
      all[i].numbers.clear();
    }
    grouping.quality = cluster_quality(body.mesh);
    grouping.tries = static_cast<std::uint8_t>(std::min(grouping.tries + 1, kMostDoublings));
  }
  std::erase_if(all, [](const Regrouped& body) { return body.numbers.empty(); });
  keep_groups();
  return all;
}

void Bodies::keep_groups() noexcept {
  for (const std::uint32_t slot : decayed_) {
    groupings_[slot].decayed = false;
    groupings_[slot].moves = 0;
  }
  decayed_.clear();
}

void Bodies::set_positions(BodyId id, const Positions& positions, int threads) {
  const base::FloatingPointMode mode;
  make_updates(1);
  prepare(updates_[0], id, positions);
  refresh(0, updates_[0].body->mesh.facet_count() >= kLargeOfFew ? threads : 1);
  take_back_if_bad(1);
  publish(0);
  note_change(updates_[0]);
}

void Bodies::set_positions(std::span<const PositionsUpdate> updates, int threads) {
  const base::FloatingPointMode mode;
  const std::size_t count = updates.size();
  if (packed_meshes_.is_due(*tuning_)) pack_meshes(threads);
  make_updates(count);
  for (std::size_t i = 0; i < count; ++i) {
    try {
      prepare(updates_[i], updates[i].body, updates[i].positions);
    } catch (const Error& error) {
      throw Error(error.code(), "update " + std::to_string(i) + ": " + error.what());
    }
  }
  check_named_once(updates);
  // Large bodies one after the other, each on all threads.
  std::atomic<bool> any_large{false};
  const bool few = count < kFewPerThread * static_cast<std::size_t>(threads);
  const auto large = [&](std::size_t i) {
    return threads > 1 && updates_[i].body->mesh.facet_count() >= (few ? kLargeOfFew : kLargeBody);
  };
  const std::size_t grain = base::grain_of(count, threads, 16, 128);
  const bool prefetches = !stay_in_cache();
  base::parallel_for(count, grain, threads, [&](std::size_t i) {
    // Of the bodies that another thread may turn over, only where they are is read.
    const std::size_t own_end = threads == 1 ? count : std::min(count, i - i % grain + grain);
    const auto ask_for = [&](std::size_t k) {
      if (k < own_end && is_packed(*updates_[k].given))
        prefetch_refit(updates_[k].body->mesh, updates_[k].given->data());
    };
    if (prefetches) {
      for (std::size_t k = 1; i % grain == 0 && k < kPrefetchDistance; ++k) ask_for(i + k);
      ask_for(i + kPrefetchDistance);
      if (i + 2 * kPrefetchDistance < count) prefetch(updates[i + 2 * kPrefetchDistance].body);
    }
    if (large(i)) {
      any_large = true;
    } else {
      refresh(i, 1);
    }
  });
  for (std::size_t i = 0; i < count && any_large; ++i) {
    if (large(i)) refresh(i, threads);
  }
  take_back_if_bad(count);
  base::parallel_for(count, kPublishedAtATime, threads, [&](std::size_t i) { publish(i); });
  for (std::size_t i = 0; i < count; ++i) note_change(updates_[i]);
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
                                             (motion == Motion::rigid ? "rigid" : "moving"));
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
  if (excluded) {
    excluded_.insert(std::ranges::upper_bound(excluded_, pair), pair);
  } else {
    excluded_.erase(std::ranges::lower_bound(excluded_, pair));
  }
  exclusions_changed_ = true;
  mark_moved(pair.a);
  mark_moved(pair.b);
}

bool Bodies::excluded(BodyId a, BodyId b) const {
  at(a), at(b);
  if (a == b) throw Error(ErrorCode::bad_settings, quoted(at(a).name) + ": a pair is of two bodies; see self_contact");
  return excludes(slots_of(a, b));
}

void Bodies::set_margin(BodyId id, double margin) {
  const Body& body = at(id);
  check_margin(margin, body.name);
  if (margins_[id.index] == margin) return;
  margins_[id.index] = margin;
  boxes_[id.index] = base::grown(body.mesh.rough_box(), margin);
  slots_[id.index].knows_box = false;
  mark_moved(id.index);
}

void Bodies::set_self_contact(BodyId id, bool wanted) {
  if (at(id).self_contact == wanted) return;
  slots_[id.index].body->self_contact = wanted;
  self_count_ += wanted ? 1 : std::size_t{0} - 1;
  mark_moved(id.index);
}

void Bodies::make_features(std::span<const std::uint32_t> slots, int threads) {
  without_features_.clear();
  std::ranges::copy_if(slots, std::back_inserter(without_features_),
                       [&](std::uint32_t slot) { return in_slot(slot).features == nullptr; });
  std::ranges::sort(without_features_);
  without_features_.erase(std::unique(without_features_.begin(), without_features_.end()), without_features_.end());
  base::parallel_for(without_features_.size(), 1, threads, [&](std::size_t i) {
    Body& body = *slots_[without_features_[i]].body;
    body.features = std::make_unique<const narrowphase::Features>(body.mesh);
  });
}

const narrowphase::ClusterNeighbors& Bodies::neighbors(std::uint32_t slot) {
  Body& body = *slots_[slot].body;
  if (body.neighbors == nullptr) {
    make_features({&slot, 1}, 1);
    body.neighbors = std::make_unique<const narrowphase::ClusterNeighbors>(body.mesh, *body.features);
  }
  return *body.neighbors;
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
    const bool was_given = id.index < slots_.size() && id.generation <= slots_[id.index].generation;
    throw Error(ErrorCode::stale_body,
                text() + (was_given ? " names a body that was removed" : " was never given out"));
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

void Bodies::mark_moved(std::uint32_t slot) {
  if (!moved(slot)) moved_vertices_ += slots_[slot].vertex_count;
  mark_changed(slot);
}

void Bodies::mark_changed(std::uint32_t slot) {
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
  exclusions_changed_ = false;
  removed_any_ = false;
  moved_vertices_ = 0;
  placed_count_ = 0;
}

void Bodies::mark_all_changed() {
  unknown_.clear();
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) mark_changed(slot);
  moved_vertices_ = vertices_;
}

}  // namespace tact
