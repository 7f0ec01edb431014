#include "mpi/program/ordered_file.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <system_error>

#include "scenes/files/file_error.h"

namespace tact::mpi::program {
namespace {

using scenes::FileError;

constexpr const char* kCut = "cannot write the file to its end";

// Before each text of a message.
struct Head {
  std::uint64_t first = 0, second = 0, size = 0;
};

void add(const Piece& piece, std::vector<char>& bytes) {
  const Head head{piece.key.first, piece.key.second, piece.text.size()};
  const auto* begin = reinterpret_cast<const char*>(&head);
  bytes.insert(bytes.end(), begin, begin + sizeof(head));
  bytes.insert(bytes.end(), piece.text.begin(), piece.text.end());
}

std::vector<Piece> pieces_of(const std::vector<char>& bytes) {
  std::vector<Piece> pieces;
  for (std::size_t at = 0; at < bytes.size();) {
    Head head;
    std::memcpy(&head, bytes.data() + at, sizeof(head));
    at += sizeof(head);
    pieces.push_back({{head.first, head.second}, std::string(bytes.data() + at, head.size)});
    at += head.size;
  }
  return pieces;
}

// Where each part of a message begins, and its end. MPI counts with int.
std::vector<int> offsets_of(const std::vector<int>& sizes) {
  std::vector<int> offsets(1, 0);
  for (const int size : sizes) {
    if (size > std::numeric_limits<int>::max() - offsets.back())
      throw FileError("a rank's share of one frame is larger than 2 GiB: use more ranks");
    offsets.push_back(offsets.back() + size);
  }
  return offsets;
}

}  // namespace

// Ranks cannot write to places of a pipe or a device.
OrderedFile::OrderedFile(MPI_Comm communicator, std::filesystem::path path, std::uint64_t key_count)
    : communicator_(communicator), path_(std::move(path)), key_count_(key_count) {
  MPI_Comm_rank(communicator_, &rank_);
  MPI_Comm_size(communicator_, &ranks_);
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::status(path_, ignored);
  const bool is_file = !std::filesystem::exists(there) || std::filesystem::is_regular_file(there);
  check(is_file ? MPI_SUCCESS : MPI_ERR_FILE, "no file, which ranks could write to in parts");
  part_ = std::filesystem::is_symlink(path_, ignored) ? path_ : std::filesystem::path(path_.string() + ".part");
  const int mode = MPI_MODE_CREATE | MPI_MODE_WRONLY;
  check(MPI_File_open(communicator_, part_.c_str(), mode, MPI_INFO_NULL, &file_), "cannot write the file");
  check(MPI_File_set_size(file_, 0), "cannot write the file");
}

OrderedFile::~OrderedFile() {
  if (file_ == MPI_FILE_NULL) return;
  MPI_File_close(&file_);
  std::error_code ignored;
  if (rank_ == 0 && part_ != path_) std::filesystem::remove(part_, ignored);
}

// What failed on one rank is an error on all of them.
void OrderedFile::check(int status, const char* what) const {
  int failed = status == MPI_SUCCESS ? 0 : 1, any = 0;
  MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, communicator_);
  if (any != 0) throw FileError(path_.string() + ": " + what);
}

void OrderedFile::append(std::string_view text) { write(rank_ == 0 ? text : std::string_view()); }

void OrderedFile::append(std::vector<Piece> pieces, std::string_view separator) {
  pieces = sort_over_ranks(std::move(pieces));
  std::int64_t own = static_cast<std::int64_t>(pieces.size()), before = 0;
  MPI_Exscan(&own, &before, 1, MPI_INT64_T, MPI_SUM, communicator_);  // leaves rank 0's as it is
  std::string text;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (before > 0 || i > 0) text += separator;
    text += pieces[i].text;
  }
  write(text);
}

// Rank r gets the r-th part of all keys, sorted.
std::vector<Piece> OrderedFile::sort_over_ranks(std::vector<Piece> pieces) const {
  std::ranges::sort(pieces, {}, &Piece::key);
  const auto rank_of = [&](const Piece& piece) {
    const double part =
        static_cast<double>(piece.key.first) / static_cast<double>(std::max<std::uint64_t>(key_count_, 1));
    return std::min(static_cast<int>(part * ranks_), ranks_ - 1);
  };
  std::vector<char> sent;
  std::vector<std::size_t> sizes(static_cast<std::size_t>(ranks_), 0);
  for (const Piece& piece : pieces) {
    const std::size_t before = sent.size();
    add(piece, sent);
    sizes[rank_of(piece)] += sent.size() - before;
  }
  const bool fits = sent.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max());
  check(fits ? MPI_SUCCESS : MPI_ERR_COUNT, "a rank's share of one frame is larger than 2 GiB: use more ranks");
  const std::vector<int> sent_sizes(sizes.begin(), sizes.end());
  std::vector<int> got_sizes(sent_sizes.size());
  MPI_Alltoall(sent_sizes.data(), 1, MPI_INT, got_sizes.data(), 1, MPI_INT, communicator_);
  const std::vector<int> sent_offsets = offsets_of(sent_sizes), got_offsets = offsets_of(got_sizes);
  std::vector<char> got(static_cast<std::size_t>(got_offsets.back()));
  MPI_Alltoallv(sent.data(), sent_sizes.data(), sent_offsets.data(), MPI_BYTE, got.data(), got_sizes.data(),
                got_offsets.data(), MPI_BYTE, communicator_);
  std::vector<Piece> sorted = pieces_of(got);
  std::ranges::sort(sorted, {}, &Piece::key);
  return sorted;
}

void OrderedFile::write(std::string_view text) {
  std::int64_t own = static_cast<std::int64_t>(text.size()), before = 0, all = 0;
  MPI_Exscan(&own, &before, 1, MPI_INT64_T, MPI_SUM, communicator_);
  MPI_Allreduce(&own, &all, 1, MPI_INT64_T, MPI_SUM, communicator_);
  const int count = static_cast<int>(text.size());
  MPI_Status status;
  int written = 0;
  check(MPI_File_write_at_all(file_, end_ + before, text.data(), count, MPI_CHAR, &status), kCut);
  MPI_Get_count(&status, MPI_CHAR, &written);
  check(written == count ? MPI_SUCCESS : MPI_ERR_NO_SPACE, kCut);
  end_ += all;
}

// Open MPI calls a write to a full disk a success: the size tells.
void OrderedFile::finish() {
  MPI_Offset size = 0;
  check(MPI_File_get_size(file_, &size), kCut);
  check(size == end_ ? MPI_SUCCESS : MPI_ERR_NO_SPACE, kCut);
  check(MPI_File_close(&file_), kCut);
  std::error_code error;
  if (rank_ == 0 && part_ != path_) std::filesystem::rename(part_, path_, error);
  check(error ? MPI_ERR_FILE : MPI_SUCCESS, "cannot give the file its name");
}

}  // namespace tact::mpi::program
