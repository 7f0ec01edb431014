// What a step over many ranks found, as one rank has it: everything in which it owns a body. Bodies are named by keys.
#pragma once

#include <tact/motion.h>
#include <tact/mpi/statistics.h>
#include <tact/report.h>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tact::mpi {

/// Two bodies, or one with itself, by their keys, and the ranks that own them. Of the ranks that own one of the two,
/// exactly one counts what they do.
struct BodyPair {
  std::uint64_t key_a = 0;  ///< not above key_b
  std::uint64_t key_b = 0;
  int rank_a = -1;       ///< the owner of a: this rank for a body that every rank holds; -1 if it was removed
  int rank_b = -1;       ///< the owner of b
  bool counted = false;  ///< whether this rank counts them, in sums over all ranks
  friend bool operator==(const BodyPair&, const BodyPair&) = default;
};

/// A contact in which this rank owns a body.
struct Contact {
  BodyPair bodies;
  /// As on one machine. Its ids name bodies of World::local(), or none where this rank does not hold the body.
  tact::Contact contact;
};

/// Two bodies that began or ceased to touch, as tact::ContactEvent.
struct ContactEvent {
  BodyPair bodies;
};

/// A change of a patch, as tact::PatchEvent.
struct PatchEvent {
  BodyPair bodies;
  tact::PatchEvent::Kind kind = tact::PatchEvent::Kind::began;  ///< what became of the patch
  std::uint64_t patch = 0;                                      ///< its id
  std::uint64_t other = 0;                                      ///< the id of the other patch, or 0
};

/// An impact, as tact::Impact.
struct Impact {
  BodyPair bodies;
  tact::Impact impact;  ///< as on one machine; its ids as those of a Contact
};

/// What World::detect() found, valid until the next call of the world that changes it.
class TACT_API Report {
 public:
  Report() = default;
  Report(const Report&) = delete;  // views the world's data
  Report& operator=(const Report&) = delete;

  /// Returns the contacts in which this rank owns a body, sorted by keys.
  std::span<const Contact> contacts() const { return contacts_; }
  /// Returns the contact of two bodies, in either order, or null.
  const Contact* find_contact(std::uint64_t a, std::uint64_t b) const noexcept;
  /// Returns the contacts that touch now and did not in the last step, sorted by keys.
  std::span<const ContactEvent> began() const { return began_; }
  /// Returns the contacts that touched in the last step and do not now, sorted by keys.
  std::span<const ContactEvent> ended() const { return ended_; }
  /// Returns the changes of patches, sorted by keys, ends before beginnings.
  std::span<const PatchEvent> patch_events() const { return patch_events_; }
  /// Returns the sum of the hashes of the contacts that this rank counts; over all ranks it is that of one machine.
  std::uint64_t hash_sum() const;
  /// Returns what this rank did in the step.
  const Statistics& stats() const { return stats_; }

 private:
  friend class ReportBuilder;
  Report(Report&&) = default;
  Report& operator=(Report&&) = default;
  std::vector<Contact> contacts_;
  std::vector<ContactEvent> began_, ended_;
  std::vector<PatchEvent> patch_events_;
  Statistics stats_;
};

/// What World::detect_motion() found, valid until the next call of the world that changes it.
class TACT_API MotionReport {
 public:
  MotionReport() = default;
  MotionReport(const MotionReport&) = delete;
  MotionReport& operator=(const MotionReport&) = delete;

  /// Returns the earliest time of all ranks, 0 to 1; infinity if no impact stops.
  double first_time() const { return first_time_; }
  /// Returns the impacts in which this rank owns a body, sorted by keys, time and features.
  std::span<const Impact> impacts() const { return impacts_; }
  /// Returns what this rank did in the call.
  const Statistics& stats() const { return stats_; }

 private:
  friend class ReportBuilder;
  std::vector<Impact> impacts_;
  double first_time_ = std::numeric_limits<double>::infinity();
  Statistics stats_;
};

}  // namespace tact::mpi
