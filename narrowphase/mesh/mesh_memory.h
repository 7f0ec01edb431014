// The memory of a mesh and how it is laid out. A mesh begins with memory of its own, in one block. Many small meshes
// that are refitted together are better packed, each kind of part in one piece: the hardware then foresees what is
// read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "narrowphase/mesh/facet_order.h"

namespace tact::narrowphase {

inline constexpr int kGroupSize = 32;  ///< clusters in a group, at most: neighbours, with a box of their own

/// The counts from which all sizes follow.
struct MeshCounts {
  int source_vertices = 0;
  int vertices = 0;  ///< those that some facet uses
  int facets = 0;
  int borrowed = 0;  ///< vertices, over all clusters: see MeshTopology
  int unused = 0;    ///< source vertices that no facet uses
  int clusters() const { return (facets + kClusterSize - 1) / kClusterSize; }
  int groups() const { return (clusters() + kGroupSize - 1) / kGroupSize; }
};

/// The parts of a mesh's memory: two placements (see MeshPlacements), what a refit reads besides, and the rest.
struct MeshMemory {
  double* placement[2];
  int* indices;
  std::byte* rest;  ///< begins where an int may
};
struct MeshMemorySize {
  std::size_t placement;  ///< doubles, of each
  std::size_t indices;    ///< ints
  std::size_t rest;       ///< bytes
};
MeshMemorySize memory_size(const MeshCounts& counts);

/// The arrays of which `indices` and `rest` are made; see MeshTopology.
struct MeshArrays {
  int* ranges;
  int* source_vertices;
  int* borrowed_sources;
  int* unused_sources;  // here `rest` begins
  int* borrowed;
  int* source_facet;
  int* facet_of_source;
  std::uint8_t* corner;  ///< the first corners of all facets, then the second, then the third
};
MeshArrays arrays_in(const MeshMemory& memory, const MeshCounts& counts);

/// The arrays of which a placement is made, lower and upper bounds as in a BoxView.
struct PlacementArrays {
  double* x;
  double* y;
  double* z;
  double* cluster_boxes;
  double* group_boxes;
};
PlacementArrays arrays_in(double* placement, const MeshCounts& counts);

/// Memory for a mesh alone, all zero.
struct OwnMemory {
  std::unique_ptr<std::byte[]> block;
  MeshMemory parts;
};
OwnMemory own_memory(const MeshCounts& counts);

}  // namespace tact::narrowphase
