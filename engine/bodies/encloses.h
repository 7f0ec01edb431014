// Whether facets have an inside at all.
#pragma once

#include <span>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact {

// Whether the facets at each edge run along it as often one way as the other, where vertices at one place are one: then
// the surface winds around each point a whole number of times, whichever way one looks. False, too, if every facet has
// one turned the other way in its place: then it winds around none. Facets without an area count for nothing, and where
// there are no others the answer is true. A sum of hashes, in one pass over vertices and facets: a surface that has an
// inside always has it, and one that has none is taken for another once in 2^64 times.
bool encloses(std::span<const double> positions, std::span<const int> facets);

// Whether the volume that the facets of a mesh enclose is positive: counter-clockwise seen from outside.
bool is_outward(const narrowphase::ClusteredMesh& mesh);
// Whether it is negative by more than its rounding; where it vanishes, the mesh is neither.
bool is_inside_out(const narrowphase::ClusteredMesh& mesh);

}  // namespace tact
