// One file that all ranks write, in the order of keys: its bytes do not depend on who held what.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tact::mpi::program {

// A text and where it stands among others.
struct Piece {
  std::pair<std::uint64_t, std::uint64_t> key;
  std::string text;
};

// All ranks call every function together. Until finish() the file is NAME.part, and an older file of its name stays;
// what a link leads to is written at once. No rank holds more than its share of the pieces, besides those that it gave.
class OrderedFile {
 public:
  // First keys are below `key_count`, and as many are near 0 as near it. Errors: FileError, on every rank, for a device
  // or a pipe as well.
  OrderedFile(MPI_Comm communicator, std::filesystem::path path, std::uint64_t key_count);
  // Without finish(), nothing is left of a file that is not written at once.
  ~OrderedFile();
  OrderedFile(const OrderedFile&) = delete;
  OrderedFile& operator=(const OrderedFile&) = delete;

  // Appends the text of rank 0.
  void append(std::string_view text);
  // Appends the pieces of all ranks in the order of their keys, of which no two are equal, with `separator` between
  // them.
  void append(std::vector<Piece> pieces, std::string_view separator);
  // Call it after the last append(). Errors: FileError if not all of it was written.
  void finish();

 private:
  // Appends the texts of all ranks, in the order of ranks.
  void write(std::string_view text);
  std::vector<Piece> sort_over_ranks(std::vector<Piece> pieces) const;
  void check(int status, const char* what) const;

  MPI_Comm communicator_;
  int rank_ = 0, ranks_ = 1;
  std::filesystem::path path_, part_;
  std::uint64_t key_count_;
  MPI_File file_ = MPI_FILE_NULL;
  MPI_Offset end_ = 0;  // bytes written so far
};

}  // namespace tact::mpi::program
