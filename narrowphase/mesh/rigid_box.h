// The box of a rigid mesh at a pose, without its vertices being placed.
#pragma once

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// The box of all facets of a rigid mesh at a pose, bit for bit as place_at() finds it; empty if there is none. Looks
/// at the vertices of the few clusters that reach farthest along each axis.
Box box_at_pose(const ClusteredMesh& mesh, const Pose& pose);

}  // namespace tact::narrowphase
