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
#include <utility>
#include <vector>

#include "narrowphase/contact_points/feature_point.h"
#include "narrowphase/crossing/cut.h"

namespace tact::narrowphase {

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
  int line_of(int source_facet) const { return node(source_facet).line; }
  /// 1 or -1, for the two layers; 0 where it meets its own.
  double layer_of(int source_facet) const;
  std::size_t count() const { return is_mixed_.size(); }

 private:
  struct Node {
    int facet, first_link;
    int line = -1;
    double layer = 0.0;
  };
  const Node& node(int source_facet) const;

  std::vector<std::pair<int, int>> links_;  // the pairs, both ways, sorted
  std::vector<Node> nodes_;                 // of the facets that meet others, sorted
  std::vector<int> next_;
  std::vector<char> is_mixed_;  // of each line: its layers meet themselves
};

/// Buffers are reused.
class CrossingSides {
 public:
  /// `last` are the points of the last step, which stay as long as this is used. Every hit is of one of the `pairs`.
  void find(const ScaledMesh& mesh, SurfaceKind surface, std::span<const FacetPair> pairs,
            std::span<const FeaturePoint> last, std::span<const EdgeHit> hits);
  /// Of each hit: to which side of the facet the edge belongs, a unit vector; zero where nothing tells.
  std::span<const Vec3> sides() const { return sides_; }
  const LastPoints& last_points() const { return last_; }

 private:
  void find_of_sheet(const ScaledMesh& mesh, std::span<const FacetPair> pairs, std::span<const EdgeHit> hits);
  void turn_guesses(const ScaledMesh& mesh, std::span<const EdgeHit> hits);

  LastPoints last_;
  CrossingLines lines_;
  std::vector<Vec3> sides_, guesses_, of_lines_, guesses_of_lines_;
  std::vector<std::tuple<int, bool, int>> ends_;  // line, is the vertex past it, vertex
  std::vector<int> more_past_;                    // of each line: vertices past it minus the others
};

/// The unit normal of a facet by the caller's number, zero if it has no area.
Vec3 unit_normal_of_source(const ScaledMesh& mesh, int source_facet);
/// Its corners, likewise.
std::array<int, 3> source_corners(const ClusteredMesh& mesh, int source_facet);
/// How high the ends of the edge are above the facet that it meets, times the length of `normal`, which is the facet's.
std::array<double, 2> heights_of_ends(const ScaledMesh& mesh, const EdgeHit& hit, Vec3 normal);

}  // namespace tact::narrowphase
