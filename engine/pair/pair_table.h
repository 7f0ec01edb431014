// The candidate pairs and their records, from step to step.
#pragma once

#include <tact/report.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/key_sort.h"
#include "engine/bodies/bodies.h"
#include "engine/bodies/plane_pairs.h"
#include "engine/pair/pair_record.h"
#include "narrowphase/hull/kdop.h"

namespace tact {

/// A pair that the step looks at.
struct MovedPair {
  PairRecord* record = nullptr;
  std::uint32_t place = 0;  ///< among the candidates
  bool touched = false;     ///< in the step before
  bool changed = false;     ///< whether it came into contact in this step, or out of it
  bool separated = false;   ///< by an axis of the k-DOPs
};

/// Gives the vertices that a record names other numbers, each that under its own number. No numbers: they stay.
void renumber(PairRecord& record, std::span<const int> numbers_a, std::span<const int> numbers_b);

/// Matches the pairs of the sweep with those of the last step, and owns their records. Runs no geometry.
class PairTable {
  friend struct StateFields;

 public:
  // Takes the pairs of the sweep and of planes, sorted, and puts them into the order of the keys: a pair that stays
  // keeps its record, unless a body of it was replaced by another. Then moved() are those with a body that moved, or
  // all.
  void update(const PlanePairs& found, const Bodies& bodies, bool all);
  // Nothing moved: the pairs and the contacts are those of the last step.
  void keep();
  // Vertices have other numbers: so have those that the records name. `bodies` are sorted by slot.
  void renumber(std::span<const Bodies::Regrouped> bodies) noexcept;
  void renumber(const Bodies::Regrouped& body) noexcept;
  // Calls visit(record) for each pair of the last step that the body is one of.
  template <class Visit>
  void for_each_of(BodyId body, const Visit& visit) {
    const std::span<const broadphase::IndexPair> pairs = pairs_;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (pairs[i].a != body.index && pairs[i].b != body.index) continue;
      // A body that was removed may stand in the pairs still: another has its slot.
      if (candidates_[i].a == body || candidates_[i].b == body) visit(record(i));
    }
  }
  // Drops from moved() the pairs that are marked as separated.
  void drop_separated();

  // Sorted by the keys of (a, b). Records of pairs that are not looked at are not read either, as memory is what costs
  // where little moves.
  std::span<const CandidatePair> candidates() const { return candidates_; }
  PairRecord& record(std::size_t place) { return *entries_[place].record; }
  // The axis of the k-DOPs that separated the pair in the last step in which a body of it moved; 0 if none did.
  narrowphase::SeparatingDiagonal& separating_axis(std::size_t place) { return entries_[place].separating_axis; }
  // Where the last report has the contact; kNowhere if it has none, or if a new one cannot take it from there, as the
  // step looked at the pair.
  static constexpr std::uint32_t kNowhere = ~std::uint32_t{0};
  std::uint32_t& place_in_report(std::size_t place) { return entries_[place].place_in_report; }

  std::span<MovedPair> moved() { return moved_; }
  std::span<const MovedPair> moved() const { return moved_; }
  // Records are given out again in any order: one whose facets are looked at gets room for what the largest held.
  void make_room(PairRecord& record) const { record.facet_pairs.reserve(room_); }
  // How many were dropped.
  std::size_t separated() const { return separated_; }
  // How many pairs with overlapping boxes are excluded by name.
  std::size_t excluded() const { return excluded_; }
  // Takes over what a step found of a pair. Different pairs may be noted by different threads.
  void note_result(MovedPair& pair);
  // Whether a pair that was looked at touches. The records of pairs that stayed apart are not read.
  bool touches_now(const MovedPair& pair) const { return entries_[pair.place].in_contact && pair.record->touching; }
  // Whether its hulls overlap or are nearer than the margins.
  bool in_contact(std::size_t place) const { return entries_[place].in_contact; }
  // Whether the pairs in contact are those of the last step.
  bool same_contacts() const;

  // Pairs that touched and are no candidates any more.
  std::span<const ContactEvent> gone() const { return gone_; }
  // And what patches they had.
  std::span<const PatchEvent> gone_patches() const { return gone_patches_; }

 private:
  struct Entry {
    PairRecord* record = nullptr;
    std::uint32_t place_in_report = kNowhere;
    bool in_contact = false;
    narrowphase::SeparatingDiagonal separating_axis = 0;
  };
  // Without those that are excluded, or whose boxes do not overlap in truth.
  std::span<const broadphase::IndexPair> tested_pairs(std::span<const broadphase::IndexPair> pairs,
                                                      const Bodies& bodies);
  std::span<const broadphase::IndexPair> by_key(std::span<const broadphase::IndexPair> pairs, const Bodies& bodies);
  void select_moved(const Bodies& bodies);
  void retire_removed(const Bodies& bodies);
  void match(std::span<const broadphase::IndexPair> pairs, const Bodies& bodies, bool all);
  void add_records();
  PairRecord& new_record(BodyId a, BodyId b);
  void retire(PairRecord& record);

  std::vector<std::unique_ptr<PairRecord[]>> pool_;
  std::size_t record_count_ = 0;  // in the pool
  std::vector<PairRecord*> free_;
  std::size_t room_ = 0;                       // facet pairs: the most that a small pair had
  std::vector<broadphase::IndexPair> pairs_;   // slots, in the order of their keys
  std::vector<broadphase::IndexPair> tested_;  // scratch: those of the sweep that are left
  base::KeySorter sorter_;
  std::size_t excluded_ = 0;
  std::vector<CandidatePair> candidates_;  // the same pairs, of bodies
  std::vector<Entry> entries_;             // of these
  std::vector<CandidatePair> last_candidates_;
  std::vector<Entry> last_entries_;
  std::vector<MovedPair> moved_;
  std::size_t separated_ = 0;
  std::vector<ContactEvent> gone_;
  std::vector<PatchEvent> gone_patches_;
  bool same_pairs_ = false;
  bool had_rigid_ = false;     // whether there were rigid bodies in the last step
  bool was_restored_ = false;  // since the last update(): the sweep does not tell whether its pairs are these
};

}  // namespace tact
