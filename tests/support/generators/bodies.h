// Bodies made from a few numbers and a seed: the same bits on every platform, as only +, -, *, / and the square root
// are used. Metres; closed ones have facets counter-clockwise seen from outside.
#pragma once

#include <cstdint>

#include "tests/support/generators/random.h"
#include "tests/support/mesh.h"

namespace tact::tests {

// Closed, 8 vertices, 12 facets.
Mesh box(Vec3 lower, Vec3 upper);
// The same with the given half edges about the origin.
Mesh centered_box(Vec3 half_edges);
Mesh cube(double edge, Vec3 center);
// A box whose faces are grids of `cells` x `cells` squares: 12 * cells² facets, vertices at edges shared.
Mesh gridded_box(Vec3 lower, Vec3 upper, int cells);

// Points of the unit sphere: 20 * 4^subdivisions facets.
Mesh icosphere(int subdivisions, double radius = 1.0);
// An icosphere whose surface is pushed in and out smoothly at random places, by up to `roughness` (0 to 0.4) radii
// each.
Mesh blob(int subdivisions, double radius, double roughness, std::uint64_t seed);
// Around the z axis; `around` and `across` are powers of two, at least 4: 2 * around * across facets.
Mesh torus(int around, int across, double major_radius, double minor_radius);
// A bent, dented, liver-like solid of 512 facets, about 1 m long.
Mesh organ(std::uint64_t seed);
// A rod along -z with a blunt tip at the origin: 96 facets, 1 m long.
Mesh tool();
// The convex hull of `points` random points in the unit ball, or of fewer if some are inside: at most 40 points.
Mesh random_hull(int points, std::uint64_t seed);
// A closed spike from the origin to `tip` with a triangular foot of the given radius: 4 facets.
Mesh spike(Vec3 tip, double radius);

// Flat, in the plane z = 0, about the origin, normals up: 2 * cells_x * cells_y facets.
Mesh sheet(int cells_x, int cells_y, double size_x, double size_y);
// A sheet of `cells` x `cells` and the given size with smooth folds of up to `height`.
Mesh wrinkled_sheet(int cells, double size, double height, std::uint64_t seed);
// A mesh of x from -0.5 to 0.5 laid into `waves` waves along x, of the given height; their flanks hang over from an
// overhang of 1 / (16 * waves) on, and waves meet from 3 / (16 * waves) on.
Mesh pleated(Mesh mesh, int waves, double height, double overhang);

// `facets` random triangles in the cube of half edge `extent`, of about a fifth of its size; nothing is shared.
Mesh soup(int facets, double extent, std::uint64_t seed);
// Like a soup, with vertices at whole numbers from -reach to reach: full of coplanar, touching and repeated facets and
// of ones that are segments or points. Vertices are shared by index, and one of eight is used by no facet.
Mesh lattice_soup(int facets, int reach, std::uint64_t seed);
// Facets as slender as `aspect` (height over length) through the unit ball.
Mesh needles(int facets, double aspect, std::uint64_t seed);

// Every vertex moved by up to `amount` along each axis.
Mesh jittered(Mesh mesh, double amount, std::uint64_t seed);
// Every vertex at a random place of the unit ball.
Mesh crumpled(Mesh mesh, std::uint64_t seed);
// Each vertex at the place of another.
Mesh scrambled(const Mesh& mesh, std::uint64_t seed);

}  // namespace tact::tests
