// A mesh takes new positions: one pass over the caller's vertices copies them cluster by cluster, finds all boxes, and
// looks whether any position changed.
#pragma once

#include <limits>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// What became of a mesh: all positions were as before; some used vertex moved; the mesh stays where it was, as some
/// coordinate cannot be taken.
enum class Refit { same, changed, bad };

struct RefitOptions {
  double largest = std::numeric_limits<double>::infinity();  ///< metres: a larger coordinate, or NaN, is bad
  int threads = 1;                                           ///< among which a large mesh is divided
  bool prefetch = true;                                      ///< the positions: pays unless they are in the cache
};

/// positions: 3 x V coordinates in metres, V the caller's vertices. Allocates nothing.
Refit refit(ClusteredMesh& mesh, const double* positions, const RefitOptions& options = {});
/// Undoes a refit() that changed the mesh, right after it: so that of a batch of bodies all move or none.
void undo_refit(ClusteredMesh& mesh);
/// Finds the boxes of the groups of a placement, from those of the clusters.
void find_group_boxes(const ClusteredMesh& mesh, double* placement);
/// Prefetches the memory that refit() reads and writes.
void prefetch_refit(const ClusteredMesh& mesh, const double* positions);
/// The same of place().
void prefetch_place(const ClusteredMesh& mesh);

}  // namespace tact::narrowphase
