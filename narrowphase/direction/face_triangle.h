// Three vertices of M that span a face of it or part of one, or did so in the last step, seen along its normal. The
// *projection* is that of the origin on their plane.
#pragma once

#include <array>
#include <optional>

#include "narrowphase/hull/gjk.h"
#include "narrowphase/hull/minkowski_difference.h"

namespace tact::narrowphase {

// The unit normal of the face of M that a simplex spans, on the side of `toward`; nothing if it spans none. Computed in
// double-double, so that the normal of a thin face is as good as any.
std::optional<Vec3> face_normal(const MinkowskiDifference& m, const GjkSimplex& simplex, Vec3 toward);

class FaceTriangle {
 public:
  // `vertices` are three, n is their normal, to either side.
  FaceTriangle(const MinkowskiDifference& m, const GjkSimplex& vertices, Vec3 n);

  const std::array<Vec3, 3>& corner() const { return corner_; }

  // The side with the least signed distance (scaled) from the projection, which is negative outside.
  struct Side {
    std::size_t index;  // from this corner to the next
    double distance;
  };
  Side side_of_projection() const;
  // Across n and the side, away from the triangle; unit.
  Vec3 outward(std::size_t side) const;
  bool is_end_of(std::size_t side, const MinkowskiVertex& v) const;

  // A side and another vertex.
  GjkSimplex side_and(std::size_t side, const MinkowskiVertex& v) const;
  // A vertex above this triangle forms a triangle with each of its sides. Returns the one that holds the projection; if
  // none does, the one at the side beyond which the projection lies; nothing if it lies beyond none.
  std::optional<GjkSimplex> toward_projection(const MinkowskiVertex& above) const;

 private:
  double span(Vec3 from, Vec3 to) const;

  GjkSimplex vertices_;
  Vec3 n_;
  std::array<Vec3, 3> corner_;
  double turn_;  // +1 if the corners go around counter-clockwise seen against n, or -1
};

}  // namespace tact::narrowphase
