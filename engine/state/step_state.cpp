// What was found of the last step as bytes: the pairs and what each keeps, and bodies held against themselves.
#include <algorithm>
#include <array>
#include <utility>

#include "engine/state/archives.h"
#include "engine/state/pair_state.h"

namespace tact {

namespace {

// A body that a history names: its slot, and whether it is gone since.
struct Named {
  std::uint32_t slot = 0;
  bool is_gone = false;
};

void write_named(BodyId body, const Bodies& bodies, StateWriter& writer) {
  const Named name{body.index, !bodies.contains(body)};
  writer(name.slot, name.is_gone);
}

}  // namespace

// A body that a history names, out of bytes.
BodyId StateFields::read_named(StateReader& reader, const Bodies& bodies) {
  Named name;
  reader(name.slot, name.is_gone);
  if (!name.is_gone) {
    reader.check(name.slot < bodies.slots_.size() && bodies.used(name.slot), "a body is not there");
    return bodies.in_slot(name.slot).id;
  }
  const auto found = std::ranges::find(bodies.removed_, name.slot, [](const auto& one) { return one.id.index; });
  reader.check(found != bodies.removed_.end(), "a removed body was not there");
  return found->id;
}

std::vector<BodyId> StateFields::gone_in(const Step& step, const Bodies& bodies) {
  std::vector<BodyId> gone;
  if (step.forgotten_ || !bodies.removed_any()) return gone;
  const auto add = [&](BodyId body) {
    if (!bodies.contains(body)) gone.push_back(body);
  };
  for (const CandidatePair& pair : step.stages_->table.candidates_) add(pair.a), add(pair.b);
  for (const std::unique_ptr<SelfRecord>& record : step.stages_->selves.records_) {
    if (record != nullptr) add(record->body);
  }
  std::ranges::sort(gone);
  gone.erase(std::unique(gone.begin(), gone.end()), gone.end());
  return gone;
}

// Dropped: sweep and the other stages, which find their answers again; the writer, whose report is that of the table;
// trace, device, what the last regroup() did, and what only worlds over many ranks have.
void StateFields::write(const Step& step, const Bodies& bodies, StateWriter& writer) {
  const auto& [stages, report_writer, trace, device, regrouped, regroup_ms, all, forgotten, discarded, altered,
               commit] = step;
  const Step::Stages nothing;
  const auto& [sweep, planes, table, pairs, containment, points, selves, curves, within_reach, patches, knows_boxes] =
      forgotten ? nothing : *stages;
  writer(all || forgotten);
  write_pairs(table, bodies, writer);
  write_selves(selves, bodies, writer);
}

Step::Restored StateFields::read_step(StateReader& reader, const Bodies& bodies) {
  Step::Restored restored;
  reader(restored.all);
  read_pairs(reader, bodies, restored.stages->table);
  read_selves(reader, bodies, restored.stages->selves);
  restored.stages->knows_boxes = false;
  restored.writer.restore(restored.stages->table, restored.stages->selves, bodies);
  return restored;
}

// In the entries: whether a pair is in contact, which its record tells; its place in the report. Dropped: what was
// found of the last step for the others, and memory.
void StateFields::write_pairs(const PairTable& table, const Bodies& bodies, StateWriter& writer) {
  const auto& [pool, record_count, free, room, pairs, tested, sorter, excluded, candidates, entries, last_candidates,
               last_entries, moved, separated, gone, gone_patches, same_pairs, had_rigid, was_restored] = table;
  writer(std::uint64_t{excluded}, std::uint64_t{pairs.size()});
  for (const PairTable::Entry& entry : entries) {
    const auto& [record, place_in_report, is_in_contact, separating_axis] = entry;
    write_named(record->a, bodies, writer);
    write_named(record->b, bodies, writer);
    if (bodies.contains(record->a) && bodies.contains(record->b)) {
      writer(separating_axis);
      write_pair(*record, writer);
    } else {
      write_gone(record->touching, record->patches == nullptr ? nullptr : &record->patches->now, writer);
    }
  }
}

void StateFields::read_pairs(StateReader& reader, const Bodies& bodies, PairTable& table) {
  table.excluded_ = static_cast<std::size_t>(reader.read<std::uint64_t>());
  table.was_restored_ = true;
  const std::size_t count = reader.read_size(1);
  std::array<std::uint64_t, 2> last_keys{};
  for (std::size_t i = 0; i < count; ++i) {
    const BodyId a = read_named(reader, bodies), b = read_named(reader, bodies);
    const std::array<std::uint64_t, 2> keys{bodies.key(a), bodies.key(b)};
    reader.check(keys[0] < keys[1] && (i == 0 || last_keys < keys), "pairs are not sorted");
    last_keys = keys;
    PairTable::Entry entry{.record = &table.new_record(a, b)};
    PairRecord& record = *entry.record;
    if (bodies.contains(a) && bodies.contains(b)) {
      reader(entry.separating_axis);
      check_axis(reader, entry.separating_axis);
      read_pair(reader, bodies.in_slot(a.index), bodies.in_slot(b.index), record);
    } else {
      record.patches = std::make_unique<PatchMemory>();
      read_gone(reader, record.touching, record.patches->now);
    }
    entry.in_contact = in_contact(record);
    table.pairs_.push_back({a.index, b.index});
    table.candidates_.push_back({a, b, record.hulls_overlap});
    table.entries_.push_back(entry);
  }
}

// In the records: who is in contact or touches. Dropped: the rest.
void StateFields::write_selves(const SelfStage& selves, const Bodies& bodies, StateWriter& writer) {
  const auto& [records, looked_at, slots, contacts, in_contact, last_in_contact, touching, last_touching, began, ended,
               gone_patches, same, work, large] = selves;
  writer(static_cast<std::uint64_t>(
      std::ranges::count_if(records, [](const std::unique_ptr<SelfRecord>& record) { return record != nullptr; })));
  for (const std::unique_ptr<SelfRecord>& record : records) {
    if (record == nullptr) continue;
    write_named(record->body, bodies, writer);
    if (bodies.contains(record->body)) {
      write_self(*record, writer);
    } else {
      write_gone(record->touching, &record->patches.now, writer);
    }
  }
}

void StateFields::read_selves(StateReader& reader, const Bodies& bodies, SelfStage& selves) {
  const std::size_t count = reader.read_size(1);
  for (std::size_t i = 0; i < count; ++i) {
    const BodyId body = read_named(reader, bodies);
    reader.check(selves.records_.size() <= body.index, "bodies with themselves are not sorted");
    selves.records_.resize(std::size_t{body.index} + 1);
    auto record = std::make_unique<SelfRecord>();
    record->body = body;
    if (bodies.contains(body)) {
      read_self(reader, bodies.in_slot(body.index), *record);
    } else {
      read_gone(reader, record->touching, record->patches.now);
    }
    selves.records_[body.index] = std::move(record);
  }
  selves.list_contacts(bodies);
}

}  // namespace tact
