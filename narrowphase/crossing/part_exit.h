// The facets around each vertex of a mesh, and the nearest exit through one part of a surface: facets that are
// connected.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "narrowphase/crossing/nearest_exit.h"

namespace tact::narrowphase {

/// By the caller's numbers, which stay when facets are grouped from scratch.
class FacetsAround {
 public:
  explicit FacetsAround(const ClusteredMesh& mesh);
  std::span<const int> operator[](int source_vertex) const;

 private:
  std::vector<int> facets_, begin_;
};

/// Buffers are reused.
class PartExitFinder {
 public:
  explicit PartExitFinder(const ClusteredMesh& mesh) : around_(mesh) {}

  /// From `vertex`, by the mesh's number: the nearest place in those facets that are connected to the facet `from` by
  /// common vertices, no farther from the vertex than that one and without it as a corner. Of the facets that have the
  /// place the one with the caller's least number. None if `from` has no area or has the vertex.
  std::optional<NearestExit> find(const ScaledMesh& mesh, int vertex, int from);
  /// The same in those of these facets alone that the vertex is behind, and does not touch.
  std::optional<NearestExit> find_behind(const ScaledMesh& mesh, int vertex, int from);
  const FacetsAround& around() const { return around_; }

  /// The normal of the surface at an exit: that of the facet; at an edge the sum of its facets' unit normals, in a
  /// vertex that of all around it, by their angles there, so that the vertex is on the side of the surface on which it
  /// is along that sum (Baerentzen and Aanaes, 2005). Not unit; zero on the border.
  Vec3 normal_at(const ScaledMesh& mesh, const NearestExit& exit) const;
  /// Whether the exit of `vertex` is on a facet with that vertex.
  bool is_beside(const ClusteredMesh& mesh, int vertex, const NearestExit& exit) const;

 private:
  int facet_at(const ScaledMesh& mesh, const NearestExit& exit) const;
  template <class Counts>
  std::optional<NearestExit> find(const ScaledMesh& mesh, int vertex, int from, const Counts& counts);

  FacetsAround around_;
  std::vector<char> seen_;    // by the caller's number
  std::vector<int> reached_;  // the vertices that are set in seen_
  std::vector<int> spread_;
};

}  // namespace tact::narrowphase
