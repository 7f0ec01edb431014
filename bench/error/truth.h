// What is true of two bodies, by slow means that share no code with the engine: how sets of facet pairs differ, and the
// heights of the Minkowski difference over all of its faces.
#pragma once

#include <tact/facet_pair.h>

#include <Eigen/Core>
#include <vector>

#include "tests/support/mesh.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::bench {

using tests::Mesh;
using tests::MinkowskiHeight;

// How many of `expected` are missing from `found`, and how many of `found` are not expected. Both sorted.
struct SetDifference {
  int missed = 0;
  int wrong = 0;
  bool empty() const { return missed == 0 && wrong == 0; }
};
SetDifference difference(const std::vector<FacetPair>& expected, const std::vector<FacetPair>& found);

// The overlap of the convex hulls of two meshes, whose facets' vertices alone count. Both must have a facet.
MinkowskiHeight height_of(const Mesh& a, const Mesh& b);

// The faces of the Minkowski difference of two solid hulls, found among all facets of both and all pairs of edges whose
// arcs of normals cross. They stay the faces, with the same normals, while the second body is only shifted.
class MinkowskiFaces {
 public:
  MinkowskiFaces(const Mesh& a, const Mesh& b);

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
Mesh convex_hull(const Mesh& mesh);

}  // namespace tact::bench
