// Volume and surface of what two closed meshes have in common.
#pragma once

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// A mesh whose facets wind around each point a whole number of times.
struct ClosedMesh {
  const ClusteredMesh* mesh = nullptr;
  bool is_outward = true;  // its facets are counter-clockwise seen from outside
};

struct OverlapSize {
  double volume = 0.0;  // cubic metres
  double area = 0.0;    // square metres
};

/// Sums over the facets of both of the part that is inside the other. That part is not constructed: its area, as a
/// vector, is an integral along its border, of which each piece is known by itself. These are the segments that the
/// facet has in common with the other mesh's, and the parts of its edges around which the other one winds. What is
/// where is decided by PerturbedSigns: what only touches is apart. A place that a mesh winds around twice counts twice.
OverlapSize overlap_size(const ClosedMesh& a, const ClosedMesh& b);

}  // namespace tact::narrowphase
