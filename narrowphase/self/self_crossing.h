// Contact points where a mesh crosses itself: their gaps are negative. crossing.h says the same of two meshes.
//
// A vertex has one point if it is on the wrong side of a part of the mesh: at the end of an edge that meets a facet,
// where that end is not on the side of crossing_sides.h, decided exactly; or next to such a vertex, by an edge that
// meets nothing, and on the same side of the same part. The part is what hangs together with that facet, or with the
// one that the vertex next to it was led to, within the ball around the vertex that just reaches that facet
// (NearestAround): so a layer behind it is another part. The point leads to the nearest place of the part. There is
// none if the place is on the border of the mesh or on a facet that has the vertex, if points of the last step between
// the vertex and that place tell of the other side, or if place and vertex are too near along the surface to have a
// contact. Of several parts the vertex takes the one that is reached by the fewest edges, and of these the nearest.
//
// A sheet has no inside that would end what is beyond it. So a way through one is no longer than the longest edge that
// meets a facet; but longer where points of the last step between the vertex and the place tell of this side. The same
// holds of edges.
//
// Points that were found within the reach go, or change their sign, where they lead back through the mesh: those of
// such a vertex whose normals do not point away from its way out; those of edges of which a piece beyond what it meets,
// or the whole if it meets nothing, holds the point, if they do not point away from the ways out of its ends.
//
// Two edges that have passed each other have a point as in crossing.h: if one meets a facet of the other, or if they
// had a point within the reach that has gone.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "narrowphase/contact_points/vertex_places.h"
#include "narrowphase/distance/surface_distance.h"
#include "narrowphase/self/crossing_sides.h"
#include "narrowphase/self/facets_around.h"

namespace tact::narrowphase {

/// Of one mesh: what is kept of it depends on its facets alone. Memory is used again.
class SelfCrossing {
 public:
  /// Takes the points that ContactPointSearch has found within the reach, all of them; changes those of what has
  /// crossed, takes out the ones that are none, and appends the others.
  void run(const SelfCrossingInput& input, std::vector<FeaturePoint>& found);

 private:
  struct Reached {
    int source_vertex;
    int vertex, from;  // by the mesh's numbers; `from` is a facet of the part
    Vec3 side;         // on which it belongs
  };
  struct Crossed {
    int source_vertex;
    WayOut way;
  };
  /// Two edges by number, the one with the lesser vertices first.
  struct EdgePair {
    int first, second;
    friend auto operator<=>(const EdgePair&, const EdgePair&) = default;
  };

  void begin(const SelfCrossingInput& input);
  double limit() const;
  ScaledMesh mesh() const { return {*input_.mesh.mesh, *input_.mesh.features, scale_}; }
  EdgeVertices source_ends(int edge) const;
  EdgePair edge_pair(int edge, int other_edge) const;
  std::span<const EdgeHit> hits_of(const EdgeVertices& vertices) const;

  void find_crossed();
  void reach_from_hits();
  void take_reached();
  void spread();
  std::optional<WayOut> way_out(const Reached& reached);
  const Crossed* crossed(int source_vertex) const;
  bool along_surface(std::span<const int> from, Vec3 from_point, std::span<const int> to, Vec3 to_point);

  void drop_vertex_points(std::vector<FeaturePoint>& found) const;
  void sign_edges(std::vector<FeaturePoint>& found);
  void append_edges(std::vector<FeaturePoint>& found);
  void append_vertices(std::vector<FeaturePoint>& found) const;
  Vec3 way_back(int edge) const;
  bool is_on_crossed_piece(int edge, double place) const;
  bool meets_beside(int edge, int other_edge) const;
  bool have_passed(const FeaturePoint& point) const;
  Vec3 sides_of(const EdgePair& edges) const;
  std::optional<FeaturePoint> passed_point(const EdgePair& edges);

  SelfCrossingInput input_;
  double scale_ = 1.0, limit_ = 0.0;  // scaled
  std::unique_ptr<NearestAround> nearest_;
  EdgeHitSearch edge_hits_;
  std::vector<EdgeHit> hits_, hits_of_second_;  // sorted, each once
  CrossingSides sides_;
  std::vector<Reached> reached_, next_;
  std::vector<Crossed> crossed_;  // in the order in which they were reached
  VertexPlaces crossed_at_;       // in that list
  std::vector<EdgePair> known_, candidates_;
  SurfaceWays ways_;
};

}  // namespace tact::narrowphase
