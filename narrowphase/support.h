// The vertex of a mesh that is farthest in a direction: cluster boxes first, then only the clusters that can hold it.
#pragma once

#include "narrowphase/clustered_mesh.h"

namespace tact::narrowphase {

// A farthest vertex.
struct Support {
  int vertex = -1;      // of equal ones, the one with the lowest source vertex
  int cluster = 0;      // that owns it
  double height = 0.0;  // n · (position - origin) as computed: ((n.x * dx + n.y * dy) + n.z * dz)
};

// The corner of each box that lies farthest along n.
PointArrays far_corners(const BoxArrays& boxes, Vec3 n);

// The vertex of `mesh` with the largest n · (position - origin). The mesh must have a facet. Bit for bit the answer of
// support_by_full_scan: rounding is monotone, so the bound from a box, computed in the same order of operations, is never
// below the height of a vertex in it. Where there are many clusters, `first_cluster` is opened
// first: any is right, the one of the last answer is fast.
Support support(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, int first_cluster = 0);
Support support_by_full_scan(const ClusteredMesh& mesh, Vec3 n, Vec3 origin);

}  // namespace tact::narrowphase
