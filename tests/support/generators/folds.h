// Sheets that are rolled, folded and cut: what contact of a body with itself is tested on. Made with sines of the C
// library: not for hashes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/mesh.h"

namespace tact::tests {

// Rolled up around the y axis, `turns` times, `gap` metres between turns; the innermost one has this radius.
Mesh rolled_sheet(int cells_x, int cells_y, double turns, double radius, double gap);
// Folded to and fro like a fan, `folds` times; flat where `angle` is 0, closed where it is pi/2 radians.
Mesh fan_fold(int cells_x, int cells_y, int folds, double angle);
// A piece of a flat ring of radius 1 to 2 that goes round `turns` times, and rises by `rise` metres a turn. Its normals
// point up, however often it lies above itself.
Mesh winding_stairs(int cells_around, int cells_across, double turns, double rise);
// A disk that goes round its middle twice before it closes: seen from above each place is covered twice.
Mesh double_disk(int cells_around, int cells_across, double height);
// A wave that hangs over at its flanks, as far as `overhang` says: from 1 on it does, from some 5 on it crosses itself.
Mesh overhanging_wave(int cells_x, int cells_y, int waves, double overhang);
// A comb in the plane: a sheet of `cells` x `cells` squares with slits from one border to its middle, teeth of `width`
// squares between them. Each tooth is sheared in the plane by up to `shear` metres, and rises by up to `height` metres.
// Its normals point up.
Mesh comb(int cells, int width, double shear, double height, std::uint64_t seed);
// What a broken file makes of a mesh: of its facets some twice, some the other way round, some without area; and
// facets that stand on its edges, which then have three.
Mesh broken(const Mesh& mesh, std::uint64_t seed);

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

// Of all kinds, smooth and creased, some crossing themselves; `cells` squares along a side.
std::vector<NamedMesh> folded_meshes(int cells, std::uint64_t seed);

}  // namespace tact::tests
