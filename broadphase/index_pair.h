// What the broad phase gives, and what decides besides boxes.
#pragma once

#include <compare>
#include <cstdint>

namespace tact::broadphase {

// What decides, besides boxes, whether two bodies are tested.
struct Filter {
  std::uint32_t layer = 1;  // a pair is tested if each mask holds a bit of the other's layer,
  std::uint32_t mask = 0xffffffffu;
  bool fixed = false;       // and not both are fixed,
  std::uint32_t group = 0;  // nor in one group; 0 is none
  friend bool operator==(const Filter&, const Filter&) = default;
};

inline bool tested(const Filter& a, const Filter& b) {
  return (a.layer & b.mask) != 0 && (b.layer & a.mask) != 0 && !(a.fixed && b.fixed) &&
         (a.group == 0 || a.group != b.group);
}

// Indices of two boxes, a < b.
struct IndexPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  friend constexpr auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

}  // namespace tact::broadphase
