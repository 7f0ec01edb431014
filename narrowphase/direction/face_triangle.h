// Three vertices of M that span a face of it, or part of one, or did so in the last step; seen along its normal. The
// foot is that of the origin on its plane.
#pragma once

#include <array>
#include <optional>

#include "narrowphase/hull/gjk.h"
#include "narrowphase/hull/minkowski_difference.h"

namespace tact::narrowphase {

// The unit normal of the face of M that a simplex spans, on the side of `toward`; nothing if it spans none. Computed
// with twice the digits: a thin face has a normal as good as any.
std::optional<Vec3> face_normal(const MinkowskiDifference& m, const GjkSimplex& simplex, Vec3 toward);

class FaceTriangle {
 public:
  // `vertices` are three, n is their normal, to either side.
  FaceTriangle(const MinkowskiDifference& m, const GjkSimplex& vertices, Vec3 n);

  const std::array<Vec3, 3>& corner() const { return corner_; }

  // The side that the foot is nearest to, or farthest beyond; its distance (scaled) is negative outside.
  struct Side {
    std::size_t index;  // from this corner to the next
    double distance;
  };
  Side side_of_foot() const;
  // Across n and the side, away from the triangle; unit.
  Vec3 outward(std::size_t side) const;
  bool is_end_of(std::size_t side, const MinkowskiVertex& v) const;

  // A side and another vertex.
  GjkSimplex side_and(std::size_t side, const MinkowskiVertex& v) const;
  // Of the triangles that a vertex above this one forms with its sides, the one that holds the foot; or, if none does,
  // the one at the side that the foot lies beyond.
  std::optional<GjkSimplex> toward_foot(const MinkowskiVertex& above) const;

 private:
  double span(Vec3 from, Vec3 to) const;

  GjkSimplex vertices_;
  Vec3 n_;
  std::array<Vec3, 3> corner_;
  double turn_;  // +1 if the corners go around counter-clockwise seen against n, or -1
};

}  // namespace tact::narrowphase
