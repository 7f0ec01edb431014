#include <filesystem>
#include <iterator>
#include <system_error>

#include "handles.h"

namespace tact::c {
namespace {

const Failure kCannotWrite{TACT_ERROR_FILE,
                           "the recording cannot be written: a file or a folder that is not there, "
                           "no right to write, or a full disk"};

// Of a name in UTF-8, whatever the system's own encoding is.
std::filesystem::path path_of(const char* name) { return reinterpret_cast<const char8_t*>(name); }

std::string bytes_of_file(const std::filesystem::path& path) {
  std::error_code not_there;
  if (std::filesystem::is_directory(path, not_there)) throw Failure{TACT_ERROR_FILE, "the recording is a folder"};
  try {
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (file) return bytes;
  } catch (const std::ios_base::failure&) {  // the iterator lets errors of reading through
  }
  throw Failure{TACT_ERROR_FILE, "the recording cannot be read"};
}

// Calls work(entry) while no other thread is in a function of the player or of its world.
template <class Work>
tact_error playing(tact_player player, const Work& work) noexcept {
  return guarded([&] {
    const std::shared_ptr<PlayerEntry> entry = player_of(player);
    const std::unique_lock lock(entry->in_use, std::try_to_lock);
    if (!lock) throw Failure{TACT_ERROR_BUSY, "another thread is in a function of this player"};
    const std::shared_ptr<WorldEntry> world = entry_of({entry->world});
    const std::unique_lock world_lock(world->in_use, std::try_to_lock);
    if (!world_lock) throw kBusy;
    work(*entry, *world);
  });
}

}  // namespace
}  // namespace tact::c

using tact::c::changing, tact::c::check_not_null, tact::c::guarded, tact::c::PlayerEntry, tact::c::playing,
    tact::c::WorldEntry;

extern "C" {

tact_error tact_world_record(tact_world world, const char* path) {
  return changing(world, [&](WorldEntry& entry) {
    if (path == nullptr) {
      entry.world.set_observer(nullptr);
      if (entry.recording == nullptr) return;
      entry.recording->file.close();
      const bool whole = entry.recording->file.good();
      entry.recording.reset();
      if (!whole) throw tact::c::kCannotWrite;
      return;
    }
    tact::WorldObserver trial;
    entry.world.set_observer(&trial);  // a refused call empties no file
    entry.world.set_observer(entry.recording == nullptr ? nullptr : &entry.recording->recorder);
    std::ofstream file(tact::c::path_of(path), std::ios::binary);
    if (!file) throw tact::c::kCannotWrite;
    // The recorder keeps the address of the file, so both are made where they stay.
    auto recording = std::unique_ptr<tact::c::FileRecording>(new tact::c::FileRecording{std::move(file)});
    entry.world.set_observer(&recording->recorder);
    entry.recording = std::move(recording);
  });
}

tact_error tact_player_open(const char* path, int32_t threads, tact_player* player) {
  return guarded([&] {
    check_not_null(path, player);
    const std::optional<int> given = threads == -1 ? std::nullopt : std::optional<int>(threads);
    auto entry = std::make_shared<PlayerEntry>(tact::c::bytes_of_file(tact::c::path_of(path)), given);
    const std::shared_ptr<tact::World> world(entry, &entry->player.world());  // holds the player as long as it is held
    entry->world = tact::c::add_entry(std::make_shared<WorldEntry>(world));
    const auto world_handle = entry->world;
    try {
      player->handle = tact::c::add_player(std::move(entry));
    } catch (...) {
      tact::c::remove_entry(world_handle);
      throw;
    }
  });
}

tact_error tact_player_close(tact_player player) {
  return guarded([&] {
    tact::c::remove_entry(tact::c::player_of(player)->world);
    tact::c::remove_player(player.handle);
  });
}

tact_error tact_player_next(tact_player player, tact_played_step* step, bool* played) {
  return playing(player, [&](PlayerEntry& entry, WorldEntry& world) {
    check_not_null(step, played);
    tact::c::check_struct_size(*step);
    world.report = nullptr;
    world.motion = nullptr;  // a record may restore a state
    const std::optional<tact::PlayedStep> made = entry.player.next();
    *played = made.has_value();
    if (!made) return;
    tact::c::write_struct(*step, {.struct_size = 0,
                                  .number = made->number,
                                  .byte = made->byte,
                                  .answered = made->recorded.has_value(),
                                  .recorded = made->recorded.value_or(0),
                                  .now = made->now});
    world.report = &entry.player.report();
  });
}

tact_error tact_player_cut_at(tact_player player, bool* cut, size_t* byte) {
  return playing(player, [&](PlayerEntry& entry, WorldEntry&) {
    check_not_null(cut, byte);
    const std::optional<std::size_t> at = entry.player.cut_at();
    *cut = at.has_value();
    *byte = at.value_or(0);
  });
}

tact_error tact_player_world(tact_player player, tact_world* world) {
  return playing(player, [&](PlayerEntry& entry, WorldEntry&) {
    check_not_null(world);
    world->handle = entry.world;
  });
}

tact_error tact_player_recorded_by(tact_player player, const char** version) {
  return playing(player, [&](PlayerEntry& entry, WorldEntry&) {
    check_not_null(version);
    *version = entry.player.recorded_by().c_str();
  });
}
}
