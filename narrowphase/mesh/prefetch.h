// Memory that is used soon is prefetched: a line of the cache, an array, or a part of a mesh.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// Of a long array only so many bytes are prefetched: the hardware then sees what is wanted.
inline constexpr int kPrefetchedBytes = 4096;

// GCC 12 thinks a function that only prefetches has no effect, and leaves out its calls: hence the empty statements.
inline void prefetch_line(const void* line) {
  __builtin_prefetch(line, 0, 3);
  asm volatile("");
}
/// To the second level of the cache: the first has room for few lines under way.
template <class T>
void prefetch_lines(const T* begin, std::size_t count) {
  const auto address = reinterpret_cast<std::uintptr_t>(begin), line = address / 64 * 64;
  const std::size_t size = address - line + std::min<std::size_t>(count * sizeof(T), kPrefetchedBytes);
  for (std::size_t i = 0; i < size; i += 64) __builtin_prefetch(reinterpret_cast<const char*>(line + i), 0, 2);
  asm volatile("");
}
template <class T>
void prefetch_lines(std::span<const T> array) {
  prefetch_lines(array.data(), array.size());
}

/// The facets of a cluster, with the vertices that it owns.
inline void prefetch_facets(const ClusteredMesh& mesh, int cluster) {
  const ClusterFacets facets = mesh.facets_of(cluster);
  const auto owned = static_cast<std::size_t>(facets.owned_count), count = static_cast<std::size_t>(facets.facet_count);
  for (const double* axis : {facets.points.x, facets.points.y, facets.points.z})
    prefetch_lines(axis + facets.owned_begin, owned);
  for (const std::uint8_t* corner : facets.corner) prefetch_lines(corner, count);
  prefetch_lines(facets.borrowed, static_cast<std::size_t>(facets.borrowed_count));
  prefetch_lines(mesh.source_facets_of(cluster), count);
}

inline void prefetch_position(const ClusteredMesh& mesh, int vertex) {
  const PointArrays points = mesh.points();
  for (const double* axis : {points.x, points.y, points.z}) prefetch_line(axis + vertex);
}

/// The positions of all vertices, or of the first thousands.
inline void prefetch_points(const ClusteredMesh& mesh) {
  const PointArrays points = mesh.points();
  for (const double* axis : {points.x, points.y, points.z})
    prefetch_lines(axis, static_cast<std::size_t>(mesh.vertex_count()));
}

/// The boxes of the clusters, and where their vertices begin.
inline void prefetch_boxes(const ClusteredMesh& mesh) {
  const auto clusters = static_cast<std::size_t>(mesh.cluster_count());
  prefetch_lines(mesh.refit_indices().data(), 2 * clusters);
  prefetch_lines(mesh.cluster_boxes().lower(0), 6 * clusters);
}

}  // namespace tact::narrowphase
