// The vertex of a mesh that is farthest in a direction: boxes of groups first, then of clusters, then only the clusters
// that can hold it.
#pragma once

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

// A farthest vertex.
struct Support {
  int vertex = -1;      // of equal ones, the one with the lowest source vertex
  double height = 0.0;  // n · (position - origin) as computed: ((n.x * dx + n.y * dy) + n.z * dz)
};

// The corner of each box that lies farthest along n.
PointArrays far_corners(BoxView boxes, Vec3 n);

// The vertex of `mesh` with the largest n · (position - origin). The mesh must have a facet. `near`, a vertex or -1,
// shortens the search if it is high itself, and changes nothing else. The answer is that of support_by_full_scan bit
// for bit: rounding is monotone, and the bound from a box is computed in the same order of operations, so it is never
// below the height of a vertex in the box.
Support support(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, int near = -1);
Support support_by_full_scan(const ClusteredMesh& mesh, Vec3 n, Vec3 origin);

// True if every vertex is lower than `height`.
bool stays_below(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, double height);

// The vertices whose computed height n · (position - origin) is at least `height`, by cluster. Replaces the contents of
// `found`.
void select_vertices(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, double height, std::vector<std::int32_t>& found);

}  // namespace tact::narrowphase
