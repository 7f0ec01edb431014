// The first part of stage 3, of all pairs in one pass: separates bodies by an axis of their 18-DOPs.
#pragma once

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_table.h"

namespace tact {

/// Drops from table.moved() the pairs that were apart, or are new, and that an axis separates; their records are not
/// read. A pair that an axis separated in the last step and none does now starts from the direction of that axis.
void separate_by_kdop(PairTable& table, Bodies& bodies, int threads);

}  // namespace tact
