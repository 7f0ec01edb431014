// A mesh in a unit of length in which distances neither vanish nor overflow.
#pragma once

#include "narrowphase/contact_points/features.h"
#include "narrowphase/contact_points/nearest.h"

namespace tact::narrowphase {

struct ScaledMesh {
  const ClusteredMesh& mesh;
  const Features& features;
  double scale;  // a power of two

  Vec3 position(int vertex) const { return scale * mesh.position(vertex); }
  ScaledVertices around(std::span<const int> vertices) const { return {mesh.points(), vertices, scale}; }
};

}  // namespace tact::narrowphase
