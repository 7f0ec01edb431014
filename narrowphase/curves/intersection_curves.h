// The curves in which two surfaces cross, or one crosses itself, out of the facet pairs that meet.
//
// Two facets that cross have a segment in common. Each of its ends is where an edge of one goes through the other; the
// other facet with that edge goes on from there. So segments follow each other by the edge and the facet of their ends,
// and no place is compared. Which edges go through which facets is told by PerturbedSigns: a segment has two ends,
// always.
//
// A curve is closed, or ends on an edge of one facet or of three and more, or at a common vertex of two facets of one
// mesh, which has no edge through it. Facets that name a vertex twice have no segment. Curves of one mesh also end at
// facets without area, which are no pair with facets that they touch in a common vertex.
#pragma once

#include <tact/facet_pair.h>

#include <array>
#include <compare>
#include <span>
#include <vector>

#include "narrowphase/curves/perturbed_signs.h"

namespace tact::narrowphase {

/// An edge of one mesh through a facet of the other one, by the caller's numbers; or a common vertex of two facets.
struct CurveNode {
  std::array<int, 2> edge{-1, -1};  // ascending; the second is -1 at a vertex
  int facet = -1;                   // -1 at a vertex
  bool edge_of_b = false;
  friend auto operator<=>(const CurveNode&, const CurveNode&) = default;
};

/// A corner of a curve.
struct CurveCorner {
  CurveNode node;
  Vec3 position;          // metres, the exact place rounded once
  double fraction = 0.0;  // how far along the edge
  int pair = -1;          // the facet pair that leads on to the next corner; -1: none does
};

/// Corners begin <= i < end of all.
struct CurveRange {
  std::size_t begin = 0, end = 0;
  bool closed = false;
};

/// Buffers are reused.
class IntersectionCurves {
 public:
  /// Of two meshes, or of one that is given twice, whose facets meet in these pairs, sorted, by the caller's numbers.
  /// `apart` leads from a to b.
  void find(const ClusteredMesh& a, const ClusteredMesh& b, std::span<const FacetPair> pairs, Vec3 apart);

  /// Valid until the next find(): sorted by the first facet pair of each curve.
  std::span<const CurveRange> curves() const { return curves_; }
  std::span<const CurveCorner> corners() const { return corners_; }

 private:
  // What two facets have in common: from one node to the other, along the normal of a's times that of b's.
  struct Segment {
    int pair = -1;
    std::array<CurveNode, 2> end;
    std::array<int, 2> next{-1, -1};  // at each end: twice the segment that follows, and which of its ends it is
  };
  struct NodeOfSegment {
    CurveNode node;
    int segment_end = -1;  // as in `next`
    friend auto operator<=>(const NodeOfSegment&, const NodeOfSegment&) = default;
  };

  void find_segment(const ClusteredMesh& a, const ClusteredMesh& b, const FacetPair& pair, int number);
  void link();
  void walk(const ClusteredMesh& a, const ClusteredMesh& b, std::span<const FacetPair> pairs);
  void append_corner(const ClusteredMesh& a, const ClusteredMesh& b, const FacetPair& facets, const CurveNode& node,
                     int pair);

  PerturbedSigns signs_;
  std::vector<Segment> segments_;
  std::vector<NodeOfSegment> nodes_;
  std::vector<char> walked_;
  std::vector<CurveRange> curves_;
  std::vector<CurveCorner> corners_;
};

}  // namespace tact::narrowphase
