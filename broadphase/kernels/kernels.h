// The one loop in which the time goes, compiled for each instruction set and chosen when the program runs. Comparisons
// of doubles are exact, so every instruction set gives the same answer.
#pragma once

#include <cstdint>

#include "broadphase/block.h"

namespace tact::broadphase {

// Compares the boxes of `a` with those of `b`, closed. Bit i of the answer says that lane i of `a` overlaps some lane
// of `b`; columns[i] then holds a bit for each such lane, and is not written otherwise. `columns` has room for kLanes.
using OverlapKernel = std::uint32_t (*)(const Block& a, const Block& b, std::uint16_t* columns);

// Each instruction set; null where the machine or the build does not have it.
OverlapKernel scalar_overlap_kernel();
OverlapKernel avx2_overlap_kernel();
OverlapKernel avx512_overlap_kernel();

// The best for this machine.
OverlapKernel best_overlap_kernel();

}  // namespace tact::broadphase
