#include "narrowphase/crossing/hull_points.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>

#include "narrowphase/mesh/refit.h"

namespace tact::narrowphase {

namespace {

constexpr std::size_t kFewest = 64;  // the facets of a cluster

// All of them at the origin.
std::unique_ptr<ClusteredMesh> mesh_of(std::size_t count) {
  std::vector<int> order(count), facets;
  std::iota(order.begin(), order.end(), 0);
  for (const int vertex : order) facets.insert(facets.end(), 3, vertex);
  return std::make_unique<ClusteredMesh>(std::vector<double>(3 * count), facets, order);
}

}  // namespace

// The vertices that are too many stand where the first one is: of equally far ones that with the least number counts.
const ClusteredMesh& HullPoints::mesh(std::span<const Vec3> points) {
  const std::size_t count = std::bit_ceil(std::max(points.size(), kFewest));
  std::unique_ptr<ClusteredMesh>& mesh = meshes_[static_cast<std::size_t>(std::countr_zero(count))];
  if (mesh == nullptr) mesh = mesh_of(count);
  positions_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 at = points[i < points.size() ? i : 0];
    positions_.insert(positions_.end(), {at.x, at.y, at.z});
  }
  refit(*mesh, positions_.data(), {.prefetch = false});
  return *mesh;
}

}  // namespace tact::narrowphase
