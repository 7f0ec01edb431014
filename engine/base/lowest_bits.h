// Sets of up to 64 in one word.
#pragma once

#include <cstdint>

namespace tact::base {

/// The `count` lowest bits, 0 <= count <= 64: all of so many.
inline std::uint64_t lowest_bits(int count) { return count == 0 ? 0 : ~std::uint64_t{0} >> (64 - count); }

}  // namespace tact::base
