// Two bodies are apart if they are along some direction. Along the diagonals of a cube's faces that costs a sum of two
// coordinates a vertex to know and a comparison a pair, and needs no search: the slabs that an 18-DOP has beside those
// of a box (Klosowski et al., "Efficient collision detection using bounding volume hierarchies of k-DOPs", 1998).
//
// It is certain: rounding a sum never changes an order, so sums that differ when rounded differed before.
#pragma once

#include "engine/base/vec3.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// How far the vertices, of which there must be one, reach along the diagonals.
DiagonalBounds kdop_of(const ClusteredMesh& mesh);

// Which diagonal parts two bodies: 1 and up along it, -1 and down against it, 0 if none does.
using PartingDiagonal = std::int8_t;

// The one along which `a` lies below `b`, with the widest gap; of equal gaps the first.
PartingDiagonal parting_diagonal(const DiagonalBounds& a, const DiagonalBounds& b);

// Does it part them?
inline bool parts(PartingDiagonal parting, const DiagonalBounds& a, const DiagonalBounds& b) {
  return parting > 0 ? a.upper[parting - 1] < b.lower[parting - 1]
                     : parting < 0 && b.upper[-parting - 1] < a.lower[-parting - 1];
}

// The unit vector along a diagonal that parts: from a to b.
base::Vec3 direction_of(PartingDiagonal parting);

}  // namespace tact::narrowphase
