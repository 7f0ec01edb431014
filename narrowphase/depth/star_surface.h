// A closed surface of triangles between vertices of M that surrounds the origin, in plain doubles.
//
// Every face looks away from the origin: the origin lies strictly behind its plane. So the projection of the surface
// onto a sphere about the origin turns no face over; it covers every direction equally often, and at least once. All
// points of the surface belong to M. So M reaches at least as far as the nearest of the planes in every direction. That
// plane is farther from the origin than the rounding of any vertex of M, so the true M surrounds the origin as well.
// The surface need not be convex for that, and no exact predicate is needed. Which faces a new vertex replaces is a
// matter of speed; the planes of the new faces tell whether all is well.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "narrowphase/hull/minkowski_difference.h"

namespace tact::narrowphase {

// A surface without coordinates: what a search ended with, and the start of the next one, when the bodies have moved.
struct SurfaceShape {
  static constexpr int kMostFaces = 252;
  static constexpr int kMostVertices = kMostFaces / 2 + 2;  // of a closed surface of so many triangles

  int vertex_count = 0;
  int face_count = 0;                                                    // 0: no surface
  int fresh_face_count = 0;                                              // when it was made from nothing
  std::array<int, kMostVertices> a, b;                                   // each vertex of M as vertices of A and B
  std::array<std::array<std::uint8_t, 3>, kMostFaces> corner, neighbor;  // see StarSurface::Face
};

class StarSurface {
 public:
  struct Face {
    std::array<int, 3> corner;    // vertices, counter-clockwise from outside
    std::array<int, 3> neighbor;  // the face across the side from corner[k] to corner[(k + 1) % 3]
    Vec3 normal;                  // unit, outward
    double distance;              // of the plane from the origin, scaled
    double error;                 // bounds that of `distance`
    bool sharp;                   // computed in double-double: normal and distance are right to the last bits
    bool removed;
  };

  // Places the shape's vertices where the bodies have them now. False if a face does not look away from the origin.
  bool start(const MinkowskiDifference& m, const SurfaceShape& shape);

  // Replaces the faces that `vertex` lies beyond, `face` and its neighbours, by faces whose last corner is the vertex.
  // Returns the first of these; the others follow. Returns -1 if the surface no longer surrounds the origin: it is
  // lost.
  int expand(int face, const MinkowskiVertex& vertex);

  // Computes the plane of a face in double-double; false if it has no normal.
  bool sharpen(int face);

  // Writes the surface that is left, or an empty one if it is too large.
  void save(SurfaceShape& shape);

  // Faces keep their numbers; those that were replaced are marked as removed.
  const std::vector<Face>& faces() const { return faces_; }
  const MinkowskiVertex& corner(int face, int k) const;
  int face_count() const { return face_count_; }

 private:
  struct BorderSide {
    int from;     // a vertex
    int to;       // a vertex
    int outside;  // the face across, which stays
  };

  bool set_plane(int face);
  bool looks_away(int face) const;
  void remove_seen_from(Vec3 p, int face);
  bool border_is_one_line(int first_face);

  double margin_ = 0.0;
  double vertex_error_ = 0.0;  // of a vertex of M
  int face_count_ = 0;         // without the removed ones
  std::vector<MinkowskiVertex> vertices_;
  std::vector<Face> faces_;
  std::vector<BorderSide> border_;  // of the patch that is being replaced
  std::vector<int> stack_;          // of faces
  std::vector<int> face_from_;      // of each vertex: the newest face whose side started there
};

// The tetrahedron of four vertices, the origin inside.
SurfaceShape tetrahedron_shape(const std::array<MinkowskiVertex, 4>& vertices);
// Two tetrahedra on the triangle of ring[0], ring[1] and ring[2], which are counter-clockwise seen from `top`.
SurfaceShape bipyramid_shape(const std::array<MinkowskiVertex, 3>& ring, const MinkowskiVertex& top,
                             const MinkowskiVertex& bottom);

}  // namespace tact::narrowphase
