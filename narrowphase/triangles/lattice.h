// Points on a lattice: where no determinant of theirs is rounded.
#pragma once

#include "narrowphase/kernels/kernels.h"

namespace tact::narrowphase {

// Points lie on a lattice if all coordinates are whole numbers of some step, a power of two. If they are within few
// steps of each other, nothing of a determinant is rounded. So it is with bricks, voxels and what was drawn on a grid.
struct Lattice {
  double step = 0.0;  // 0: there is none
  Grid grid = {};  // one step a cell: places of points on the lattice are whole numbers, and nothing of them is rounded
};

// The finest lattices, of up to 2^16 and 2^10 steps along a side, on which doubles, and floats, round nothing of a
// determinant of points in a box: differences are up to 2^16 steps, products of two up to 2^32, and a sum of six
// products of three up to 3 * 2^49; in floats six times the product of the sides is up to 2^24.
Lattice finest_lattice_in_doubles(const BoxBounds& box);
Lattice finest_lattice_in_floats(const BoxBounds& box);

}  // namespace tact::narrowphase
