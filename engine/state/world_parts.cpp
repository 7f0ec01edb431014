#include "engine/state/world_parts.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "broadphase/sweep_and_prune.h"
#include "engine/base/floating_point_mode.h"
#include "engine/bodies/room.h"
#include "engine/motion_stage.h"
#include "engine/state/archives.h"
#include "engine/state/pair_state.h"
#include "engine/state/world_state.h"
#include "engine/with_memory.h"
#include "narrowphase/mesh/source_mesh.h"

namespace tact {

const VertexNumbers::OfMesh& VertexNumbers::of(const Body& body) {
  const auto found = of_slot_.find(body.id.index);
  if (found != of_slot_.end()) return found->second;
  const narrowphase::ClusteredMesh& mesh = body.mesh;
  OfMesh numbers;
  numbers.source.resize(static_cast<std::size_t>(mesh.vertex_count()));
  numbers.mesh.resize(static_cast<std::size_t>(mesh.source_vertex_count()));
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    numbers.source[v] = mesh.source_vertex(v);
    numbers.mesh[mesh.source_vertex(v)] = v;
  }
  return of_slot_[body.id.index] = std::move(numbers);
}

// The bytes that write_body() makes of a body with its facets.
void StateFields::join(std::span<const std::byte> shape, std::span<const std::byte> rest, StateWriter& writer) {
  StateReader reader(rest), of_shape(shape);
  const auto place = reader.read<Bodies::Place>();
  auto mesh = reader.read<MeshState>();
  of_shape(mesh.facets, mesh.order);
  writer(place, mesh);
  writer.bytes().insert(writer.bytes().end(), reader.rest().begin(), reader.rest().end());
}

// A slot that the next step knows as changed stays that of the body that was in it: what is kept of it ends there.
BodyId StateFields::put_body(StateReader& reader, Bodies& bodies, bool is_copy) {
  const auto is_new = [&](std::uint32_t slot) { return !bodies.slots_[slot].changed; };
  auto found = std::find_if(bodies.free_.rbegin(), bodies.free_.rend(), is_new);
  if (found == bodies.free_.rend()) {
    add_slots(bodies, bodies.slots_.size() + 1);
    bodies.free_.push_back(static_cast<std::uint32_t>(bodies.slots_.size() - 1));
    found = bodies.free_.rbegin();
  }
  const std::uint32_t slot = *found;
  read_body(reader, bodies, slot);
  bodies.free_.erase(std::next(found).base());
  Bodies::Slot& put = bodies.slots_[slot];
  if (!put.changed) {  // it was noted as such when it was put
    bodies.changed_.pop_back();
    bodies.moved_vertices_ -= put.vertex_count;
  }
  Body& body = *put.body;
  body.id = {slot, ++bodies.generations_[slot], bodies.world_};
  put.generation = body.id.generation;
  if (put.rigid != nullptr) put.rigid->begin_is_placed = false;  // as an earlier body may have left it
  if (is_copy && std::exchange(body.self_contact, false)) --bodies.self_count_;
  return body.id;
}

void StateFields::take_bodies(std::span<const BodyId> gone, Bodies& bodies, Step& step) {
  PairTable& table = step.stages_->table;
  SelfStage& selves = step.stages_->selves;
  std::vector<char> goes(bodies.slots_.size(), 0);
  for (const BodyId body : gone) goes[body.index] = 1;
  const auto takes = [&](BodyId body) { return bodies.contains(body) && goes[body.index] != 0; };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < table.pairs_.size(); ++i) {
    const CandidatePair candidate = table.candidates_[i];
    if (takes(candidate.a) || takes(candidate.b)) {
      PairRecord& record = *table.entries_[i].record;
      record.touching = false;
      if (record.patches != nullptr) record.patches->now.clear(), record.patches->last.clear();
      table.retire(record);
      continue;
    }
    table.pairs_[kept] = table.pairs_[i];
    table.candidates_[kept] = candidate;
    table.entries_[kept++] = table.entries_[i];
  }
  table.pairs_.resize(kept), table.candidates_.resize(kept), table.entries_.resize(kept);
  for (const BodyId body : gone) {
    if (selves.find(body) != nullptr) selves.records_[body.index].reset();
    bodies.remove(body);
    bodies.removed_.pop_back();
    bodies.former_.clear();
    // The next step tells what ended with a body that was removed from this slot before.
    const bool has_other = body.index < selves.records_.size() && selves.records_[body.index] != nullptr;
    bodies.slots_[body.index].changed = has_other;
  }
  std::erase_if(bodies.changed_, [&](std::uint32_t slot) { return !bodies.slots_[slot].changed; });
}

// No state from before is restored into such a world: former ids are not kept.
void StateFields::remove_copy(BodyId body, Bodies& bodies) {
  bodies.remove(body);
  bodies.former_.clear();
}

void StateFields::exclude(BodyId a, BodyId b, bool excluded, Bodies& bodies) {
  if (bodies.excluded(a, b) == excluded) return;
  const broadphase::IndexPair pair = Bodies::slots_of(a, b);
  excluded ? bodies.excluded_.add(pair) : bodies.excluded_.remove(pair);
}

void StateFields::exclude(const LabelPair& labels, bool excluded, Bodies& bodies) {
  bodies.check_labels(labels);
  bodies.excluded_labels_.set(labels, excluded);
}

void StateFields::mark_moved(BodyId body, bool is_on_its_way, Bodies& bodies) {
  bodies.mark_moved(body.index);
  Bodies::Slot& slot = bodies.slots_[body.index];
  if (!is_on_its_way || slot.begin != Bodies::Begin::here) return;
  if (slot.rigid != nullptr) {
    slot.rigid->begin_pose = slot.rigid->pose.pose();
    slot.rigid->begin_is_placed = false;
  } else {
    const narrowphase::MeshPlacements& placements = slot.body->mesh.placements();
    slot.body->begin.resize(placements.size());
    std::copy_n(placements.now_memory(), placements.size() - narrowphase::kPadding, slot.body->begin.data());
  }
  slot.begin = Bodies::Begin::kept;
}

// The records stay as they are: each is renumbered to be written, and back.
std::vector<SavedPair> StateFields::pairs_of(std::span<const BodyId> those, const Bodies& bodies, Step& step) {
  std::vector<SavedPair> saved;
  if (step.forgotten_) return saved;
  std::vector<char> is_wanted(bodies.slots_.size(), 0);
  for (const BodyId body : those) is_wanted[body.index] = 1;
  PairTable& table = step.stages_->table;
  VertexNumbers numbers;
  for (std::size_t i = 0; i < table.pairs_.size(); ++i) {
    const CandidatePair& pair = table.candidates_[i];
    const bool has_a = bodies.contains(pair.a), has_b = bodies.contains(pair.b);
    if (!(has_a && is_wanted[pair.a.index] != 0) && !(has_b && is_wanted[pair.b.index] != 0)) continue;
    saved.push_back(saved_pair(i, bodies, table, numbers));
  }
  return saved;
}

// Also what ends with a body that was removed, and was held against itself.
std::vector<SavedPair> StateFields::all_pairs(const Bodies& bodies, Step& step) {
  std::vector<SavedPair> saved;
  if (step.forgotten_) return saved;
  PairTable& table = step.stages_->table;
  VertexNumbers numbers;
  for (std::size_t i = 0; i < table.pairs_.size(); ++i) saved.push_back(saved_pair(i, bodies, table, numbers));
  for (const std::unique_ptr<SelfRecord>& record : step.stages_->selves.records_) {
    if (record == nullptr || bodies.contains(record->body)) continue;
    const std::uint64_t key = bodies.key(record->body);
    SavedPair& one = saved.emplace_back();
    one.key_a = one.key_b = key;
    one.touching = record->touching;
    for (const Patch& patch : record->patches.now.patches) one.patches.push_back(patch.id);
  }
  return saved;
}

SavedPair StateFields::saved_pair(std::size_t i, const Bodies& bodies, PairTable& table, VertexNumbers& numbers) {
  const CandidatePair& pair = table.candidates_[i];
  PairRecord& record = table.record(i);
  SavedPair one;
  one.key_a = bodies.key(pair.a), one.key_b = bodies.key(pair.b);
  const bool has_a = bodies.contains(pair.a), has_b = bodies.contains(pair.b);
  if (has_a) one.birth_a = bodies.in_slot(pair.a.index).birth;
  if (has_b) one.birth_b = bodies.in_slot(pair.b.index).birth;
  if (has_a && has_b) {
    const Body &a = bodies.in_slot(pair.a.index), &b = bodies.in_slot(pair.b.index);
    StateWriter writer;
    writer(table.separating_axis(i));
    const VertexNumbers::OfMesh &of_a = numbers.of(a), &of_b = numbers.of(b);
    const auto go_back = [&] { renumber(record, of_a.mesh, of_b.mesh); };
    renumber(record, of_a.source, of_b.source);
    try {
      write_pair(record, writer);
    } catch (...) {
      go_back();
      throw;
    }
    go_back();
    one.bytes = std::move(writer.bytes());
  }
  one.touching = record.touching;
  if (record.patches == nullptr) return one;
  for (const Patch& patch : record.patches->now.patches) one.patches.push_back(patch.id);
  return one;
}

void StateFields::write_steps(const Bodies& bodies, const Step& step, StateWriter& writer) {
  writer(bodies.steps_, step.all_ || step.forgotten_);
}

void StateFields::read_steps(StateReader& reader, Bodies& bodies, Step& step) { reader(bodies.steps_, step.all_); }

bool StateFields::put_pair(const SavedPair& pair, const Bodies& bodies, Step& step, VertexNumbers& numbers) {
  const auto slot_a = bodies.keys_.find(pair.key_a), slot_b = bodies.keys_.find(pair.key_b);
  if (!slot_a || !slot_b || pair.bytes.empty()) return false;
  const Body &a = bodies.in_slot(*slot_a), &b = bodies.in_slot(*slot_b);
  if (a.birth != pair.birth_a || b.birth != pair.birth_b) return false;
  if (step.forgotten_) return true;
  PairTable& table = step.stages_->table;
  PairTable::Entry entry{.record = &table.new_record(a.id, b.id)};
  PairRecord& record = *entry.record;
  record.patches.reset();  // of an earlier pair
  try {
    StateReader reader(pair.bytes);
    reader(entry.separating_axis, record);
    check_axis(reader, entry.separating_axis);
    renumber(record, numbers.of(a).mesh, numbers.of(b).mesh);
    check_pair(reader, a, b, record);
    const std::size_t count = table.pairs_.size() + 1;
    make_room(table.pairs_, count), make_room(table.candidates_, count), make_room(table.entries_, count);
  } catch (...) {
    record.touching = false;
    record.patches.reset();
    table.retire(record);
    throw;
  }
  entry.in_contact = in_contact(record);
  table.pairs_.push_back({*slot_a, *slot_b});
  table.candidates_.push_back({a.id, b.id, record.hulls_overlap});
  table.entries_.push_back(entry);
  return true;
}

void StateFields::write_self_of(BodyId body, Step& step, StateWriter& writer) {
  const SelfRecord* const record = step.forgotten_ ? nullptr : step.stages_->selves.find(body);
  writer(record != nullptr);
  if (record != nullptr) write_self(*record, writer);
}

void StateFields::read_self_of(StateReader& reader, BodyId body, const Bodies& bodies, Step& step) {
  if (!reader.read<bool>() || step.forgotten_) return;
  auto record = std::make_unique<SelfRecord>();
  record->body = body;
  read_self(reader, bodies.in_slot(body.index), *record);
  auto& records = step.stages_->selves.records_;
  if (records.size() <= body.index) records.resize(std::size_t{body.index} + 1);
  records[body.index] = std::move(record);
}

// The pairs in the order of the keys again, and the report that of these pairs, as after restore().
void StateFields::settle(Bodies& bodies, Step& step) {
  if (step.forgotten_) return;
  bodies.update_order();
  PairTable& table = step.stages_->table;
  std::vector<std::array<std::uint64_t, 3>> order(table.pairs_.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = {bodies.key(table.candidates_[i].a), bodies.key(table.candidates_[i].b), i};
  if (!std::ranges::is_sorted(order)) {
    std::ranges::sort(order);
    const auto permute = [&](auto& list) {
      std::remove_reference_t<decltype(list)> sorted;
      sorted.reserve(list.size());
      for (const auto& one : order) sorted.push_back(list[one[2]]);
      list = std::move(sorted);
    };
    permute(table.pairs_), permute(table.candidates_), permute(table.entries_);
  }
  table.was_restored_ = true;
  step.stages_->selves.list_contacts(bodies);
  step.writer_.forget();
  step.writer_.restore(table, step.stages_->selves, bodies);
  step.stages_->knows_boxes = false;
  step.altered_ = true;
}

void StateFields::write_contact(const Contact& contact, StateWriter& writer) {
  writer(contact.key_a_, contact.key_b_, contact.touching_, contact);
  writer(std::vector<FacetPair>(contact.facet_pairs_.begin(), contact.facet_pairs_.end()),
         std::vector<ContactPoint>(contact.points_.begin(), contact.points_.end()),
         std::vector<ReachPair>(contact.within_reach_.begin(), contact.within_reach_.end()));
  PatchSet set;
  for (const Patch& patch : contact.patches_) {
    set.patches.push_back(patch);
    set.facet_pairs.insert(set.facet_pairs.end(), patch.facet_pairs.begin(), patch.facet_pairs.end());
    set.points.insert(set.points.end(), patch.points.begin(), patch.points.end());
  }
  CurveSet curves;
  for (const IntersectionCurve& curve : contact.curves_) {
    curves.curves.push_back(curve);
    curves.points.insert(curves.points.end(), curve.points.begin(), curve.points.end());
  }
  writer(set, curves);
}

void StateFields::read_contact(StateReader& reader, FarContact& far) {
  Contact& contact = far.contact;
  reader(contact.key_a_, contact.key_b_, contact.touching_, contact);
  reader(far.facet_pairs, far.points, far.within_reach, far.patches, far.curves);
  contact.facet_pairs_ = far.facet_pairs;
  contact.points_ = far.points;
  contact.within_reach_ = far.within_reach;
  contact.patches_ = far.patches.patches;
  contact.curves_ = far.curves.curves;
}

void WorldParts::set_choice(const PairChoice* choice) { bodies_.set_choice(choice); }
void WorldParts::set_commit(std::function<void(const Report&)> commit) { step_.set_commit(std::move(commit)); }
bool WorldParts::moved(BodyId body) const { return bodies_.moved(bodies_.at(body).id.index); }
bool WorldParts::any_moved() const { return !bodies_.changed().empty(); }
bool WorldParts::on_its_way(BodyId body) const { return bodies_.on_its_way(body.index); }
base::Box WorldParts::box(BodyId body) const { return bodies_.boxes()[body.index]; }
base::Box WorldParts::way_box(BodyId body) const {
  const base::FloatingPointMode mode;
  return on_its_way(body) ? merged(box(body), bodies_.begin_box(body.index)) : box(body);
}
broadphase::Filter WorldParts::filter(BodyId body) const { return bodies_.filter(body); }
std::optional<double> WorldParts::rest_offset(BodyId body) const { return bodies_.given_rest_offset(body.index); }

std::vector<double> WorldParts::positions(BodyId body) const {
  const narrowphase::ClusteredMesh& mesh = bodies_.at(body).mesh;
  return source_positions(mesh, mesh.points());
}

PoseUpdate WorldParts::pose(BodyId body) const {
  const narrowphase::Pose pose = StateFields::mesh_state(bodies_, body.index).pose;
  PoseUpdate update{.body = body};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) update.rotation(i, k) = pose.rows[i][k];
    update.translation[i] = pose.translation[i];
  }
  return update;
}

StateBytes WorldParts::shape(BodyId body) const {
  const MeshState mesh = StateFields::mesh_state(bodies_, bodies_.at(body).id.index);
  StateWriter writer;
  writer(mesh.facets, mesh.order);
  return std::move(writer.bytes());
}

StateBytes WorldParts::rest(BodyId body) const {
  MeshState mesh = StateFields::mesh_state(bodies_, bodies_.at(body).id.index);
  mesh.facets.clear(), mesh.order.clear();
  StateWriter writer;
  StateFields::write_body(bodies_, body.index, mesh, writer);
  return std::move(writer.bytes());
}

void WorldParts::forget_ways() {
  if (motion_ != nullptr) motion_->forget_ways();
}

BodyId WorldParts::put(std::span<const std::byte> shape, std::span<const std::byte> rest, bool is_copy) {
  const base::FloatingPointMode mode;
  forget_ways();
  StateWriter writer;
  StateFields::join(shape, rest, writer);
  StateReader joined(writer.bytes());
  return StateFields::put_body(joined, bodies_, is_copy);
}

void WorldParts::take(std::span<const BodyId> bodies) {
  forget_ways();
  StateFields::take_bodies(bodies, bodies_, step_);
}
void WorldParts::remove_copy(BodyId body) {
  forget_ways();
  StateFields::remove_copy(body, bodies_);
}
void WorldParts::check(const BodyDefinition& definition) const {
  const base::FloatingPointMode mode;
  with_memory("adding a body ran out of memory", [&] { bodies_.check(definition); });
}
void WorldParts::check(const PlaneDefinition& definition) const {
  const base::FloatingPointMode mode;
  with_memory("adding a plane ran out of memory", [&] { bodies_.check(definition); });
}
void WorldParts::set_birth(BodyId body, std::uint64_t birth) { StateFields::set_birth(body, birth, bodies_); }
std::uint64_t WorldParts::birth(BodyId body) const { return bodies_.in_slot(body.index).birth; }
void WorldParts::mark_moved(BodyId body, bool is_on_its_way) {
  forget_ways();
  StateFields::mark_moved(body, is_on_its_way, bodies_);
}
void WorldParts::exclude(BodyId a, BodyId b, bool excluded) { StateFields::exclude(a, b, excluded, bodies_); }
void WorldParts::exclude(const LabelPair& labels, bool excluded) { StateFields::exclude(labels, excluded, bodies_); }

std::vector<SavedPair> WorldParts::pairs_of(std::span<const BodyId> bodies) const {
  bodies_.update_order();  // by which keys of removed bodies are found
  return StateFields::pairs_of(bodies, bodies_, step_);
}
std::vector<SavedPair> WorldParts::all_pairs() const {
  bodies_.update_order();
  return StateFields::all_pairs(bodies_, step_);
}
bool WorldParts::put(const SavedPair& pair, VertexNumbers& numbers) {
  return StateFields::put_pair(pair, bodies_, step_, numbers);
}

StateBytes WorldParts::self_of(BodyId body) const {
  StateWriter writer;
  StateFields::write_self_of(body, step_, writer);
  return std::move(writer.bytes());
}
void WorldParts::put_self(BodyId body, std::span<const std::byte> bytes) {
  StateReader reader(bytes);
  StateFields::read_self_of(reader, body, bodies_, step_);
}

void WorldParts::settle() { StateFields::settle(bodies_, step_); }

void WorldParts::forget_step() {
  forget_ways();
  step_.forget();
  bodies_.mark_all_changed();
}

StateBytes WorldParts::steps() const {
  StateWriter writer;
  StateFields::write_steps(bodies_, step_, writer);
  return std::move(writer.bytes());
}
void WorldParts::set_steps(std::span<const std::byte> bytes) {
  StateReader reader(bytes);
  StateFields::read_steps(reader, bodies_, step_);
}

StateBytes WorldParts::settings_bytes(const Settings& settings) {
  StateWriter writer;
  writer(settings);
  return std::move(writer.bytes());
}

Settings WorldParts::settings_of(std::span<const std::byte> bytes, const Settings& kept) {
  Settings settings = kept;
  StateReader reader(bytes);
  reader(settings);
  return settings;
}

std::uint64_t WorldParts::checksum(std::span<const std::byte> bytes) { return checksum_of(bytes); }

StateBytes WorldParts::contact_bytes(const Contact& contact) {
  StateWriter writer;
  StateFields::write_contact(contact, writer);
  return std::move(writer.bytes());
}

FarContact WorldParts::contact_of(std::span<const std::byte> bytes) {
  FarContact contact;
  StateReader reader(bytes);
  StateFields::read_contact(reader, contact);
  return contact;
}

std::array<std::uint64_t, 2> WorldParts::keys_of(const Contact& contact) { return StateFields::keys_of(contact); }

std::vector<broadphase::IndexPair> WorldParts::overlapping(std::span<const base::Box> boxes,
                                                           std::span<const broadphase::Filter> filters, int threads) {
  const base::FloatingPointMode mode;
  std::vector<std::uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0u);
  broadphase::SweepAndPrune sweep;
  const auto pairs = sweep.update(boxes, filters, all, threads);
  return {pairs.begin(), pairs.end()};
}

}  // namespace tact
