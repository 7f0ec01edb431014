// Which edges of two meshes meet which facets of the other one, or those of one mesh which facets of its own.
#pragma once

#include <tact/facet_pair.h>

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/mesh/features.h"
#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

/// An edge and a facet of the other mesh that share a point, as closed sets, decided exactly.
struct EdgeHit {
  EdgeVertices vertices;  // of the edge, by the caller's numbers, ascending
  int facet = -1;         // of the other mesh, by the caller's number
  int edge = -1;          // as Features counts it

  /// The two vertices as one number, of the same order.
  std::uint64_t key() const {
    return std::uint64_t{static_cast<std::uint32_t>(vertices[0])} << 32 | static_cast<std::uint32_t>(vertices[1]);
  }
  friend bool operator==(const EdgeHit& x, const EdgeHit& y) { return x.key() == y.key() && x.facet == y.facet; }
  friend auto operator<=>(const EdgeHit& x, const EdgeHit& y) {
    return x.key() != y.key() ? x.key() <=> y.key() : x.facet <=> y.facet;
  }
};

/// Buffers are reused.
class EdgeHitSearch {
 public:
  /// Takes the facets that meet, by the caller's numbers. Sets what each mesh has, sorted, each once; of one mesh both
  /// are one list.
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
