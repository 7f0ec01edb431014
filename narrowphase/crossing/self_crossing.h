// Which vertices of a mesh are past a part of it, and their exits.
//
// Of a closed mesh that has no border, those that are inside another part of it, decided exactly (vertex_winding.h):
// what is inside leaves through the parts that its edges, or those of vertices connected to it inside, meet. One that
// touches such a part, as where two faces lie in one plane, leaves through those facets of it that it is behind.
//
// Otherwise a vertex is past a part if it is the end of an edge that meets a facet, and not on the side of
// crossing_sides.h, decided exactly; or if it is connected to such a vertex by an edge that meets nothing, and on the
// same side of the same part. The part is what is connected to that facet, or to the one with the exit of the vertex
// next to it, within the ball around the vertex that just reaches that facet (PartExitFinder): so a layer behind it is
// another part. The exit is the nearest place of the part. A vertex has none if the place is on the border of the mesh
// or on a facet that has the vertex; and, if it is not known to be inside, if points of the last step between the
// vertex and that place tell of the other side, or if place and vertex are too near along the surface to have a
// contact. Of several parts the one counts that is reached by the fewest edges, and of these the nearest.
//
// A sheet has no inside that would end what is past it. So an exit through one is no farther than the longest edge that
// meets a facet is long, which is told as a limit; but farther where points of the last step between the vertex and the
// place tell of this side. The same holds of edges.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "narrowphase/crossing/crossing.h"
#include "narrowphase/crossing/part_exit.h"
#include "narrowphase/crossing/spread_past.h"
#include "narrowphase/crossing/vertex_winding.h"
#include "narrowphase/distance/surface_distance.h"

namespace tact::narrowphase {

/// A mesh that meets itself, in the words of the caller.
struct SelfCrossingInput {
  FeaturedMesh mesh;
  SurfaceKind surface = SurfaceKind::sheet;
  double reach = 0.0;  // metres; zero: only what crosses has points
  std::span<const FacetPair> facet_pairs;
  std::span<const FeaturePoint> last;  // points of the last step
};

/// Of one mesh: what is kept of it depends on its facets alone. Buffers are reused.
class SelfCrossing {
 public:
  /// What `input` refers to stays as long as the crossing is used: until the next call.
  const Crossing& find(const SelfCrossingInput& input);

 private:
  void take_pairs(const SelfCrossingInput& input);
  void append_hits_beside(std::span<const FacetPair> pairs);
  void append_hit_across(int facet, int corner, int other);
  void find_inside();
  double longest_exit() const;
  bool any_too_far() const;
  std::optional<NearestExit> exit_of(const ReachedVertex& reached);
  std::optional<NearestExit> exit_from_inside(const ReachedVertex& reached);

  Crossing crossing_;
  std::vector<FacetPair> pairs_;  // of facets that share no vertex
  std::unique_ptr<PartExitFinder> exits_;
  std::optional<bool> winds_;  // whether the mesh is closed, and has no border
  PredicateCounts counts_;
  std::vector<int> folded_;  // vertices around which the surface crosses itself
  VertexWinding winding_;
  EdgeHitSearch edge_hits_;
  SpreadPast spread_;
  SurfaceWays ways_;
  std::vector<int> too_far_;  // vertices that had an exit longer than `within`, by the caller's numbers
};

}  // namespace tact::narrowphase
