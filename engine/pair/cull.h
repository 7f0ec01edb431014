// Stage 5: which clusters of a pair can hold facets that meet, and which pairs of them.
#pragma once

#include "engine/pair/pair_work.h"

namespace tact {

/// Replaces what `pair.work.culled` holds by what the criteria leave of the pair. At Accuracy::paper, or where zones
/// are asked for, also fills the zones of the record's contact. Errors: backend_failure, out_of_memory.
void cull(const PairTask& pair, const narrowphase::Slab& slab, narrowphase::EmbreeDevice& device);

}  // namespace tact
