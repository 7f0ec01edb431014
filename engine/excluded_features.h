// Layers, masks, excluded labels, neighbours, margins of vertices: what a step found of features that are not tested
// against each other is left out.
#pragma once

#include <span>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_table.h"
#include "engine/self_record.h"

namespace tact {

/// Leaves out facet pairs, points and pairs within reach. It comes when nothing else needs all that surfaces have in
/// common: whether one lies inside the other, how deep they cross. It is found with the margins of bodies, which no
/// vertex exceeds: what is left is all that comes within those of vertices.
void leave_out_excluded(std::span<const MovedPair> moved, std::span<SelfRecord* const> selves, const Bodies& bodies,
                        int threads);

}  // namespace tact
