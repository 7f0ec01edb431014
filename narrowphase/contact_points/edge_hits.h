// Which edges of two meshes meet which facets of the other one.
#pragma once

#include <tact/facet_pair.h>

#include <compare>
#include <span>
#include <tuple>
#include <vector>

#include "narrowphase/contact_points/features.h"
#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

/// An edge and a facet of the other mesh that share a point, as closed sets, decided exactly.
struct EdgeHit {
  EdgeVertices vertices;  // of the edge, by the caller's numbers, ascending
  int facet = -1;         // of the other mesh, by the caller's number
  int edge = -1;          // as Features counts it

  friend bool operator==(const EdgeHit&, const EdgeHit&) = default;
  friend auto operator<=>(const EdgeHit& x, const EdgeHit& y) {
    return std::tie(x.vertices, x.facet) <=> std::tie(y.vertices, y.facet);
  }
};

/// Memory of the search, used again.
class EdgeHitSearch {
 public:
  /// Takes the facets that meet, by the caller's numbers. Sets what each mesh has, sorted, each once.
  void run(const FeaturedMesh& a, const FeaturedMesh& b, std::span<const FacetPair> pairs, std::vector<EdgeHit>& of_a,
           std::vector<EdgeHit>& of_b);

 private:
  struct MetFacets {
    int facet[2];  // by the meshes' numbers
    FacetPair source;
  };
  void decide(const FeaturedMesh& a, const FeaturedMesh& b, std::vector<EdgeHit>& of_a, std::vector<EdgeHit>& of_b);

  TrianglePairs triangles_;
  MetFacets met_[TrianglePairs::kCapacity] = {};
  PredicateCounts counts_;
};

}  // namespace tact::narrowphase
