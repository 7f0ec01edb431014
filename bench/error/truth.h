// What is true of two bodies, by slow means that share no code with the engine: facet pairs by CGAL's exact predicates,
// heights of the Minkowski difference in long double, its smallest height over all of its faces.
#pragma once

#include <tact/facet_pair.h>

#include <Eigen/Core>
#include <vector>

namespace tact::bench {

// A triangle mesh: 3 x V metres, 3 x F indices of vertices.
struct TruthMesh {
  Eigen::Matrix3Xd positions{3, 0};
  Eigen::Matrix3Xi facets{3, 0};
};

// The facets of a and of b that share at least one point, sorted. A facet without area is the segment or point that it
// is.
std::vector<FacetPair> true_facet_pairs(const TruthMesh& a, const TruthMesh& b);

// How many of `expected` are missing from `found`, and how many of `found` are not expected. Both sorted.
struct SetDifference {
  int missed = 0;
  int wrong = 0;
  bool empty() const { return missed == 0 && wrong == 0; }
};
SetDifference difference(const std::vector<FacetPair>& expected, const std::vector<FacetPair>& found);

// The overlap w(n) of the convex hulls of two meshes, whose facets' vertices alone count. Both must have a facet.
class TrueHeight {
 public:
  TrueHeight(const TruthMesh& a, const TruthMesh& b);

  // w(n / |n|), metres, with the second body shifted by `shift`. n need not be of unit length and must not be zero.
  long double operator()(const Eigen::Vector3d& n, const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) const;
  // The largest edge of the box around both, metres; 0 if all vertices are one point.
  double size() const { return size_; }
  // Do 16 turns of n by each of 1e-2, 1e-3, … 1e-7 radians lower w by no more than `tolerance`?
  bool is_local_minimum(const Eigen::Vector3d& n, double tolerance,
                        const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) const;

 private:
  using Points = Eigen::Matrix<long double, 3, Eigen::Dynamic>;
  long double height(const Eigen::Matrix<long double, 3, 1>& n, const Eigen::Vector3d& shift) const;

  Points a_, b_;  // less the first vertex of a
  double size_ = 0.0;
};

// The faces of the Minkowski difference of two solid hulls, found among all facets of both and all pairs of edges whose
// arcs of normals cross. They stay the faces, with the same normals, while the second body is only shifted.
class MinkowskiFaces {
 public:
  MinkowskiFaces(const TruthMesh& a, const TruthMesh& b);

  // The smallest w over all directions, with the second body shifted by `shift`, and the normals whose w is that but
  // for `tie`: where the difference holds the origin. If it does not, some w < 0.
  struct Smallest {
    double height = 0.0;  // metres
    std::vector<Eigen::Vector3d> directions;
  };
  Smallest smallest(const Eigen::Vector3d& shift, double tie) const;

  // The normal nearest to the unit vector `n`, and its w.
  struct Nearest {
    Eigen::Vector3d direction;
    double height = 0.0;  // metres
  };
  Nearest nearest(const Eigen::Vector3d& n, const Eigen::Vector3d& shift) const;

 private:
  struct Face {
    Eigen::Vector3d normal;
    long double height = 0.0L;  // w without a shift
  };
  std::vector<Face> faces_;
};

// The vertices and facets of the convex hull of a mesh that is not flat.
TruthMesh convex_hull(const TruthMesh& mesh);

}  // namespace tact::bench
