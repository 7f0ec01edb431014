// Two bodies are separated if they are along some direction. An 18-DOP bounds a body along the three axes and the six
// diagonals of a cube's faces (Klosowski et al., "Efficient collision detection using bounding volume hierarchies of
// k-DOPs", 1998). The axes are those of the boxes; here are the diagonals. They cost a sum of two coordinates a vertex
// and a comparison a pair.
//
// The answer is certain: rounding keeps the order of two sums, so sums that differ when rounded differ in truth.
#pragma once

#include "engine/base/vec3.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// The extent of the vertices, of which there must be one, along the diagonals.
Kdop kdop_of(const ClusteredMesh& mesh);

/// A diagonal that separates two bodies, from a to b: k + 1 along diagonal k of Kdop, -k - 1 against it, 0 for none.
using SeparatingDiagonal = std::int8_t;

/// The diagonal with the widest gap between `a` and `b`; of equal gaps the first.
SeparatingDiagonal separating_diagonal(const Kdop& a, const Kdop& b);

/// True if the diagonal separates them.
inline bool separates(SeparatingDiagonal diagonal, const Kdop& a, const Kdop& b) {
  return diagonal > 0 ? a.upper[diagonal - 1] < b.lower[diagonal - 1]
                      : diagonal < 0 && b.upper[-diagonal - 1] < a.lower[-diagonal - 1];
}

/// The unit vector from a to b along a diagonal that separates them.
base::Vec3 direction_of(SeparatingDiagonal diagonal);

}  // namespace tact::narrowphase
