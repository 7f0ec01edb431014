#include "narrowphase/mesh/mesh_topology.h"

#include <algorithm>
#include <cstddef>

namespace tact::narrowphase {

MeshTopology::MeshTopology(const MeshMemory& memory, const MeshCounts& counts) : counts_(counts) {
  const MeshArrays arrays = arrays_in(memory, counts);
  ranges_ = arrays.ranges;
  unused_sources_ = arrays.unused_sources;
  borrowed_ = arrays.borrowed;
  source_facet_ = arrays.source_facet;
  corner_ = arrays.corner;
}

void MeshTopology::move_to(const MeshMemory& memory) {
  const MeshMemorySize size = memory_size(counts_);
  std::copy_n(ranges_, size.indices, memory.indices);
  std::copy_n(reinterpret_cast<const std::byte*>(unused_sources_), size.rest, memory.rest);
  *this = MeshTopology(memory, counts_);
}

ClusterFacets MeshTopology::facets_of(int cluster, const PointArrays& points) const {
  const int first = facet_begin(cluster);
  const int *here = ranges_ + 2 * cluster, *next = here + 2;
  const std::uint8_t* const corner = corner_ + first;
  return {.points = points,
          .owned_begin = here[0],
          .owned_count = next[0] - here[0],
          .borrowed = borrowed_ + here[1],
          .borrowed_count = next[1] - here[1],
          .corner = {corner, corner + counts_.facets, corner + 2 * static_cast<std::ptrdiff_t>(counts_.facets)},
          .facet_begin = first,
          .facet_count = facet_end(cluster) - first};
}

Corners MeshTopology::corners(int facet) const {
  const ClusterFacets cluster = facets_of(facet / kClusterSize, {});
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const int local = cluster.corner[k][facet % kClusterSize];
    corners[k] =
        local < cluster.owned_count ? cluster.owned_begin + local : cluster.borrowed[local - cluster.owned_count];
  }
  return corners;
}

}  // namespace tact::narrowphase
