// The worlds of C programs: handles that can be checked, and the guard that every function of the interface runs in.
#pragma once

#include <tact/kept_report.h>
#include <tact/recording.h>
#include <tact/tact.h>
#include <tact/tact_c.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tact::c {

// A failure of the C interface's own kind.
struct Failure {
  tact_error error;
  std::string message;
};

// A file that a world is recorded to.
struct FileRecording {
  std::ofstream file;
  Recorder recorder{file};
};

struct WorldEntry {
  explicit WorldEntry(std::shared_ptr<World> given) : held(std::move(given)), world(*held) {}
  std::unique_ptr<FileRecording> recording = nullptr;  // outlives the world
  std::shared_ptr<World> held;                         // a player's, or its own
  World& world;
  std::optional<KeptReport> kept = {};   // of a handle that is of no world but of a report
  const Report* report = nullptr;        // of the last step; null before the first, or after a change of settings
  const MotionReport* motion = nullptr;  // of the last tact_world_detect_motion(); null before
  std::vector<PositionsUpdate> updates;  // scratch
  std::vector<PoseUpdate> poses;         // scratch
  std::shared_mutex in_use;
};

// A recording that is played. Its world is among the worlds, too.
struct PlayerEntry {
  PlayerEntry(std::string given, std::optional<int> threads)
      : bytes(std::move(given)), player(bytes, {.threads = threads, .outputs = {}}) {}
  std::string bytes;
  RecordingPlayer player;
  std::uint64_t world = 0;  // its handle
  std::mutex in_use;
};

std::uint64_t add_entry(std::shared_ptr<WorldEntry> entry);
void remove_entry(std::uint64_t handle);
// Throws Failure for a handle that was not given out or is gone.
std::shared_ptr<WorldEntry> entry_of(tact_world world);

std::uint64_t add_player(std::shared_ptr<PlayerEntry> player);
void remove_player(std::uint64_t handle);
// Throws Failure for a handle that was not given out or is closed.
std::shared_ptr<PlayerEntry> player_of(tact_player player);

// Keeps the message of the calling thread.
tact_error failed(tact_error error, const char* message) noexcept;
// Turns the exception that is being handled into an error.
tact_error failed_by_exception() noexcept;

// Calls work(); whatever it throws becomes the error that is returned.
template <class Work>
tact_error guarded(const Work& work) noexcept {
  try {
    work();
    return TACT_OK;
  } catch (...) {
    return failed_by_exception();
  }
}

template <class... Pointers>
void check_not_null(const Pointers*... pointers) {
  if ((!pointers || ...)) throw Failure{TACT_ERROR_NULL_ARGUMENT, "an argument is null"};
}

// A list of a report, with the same bits under the name of C.
template <class ForC, class Value>
void show(std::span<const Value> values, const ForC** first, size_t* count) {
  check_not_null(first, count);
  *first = reinterpret_cast<const ForC*>(values.data());
  *count = values.size();
}

template <class Value>
const Value& at(std::span<const Value> values, size_t index) {
  if (index >= values.size())
    throw Failure{TACT_ERROR_INDEX_OUT_OF_RANGE,
                  "index " + std::to_string(index) + " is not below the count, " + std::to_string(values.size())};
  return values[index];
}

inline const Failure kBusy{TACT_ERROR_BUSY, "another thread is in a function of this world"};

// Calls work(entry) while no other thread is in a function of the world.
template <class Work>
tact_error changing(tact_world world, const Work& work) noexcept {
  return guarded([&] {
    const std::shared_ptr<WorldEntry> entry = entry_of(world);
    const std::unique_lock lock(entry->in_use, std::try_to_lock);
    if (!lock) throw kBusy;
    work(*entry);
  });
}

// The same among others that only read.
template <class Work>
tact_error reading(tact_world world, const Work& work) noexcept {
  return guarded([&] {
    const std::shared_ptr<WorldEntry> entry = entry_of(world);
    const std::shared_lock lock(entry->in_use, std::try_to_lock);
    if (!lock) throw kBusy;
    work(std::as_const(*entry));
  });
}

inline const Report& report_of(const WorldEntry& entry) {
  if (entry.report == nullptr)
    throw Failure{TACT_ERROR_WRONG_ORDER, "there is no report: no step since the world or its settings were made"};
  return *entry.report;
}

// Calls work(report) with the report of the last step.
template <class Work>
tact_error with_report(tact_world world, const Work& work) noexcept {
  return reading(world, [&](const WorldEntry& entry) { work(report_of(entry)); });
}

// Calls work(report) with what the last call of tact_world_detect_motion() found.
template <class Work>
tact_error with_motion(tact_world world, const Work& work) noexcept {
  return reading(world, [&](const WorldEntry& entry) {
    if (entry.motion == nullptr)
      throw Failure{TACT_ERROR_WRONG_ORDER, "tact_world_detect_motion() was not called, or failed"};
    work(*entry.motion);
  });
}

// Version 0.1 is the first: no struct is smaller than it was there.
template <class Struct>
void check_struct_size(const Struct& given) {
  if (given.struct_size == sizeof(Struct)) return;
  throw Failure{TACT_ERROR_WRONG_STRUCT_SIZE,
                "struct_size is not that of a version of this library: begin with the TACT_..._INIT of the struct"};
}

// A caller's struct begins with its size: it may be older than this library, whose later fields then have the values of
// `defaults`, never newer.
template <class Struct>
Struct read_struct(const Struct& given, const Struct& defaults) {
  Struct result = defaults;
  check_struct_size(given);
  std::copy_n(reinterpret_cast<const std::byte*>(&given), given.struct_size, reinterpret_cast<std::byte*>(&result));
  return result;
}
template <class Struct>
void write_struct(Struct& to, Struct value) {
  check_struct_size(to);
  value.struct_size = to.struct_size;
  std::copy_n(reinterpret_cast<const std::byte*>(&value), to.struct_size, reinterpret_cast<std::byte*>(&to));
}

// What a solver gives for each of some points.
std::vector<PointImpulse> impulses_of(const tact_point_impulse* impulses, size_t count);

inline BodyId id_of(tact_body body) { return {body.index, body.generation, body.world}; }
inline tact_body body_of(BodyId id) { return {id.index, id.generation, id.world}; }

}  // namespace tact::c
