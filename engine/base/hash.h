// Hashes of 64-bit words.
#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace tact::base {

/// The finisher of SplitMix64 (Steele, Lea, Flood, 2014): a permutation in which each bit changes half of the others.
inline std::uint64_t mixed(std::uint64_t word) {
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
  return word ^ (word >> 31);
}

/// The fraction of the golden ratio: steps of this size hit all 64-bit words before one comes twice.
inline constexpr std::uint64_t kGoldenStep = 0x9e3779b97f4a7c15u;

/// A hash of words in their order: multiply and rotate.
class Hash {
 public:
  // Of any unsigned integer: sizes have 32 bits on some machines.
  template <std::unsigned_integral Word>
  void add(Word word) {
    state_ = std::rotl(state_ ^ mixed(word), 23) * kGoldenStep;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  // Word by word, the last filled up with zeros; not how many there are.
  void add(std::span<const std::byte> bytes) {
    for (std::size_t begin = 0; begin < bytes.size(); begin += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + begin, std::min(sizeof word, bytes.size() - begin));
      add(word);
    }
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0x243f6a8885a308d3u;
};

/// An id made of words in their order: a chain of SplitMix64.
class WordChain {
 public:
  void add(std::uint64_t word) { id_ = mixed(id_ + kGoldenStep + word); }
  std::uint64_t value() const { return id_; }

 private:
  std::uint64_t id_ = 0;
};

}  // namespace tact::base
