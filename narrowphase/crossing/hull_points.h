// Points as a mesh: searches that see a body through its convex hull alone take meshes.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// One mesh for each power of two of points, made once and moved from then on: whoever takes no more points than
/// before allocates nothing.
class HullPoints {
 public:
  /// A mesh with a facet of no area at each point; vertex i, by the caller's number, is at points[i]. There is at least
  /// one point. Valid until the next call.
  const ClusteredMesh& mesh(std::span<const Vec3> points);

 private:
  std::array<std::unique_ptr<ClusteredMesh>, 32> meshes_;
  std::vector<double> positions_;
};

}  // namespace tact::narrowphase
