// How one surface is cut by another one: its edges that meet facets, the vertices past the other surface, and the
// patches that both make up.
#pragma once

#include <tact/facet_pair.h>

#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/crossing/edge_hits.h"
#include "narrowphase/mesh/disjoint_sets.h"
#include "narrowphase/mesh/features.h"

namespace tact::narrowphase {

/// Past a closed surface is what is inside it; a sheet has two sides, and what is past it is on the wrong one.
enum class SurfaceKind { closed, sheet };

/// A mesh as another one, or itself, cuts it. Buffers are reused.
class Cut {
 public:
  /// Which facets of each pair are of the mesh.
  enum class Which { a, b, both };

  /// Takes the facets that meet, by the caller's numbers. Its edges that meet facets are then to be put into
  /// edge_hits().
  void begin(const FeaturedMesh& own, std::span<const FacetPair> pairs, Which which);
  std::vector<EdgeHit>& edge_hits() { return hits_; }
  /// After edge_hits() are there: finds where those of a vertex begin.
  void order_hits();
  /// After it: finds the vertices that are inside the closed mesh `other` or on its surface. Exact: one vertex of those
  /// that are connected by edges is tested, and edges that meet no facet lead to the others. What is looked at is what
  /// is inside, and the corners of facets that meet.
  void find_inside(const ClusteredMesh& other);
  /// Makes a vertex, by the mesh's number, none of those that find_past() finds.
  void leave_out(int vertex);
  /// The same where is_past(vertex) decides, of corners of facets that meet and what is connected to them.
  template <class IsPast>
  void find_past(const IsPast& is_past) {
    for (const int v : ring_) {
      if (state(v) != kRing) continue;
      if (is_past(v)) {
        flood_inside(v);
      } else {
        flood_outside(v);
      }
    }
  }
  /// Adds a vertex, by the mesh's number, that is beyond a surface without an inside.
  void add_past(int vertex);
  /// Makes the patches of two vertices, by the caller's numbers, one.
  void join_patches(int source_vertex, int other) { join_sets(parent_, source_vertex, other); }

  /// Sorted, each once.
  std::span<const EdgeHit> hits() const { return hits_; }
  std::span<const EdgeHit> hits_of(const EdgeVertices& source_vertices) const;
  /// Whether an edge meets a facet.
  bool is_cut(const EdgeVertices& source_vertices) const { return !hits_of(source_vertices).empty(); }
  /// The same of the edge between two vertices, by the mesh's numbers.
  bool is_cut_between(int v, int w) const;
  /// Whether a vertex, by the caller's number, is past the other surface.
  bool is_past(int source_vertex) const { return state_[source_vertex] == kPast; }
  /// What is past it, by the mesh's numbers: connected vertices stand together.
  std::span<const int> past() const { return past_; }

  /// Corners of facets that meet are in one patch if a facet joins them, and with them what is past the other surface
  /// and connected to them by edges. Counted from 0; negative for other vertices. After number_patches().
  void number_patches();
  int patch_of(int source_vertex) const;
  int patch_count() const { return patch_count_; }

 private:
  enum State : std::uint8_t { kUnknown, kRing, kOutside, kPast };

  void clear(const FeaturedMesh& own);
  void take_facet(int source_facet);
  State& state(int vertex) { return state_[own_.mesh->source_vertex(vertex)]; }
  void touch(int source_vertex);
  void flood_inside(int vertex);
  void flood_outside(int vertex);

  FeaturedMesh own_;
  std::vector<EdgeHit> hits_;
  std::vector<int> ring_;  // the corners of the facets that meet, by the mesh's numbers
  std::vector<int> past_, next_;
  std::vector<State> state_;    // by the caller's number, as the next two
  std::vector<int> parent_;     // of sets that are patches, see join_sets(); -1: in none
  std::vector<int> patch_;      // of the least of each set
  std::vector<int> first_hit_;  // of the edges that have the vertex as their first one; -1: none
  std::vector<int> touched_;    // vertices of which these are set
  int patch_count_ = 0;
};

}  // namespace tact::narrowphase
