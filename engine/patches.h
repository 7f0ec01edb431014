// The patches of a contact: where two bodies touch in several places, each with a direction and depth of its own.
#pragma once

#include <vector>

#include "engine/bodies.h"
#include "engine/pair/pair_record.h"

namespace tact {

// The connected sets of the record's facet pairs, ordered by their first. The direction of a patch is the mean of the
// normals of its facets, weighted by area, turned to the side of the contact direction where a body is a sheet; without
// a mean, it is the contact direction.
std::vector<Patch> find_patches(const Body& a, const Body& b, const PairRecord& record);

}  // namespace tact
