#include <tact/tact.h>

#include <cstdio>

int main() {
  // A tetrahedron: a vertex a column, metres; a facet a column, counter-clockwise seen from outside.
  Eigen::Matrix3Xd positions(3, 4);
  positions << 0, 1, 0, 0,  // x
      0, 0, 1, 0,           // y
      0, 0, 0, 1;           // z
  Eigen::Matrix3Xi facets(3, 4);
  facets << 0, 0, 0, 1,  //
      2, 1, 3, 2,        //
      1, 3, 2, 3;

  tact::World world;
  world.add_body({.positions = positions, .facets = facets, .name = "left"});
  positions.row(0).array() += 0.75;
  const tact::BodyId right = world.add_body({.positions = positions, .facets = facets, .name = "right"});

  for (int step = 0; step < 4; ++step) {
    const tact::Report& report = world.detect();
    std::printf("step %d: %zu contacts\n", step, report.contacts().size());
    for (const tact::Contact& contact : report.contacts()) {
      std::printf("  %s and %s, %.2f m deep, %zu facet pairs\n", world.name(contact.a).c_str(),
                  world.name(contact.b).c_str(), contact.depth, contact.facet_pairs().size());
    }
    positions.row(0).array() += 0.1;  // your engine moves the vertices as it likes
    world.set_positions(right, positions);
  }
}
