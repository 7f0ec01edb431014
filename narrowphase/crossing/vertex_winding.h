// Which vertices of a closed mesh are inside another part of it.
#pragma once

#include <vector>

#include "narrowphase/contact_points/scaled_mesh.h"
#include "narrowphase/numeric/predicates.h"
#include "narrowphase/queries/mesh_queries.h"

namespace tact::narrowphase {

/// Whether the facets at each edge run along it as often one way as the other: then the mesh winds around each point a
/// whole number of times.
bool is_closed(const FeaturedMesh& mesh);

/// Buffers are reused.
class VertexWinding {
 public:
  /// Whether a closed mesh winds more than once around what is just inside of `vertex`, by the mesh's number: another
  /// part of it is there, too. `outward` leads out of the vertex's own part. Exact: a half-line against it, turned a
  /// little where it meets an edge, counts the facets through which it leaves minus those through which it enters.
  bool is_inside(const ScaledMesh& mesh, int vertex, Vec3 outward);

 private:
  enum class Side { inside, outside, undecided };
  Side look_along(const ScaledMesh& mesh, int vertex, Vec3 direction);

  std::vector<FacetHit> hits_;
  PredicateCounts counts_;
};

}  // namespace tact::narrowphase
