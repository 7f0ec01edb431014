// Meshes that the benchmarks' workloads are made of. Only +, -, *, / and the square root are used, so that a workload
// has the same bits on every platform. Closed ones have facets counter-clockwise seen from outside.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace tact::bench {

// Positions 3 x V in metres, facets 3 x F.
struct Shape {
  Eigen::Matrix3Xd positions{3, 0};
  Eigen::Matrix3Xi facets{3, 0};
};

// The unit sphere as an icosahedron with every facet cut into frequency²: 20 * frequency² facets of nearly equal size,
// stored facet of the icosahedron by facet, row by row.
Shape geodesic_sphere(int frequency);

// A square sheet in z = 0 about the origin, `cells` x `cells` squares of two facets each, stored row by row.
Shape square_sheet(int cells, double size);

// A rod of radius 1 from z = 0, its blunt tip, to z = 1, with 2 * around * (bands - 1) facets.
Shape rod(int around, int bands);

// A ring about the z axis, of radius 1 from its middle to that of its tube, with 2 * around * across facets.
Shape ring(double tube_radius, int around, int across);

// An open tube of radius 1 about the z axis from z = 0 to 1, with 2 * around * bands facets.
Shape tube(int around, int bands);

// All that is nearer than 1 to the z axis between 0 and `length`, with edges of about `edge`.
Shape capsule(double length, double edge);

// An axis-aligned box: 8 vertices, 12 facets.
Shape brick(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper);

// A point of the unit circle after a part of a turn: one of a square's outline, made round. No sine is needed.
Eigen::Vector2d on_circle(double turn);

// The same shape with its vertices and its facets stored in a random order.
Shape shuffled(const Shape& shape, std::uint64_t seed);

// Smooth in the cosine of an angle: 1 at 0, a quarter at 40 degrees, 0 at 180.
double bump(double cosine);

// A smooth wave of period 1 through 0 at 0, between -1 and 1; two parabolas that meet with equal slope.
double wave(double phase);

}  // namespace tact::bench
