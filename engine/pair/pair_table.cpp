#include "engine/pair/pair_table.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

namespace tact {

using broadphase::IndexPair;

namespace {

// What a pair leaves to the next that has its record, so that steps in which small pairs come and go allocate nothing.
constexpr std::size_t kLargestRoom = 512;                      // facet pairs, 4 kB
constexpr std::size_t kFewestRecords = 4, kMostRecords = 256;  // taken at once

// Of one body, if it has other numbers now. What a record keeps of earlier pairs is left alone. A start of a search
// that has lost a vertex is forgotten.
template <class InSimplex, class InSurface>
void renumber_vertices(PairRecord& record, std::span<const int> numbers, InSimplex in_simplex, InSurface in_surface) {
  if (numbers.empty()) return;
  const auto renumber = [&](auto& vertices, int count) {
    bool are_there = true;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      vertices[k] = numbers[vertices[k]];
      are_there = are_there && vertices[k] >= 0;
    }
    return are_there;
  };
  PairHistory& history = record.history;
  if (!renumber(history.hulls.*in_simplex, history.hulls.count)) history.hulls = {};
  if (record.hulls_overlap && !renumber(record.face.*in_simplex, record.face.count)) record.face = {};
  if (history.has_surface) history.has_surface = renumber(*record.surface.*in_surface, record.surface->vertex_count);
}

}  // namespace

void renumber(PairRecord& record, std::span<const int> numbers_a, std::span<const int> numbers_b) {
  renumber_vertices(record, numbers_a, &narrowphase::GjkSimplex::a, &narrowphase::SurfaceShape::a);
  renumber_vertices(record, numbers_b, &narrowphase::GjkSimplex::b, &narrowphase::SurfaceShape::b);
}

void PairTable::update(const PlanePairs& found, const Bodies& bodies, bool all) {
  gone_.clear();
  gone_patches_.clear();
  moved_.clear();
  separated_ = 0;
  same_pairs_ = !std::exchange(was_restored_, false) && !all && !bodies.removed_any() &&
                !bodies.excluded_pairs().changed() && !found.pairs_changed();
  // The sweep sees boxes of rigid bodies that may be too large: what it says of them has to be looked at in each step.
  const bool rough = bodies.any_rigid() || had_rigid_;
  had_rigid_ = bodies.any_rigid();
  if (same_pairs_ && !rough) return select_moved(bodies);
  const std::span<const IndexPair> pairs = tested_pairs(found.pairs(), bodies);
  same_pairs_ = rough && !all && !bodies.removed_any() && std::ranges::equal(pairs, pairs_);
  if (same_pairs_) {
    select_moved(bodies);
  } else {
    match(pairs, bodies, all);
  }
}

std::span<const IndexPair> PairTable::tested_pairs(std::span<const IndexPair> pairs, const Bodies& bodies) {
  excluded_ = 0;
  if (bodies.excluded_pairs().empty() && !bodies.any_rigid() && !bodies.has_choice()) return by_key(pairs, bodies);
  tested_.clear();
  for (const IndexPair& pair : pairs) {
    if (!bodies.is_chosen(pair)) continue;
    if (bodies.excluded_pairs().contains(pair)) {
      ++excluded_;
      continue;
    }
    const bool is_exact = !bodies.is_rigid(pair.a) && !bodies.is_rigid(pair.b);
    if (is_exact || bodies.boxes_meet(pair)) tested_.push_back(pair);
  }
  return by_key(tested_, bodies);
}

// Sorted by ranks, and named by slots again.
std::span<const IndexPair> PairTable::by_key(std::span<const IndexPair> pairs, const Bodies& bodies) {
  const BodyKeys& keys = bodies.keys();
  if (keys.are_slots()) return pairs;
  const int rank_bits = std::max(1, static_cast<int>(std::bit_width(bodies.boxes().size())));
  const std::span<std::uint64_t> unsorted = sorter_.keys(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const IndexPair ranks = keys.ranks(keys.ordered(pairs[i]));
    unsorted[i] = std::uint64_t{ranks.a} << rank_bits | ranks.b;
  }
  tested_.clear();
  for (const std::uint64_t ranks : sorter_.sort(2 * rank_bits, 1)) {
    tested_.push_back({keys.slot_at(static_cast<std::uint32_t>(ranks >> rank_bits)),
                       keys.slot_at(static_cast<std::uint32_t>(ranks & ((std::uint64_t{1} << rank_bits) - 1)))});
  }
  return tested_;
}

void PairTable::select_moved(const Bodies& bodies) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (bodies.moved(pairs_[i].a) || bodies.moved(pairs_[i].b))
      moved_.push_back({entries_[i].record, static_cast<std::uint32_t>(i)});
  }
}

// Pairs with a body that is gone. The others are in the order of the keys that there are.
void PairTable::retire_removed(const Bodies& bodies) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const CandidatePair candidate = candidates_[i];
    if (!bodies.contains(candidate.a) || !bodies.contains(candidate.b)) {
      retire(*entries_[i].record);
      continue;
    }
    pairs_[kept] = pairs_[i];
    candidates_[kept] = candidate;
    entries_[kept++] = entries_[i];
  }
  pairs_.resize(kept), candidates_.resize(kept), entries_.resize(kept);
}

void PairTable::match(std::span<const IndexPair> pairs, const Bodies& bodies, bool all) {
  if (bodies.removed_any()) retire_removed(bodies);
  const BodyKeys& keys = bodies.keys();
  std::swap(last_entries_, entries_);
  std::swap(last_candidates_, candidates_);
  entries_.clear();
  candidates_.clear();
  std::size_t last = 0;
  for (const IndexPair& pair : pairs) {
    while (last < pairs_.size() && keys.ranks(pairs_[last]) < keys.ranks(pair)) retire(*last_entries_[last++].record);
    Entry entry;
    CandidatePair candidate;
    if (last < pairs_.size() && pairs_[last] == pair) {
      candidate = last_candidates_[last];
      entry = last_entries_[last++];
    } else {
      candidate = {bodies.in_slot(pair.a).id, bodies.in_slot(pair.b).id, false};
      entry.record = &new_record(candidate.a, candidate.b);
    }
    if (all || bodies.moved(pair.a) || bodies.moved(pair.b))
      moved_.push_back({entry.record, static_cast<std::uint32_t>(entries_.size())});
    entries_.push_back(entry);
    candidates_.push_back(candidate);
  }
  while (last < pairs_.size()) retire(*last_entries_[last++].record);
  pairs_.assign(pairs.begin(), pairs.end());
}

// Many at once, so that pairs that follow each other lie together.
void PairTable::add_records() {
  const std::size_t count = std::clamp(record_count_, kFewestRecords, kMostRecords);
  free_.reserve(record_count_ + count);  // so that retire() cannot fail
  pool_.push_back(std::make_unique<PairRecord[]>(count));
  record_count_ += count;
  for (std::size_t i = count; i-- > 0;) free_.push_back(&pool_.back()[i]);
}

PairRecord& PairTable::new_record(BodyId a, BodyId b) {
  if (free_.empty()) add_records();
  PairRecord& record = *free_.back();
  free_.pop_back();
  record.a = a;
  record.b = b;
  record.history = {};
  record.slab_lower = record.slab_upper = 0.0;  // pairs with planes write none
  record.hulls_overlap = record.near = record.touching = record.is_renumbered = false;
  record.facet_pairs.clear();
  record.bare_pairs.clear();
  record.points.clear();
  record.within_reach.clear();
  record.surfaces.reset();
  record.curves.reset();
  return record;
}

void PairTable::retire(PairRecord& record) {
  if (record.touching) gone_.push_back({record.a, record.b});
  if (record.patches != nullptr) record.patches->end_all(record.a, record.b, gone_patches_);
  const std::size_t room = record.facet_pairs.capacity();
  room_ = std::min(std::max(room_, room), kLargestRoom);
  if (room > kLargestRoom) record.facet_pairs = std::vector<FacetPair>();
  free_.push_back(&record);
}

void PairTable::renumber(std::span<const Bodies::Regrouped> bodies) noexcept {
  if (bodies.empty()) return;
  // A body that was removed may stand in the records still: another has its slot.
  const auto numbers_of = [&](BodyId id) -> std::span<const int> {
    const auto slot_of = [](const Bodies::Regrouped& body) { return body.id.index; };
    const auto found = std::ranges::lower_bound(bodies, id.index, {}, slot_of);
    return found != bodies.end() && found->id == id ? std::span(found->numbers) : std::span<const int>();
  };
  for (const Entry& entry : entries_) {
    tact::renumber(*entry.record, numbers_of(entry.record->a), numbers_of(entry.record->b));
  }
}

void PairTable::renumber(const Bodies::Regrouped& body) noexcept {
  const auto numbers_of = [&](BodyId id) { return id == body.id ? std::span(body.numbers) : std::span<const int>(); };
  for_each_of(body.id, [&](PairRecord& record) { tact::renumber(record, numbers_of(record.a), numbers_of(record.b)); });
}

void PairTable::keep() {
  moved_.clear();
  gone_.clear();
  separated_ = 0;
  same_pairs_ = true;
}

void PairTable::drop_separated() {
  separated_ = std::erase_if(moved_, [](const MovedPair& pair) { return pair.separated; });
}

void PairTable::note_result(MovedPair& pair) {
  const bool in_contact = tact::in_contact(*pair.record);
  pair.changed = std::exchange(entries_[pair.place].in_contact, in_contact) != in_contact;
  candidates_[pair.place].hulls_overlap = pair.record->hulls_overlap;
}

bool PairTable::same_contacts() const {
  return same_pairs_ && std::ranges::none_of(moved_, [](const MovedPair& pair) { return pair.changed; });
}

}  // namespace tact
