// Which facets of a mesh are still there when its vertices and facets have changed, and an order of the new ones that
// leaves the others in their clusters: grouping is mended where facets changed, not made anew.
#pragma once

#include <span>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// A mesh as it is to be: in the numbers that the caller gives to its vertices and facets from now on.
struct ChangedMesh {
  std::span<const int> facets;      ///< 3 x F
  std::span<const int> vertex_was;  ///< of each vertex: the one that it was, by the caller's number; -1: none
  std::span<const int> vertex_now;  ///< of each vertex that was, by the caller's number: the one that keeps its name,
                                    ///< or -1
};

struct FacetsNow {
  std::vector<int> number;  ///< of each facet, by the mesh's number: the caller's new one; -1: it is gone
  std::vector<int> turned;  ///< facets, by the mesh's numbers, whose corners stand in another order now
  std::vector<char> known;  ///< of each new facet: whether it was there
};

/// A facet is still there if its three vertices keep their names and one has them, in whatever order. Of several with
/// the same vertices, each is another one.
FacetsNow facets_now(const ClusteredMesh& mesh, const ChangedMesh& now);

/// The new facets in the order in which clusters take them. A facet that is still there keeps its place; a new one
/// takes that of a facet that is gone, of the same number or in the cluster of one of its vertices; the others come
/// last. Empty if so few are still there that they are better grouped from scratch.
std::vector<int> mended_order(const ClusteredMesh& mesh, const ChangedMesh& now, const FacetsNow& facets);

}  // namespace tact::narrowphase
