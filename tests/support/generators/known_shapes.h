// Bodies that other libraries test distances and depths with: FCL's boxes, Jolt's balls.
#pragma once

#include <vector>

#include "tests/support/mesh.h"

namespace tact::tests {

// A rigid motion, rotation first.
struct Pose {
  Rotation rotation;
  Vec3 translation;
};

Mesh posed(const Mesh& mesh, const Pose& pose);
// Of the given edges, about its centre before it is moved.
Mesh posed_box(Vec3 edges, const Pose& pose);

Mesh rounded_to_floats(Mesh mesh);

struct BoxPair {
  Mesh a, b;
};

// FCL: poses from the field that ended in an exception, fcl#388, #395, #415, #398, #428, drake#21673.
std::vector<BoxPair> boxes_from_the_field();
// FCL, fcl#445: edge against edge, 4.6e-11 deep.
BoxPair boxes_from_the_field_that_touch();

// FCL: a unit cube whose face is at x = -0.5, and a box of 0.6 x 0.8 x 1 turned so that an edge points at it, `depth`
// deep: the edge is at (depth - 0.5, y), upright; both reach from z = 0 to 1.
BoxPair edge_against_face(double y, double depth);
// The six frames of the world that it is turned and moved to, and one that FCL leaves out as it cannot do it yet.
std::vector<Pose> frames_of_the_world();

// Jolt: a ball whose depth in an edge or a corner is to be that of a sphere. A square facet across `toward`, a fifth of
// the radius wide, lies at `radius` from the centre, the rest a little deeper.
Mesh ball_with_facet(Vec3 center, double radius, Vec3 toward);

}  // namespace tact::tests
