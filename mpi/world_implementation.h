// What a rank keeps of a world over many ranks, and the stages of its step, a file each.
#pragma once

#include <tact/mpi/world.h>

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "engine/state/world_parts.h"
#include "mpi/channel.h"
#include "mpi/held_bodies.h"
#include "mpi/partition.h"

namespace tact::mpi {

/// What is kept of a pair whose host is here, until the guest is, too.
struct WaitingPair {
  std::uint64_t host = 0;
  SavedPair pair;
  std::uint64_t guest() const { return pair.key_a == host ? pair.key_b : pair.key_a; }
  KeyPair keys() const { return {pair.key_a, pair.key_b}; }
};

void put(const SavedPair& pair, ByteWriter& to);
SavedPair get_pair(ByteReader& reader);

/// What ended with a pair that is no candidate any more.
struct EndedPair {
  KeyPair keys;
  bool touched = false;
  std::vector<std::uint64_t> patches;
  bool is_removed_a = false, is_removed_b = false;  // another body may have the key
};

/// A contact that another rank found.
struct Far {
  BodyPair bodies;
  FarContact found;
};

/// Who has what was found of a contact, and from whom.
struct Sent {
  int to = 0;
  bool by_this_rank = true;
};

/// Writes the reports of a rank.
class ReportBuilder {
 public:
  static void clear(Report& report);
  static void clear(MotionReport& report);
  static std::vector<Contact>& contacts(Report& report) { return report.contacts_; }
  static std::vector<ContactEvent>& began(Report& report) { return report.began_; }
  static std::vector<ContactEvent>& ended(Report& report) { return report.ended_; }
  static std::vector<PatchEvent>& patch_events(Report& report) { return report.patch_events_; }
  static Statistics& stats(Report& report) { return report.stats_; }
  static std::vector<Impact>& impacts(MotionReport& report) { return report.impacts_; }
  static double& first_time(MotionReport& report) { return report.first_time_; }
  static Statistics& stats(MotionReport& report) { return report.stats_; }
  static void sort(Report& report);
  static void swap(Report& report, Report& other) {
    Report last = std::move(report);
    report = std::move(other);
    other = std::move(last);
  }
};

struct World::Implementation {
  Implementation(MPI_Comm communicator, const Settings& given);

  Channel channel;
  Settings settings;
  tact::World local;
  WorldParts parts{local};
  HeldBodies held;
  Directory directory;
  std::unique_ptr<Partition> partition;
  BodyState body_state;

  // What the next call together has to tell.
  struct Exclusion {
    ExcludedPair pair;
    bool wanted = false;
    bool marks = true;  // whether both bodies count as moved: not if one is removed
    void put(ByteWriter& to) const { pair.put(to), to.put(wanted, marks); }
    static Exclusion get(ByteReader& from) {
      Exclusion one{.pair = ExcludedPair::get(from)};
      one.wanted = from.get<bool>(), one.marks = from.get<bool>();
      return one;
    }
  };
  std::vector<std::uint64_t> new_keys, gone_keys;
  std::vector<Exclusion> exclusions;
  std::map<std::uint64_t, std::vector<Subscriber>> removed;  // bodies of this rank, and who has copies
  std::set<std::uint64_t> new_shared;                        // that every rank holds, since all agreed on them
  std::uint64_t removed_shared = 0;                          // a hash of those that went since
  std::map<std::uint64_t, int> new_owners;                   // that set_owner() asked for
  std::vector<WaitingPair> waiting;
  std::vector<WaitingPair> waiting_of_ghosts;  // that became own bodies, until all have arrived
  bool needs_near = false;                     // bodies have other owners, or space is cut anew, on any rank
  bool owners_changed = false;
  bool lost_ghost = false;                         // of this rank: one that its owner counts on is gone
  std::int64_t moved_bodies = 0, moved_bytes = 0;  // since the last step
  bool sends_all = false;                          // the next step looks at every pair
  std::uint64_t step = 0;                          // how often copies were put to sleep or not

  // Of the last step.
  std::map<KeyPair, Sent> sent;  // contacts with ghosts, and the owners that have them
  std::map<KeyPair, Far> far;    // contacts that other ranks found of bodies of this one
  // Of this step: waiting pairs that are no candidates, and the owners of their bodies, or -1.
  std::vector<EndedPair> ended_waiting;
  std::map<std::uint64_t, int> owners_of_ended;
  double imbalance = 1.0;
  Report report;
  Report next_report;
  MotionReport motion_report;
  Statistics stats;

  // world.cpp
  OwnBody& at(std::uint64_t key);
  HostOrder order_of_new(BodyId id, std::uint64_t key) const;
  void hold_shared(BodyId id, std::uint64_t key, std::uint64_t hash);
  std::uint64_t hash_of_shared() const;
  void note_change(OwnBody& body, bool has_moved);
  bool forget_ghost(std::uint64_t key);  // whether there was one
  template <class Definition, class Add>
  BodyId add_in_place_of_ghost(const Definition& definition, const Add& add);
  void set_excluded(const ExcludedPair& pair, bool wanted);
  void exclude(const ExcludedPair& pair, bool wanted, bool marks);
  void exclude_here(const ExcludedPair& pair, bool wanted);
  template <class Set>
  void set(std::uint64_t key, const Set& set) {
    OwnBody& body = at(key);
    set(body.id);
    note_change(body, false);
  }

  // agreement.cpp: what comes before each call together. Returns whether anything moved or came anywhere.
  bool begin(bool for_step);
  void update_directory();
  void send_exclusions();
  void check_exclusions(std::span<const int> owners);
  void settle_names();  // before bodies move: whose keys are whose, what is excluded

  // near.cpp: which ranks have a host near each own body, by boxes or by those of ways.
  void find_near(bool by_ways);
  void cut_if_new();
  std::vector<Site> sites() const;

  // ghosts.cpp: copies of own bodies go to these ranks; may_sleep: those that are not near any more are put to sleep.
  void send_ghosts(bool may_sleep);
  void plan(std::uint64_t key, OwnBody& body, bool may_sleep, Outbox& outbox);
  void write_whole(std::uint64_t key, const OwnBody& body, bool with_shape, ByteWriter& to);
  void write_update(std::uint64_t key, const OwnBody& body, const Subscriber& knows, ByteWriter& to);
  bool take_leaving(std::span<const Message> messages);
  bool take_coming(std::span<const Message> messages);
  void take_updates(std::span<const Message> messages);
  void put_ghost(std::uint64_t key, int owner, std::span<const std::byte> shape, std::span<const std::byte> rest);
  void send_meshes();
  void place_waiting();
  void find_owners_of_ended();
  void end_step();
  void drop_ghosts(bool keep_pairs);
  void start_from_scratch();

  // results.cpp: what was found of ghosts goes to their owners, and what others found comes.
  BodyPair named(BodyId a, BodyId b) const;
  BodyPair named(const EndedPair& pair) const;
  int guest_owner(BodyId a, BodyId b) const;
  void commit(const tact::Report& found);
  void send_results(const tact::Report& found, Outbox& outbox, std::map<KeyPair, Sent>& next_sent);
  void take_results(std::span<const Message> messages);
  void build_report(const tact::Report& found);
  void count_work(const tact::Report& found);
  void finish_motion(const tact::MotionReport& found, Impacts wanted);

  // moves.cpp
  using Goals = std::map<std::uint64_t, int>;  // the new owners of own bodies
  struct Leaving;
  /// A body that came, and is of this rank once all have come.
  struct Arrival {
    std::uint64_t key = 0;
    OwnBody body;
    std::vector<ExcludedPair> excluded;
    std::vector<SavedPair> pairs;
    std::vector<std::pair<KeyPair, int>> sent;
  };
  void rebalance();
  void move(Goals goals);
  Leaving pack(const Goals& goals);
  Bytes pack(std::uint64_t key, int to, std::span<const SavedPair> pairs, std::span<const std::byte> sent_pairs);
  void pack_body(std::uint64_t key, std::span<const SavedPair> pairs, ByteWriter& to);
  void pack_state(std::uint64_t key, ByteWriter& to);
  void unpack(const Parcel& parcel, std::vector<Arrival>& arrivals);
  Arrival& unpack_body(std::uint64_t key, ByteReader& reader, std::vector<Arrival>& arrivals);
  void ghosts_become_own(std::span<const Parcel> arriving);
  void undo(std::span<const Arrival> arrivals);
  void let_go(const Goals& goals, Leaving&& leaving);
  void take_in(std::vector<Arrival>&& arrivals);

  // saved.cpp
  struct Share;
  Bytes content_of_share();
  Bytes common_bytes();
  void take_common(std::span<const std::byte> bytes);
  using States = std::vector<std::pair<std::uint64_t, std::span<const std::byte>>>;  // by key
  void take_shares(std::span<const Share> shares, States& states);
  void exchange_states(const Implementation& last, const States& states);

  Statistics finished_stats();
  std::uint64_t own_work() const;
};

}  // namespace tact::mpi
