// Runs a recording again, step by step.
#pragma once

#include <tact/tact.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/files/binary_reader.h"
#include "scenes/files/recording.h"

namespace tact::scenes {

// A step that was run again.
struct PlayedStep {
  int number = 0;              // from 0
  std::size_t byte = 0;        // where its hash stands in the file
  std::uint64_t recorded = 0;  // hash of the report then
  std::uint64_t now = 0;       // hash of the report now
  bool same() const { return recorded == now; }
};

// Takes memory for what the file holds, never for what it promises.
class RecordingPlayer {
 public:
  // Reads the head of `bytes`, which must outlive the player; messages begin with `file`. `threads`, if given, replaces
  // those of the recording. Errors: FileError, with the byte.
  RecordingPlayer(std::string_view bytes, std::string file, std::optional<int> threads = {});

  // Makes the calls up to the next detect, and that one; nothing at the end of the recording. Calls after the last
  // detect are made too. Errors: FileError, with the byte, for what is no recording, ends in a record or in a step, or
  // what the world refuses.
  std::optional<PlayedStep> next();

  const World& world() const { return *world_; }
  // The version of tact that wrote the recording.
  const std::string& recorded_by() const { return recorded_by_; }

 private:
  void read_head(std::string_view bytes);
  RecordKind read_kind();
  // Makes the call of a record that is neither detect nor hash.
  void play(RecordKind kind);
  PlayedStep detect();
  void add_body();
  void set_positions();
  Settings read_settings();
  std::string read_text();
  BodyId read_body();
  bool read_flag();
  template <class Enumeration>
  Enumeration read_enumeration(Enumeration last);
  // A count of things of `size` bytes each, which the file has room for.
  std::size_t read_count(const char* things, std::size_t size);
  template <class Number>
  Eigen::Matrix<Number, 3, Eigen::Dynamic> read_columns(std::size_t count);
  // Calls call(); data that the world refuses are the file's fault.
  template <class Call>
  void make(const Call& call);
  std::size_t position() const { return size_ - reader_.bytes_left(); }
  // For what is wrong with the record as a whole.
  [[noreturn]] void fail_record(const std::string& message) const;

  std::size_t size_;
  std::string file_;
  BinaryReader reader_;
  std::size_t record_ = 0;  // the byte at which the record begins that is being read
  std::optional<int> threads_;
  std::string recorded_by_;
  std::optional<World> world_;
  std::uint32_t world_number_ = 0;  // that ids carry; known from the first body
  int steps_ = 0;
};

}  // namespace tact::scenes
