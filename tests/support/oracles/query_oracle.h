// Queries to a mesh, hard ones, and their answers by brute force: exact ones from CGAL, distances in long doubles.
#pragma once

#include <tact/queries.h>

#include <array>
#include <vector>

#include "tests/support/generators/random.h"
#include "tests/support/mesh.h"
#include "tests/support/oracles/triangle_oracle.h"

namespace tact::tests {

inline Eigen::Vector3d vector_of(Vec3 p) { return {p.x, p.y, p.z}; }
inline Vec3 point_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
Triangle facet_at(const Mesh& mesh, int f);
inline Vec3 weighted(const Triangle& t, const std::array<double, 3>& w) {
  return w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
}

// Closed ones, sheets, soups, needles; about the unit ball.
std::vector<Mesh> meshes_to_query();

// Anywhere; along an axis, on a grid; through a vertex; through an edge; in the plane of a facet.
Ray random_ray(const Mesh& mesh, Random& random);
// Besides: that end on a vertex, lie along an edge, graze a facet at a tiny angle, run along an axis through a vertex;
// that are a point.
Ray hard_ray(const Mesh& mesh, Random& random);
// Anywhere, far away, a vertex, on an edge or a facet, to rounding or just off it.
Vec3 hard_point(const Mesh& mesh, Random& random);
// Anywhere, on a grid, with a corner on a vertex, flat, a point.
BoxQuery hard_box(const Mesh& mesh, Random& random);

// Ascending.
std::vector<int> hit_facets(const Mesh& mesh, const Ray& ray);
std::vector<int> facets_in(const Mesh& mesh, const BoxQuery& box);
long double distance_by_brute_force(const Mesh& mesh, Vec3 p);
// Of a closed mesh that does not meet itself: is the point on its surface, or does a segment from it, in some
// direction, cross it an odd number of times?
bool is_inside(const Mesh& mesh, Vec3 p, Random& random);

}  // namespace tact::tests
