// The first query of stage 3, to all pairs in one pass: does an axis of an 18-DOP separate the bodies?
#pragma once

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_table.h"

namespace tact {

/// Drops from table.moved() the pairs that were apart, or are new, and that an axis separates; their records are not
/// read. A pair that an axis separated in the last step and none does now starts from the direction of that axis.
void separate_by_kdop(PairTable& table, Bodies& bodies, int threads);

}  // namespace tact
