// A world over many ranks and one world that holds all its bodies, which are to find the same.
#pragma once

#include <mpi.h>
#include <tact/mpi/world.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/failed_step.h"
#include "tests/mpi/sums.h"

namespace tact::tests {

// False: the ranks alone, whose digest is compared with that of a run beside one world.
inline bool has_one_world = true;

inline mpi::Settings all_outputs(mpi::Partitioner partitioner = mpi::Partitioner::rcb) {
  return {.world = {.threads = 1, .outputs = {.zones = true, .patches = true, .points = true}},
          .partitioner = partitioner};
}

inline std::string caught(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return std::string(error_code_name(error.code())) + ": " + error.what();
  }
  return "nothing";
}

inline void expect_on_all(const std::string& found, const std::string& expected) {
  expect(found == expected, "threw '" + found + "', not '" + expected + "'");
}

// One world on rank 0 beside the world of all ranks. All ranks make the same calls of it.
class Both {
 public:
  explicit Both(std::string name, const mpi::Settings& settings)
      : name_(std::move(name)), many(MPI_COMM_WORLD, settings) {
    if (rank_of_all() == 0 && has_one_world) one_ = std::make_unique<World>(settings.world);
  }

  void add(BodyDefinition definition, int owner, bool shared = false) {
    const Key key = *definition.key;
    if (shared) {
      many.add_body(definition, mpi::Holders::every_rank);
    } else if (owner == rank_of_all()) {
      many.add_body(definition);
    }
    if (one_ == nullptr) return;
    ids_[key] = one_->add_body(definition);
    keys_[ids_[key]] = key;
  }
  void remove(Key key) {
    if (many.owns(key)) many.remove_body(key);
    if (one_ == nullptr) return;
    one_->remove_body(ids_.at(key));
    ids_.erase(key);
  }
  // set(world, name of the body in it)
  template <class Set>
  void on_owner(Key key, const Set& set) {
    if (many.owns(key)) set(many, key);
    if (one_ != nullptr) set(*one_, ids_.at(key));
  }
  void exclude(Key key, Key other, bool excluded) {
    if (many.owns(key)) many.set_excluded(key, other, excluded);
    if (one_ != nullptr) one_->set_excluded(ids_.at(key), ids_.at(other), excluded);
  }
  // Whoever owns the first body says so, or, if `by_second`, the other's owner.
  void exclude(const mpi::LabelPair& labels, bool excluded, bool by_second) {
    if (many.owns(by_second ? labels.key_b : labels.key_a)) many.set_excluded_labels(labels, excluded);
    if (one_ == nullptr) return;
    one_->set_excluded_labels(
        {ids_.at(labels.key_a), labels.label_a, ids_.at(labels.key_b), labels.label_b, labels.kind}, excluded);
  }

  void detect() {
    const mpi::Report& report = many.detect();
    const std::string where = name_ + ", step " + std::to_string(step_++);
    const Sums found = over_all_ranks(sums_of(report, true, false));
    const Report* alone = one_ != nullptr ? &one_->detect() : nullptr;
    wait_for_all();
    const Sums expected = alone != nullptr ? sums_of(*alone, keys_) : found;
    add_to_digest(found);
    expect_same(found, expected, where);
    int differ = found.of[Sums::contacts] != expected.of[Sums::contacts] ? 1 : 0;
    MPI_Bcast(&differ, 1, MPI_INT, 0, MPI_COMM_WORLD);
    if (differ != 0) name_another_contact(report, alone, where);
    const Sums counted = over_all_ranks(sums_of(report, true, true));
    expect_same(over_all_ranks(sums_of(report, false, true)), counted, where + ", the other owners");
    contacts_ += found.of[Sums::contact_count];
    const auto is_before = [](const mpi::Contact& x, const mpi::Contact& y) {
      return std::pair(x.bodies.key_a, x.bodies.key_b) < std::pair(y.bodies.key_a, y.bodies.key_b);
    };
    expect(std::ranges::is_sorted(report.contacts(), is_before), where + ": contacts are not sorted");
    for (const mpi::Contact& contact : report.contacts())
      expect(many.owns(contact.bodies.key_a) || many.owns(contact.bodies.key_b), where + ": a contact of others");
  }

  void detect_motion(Impacts wanted) {
    const mpi::MotionReport& report = many.detect_motion(wanted);
    Sums found, expected, others, far;
    for (const mpi::Impact& impact : report.impacts()) {
      const mpi::BodyPair& bodies = impact.bodies;
      const std::uint64_t word = word_of(bodies.key_a, bodies.key_b, impact.impact);
      found.of[Sums::impacts] += bodies.counted ? word : 0;
      if (bodies.rank_a != bodies.rank_b) (bodies.counted ? far : others).of[Sums::impacts] += word;
    }
    const std::string where = name_ + ", motion in step " + std::to_string(step_);
    found = over_all_ranks(found);
    add_to_digest(found);
    digest.add(report.first_time());
    expect_same(over_all_ranks(others), over_all_ranks(far), where + ", the other owners");
    const MotionReport* one = one_ != nullptr ? &one_->detect_motion(wanted) : nullptr;
    wait_for_all();
    if (one == nullptr) return;
    const MotionReport& alone = *one;
    for (const Impact& impact : alone.impacts()) {
      expected.of[Sums::impacts] += word_of(keys_.at(impact.a), keys_.at(impact.b), impact);
      ++impacts_;
    }
    expect_same(found, expected, where);
    expect(report.first_time() == alone.first_time(), where + ": the first time differs");
  }

  void detect_of_one() {
    if (one_ != nullptr) one_->detect();
    ++step_;
  }
  // Who gets which rank's share: the ranks in turn, from `first` on, or the last one all of them.
  enum class Shares { in_turn, one_rank };
  void save() {
    share_ = many.save();
    if (one_ == nullptr) return;
    saved_ = one_->save();
    saved_ids_ = ids_, saved_keys_ = keys_;
  }
  void restore(Shares who, int first) {
    const std::vector<std::vector<std::byte>> all = of_each_rank(share_);
    std::vector<std::span<const std::byte>> given;
    for (int i = 0; i < count_of_ranks(); ++i) {
      const int to = who == Shares::one_rank ? count_of_ranks() - 1 : (i + first) % count_of_ranks();
      if (to == rank_of_all()) given.push_back(all[i]);
    }
    many.restore(given);
    if (one_ == nullptr) return;
    one_->restore(saved_);
    ids_ = saved_ids_, keys_ = saved_keys_;
  }
  void add_plane(const PlaneDefinition& plane) {
    many.add_plane(plane);
    if (one_ == nullptr) return;
    ids_[*plane.key] = one_->add_plane(plane);
    keys_[ids_[*plane.key]] = *plane.key;
  }
  // The one world fails as that of all ranks did.
  void fail() {
    if (one_ != nullptr) FailedStep::play(*one_);
  }
  ~Both() {
    if (one_ != nullptr) expect(contacts_ > 0 && impacts_ > 0, name_ + ": nothing touched or met");
  }

 private:
  // The first contact of one world that the ranks do not count alike.
  void name_another_contact(const mpi::Report& report, const Report* alone, const std::string& where) {
    std::vector<std::uint64_t> own;
    for (const mpi::Contact& contact : report.contacts()) {
      const mpi::BodyPair& bodies = contact.bodies;
      if (bodies.counted) own.insert(own.end(), {bodies.key_a, bodies.key_b, contact.contact.hash()});
    }
    std::map<std::pair<Key, Key>, std::uint64_t> counted;
    for (const std::vector<std::uint64_t>& words : of_each_rank(own)) {
      for (std::size_t i = 0; i < words.size(); i += 3) counted[{words[i], words[i + 1]}] = words[i + 2];
    }
    if (alone == nullptr) return;
    for (const Contact& contact : alone->contacts()) {
      const auto pair = counted.find({keys_.at(contact.a), keys_.at(contact.b)});
      if (pair != counted.end() && pair->second == contact.hash()) continue;
      expect(false, where + ": the contact of " + std::to_string(keys_.at(contact.a)) + " and " +
                        std::to_string(keys_.at(contact.b)) + (pair == counted.end() ? " is missing" : " is another"));
      return;
    }
  }

  std::string name_;
  std::unique_ptr<World> one_;
  std::map<Key, BodyId> ids_;
  std::map<BodyId, Key> keys_;
  std::vector<std::byte> share_, saved_;
  std::map<Key, BodyId> saved_ids_;
  std::map<BodyId, Key> saved_keys_;
  std::uint64_t contacts_ = 0, impacts_ = 0;
  int step_ = 0;

 public:
  mpi::World many;
};

}  // namespace tact::tests
