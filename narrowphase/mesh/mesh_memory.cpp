#include "narrowphase/mesh/mesh_memory.h"

#include "narrowphase/mesh/box_arrays.h"

namespace tact::narrowphase {

MeshMemorySize memory_size(const MeshCounts& counts) {
  const auto clusters = static_cast<std::size_t>(counts.clusters()), groups = static_cast<std::size_t>(counts.groups());
  const auto vertices = static_cast<std::size_t>(counts.vertices), facets = static_cast<std::size_t>(counts.facets);
  const auto borrowed = static_cast<std::size_t>(counts.borrowed), unused = static_cast<std::size_t>(counts.unused);
  return {.placement = 3 * vertices + 6 * (clusters + groups),
          .indices = 2 * clusters + 2 + vertices + borrowed,
          .rest = (unused + borrowed + 2 * facets) * sizeof(int) + 3 * facets};
}

MeshArrays arrays_in(const MeshMemory& memory, const MeshCounts& counts) {
  MeshArrays arrays;
  arrays.ranges = memory.indices;
  arrays.source_vertices = arrays.ranges + 2 * counts.clusters() + 2;
  arrays.borrowed_sources = arrays.source_vertices + counts.vertices;
  arrays.unused_sources = reinterpret_cast<int*>(memory.rest);
  arrays.borrowed = arrays.unused_sources + counts.unused;
  arrays.source_facet = arrays.borrowed + counts.borrowed;
  arrays.facet_of_source = arrays.source_facet + counts.facets;
  arrays.corner = reinterpret_cast<std::uint8_t*>(arrays.facet_of_source + counts.facets);
  return arrays;
}

PlacementArrays arrays_in(double* placement, const MeshCounts& counts) {
  double* const boxes = placement + 3 * static_cast<std::ptrdiff_t>(counts.vertices);
  return {placement, placement + counts.vertices, placement + 2 * static_cast<std::ptrdiff_t>(counts.vertices), boxes,
          boxes + 6 * static_cast<std::ptrdiff_t>(counts.clusters())};
}

OwnMemory own_memory(const MeshCounts& counts) {
  const MeshMemorySize size = memory_size(counts);
  constexpr std::size_t kEnd = kPadding * sizeof(double);
  const std::size_t placements = 2 * size.placement * sizeof(double) + kEnd;
  OwnMemory own{std::make_unique<std::byte[]>(placements + size.indices * sizeof(int) + size.rest + kEnd), {}};
  double* const first = reinterpret_cast<double*>(own.block.get());
  int* const indices = reinterpret_cast<int*>(own.block.get() + placements);
  own.parts = {{first, first + size.placement}, indices, reinterpret_cast<std::byte*>(indices + size.indices)};
  return own;
}

}  // namespace tact::narrowphase
