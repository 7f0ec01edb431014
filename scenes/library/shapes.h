// Meshes made by rule, for the scenes. Closed ones turn counter-clockwise seen from outside.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "scenes/dynamics/mesh.h"
#include "scenes/library/random.h"

namespace tact::scenes {

// A flat grid of `columns` x `rows` vertices, at least 2 each, centred on the origin in the plane z = 0; `width` along
// x and `depth` along y in metres. Diagonals alternate, so that it folds the same way in both directions.
Mesh grid_sheet(int columns, int rows, double width, double depth);
// An icosahedron whose edges were halved `levels` times, on the sphere of this radius: 20 * 4^levels facets.
Mesh sphere(int levels, double radius);
// A sphere of radius 1 whose points p are moved to shape(p).
Mesh shaped_sphere(int levels, const std::function<Vec3(Vec3)>& shape);
// A box between two corners, each face a grid with edges not longer than `longest`, metres.
Mesh box(Vec3 lower, Vec3 upper, double longest);
// A globe of `rings` circles of `around` vertices between two poles on the z axis, 2 * around * rings facets, whose
// points p, of length 1, are moved to shape(p).
Mesh shaped_globe(int around, int rings, const std::function<Vec3(Vec3)>& shape);
// The surface of filled cells of the grid, each at `cell_size` times its three integers, metres. Cells must not touch
// along an edge or at a corner alone.
Mesh cells(const std::vector<std::array<int, 3>>& filled, Vec3 cell_size);
// A ring around the z axis: `around` segments, an even number, of the radius `ring`, `across` of the radius `tube`.
Mesh torus(int around, int across, double ring, double tube);

Mesh moved(Mesh mesh, Vec3 by);
Mesh scaled(Mesh mesh, double factor);
// Turned by a random rotation about the origin.
Mesh rotated(Mesh mesh, Random& random);
// Turned about the axis through the origin by `angle`, radians; `axis` is a unit vector.
Mesh rotated(Mesh mesh, Vec3 axis, double angle);
// `p` turned in the same way.
Vec3 rotated(Vec3 p, Vec3 axis, double angle);

}  // namespace tact::scenes
