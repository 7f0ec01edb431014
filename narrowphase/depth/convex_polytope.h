// The convex hull of points that arrive one by one, as a closed surface of triangles with their neighbours.
//
// Exact predicates decide which faces a new point sees; it does not see a face in whose plane it lies. So the faces
// that it sees form one patch without holes, the border of the patch is one closed line, and every new face has area.
// The surface is closed and convex at all times, in exact arithmetic, whatever the points. Faces may lie in one plane.
#pragma once

#include <array>
#include <vector>

#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

class ConvexPolytope {
 public:
  struct Face {
    std::array<int, 3> corner;    // points, counter-clockwise from outside
    std::array<int, 3> neighbor;  // the face across the side from corner[k] to corner[(k + 1) % 3]
    bool removed = false;
  };

  // The tetrahedron of four points that do not lie in one plane, in any order.
  explicit ConvexPolytope(const std::array<Vec3, 4>& points) { restart(points); }
  // Nothing, until restart().
  ConvexPolytope() = default;
  // Begins again with a tetrahedron, and keeps the memory.
  void restart(const std::array<Vec3, 4>& points);

  // Faces keep their numbers; those that a point has covered are marked as removed.
  const std::vector<Face>& faces() const { return faces_; }
  Vec3 corner(int face, int k) const;

  // True if p lies strictly outside the plane of `face`.
  bool is_beyond(int face, Vec3 p) const;
  // The first face that p lies beyond, or -1 if p is in the polytope.
  int face_below(Vec3 p) const;

  // Adds p, which lies beyond `face`: the faces that it lies beyond are removed and new ones, which all have p as their
  // last corner, are appended to faces(). Returns the first of them.
  int expand(int face, Vec3 p);

  // Throws std::logic_error that says what is broken: neighbours agree, the surface is one closed sphere, and no point
  // lies beyond a face. For tests.
  void validate() const;

 private:
  struct BorderSide {
    int from;     // a point
    int to;       // a point
    int outside;  // the face across, which stays
  };

  void remove_seen_from(Vec3 p, int face);

  std::vector<Vec3> points_;
  std::vector<Face> faces_;
  std::vector<BorderSide> border_;  // of the patch that is being replaced
  std::vector<int> stack_;          // of faces
  std::vector<int> face_from_;      // of each point on the border: the new face whose side starts there
  mutable PredicateCounts counts_;
};

}  // namespace tact::narrowphase
