// Bodies that cross are moved apart by their contact points alone, as a solver would.
#pragma once

#include <tact/world.h>

#include "tests/support/mesh.h"

namespace tact::tests {

// The highest point of a mesh along n.
double reach_along(const Mesh& mesh, Vec3 n);

// How far two convex bodies are in each other along a direction from a to b; negative: they are so far apart.
struct Overlap {
  Vec3 direction;
  double depth = 0.0;
};
// The least one: over the normals of facets and the directions across an edge of each.
Overlap least_overlap(const Mesh& a, const Mesh& b);

// How b moves if each point with a negative gap is closed after the other.
Vec3 way_along_points(const Contact& contact);

struct Parting {
  int passes = 0;         // until nothing meets, or so many as are allowed
  int without_point = 0;  // passes in which surfaces met and no point led anywhere
  double way = 0.0;       // of b, metres
};

struct PartingInput {
  double margin = 0.0;  // of both
  int most_passes = 12;
  Vec3 came_by = {};  // the way that b came, in so many steps; none: it is there at once
  int steps = 0;
};

// Moves b along the points until no facets of a and b meet, or so often.
Parting part_by_points(const Mesh& a, const Mesh& b, const PartingInput& input);

// What became of a body that was thrown at another one.
struct Thrown {
  bool met = false;
  int longest_crossing = 0;  // steps one after the other in which facets met
  // Once it came out beyond the other one, along the axis that separated them before. What hits a rim and slides past
  // does not.
  bool other_side = false;
};

// Moves b by `step`, so often; after each step it is moved along the points, and goes on without what leads against
// these. a stands still. Both are convex.
Thrown throw_at(const Mesh& a, Mesh b, Vec3 step, int steps, double margin);

// How thick a closed mesh is through an inside point along a line: from the first facet on one side to the first on the
// other.
double thickness_through(const Mesh& mesh, Vec3 point, Vec3 along);

// How far a point is from the nearest facet.
double distance_to(const Mesh& mesh, Vec3 point);

}  // namespace tact::tests
