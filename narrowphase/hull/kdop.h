// Two bodies are separated if they are along some direction. An 18-DOP bounds a body along the three axes and the six
// diagonals of a cube's faces (Klosowski et al., "Efficient collision detection using bounding volume hierarchies of
// k-DOPs", 1998). The axes are those of the boxes; here are the diagonals. They cost a sum of two coordinates a vertex
// and a comparison a pair.
//
// The answer is certain. Rounding keeps the order of two sums: sums that differ when rounded differ in truth. By how
// much they differ is wrong by a roundoff of each, and of the difference; bodies are apart by a distance only with 2^11
// roundoffs of their size to spare, so that GJK, which rounds more often, finds them no nearer.
#pragma once

#include "engine/base/vec3.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// The extent of the vertices, of which there must be one, along the diagonals.
Kdop kdop_of(const ClusteredMesh& mesh);

/// A diagonal that separates two bodies, from a to b: k + 1 along diagonal k of Kdop, -k - 1 against it, 0 for none.
using SeparatingDiagonal = std::int8_t;

/// The diagonal with the widest gap between `a` and `b`, if they are farther apart along it than `reach`, metres; of
/// equal gaps the first.
SeparatingDiagonal separating_diagonal(const Kdop& a, const Kdop& b, double reach);

/// True if they are farther apart along the diagonal than `reach`, metres.
bool separates(SeparatingDiagonal diagonal, const Kdop& a, const Kdop& b, double reach);

/// The unit vector from a to b along a diagonal that separates them.
base::Vec3 direction_of(SeparatingDiagonal diagonal);

}  // namespace tact::narrowphase
