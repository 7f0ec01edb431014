// M = C_A ⊖ C_B, the set of all a - b, seen through its support function. The hulls overlap if and only if M holds the
// origin; their overlap along n is M's height w(n) (paper §4.1).
//
// Points of M are scaled by a power of two so that the pair has a size of about 1: nothing overflows or vanishes
// whatever the unit of length, and the rounding of a - b is the only one between the input and a point of M.
#pragma once

#include "narrowphase/hull/support.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

// A point of M that is the difference of a vertex of A and one of B.
struct MinkowskiVertex {
  Vec3 point;  // scale * (a - b)
  int a = -1;  // vertex of A
  int b = -1;  // vertex of B
};

class MinkowskiDifference {
 public:
  // Both meshes must have a facet, and outlive this.
  MinkowskiDifference(const ClusteredMesh& a, const ClusteredMesh& b);

  // The vertex of M farthest along `direction`, which need not be of unit length.
  MinkowskiVertex support(Vec3 direction) const;
  // The same vertex, found sooner if `near` is close to it.
  MinkowskiVertex support(Vec3 direction, const MinkowskiVertex& near) const;
  // Does a plane half-way between two vertices, a of A and b of B, have A below and B above, `direction`, of unit
  // length, being upwards? If so, the hulls are apart, and that was found sooner than by a support query.
  bool parted_by_plane(Vec3 direction, int a, int b) const;
  // The point of M that vertices `a` and `b` make.
  MinkowskiVertex vertex(int a, int b) const { return {scale_ * (a_->position(a) - b_->position(b)), a, b}; }

  // Scaled length = scale() * metres.
  double scale() const { return scale_; }
  // An upper bound of the size (scaled) of any vertex of M less any other, and of the boxes of A and of B about
  // origin().
  double size() const { return size_; }
  // Bounds the error of w(n) = n · support(n).point for unit n, as against the true height of M (scaled): the rounding
  // of two dot products that choose the vertices and of the one that measures.
  double height_error() const { return height_error_; }
  // Bounds the error of n · (x - origin()) as computed, for unit n and any vertex x of A or B. Metres.
  double vertex_height_error() const { return vertex_height_error_; }
  // The point that heights are measured from, near both bodies, so that coordinates far from zero do no harm.
  Vec3 origin() const { return origin_; }

  const ClusteredMesh& a() const { return *a_; }
  const ClusteredMesh& b() const { return *b_; }

 private:
  const ClusteredMesh* a_;
  const ClusteredMesh* b_;
  Vec3 origin_;
  double scale_ = 1.0;
  double size_ = 0.0;
  double height_error_ = 0.0;
  double vertex_height_error_ = 0.0;
};

}  // namespace tact::narrowphase
