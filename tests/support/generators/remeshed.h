// Bodies whose facets change: cut, torn, refined, renumbered. What World::set_facets() takes.
#pragma once

#include <vector>

#include "tests/support/generators/random.h"
#include "tests/support/mesh.h"

namespace tact::tests {

struct Remeshed {
  Mesh mesh;
  std::vector<int> vertex_map;  // of each vertex the one that it was, or -1
};

// The mesh as it is.
Remeshed unchanged(const Mesh& mesh);
// Vertices and facets in another order; with `turns`, facets begin with another corner.
Remeshed renumbered(const Remeshed& from, Random& random, bool turns);
// Facets whose middle is beyond a plane have vertices of their own there: those on both sides are doubled.
Remeshed cut(const Remeshed& from, Vec3 normal, double offset);
// Each facet is left out with this probability, and so are vertices that no facet uses.
Remeshed torn(const Remeshed& from, Random& random, double probability);
// Each facet has a vertex in its middle, with this probability, and is three.
Remeshed refined(const Remeshed& from, Random& random, double probability);
// Some of these, one after the other.
Remeshed remeshed(const Mesh& mesh, Random& random);

}  // namespace tact::tests
