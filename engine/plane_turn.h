// Exact turns in a plane, for the program's readers. No part of the package: its header is not installed.
#pragma once

#include <tact/error.h>

#include <array>

namespace tact {

// +1 if a, b, c turn counter-clockwise, -1 clockwise, 0 on one line, decided exactly. Coordinates are finite and at
// most kLargestCoordinate in size.
TACT_API int plane_turn(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c);

}  // namespace tact
