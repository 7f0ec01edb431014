// A mesh of points alone, for what looks at hulls.
#pragma once

#include <span>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::tests {

// A mesh that uses every one of `points` (at least one). Only its hull means anything.
inline narrowphase::ClusteredMesh mesh_through(std::span<const base::Vec3> points) {
  std::vector<double> positions;
  std::vector<int> facets;
  const int count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i) {
    const base::Vec3& p = points[i];
    positions.insert(positions.end(), {p.x, p.y, p.z});
    facets.insert(facets.end(), {i, (i + 1) % count, (i + 2) % count});
  }
  return {positions, facets};
}

}  // namespace tact::tests
