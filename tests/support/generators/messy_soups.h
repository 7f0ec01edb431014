// Meshes as broken files hold them.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/mesh.h"

namespace tact::tests {

// Two soups of `facets` facets each around a place some 10⁴ m from the origin, nothing manifold: edges of many facets,
// facets repeated as they are, turned and reversed, facets that are a segment or a point, repeated vertices, vertices
// that miss each other by a unit in the last place, vertices exactly on edges and in the planes of others, needles that
// cross everything, and vertices that no facet uses. The second takes a part of its vertices from the first.
std::vector<Mesh> messy_soups(int facets, std::uint64_t seed);

}  // namespace tact::tests
