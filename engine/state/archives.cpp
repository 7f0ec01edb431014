#include "engine/state/archives.h"

#include <cstring>

namespace tact {

void StateWriter::append(const void* first, std::size_t size) {
  const auto* const from = static_cast<const std::byte*>(first);
  bytes_.insert(bytes_.end(), from, from + size);
}

void StateReader::refuse(const char* what) const {
  throw Error(ErrorCode::bad_state, "byte " + std::to_string(position_) + ": " + what);
}

void StateReader::take(void* to, std::size_t size) {
  check(size <= bytes_left(), "the state ends early");
  if (size > 0) std::memcpy(to, bytes_.data() + position_, size);
  position_ += size;
}

}  // namespace tact
