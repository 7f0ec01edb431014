// Stage 4: the contact direction and the depth of a pair.
#pragma once

#include "engine/pair/pair_work.h"
#include "engine/pair/test_hulls.h"

namespace tact {

/// Fills the record's contact and returns the slab between the contact planes. A pair that was in contact starts from
/// the direction of the last step, one that was apart from the direction that separated it, one that is new from its
/// smallest separation.
narrowphase::Slab find_direction(const PairTask& pair, const HullTest& hulls);

}  // namespace tact
