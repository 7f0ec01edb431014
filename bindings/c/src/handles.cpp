#include "handles.h"

#include <array>
#include <cstring>
#include <map>
#include <new>

namespace tact::c {
namespace {

template <class Entry>
using Handles = std::map<std::uint64_t, std::shared_ptr<Entry>>;

// The one list of what C programs hold: a handle that is not in it is refused, whatever its bits are. It is never taken
// down, so that a program may end with worlds left.
struct Registry {
  std::shared_mutex mutex;
  Handles<WorldEntry> entries;
  Handles<PlayerEntry> players;
  std::uint64_t last = 0x7461637400000000;  // "tact": no small number is ever a handle
};

Registry& registry() {
  static Registry& only = *new Registry;
  return only;
}

template <class Entry>
std::uint64_t add(Handles<Entry> Registry::*list, std::shared_ptr<Entry> entry) {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  (all.*list).emplace(all.last + 1, std::move(entry));
  return ++all.last;
}

template <class Entry>
void remove(Handles<Entry> Registry::*list, std::uint64_t handle) {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  (all.*list).erase(handle);
}

template <class Entry>
std::shared_ptr<Entry> find(Handles<Entry> Registry::*list, std::uint64_t handle, const char* message) {
  Registry& all = registry();
  const std::shared_lock lock(all.mutex);
  const auto found = (all.*list).find(handle);
  if (found == (all.*list).end()) throw Failure{TACT_ERROR_INVALID_HANDLE, message};
  return found->second;
}

// In place, so that there is a message also where there is no memory.
thread_local std::array<char, 1024> last_message{};

tact_error error_of(ErrorCode code) {
  const int number = static_cast<int>(code) + 1;
  return number <= TACT_ERROR_BAD_STATE ? static_cast<tact_error>(number) : TACT_ERROR_INTERNAL;
}
static_assert(static_cast<int>(ErrorCode::non_finite_position) + 1 == TACT_ERROR_NON_FINITE_POSITION);
static_assert(static_cast<int>(ErrorCode::stale_body) + 1 == TACT_ERROR_STALE_BODY);
static_assert(static_cast<int>(ErrorCode::bad_settings) + 1 == TACT_ERROR_BAD_SETTINGS);
static_assert(static_cast<int>(ErrorCode::not_a_rotation) + 1 == TACT_ERROR_NOT_A_ROTATION);
static_assert(static_cast<int>(ErrorCode::invalid_argument) + 1 == TACT_ERROR_INVALID_ARGUMENT);
static_assert(static_cast<int>(ErrorCode::bad_state) + 1 == TACT_ERROR_BAD_STATE);

}  // namespace

std::uint64_t add_entry(std::shared_ptr<WorldEntry> entry) { return add(&Registry::entries, std::move(entry)); }
void remove_entry(std::uint64_t handle) { remove(&Registry::entries, handle); }
std::shared_ptr<WorldEntry> entry_of(tact_world world) {
  return find(&Registry::entries, world.handle, "the world was destroyed, or the handle was never given out");
}

std::uint64_t add_player(std::shared_ptr<PlayerEntry> player) { return add(&Registry::players, std::move(player)); }
void remove_player(std::uint64_t handle) { remove(&Registry::players, handle); }
std::shared_ptr<PlayerEntry> player_of(tact_player player) {
  return find(&Registry::players, player.handle, "the player was closed, or the handle was never given out");
}

tact_error failed(tact_error error, const char* message) noexcept {
  const std::size_t size = std::min(std::strlen(message), last_message.size() - 1);
  std::memcpy(last_message.data(), message, size);
  last_message[size] = '\0';
  return error;
}

tact_error failed_by_exception() noexcept {
  try {
    throw;
  } catch (const Failure& failure) {
    return failed(failure.error, failure.message.c_str());
  } catch (const Error& error) {
    return failed(error_of(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return failed(TACT_ERROR_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return failed(TACT_ERROR_INTERNAL, error.what());
  } catch (...) {
    return failed(TACT_ERROR_INTERNAL, "an exception of an unknown kind");
  }
}

}  // namespace tact::c

extern "C" {

const char* tact_version(void) { return TACT_VERSION; }

const char* tact_last_error_message(void) { return tact::c::last_message.data(); }

const char* tact_error_code_name(int error) {
  switch (error) {
    case TACT_OK: return "ok";
    case TACT_ERROR_INVALID_HANDLE: return "invalid_handle";
    case TACT_ERROR_NULL_ARGUMENT: return "null_argument";
    case TACT_ERROR_WRONG_STRUCT_SIZE: return "wrong_struct_size";
    case TACT_ERROR_BUSY: return "busy";
    case TACT_ERROR_INDEX_OUT_OF_RANGE: return "index_out_of_range";
    case TACT_ERROR_INTERNAL: return "internal";
    case TACT_ERROR_FILE: return "file";
    default: break;
  }
  // Below, `error - 1` may overflow.
  return error > TACT_OK ? tact::error_code_name(static_cast<tact::ErrorCode>(error - 1)) : "unknown";
}
}
