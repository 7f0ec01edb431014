// Saved states whose content was changed, with a checksum that is right again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/base/hash.h"

namespace tact::tests {

/// Where the content begins: behind "tactstat", u32 version, u64 size and u64 checksum of the content.
inline constexpr std::size_t kStateHead = 28;

inline void mend(std::vector<std::byte>& state) {
  if (state.size() < kStateHead) return;
  const std::uint64_t size = state.size() - kStateHead;
  base::Hash hash;
  hash.add(size);
  for (std::size_t begin = kStateHead; begin < state.size(); begin += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, state.data() + begin, std::min(sizeof word, state.size() - begin));
    hash.add(word);
  }
  const std::uint64_t checksum = hash.value();
  std::memcpy(state.data() + 12, &size, sizeof size);
  std::memcpy(state.data() + 20, &checksum, sizeof checksum);
}

}  // namespace tact::tests
