// Where a surface crosses itself: on which side of a facet an edge through it belongs.
//
// Of a closed mesh it is the outer side, everywhere. A sheet has no such side. There it is, for an edge and a facet
// that meet,
//   1. the side that points of the last step tell of, those between a feature with an end of the edge and one with a
//      corner of the facet: the sum of their normals; or
//   2. that of the crossing line. Facets that meet, and those that these meet, are one line; on it every facet is of
//      one of two layers, and never meets one of its own. All that 1. tells on a line is added up, as seen from one of
//      its layers; or
//   3. for a line that is new: of each edge and facet the normal of the facet, weighted by how much more of the edge is
//      on its side, is added up likewise. Of the two ways along that sum it is the one on which more ends of edges are:
//      what is inside a closed line goes back.
// A facet that meets facets of its own layer, three layers through each other say, is left to 1. and to its own part
// of 3.
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "narrowphase/contact_points/contact_points.h"
#include "narrowphase/contact_points/crossing.h"
#include "narrowphase/contact_points/edge_hits.h"

namespace tact::narrowphase {

/// A mesh that meets itself, in the words of the caller.
struct SelfCrossingInput {
  FeaturedMesh mesh;
  SurfaceKind surface = SurfaceKind::sheet;
  double reach = 0.0;  // metres; zero: only what crosses has points
  std::span<const FacetPair> facet_pairs;
  std::span<const FeaturePoint> last;  // points of the last step
};

/// Of the mesh with itself: which points of the last step have a vertex.
class LastPoints {
 public:
  void take(std::span<const FeaturePoint> points);
  /// The sum of the normals of the points between a feature with a vertex of `own` and one with a vertex of `other`, by
  /// the caller's numbers, each from `other` to `own`; zero if there is none.
  Vec3 side(std::span<const int> own, std::span<const int> other) const;

 private:
  struct Entry {
    int vertex, point;
    bool is_a;
  };
  std::span<const FeaturePoint> points_;
  std::vector<Entry> entries_;  // sorted by vertex
};

/// The crossing lines of a mesh, and the layer of each facet on one.
class CrossingLines {
 public:
  void find(std::span<const FacetPair> pairs);
  /// Of a facet that meets another, by the caller's number: its line, counted from 0.
  int line_of(int source_facet) const { return node_[place(source_facet)].line; }
  /// 1 or -1, for the two layers; 0 where it meets its own.
  double layer_of(int source_facet) const;
  std::size_t count() const { return count_; }

 private:
  struct Node {
    int parent;
    bool other_layer;  // than the parent
    bool mixed;        // of a root: its layers meet themselves
    int line;
  };
  struct Found {
    int root;
    bool other_layer;
  };
  std::size_t place(int source_facet) const;
  Found root_of(std::size_t place);
  void join(const FacetPair& pair);

  std::vector<int> facets_;  // that meet others, sorted
  std::vector<Node> node_;   // of each
  std::size_t count_ = 0;
};

/// Memory of it, used again.
class CrossingSides {
 public:
  /// `mesh` is that of `input`. Every hit is of a facet pair of it.
  void find(const ScaledMesh& mesh, const SelfCrossingInput& input, std::span<const EdgeHit> hits);
  /// Of each hit: to which side of the facet the edge belongs, a unit vector; zero where nothing tells.
  std::span<const Vec3> sides() const { return sides_; }
  const LastPoints& last_points() const { return last_; }

 private:
  void find_of_sheet(const ScaledMesh& mesh, const SelfCrossingInput& input, std::span<const EdgeHit> hits);

  void turn_guesses(const ScaledMesh& mesh, std::span<const EdgeHit> hits);

  LastPoints last_;
  CrossingLines lines_;
  std::vector<Vec3> sides_, guesses_, of_lines_, guesses_of_lines_;
  std::vector<std::tuple<int, bool, int>> ends_;  // line, has the vertex crossed, vertex
  std::vector<int> more_crossed_;                 // of each line: so many more than have not
};

/// The unit normal of a facet by the caller's number, zero if it has no area.
Vec3 unit_normal_of_source(const ScaledMesh& mesh, int source_facet);
/// Its corners, likewise.
std::array<int, 3> source_corners(const ClusteredMesh& mesh, int source_facet);

}  // namespace tact::narrowphase
