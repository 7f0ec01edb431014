// Which vertices stand at one place.
#pragma once

#include <span>
#include <vector>

namespace tact {

// The first vertex with the position of each, three coordinates a vertex; 0 and -0 are equal.
std::vector<int> first_at_position(std::span<const double> positions);

}  // namespace tact
