// M = C_A ⊖ C_B, the set of all a - b, seen through its support function. The hulls overlap if and only if M holds the
// origin; their overlap along n is M's height w(n) (paper §4.1).
//
// Points of M are scaled by a power of two so that the pair has a size of about 1. So nothing overflows or vanishes,
// whatever the unit of length, and the rounding of a - b is the only one between the input and a point of M.
#pragma once

#include "engine/base/tuning.h"
#include "narrowphase/hull/support.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/numeric/unit_roundoff.h"

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
  MinkowskiDifference(const ClusteredMesh& a, const ClusteredMesh& b, const base::Tuning& tuning = base::kTuning);

  // The vertex of M farthest along `direction`, which need not be of unit length.
  MinkowskiVertex support(Vec3 direction) const;
  // The same vertex, found sooner if `near` is close to it.
  MinkowskiVertex support(Vec3 direction, const MinkowskiVertex& near) const;
  // True if the plane across `direction` (unit) half-way between vertex a of A and vertex b of B has all of A below it
  // and all of B above: it separates the hulls. Cheaper than a support query.
  bool separated_by_plane(Vec3 direction, int a, int b) const;
  // The point of M that vertices `a` and `b` make.
  MinkowskiVertex vertex(int a, int b) const { return {scale_ * (a_->position(a) - b_->position(b)), a, b}; }

  // Scaled length = scale() * metres.
  double scale() const { return scale_; }
  // An upper bound (scaled) of the distance between two vertices of M, and of the size of the boxes of A and of B about
  // origin().
  double size() const { return size_; }
  // Bounds the error of w(n) = n · support(n).point for unit n against the true height of M (scaled). It covers the
  // rounding of the two dot products that choose the vertices and of the one that measures.
  double height_error() const { return height_error_; }
  // Bounds the error of n · (x - origin()) as computed, for unit n and any vertex x of A or B. Metres.
  double vertex_height_error() const { return vertex_height_error_; }
  // The point from which heights are measured. It is near both bodies, so that coordinates far from zero do no harm.
  Vec3 origin() const { return origin_; }

  const ClusteredMesh& a() const { return *a_; }
  const ClusteredMesh& b() const { return *b_; }

 private:
  const ClusteredMesh* a_;
  const ClusteredMesh* b_;
  bool by_clusters_;
  Vec3 origin_;
  double scale_ = 1.0;
  double size_ = 0.0;
  double height_error_ = 0.0;
  double vertex_height_error_ = 0.0;
};

}  // namespace tact::narrowphase
