#include "mpi/channel.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <string>

namespace tact::mpi {

namespace {

constexpr int kTag = 1;
constexpr std::uint64_t kFailed = ~std::uint64_t{0};
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;  // bytes of one call: MPI counts in int

void check(int code) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  throw Error(ErrorCode::backend_failure, "MPI: " + std::string(text.data(), static_cast<std::size_t>(length)));
}

// Of any exception: those of the program's functions have no code of ours.
Error error_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return {ErrorCode::out_of_memory, "a rank ran out of memory"};
  } catch (const std::exception& error) {
    return {ErrorCode::invalid_argument, error.what()};
  } catch (...) {
    return {ErrorCode::invalid_argument, "a function of the program threw"};
  }
}

// Calls part(first, count) for each part of so many bytes.
template <class Part>
void for_parts(Bytes& bytes, const Part& part) {
  for (std::size_t begin = 0; begin < bytes.size(); begin += kMostAtOnce)
    part(bytes.data() + begin, static_cast<int>(std::min(kMostAtOnce, bytes.size() - begin)));
}

}  // namespace

Channel::Channel(MPI_Comm parent) {
  int is_initialized = 0, is_finalized = 0;
  MPI_Initialized(&is_initialized);
  MPI_Finalized(&is_finalized);
  if (is_initialized == 0 || is_finalized != 0)
    throw Error(ErrorCode::wrong_order, "a world over many ranks is made between MPI_Init() and MPI_Finalize()");
  check(MPI_Comm_dup(parent, &comm_));
  MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
  const auto ranks = static_cast<std::size_t>(size_);
  gathered_.resize(2 * ranks), numbers_.resize(ranks), sizes_to_.resize(ranks), sizes_from_.resize(ranks);
}

Channel::~Channel() {
  int is_finalized = 0;
  MPI_Finalized(&is_finalized);
  if (comm_ != MPI_COMM_NULL && is_finalized == 0) MPI_Comm_free(&comm_);
}

// A longer message is cut.
void Channel::throw_of(int rank, const std::exception_ptr& failure) const {
  struct {
    int code = 0;
    std::array<char, 1024> message{};
  } told;
  if (rank == rank_) {
    const Error error = error_of(failure);
    told.code = static_cast<int>(error.code());
    std::strncpy(told.message.data(), error.what(), told.message.size() - 1);
  }
  check(MPI_Bcast(&told, sizeof told, MPI_BYTE, rank, comm_));
  throw Error(static_cast<ErrorCode>(told.code), told.message.data());
}

std::span<const std::uint64_t> Channel::gather(std::uint64_t number, const std::exception_ptr& failure) {
  const std::array<std::uint64_t, 2> own{number, failure != nullptr ? kFailed : 0};
  check(MPI_Allgather(own.data(), 2, MPI_UINT64_T, gathered_.data(), 2, MPI_UINT64_T, comm_));
  for (int rank = 0; rank < size_; ++rank) {
    if (gathered_[2 * rank + 1] == kFailed) throw_of(rank, failure);
    numbers_[rank] = gathered_[2 * rank];
  }
  return numbers_;
}

void Channel::largest(std::span<std::uint64_t> numbers) const {
  check(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_UINT64_T, MPI_MAX, comm_));
}

// How much comes from each rank.
void Channel::find_sizes(Outbox& outbox, const std::exception_ptr& failure) {
  std::ranges::fill(sizes_to_, failure != nullptr ? kFailed : 0);
  if (failure == nullptr) {
    for (auto& [rank, writer] : outbox.writers()) sizes_to_[rank] = writer.bytes().size();
  }
  check(MPI_Alltoall(sizes_to_.data(), 1, MPI_UINT64_T, sizes_from_.data(), 1, MPI_UINT64_T, comm_));
  for (int rank = 0; rank < size_; ++rank) {
    if (sizes_from_[rank] == kFailed) throw_of(rank, failure);
  }
}

std::vector<Message> Channel::deliver(Outbox& outbox, const std::exception_ptr& failure) {
  find_sizes(outbox, failure);
  std::vector<Message> messages;
  std::vector<MPI_Request> requests;
  together([&] {  // all have room for what comes, or none sends
    std::size_t parts = 0;
    const auto count_parts = [&](std::uint64_t size) { parts += (size + kMostAtOnce - 1) / kMostAtOnce; };
    for (int rank = 0; rank < size_; ++rank) {
      if (sizes_from_[rank] > 0) messages.push_back({rank, Bytes(rank == rank_ ? 0 : sizes_from_[rank])});
      count_parts(sizes_from_[rank]), count_parts(sizes_to_[rank]);
    }
    requests.reserve(parts);
  });
  for (Message& message : messages) {
    if (message.rank == rank_) {
      message.bytes = std::move(outbox.to(rank_).bytes());
      continue;
    }
    for_parts(message.bytes, [&](std::byte* first, int count) {
      check(MPI_Irecv(first, count, MPI_BYTE, message.rank, kTag, comm_, &requests.emplace_back()));
    });
  }
  for (auto& [rank, writer] : outbox.writers()) {
    if (rank == rank_ || writer.bytes().empty()) continue;
    ++messages_;
    bytes_ += static_cast<std::int64_t>(writer.bytes().size());
    for_parts(writer.bytes(), [&, to = rank](std::byte* first, int count) {
      check(MPI_Isend(first, count, MPI_BYTE, to, kTag, comm_, &requests.emplace_back()));
    });
  }
  check(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE));
  return messages;
}

}  // namespace tact::mpi
