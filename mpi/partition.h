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

/// Keys as Zoltan takes them, and who owns them.
class Keys {
 public:
  explicit Keys(std::span<const std::uint64_t> keys);
  int count() const { return static_cast<int>(owners_.size()); }
  ZOLTAN_ID_PTR words() { return words_.data(); }
  /// After Directory::find(): the owner of each, or -1.
  std::span<int> owners() { return owners_; }

 private:
  std::vector<ZOLTAN_ID_TYPE> words_;
  std::vector<int> owners_;
};

/// The owner of each key. Errors: backend_failure.
class Directory {
 public:
  explicit Directory(const Channel& channel);
  ~Directory();
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  /// These keys are of this rank now; of nobody.
  void add(Keys& keys);
  void remove(Keys& keys);
  void find(Keys& keys) const;

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

/// Parcels that are ready to be sent.
struct Shipment {
  explicit Shipment(std::vector<Parcel> given = {});
  std::vector<Parcel> parcels;
  std::vector<std::uint64_t> keys;
  std::vector<int> ranks;
  std::vector<ZOLTAN_ID_TYPE> places;
  Keys words;
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
  /// The ranks whose parts a box meets: two boxes with a point in common have a rank in common. Errors:
  /// backend_failure.
  void ranks_near(const base::Box& box, std::vector<int>& ranks) const;
  /// Sends parcels and returns those that came, by key. Errors: backend_failure.
  std::vector<Parcel> send(Shipment& shipment);

 private:
  struct Cargo;
  const Channel& channel_;
  Zoltan_Struct* zoltan_ = nullptr;
  bool is_cut_ = false;
  mutable std::vector<int> found_;  // scratch, one for each rank
};

}  // namespace tact::mpi
