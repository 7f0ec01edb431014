// The edges of one mesh that meet the facets of another, and the vertices that lie beyond them.
#pragma once

#include <tact/facet_pair.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/contact_points/edge_hits.h"
#include "narrowphase/mesh/features.h"

namespace tact::narrowphase {

/// A mesh as another one cuts it. Memory is used again.
class Cut {
 public:
  enum class Which { a, b };

  /// Takes the facets that meet, by the caller's numbers; `which` of each pair is of `own`. Its edges that meet facets
  /// are then to be put into edge_hits().
  void begin(const FeaturedMesh& own, std::span<const FacetPair> pairs, Which which);
  std::vector<EdgeHit>& edge_hits() { return hits_; }
  /// After edge_hits() are there: finds where those of a vertex begin.
  void order_hits();
  /// After it: finds the vertices of `own` that are inside the closed mesh `other` or on its surface. Exact: one vertex
  /// of those that hang together is asked, and edges that meet no facet lead to the others. What is looked at is what
  /// is inside, and the corners of facets that meet.
  void find_inside(const FeaturedMesh& own, const ClusteredMesh& other);

  /// Sorted, each once.
  std::span<const EdgeHit> hits() const { return hits_; }
  std::span<const EdgeHit> hits_of(const EdgeVertices& vertices) const;
  bool is_cut(const EdgeVertices& vertices) const { return !hits_of(vertices).empty(); }
  /// Is a vertex, by the caller's number, among inside()?
  bool is_inside(int source_vertex) const { return state_[source_vertex] == kInside; }
  /// What is inside, by the mesh's numbers: what hangs together stands together.
  std::span<const int> inside() const { return inside_; }
  /// The corners of the facets that meet, by the mesh's numbers.
  std::span<const int> ring() const { return ring_; }

  /// Corners of facets that meet are in one patch if a facet joins them, and with them what is inside and hangs
  /// together with them. Counted from 0; negative for other vertices. After number_patches().
  void number_patches();
  int patch_of(int source_vertex) const;
  int patch_count() const { return patch_count_; }

  /// Adds a vertex to inside(): one that is beyond a sheet, reached from another one or, as a corner, from none.
  void add_inside(const FeaturedMesh& own, int vertex, int from_source_vertex);

 private:
  enum State : std::uint8_t { kUnknown, kRing, kOutside, kInside };

  bool is_cut_between(const ClusteredMesh& mesh, int v, int w) const;
  void clear_state(const FeaturedMesh& own);
  State& state(const ClusteredMesh& mesh, int vertex);
  void touch(int source_vertex);
  void join(int source_vertex, int other_source_vertex);
  int root_of(int source_vertex) const;
  void flood_inside(const FeaturedMesh& own, int vertex);
  void flood_outside(const FeaturedMesh& own, int vertex);

  std::vector<EdgeHit> hits_;
  std::vector<int> ring_, inside_, next_;
  std::vector<State> state_;    // by the caller's number, as the next two
  std::vector<int> parent_;     // of sets that are patches; -1: in none
  std::vector<int> patch_;      // of roots
  std::vector<int> first_hit_;  // of the edges that have the vertex as their first one; -1: none
  std::vector<int> touched_;    // vertices of which these are set
  int patch_count_ = 0;
};

}  // namespace tact::narrowphase
