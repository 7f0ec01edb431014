// Pairs of triangles that are hard to decide, for tests and for runs over many millions.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::tests {

using narrowphase::Triangle;

// How the two triangles lie before the disturbances that hard_triangle_pair lists.
enum class PairKind {
  random,         // six random points
  crossing,       // an edge of one passes through a point near the other
  coplanar,       // in one plane across the axes, exactly; often with corners on one line or in one place
  axis_plane,     // in one coordinate plane
  shared_vertex,  // and otherwise random
  shared_edge,
  identical,  // the same three corners
  touching,   // a corner of one lies exactly on the face, an edge or a corner of the other
  edge_edge,  // two edges cross exactly
  sliver,     // one or both nearly on a line, aspect to 1e12
  needle,     // one or both with two corners nearly in one place, aspect to 1e12
  grid,       // coordinates 0, 1 or 2
  tenths,     // coordinates 0, 0.1, … 0.9
  collinear,  // one or both have no area: segments and points, on the other as often as not
};
inline constexpr int kPairKinds = 14;

struct TrianglePair {
  Triangle a;
  Triangle b;
  PairKind kind = PairKind::random;
};

// Pair `index` of the sequence `seed`, a function of these two numbers alone. Kinds follow each other in turn; then,
// each with some probability: offsets to 1e8, a scale from 2^-1060 (subnormal) to 2^290 (a coordinate stays below
// 2^300), a scale of each axis by itself, all or single coordinates moved by one unit in the last place; and always a
// random order of axes, of corners and of the two triangles.
TrianglePair hard_triangle_pair(std::uint64_t seed, std::uint64_t index);

// All 72 orders of a pair: six of each triangle's corners, two of the triangles.
std::array<TrianglePair, 72> all_orders(const TrianglePair& pair);

// Kind and coordinates, hexadecimal so that they read back to the same bits.
std::string to_string(const TrianglePair& pair);

}  // namespace tact::tests
