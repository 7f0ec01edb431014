// The oracle of the broad phase: every two boxes compared, by nothing but the definition.
#pragma once

#include <span>
#include <vector>

#include "broadphase/index_pair.h"
#include "engine/base/box.h"

namespace tact::tests {

std::vector<broadphase::IndexPair> all_overlapping_pairs(std::span<const base::Box> boxes,
                                                         std::span<const broadphase::Filter> filters);

}  // namespace tact::tests
