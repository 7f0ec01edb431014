// Meshes of very many facets at one vertex or edge, and of long thin facets: what makes boxes of clusters useless. Made
// with sines of the C library: not for hashes.
#pragma once

#include <cstdint>

#include "tests/support/mesh.h"

namespace tact::tests {

// A closed cone of radius 1 that stands on its tip at the origin: `count` facets there, and as many on top.
Mesh fan_cone(int count, double height);
// `count` needles of length 1 that have one end, the origin, in common, in random directions.
Mesh star(int count, std::uint64_t seed);
// `count` pages around the z axis from 0 to 1.
Mesh open_book(int count);
// A tube along the z axis from 0 to `length`, of 2 * count facets as long as it.
Mesh sliver_tube(int count, double radius, double length);

}  // namespace tact::tests
