// Contact points of what crosses: their gaps are negative. Each kind of point has one rule, for two bodies and for one
// with itself; where these differ, the function says so by its name.
//
// Vertices. Each vertex past the other surface that has an exit has one point: the way to it, negative. Of two bodies
// it has no other points. Of one mesh it keeps those near points whose normals lead away from its exit: they are of
// other parts.
//
// Edges that have passed each other. The facets at either lie as in nearest.h, seen along the normal, but the closest
// points have changed places; and the normal is along the exits of their ends, or else of two bodies the direction
// that their crossing keeps, see kept_directions.h, or the contact direction; of one mesh the sides of
// crossing_sides.h. There is a point, however deep, if one of the edges meets a facet that has the other. Two edges
// within the reach have it instead of their near point if
//   - of two bodies, one of them goes on past the other surface, or meets it and has the near point inside it;
//   - of one mesh, the near point is on a piece of one of them that is past the mesh, between a vertex and where the
//     edge meets something, and is not led away from the exits of that edge.
// Where facets lie level with the edges, as in a box on a floor, edges that go on inside so keep the point that they
// had outside.
//
// Edges through a closed body, both ends outside. One that has no such point has one with the nearest edge of the body
// for which its closest point is inside, if there is one.
//
// A crossing of two bodies, see crossing_groups.h, that has no such point has those of way_apart.h.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "narrowphase/contact_points/waiting_edges.h"
#include "narrowphase/crossing/crossing_groups.h"
#include "narrowphase/crossing/edge_through.h"
#include "narrowphase/crossing/kept_directions.h"
#include "narrowphase/crossing/way_apart.h"
#include "narrowphase/distance/surface_distance.h"

namespace tact::narrowphase {

/// Of one mesh: whether a way along `normal`, from a vertex to a part of the mesh near it, leads back through the mesh.
bool leads_back(const Crossing& crossing, int source_vertex, Vec3 normal);

/// The point of two edges of which the point within the reach is `near`: that, or that of edges that have passed each
/// other. None if they have passed each other and have no such point, or one that CrossingPoints::append() makes.
std::optional<FeaturePoint> point_of_near_edges(const Crossing& crossing, const FeaturePoint& near, SurfaceWays& ways);

/// Buffers are reused.
class CrossingPoints {
 public:
  /// Appends the points that do not begin with near features. `found` holds those of near features.
  void append(const Crossing& crossing, std::vector<FeaturePoint>& found);

 private:
  using EdgePair = std::pair<int, int>;  // of a and of b

  template <class Visit>
  void filter(const Crossing& crossing, EdgePair edges, const Visit& visit);
  template <class Visit>
  void filter_rest(const Crossing& crossing, const Visit& visit);
  void append_edges(const Crossing& crossing, std::vector<FeaturePoint>& found);
  void append_edges_through(const Crossing& crossing, const CrossedSurface& own, const CrossedSurface& body,
                            std::vector<FeaturePoint>& found);
  std::optional<FeaturePoint> point_through(const Crossing& crossing, const CrossedSurface& own,
                                            std::span<const EdgeHit> hits, const CrossedSurface& body);

  void append_ways_apart(const Crossing& crossing, std::vector<FeaturePoint>& found);

  CrossingGroups groups_;  // if the crossing has none
  KeptDirections kept_;
  WayApart way_apart_;
  std::vector<char> has_point_;    // of each group
  PartOfSurface part_a_, part_b_;  // of a group
  std::vector<EdgePair> candidates_;
  std::vector<int> with_point_;
  std::vector<EdgePair> touching_;  // edges with a point of gap zero
  WaitingEdges waiting_;
  EdgesBeside beside_;
  SurfaceWays ways_;
};

}  // namespace tact::narrowphase
