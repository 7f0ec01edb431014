// Messages between ranks, and what all of them agree on. Every function is called by all ranks in the same order, but
// for the getters. An error of one rank becomes that of all: what may fail stands in together() or exchange(), and
// outside of them nothing is allocated before the next call of all.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <exception>
#include <map>
#include <span>
#include <vector>

#include "mpi/bytes.h"

namespace tact::mpi {

/// What came from a rank.
struct Message {
  int rank = 0;
  Bytes bytes;
};

/// What goes to ranks, one message each.
class Outbox {
 public:
  ByteWriter& to(int rank) { return writers_[rank]; }
  std::map<int, ByteWriter>& writers() { return writers_; }

 private:
  std::map<int, ByteWriter> writers_;
};

class Channel {
 public:
  /// Over a communicator of its own. Errors: wrong_order (MPI was not initialized), backend_failure.
  explicit Channel(MPI_Comm parent);
  ~Channel();
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  MPI_Comm comm() const { return comm_; }
  int rank() const { return rank_; }
  int size() const { return size_; }

  /// Returns the number that each rank gives, valid until the next call. Throws on all ranks the failure of the lowest
  /// one that has any.
  std::span<const std::uint64_t> gather(std::uint64_t number, const std::exception_ptr& failure = nullptr);
  /// The largest of each number over all ranks.
  void largest(std::span<std::uint64_t> numbers) const;

  /// Calls work() on each rank; throws on all what it throws on any.
  template <class Work>
  void together(const Work& work) {
    gather(0, failure_of(work));
  }
  /// Calls fill(outbox) on each rank, sends what is in it and returns what came, by rank. Throws on all ranks, before
  /// anything is sent, what fill throws on any.
  template <class Fill>
  std::vector<Message> exchange(const Fill& fill) {
    Outbox outbox;
    const std::exception_ptr failure = failure_of([&] { fill(outbox); });
    return deliver(outbox, failure);
  }
  std::vector<Message> deliver(Outbox& outbox, const std::exception_ptr& failure);

  /// Messages to other ranks and their bytes, from the last reset on.
  std::int64_t messages() const { return messages_; }
  std::int64_t bytes() const { return bytes_; }
  void reset_counts() { messages_ = bytes_ = 0; }

  template <class Work>
  static std::exception_ptr failure_of(const Work& work) {
    try {
      work();
    } catch (...) {
      return std::current_exception();
    }
    return nullptr;
  }

 private:
  [[noreturn]] void throw_of(int rank, const std::exception_ptr& failure) const;
  void find_sizes(Outbox& outbox, const std::exception_ptr& failure);

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
  std::int64_t messages_ = 0, bytes_ = 0;
  std::vector<std::uint64_t> gathered_, numbers_;  // two of each rank, and one
  std::vector<std::uint64_t> sizes_to_, sizes_from_;
};

}  // namespace tact::mpi
