// Gaps of closed bodies that cross each other by plain loops in long doubles: what is inside by solid angles, ways out
// over all facets, edges against all edges. It shares no code with the engine.
#pragma once

#include <gtest/gtest.h>
#include <tact/report.h>

#include <array>
#include <map>

#include "tests/support/mesh.h"

namespace tact::tests {

struct ExpectedGap {
  double gap = 0.0;     // metres, not positive
  bool certain = true;  // false: a threshold or a border is so near that rounding decides
};

/// The points with negative gaps of two closed bodies.
struct ExpectedGaps {
  std::map<int, ExpectedGap> vertices_of_a, vertices_of_b;  // inside the other body
  std::map<std::array<int, 4>, ExpectedGap> edges;          // of a, of b
  // Of crossings that are not known to have such a point: the number of each vertex's crossing. A way apart leads out.
  std::map<int, int> others_of_a, others_of_b;
};

/// What the last step said of the normals of vertices, from a to b.
struct LastNormals {
  struct Of {
    Vec3 normal;
    double gap = 0.0;
  };
  std::map<int, Of> of_a, of_b;
  std::map<std::array<int, 4>, Vec3> crossed_edges;  // of a, of b: the normals of those with a negative gap
};
LastNormals last_normals(const Contact& contact);

/// `contact` says the direction and depth of the hulls. No facet may lie level with an edge that is near another.
ExpectedGaps gaps_by_brute_force(const Mesh& a, const Mesh& b, const Contact& contact, const LastNormals& last);

/// Does the contact have these points, each once, and no other with a negative gap? Crossings that are not known to
/// have one have at least one point, and none deeper than the contact. Says the first that differs.
::testing::AssertionResult has_gaps(const Contact& contact, const ExpectedGaps& expected, double tolerance);

}  // namespace tact::tests
