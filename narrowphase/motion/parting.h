// Whether features that touch go on into each other, or part, or go along: decided by exact signs.
//
// Surfaces do not cross around two features as long as there is a plane with what has the one feature on one side of
// it, and what has the other on the other side; both may touch the plane. For an edge that begins to cross a facet does
// so at a vertex of its own, or at a side of the facet: then the facets around these two features are on both sides of
// each plane. Planes are those of facets around the features, or along both edges: they move as their vertices do, and
// the gap of a vertex over them is told by exact signs: height_signs.h.
// Surfaces with vertices at equal places, as the walls of a cut, are looked at in another way before: opening_walls.h.
#pragma once

#include <tact/feature_pair.h>

#include <cstddef>
#include <vector>

#include "narrowphase/motion/height_signs.h"
#include "narrowphase/motion/moving_mesh.h"
#include "narrowphase/motion/moving_way.h"

namespace tact::narrowphase {

/// What is known of the planes between two features from where they begin alone, whatever way they go: nothing; that no
/// plane has a vertex of both in it and a side for each; or that none has a side for each.
enum class PlanesAtBegin : unsigned char { unknown, none_to_slide_along, none };

/// One for each thread; its memory is reused.
class PartingSearch {
 public:
  /// Features of two meshes, or of one, which come near at `time`: until when the surfaces around them certainly do not
  /// cross there, though they touch. Zero if nothing is known. If `time` is zero, a time until which they are on two
  /// sides of a plane. Later, 1 if both have a vertex in such a plane all the time: they slide along it. `planes` is
  /// what is known of them, and gets what was found.
  double apart_until(const MovingMesh& a, const MovingMesh& b, FeaturePair kind, int feature_a, int feature_b,
                     double time, PlanesAtBegin& planes);

 private:
  // What has a feature.
  struct Star {
    std::vector<MovingVertex> vertices;  // its own come first
    std::size_t own = 0;
    bool is_border = false;  // of an edge: it has one facet
  };
  // A plane, or two parallel ones, one for each star: through its base, along u and v.
  struct Plane {
    MovingWay u, v;
    MovingVertex base_a, base_b;
  };
  // A way from the base of a plane to a vertex that doubles do not tell all signs of.
  struct OpenWay {
    MovingWay way;
    std::size_t side;  // 0: of a_
    bool may_be_own_in_plane;
    MovingNormal::Signs signs;
  };

  void take_vertex(const MovingMesh& mesh, int vertex, Star& star);
  void take_edge(const MovingMesh& mesh, int edge, Star& star);
  void take_facet(const MovingMesh& mesh, int facet, Star& star);
  void add_plane(const MovingVertex& a, const MovingVertex& b, const MovingVertex& c);
  void add_planes_of_vertex(const MovingMesh& mesh, int vertex, const Star& star, bool only_one);
  void add_planes_of_edges(bool only_facets);
  void add(const Plane& plane);
  bool begins_on_both_sides(const Plane& plane) const;
  bool separates(const Plane& plane, int halvings);

  Star a_, b_;
  bool own_in_plane_ = false;  // whether that is asked of each star
  std::vector<Plane> planes_;
  std::vector<OpenWay> open_;   // scratch
  std::vector<int> neighbors_;  // the same
};

}  // namespace tact::narrowphase
