#pragma once

namespace tact::narrowphase {

// How much one rounding of doubles changes a number at most, as a part of it.
inline constexpr double kUnitRoundoff = 0x1p-53;

}  // namespace tact::narrowphase
