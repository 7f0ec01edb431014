#include "tests/support/checks/sinking_bodies.h"

#include <gtest/gtest.h>
#include <tact/world.h>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/crossing_oracle.h"

namespace tact::tests {

namespace {

Mesh closed_shape(Random& random) {
  const std::uint64_t seed = random.below(1 << 30);
  if (random.chance(0.5)) {
    const double radius = random.uniform(0.5, 1.0);
    return blob(1 + random.below(2), radius, 0.3, seed);
  }
  return random_hull(8 + random.below(30), seed);
}

}  // namespace

std::size_t sink_and_compare(std::uint64_t seed) {
  Random random(seed);
  const Mesh first = closed_shape(random), second = closed_shape(random);
  const Mesh a = rotated(first, random.rotation()), shape = rotated(second, random.rotation());
  const Vec3 way = random.direction(), beside = highest(a, way) - highest(shape, -way);
  const double margin = random.chance(0.5) ? random.uniform(0.0, 0.05) : 0.0;
  World world({.threads = 1, .outputs = {.points = true}});
  const auto add = [&](const Mesh& mesh) {
    return world.add_body({.positions = mesh.positions, .facets = mesh.facets, .margin = margin});
  };
  add(a);
  const BodyId moved = add(translated(shape, beside + 0.1 * way));
  std::size_t points = 0;
  LastNormals last;
  double depth = -0.1;
  for (int step = 0; step < 6; ++step) {
    depth += random.uniform(-0.05, 0.25);
    const Mesh b = translated(shape, beside - depth * way + 0.05 * random.direction());
    world.set_positions(moved, b.positions);
    const Report& report = world.detect();
    if (report.contacts().empty()) {
      last = {};
      continue;
    }
    const Contact& contact = report.contacts()[0];
    if (!contact.facet_pairs().empty()) {
      const ExpectedGaps expected = gaps_by_brute_force(a, b, contact, last);
      EXPECT_TRUE(has_gaps(contact, expected, 1e-11)) << "seed " << seed << ", step " << step;
      points += expected.vertices_of_a.size() + expected.vertices_of_b.size() + expected.edges.size();
    }
    last = last_normals(contact);
  }
  return points;
}

}  // namespace tact::tests
