// Small bodies made from a few numbers and a seed, for cases that a collision engine finds hard. Metres.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "bench/error/truth.h"
#include "scenes/library/random.h"

namespace tact::bench {

// Random numbers, the same on every platform.
class StabilityRandom {
 public:
  explicit StabilityRandom(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) { return random_.between(low, high); }
  // 0 <= the number < count.
  int below(int count);
  Eigen::Vector3d in_cube(double half_edge);
  Eigen::Vector3d direction();
  Eigen::Matrix3d rotation();

 private:
  scenes::Random random_;
};

Mesh box_shape(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper);
// An icosahedron whose facets are split `subdivisions` times and put on the unit sphere: 20 * 4^subdivisions facets.
Mesh ball_shape(int subdivisions);
// A ball with smooth bumps and dents of up to `roughness` radii: not convex.
Mesh lumpy_shape(int subdivisions, double roughness, StabilityRandom& random);
// Flat, edge 1, in the plane z = 0, about the origin: 2 * cells² facets.
Mesh sheet_shape(int cells);
// Random triangles in the cube of half edge 1, each with vertices of its own.
Mesh soup_shape(int facets, StabilityRandom& random);
// Facets of length 1 and width 1 / aspect through the unit ball; a needle has its short edge at one end, a sliver none.
Mesh needle_shape(int facets, double aspect, StabilityRandom& random);
Mesh sliver_shape(int facets, double aspect, StabilityRandom& random);
// The convex hull of random points of the unit sphere.
Mesh hull_shape(int points, StabilityRandom& random);
Mesh triangle_shape(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r);

Mesh moved(Mesh mesh, const Eigen::Vector3d& by);
Mesh rotated(Mesh mesh, const Eigen::Matrix3d& rotation);
// One mesh with the vertices and facets of both.
Mesh joined(const Mesh& a, const Mesh& b);

}  // namespace tact::bench
