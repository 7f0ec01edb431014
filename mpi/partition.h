// Zoltan's parts: who owns which key, how space is cut, which parts a box meets, and how bytes of bodies move. All
// functions but ranks_near() are called by all ranks in the same order.
#pragma once

#include <tact/mpi/world.h>
#include <zoltan.h>
#include <zoltan_dd.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/box.h"
#include "mpi/channel.h"

namespace tact::mpi {

/// The owner of each key. Errors: backend_failure.
class Directory {
 public:
  explicit Directory(const Channel& channel);
  ~Directory();
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  /// These keys are of this rank now; of nobody.
  void add(std::span<const std::uint64_t> keys);
  void remove(std::span<const std::uint64_t> keys);
  /// The owner of each, or -1.
  std::vector<int> find(std::span<const std::uint64_t> keys) const;

 private:
  Zoltan_DD_Directory* directory_ = nullptr;
};

/// A body as it is cut.
struct Site {
  std::uint64_t key = 0;
  std::array<double, 3> middle{};
  double work = 1.0;
};

/// A body on its way to another rank.
struct Parcel {
  std::uint64_t key = 0;
  int rank = 0;  ///< where to
  Bytes bytes;
};

class Partition {
 public:
  Partition(const Channel& channel, Partitioner partitioner);
  ~Partition();
  Partition(const Partition&) = delete;
  Partition& operator=(const Partition&) = delete;

  bool is_cut() const { return is_cut_; }
  /// Cuts space so that all parts have the same work; returns the rank of each site. Errors: backend_failure.
  std::vector<int> cut(std::span<const Site> sites);
  /// The ranks whose parts a box meets: two boxes with a point in common have a rank in common. Errors: backend_failure.
  void ranks_near(const base::Box& box, std::vector<int>& ranks) const;
  /// Sends parcels and returns those that came, by key. Errors: backend_failure.
  std::vector<Parcel> send(std::span<const Parcel> parcels);

 private:
  struct Cargo;
  const Channel& channel_;
  Zoltan_Struct* zoltan_ = nullptr;
  bool is_cut_ = false;
  mutable std::vector<int> found_;  // scratch, one for each rank
};

}  // namespace tact::mpi
