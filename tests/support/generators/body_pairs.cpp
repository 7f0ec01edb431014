#include "tests/support/generators/body_pairs.h"

#include <cmath>
#include <iterator>
#include <utility>

#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

// `mesh` turned at random about its centroid, which is moved to a random place in a ball about the origin.
Mesh placed(Mesh mesh, double reach, Random& random) {
  mesh = rotated(translated(mesh, -centroid(mesh)), random.rotation());
  return translated(std::move(mesh), reach * random.in_ball());
}

std::vector<Mesh> pair_in(double reach, Mesh a, Mesh b, std::uint64_t seed) {
  Random random(seed ^ 0x5eedu);
  Mesh first = placed(std::move(a), 0.0, random);
  return {std::move(first), placed(std::move(b), reach, random)};
}

std::vector<Mesh> blobs(std::uint64_t seed) {
  return pair_in(1.6, blob(2, 1.0, 0.3, seed), blob(3, 0.8, 0.3, seed + 1000), seed);
}

std::vector<Mesh> organ_and_tool(std::uint64_t seed) { return pair_in(0.6, organ(seed), tool(), seed); }

std::vector<Mesh> tori(std::uint64_t seed) {
  return pair_in(1.5, torus(16, 8, 1.0, 0.3), torus(32, 8, 1.1, 0.2), seed);
}

std::vector<Mesh> sphere_in_cloth(std::uint64_t seed) {
  return pair_in(0.8, wrinkled_sheet(20, 3.0, 0.8, seed), icosphere(2, 0.6), seed);
}

std::vector<Mesh> cloths(std::uint64_t seed) {
  return pair_in(0.3, wrinkled_sheet(16, 2.0, 0.4, seed), wrinkled_sheet(20, 2.0, 0.4, seed + 1000), seed);
}

// Sheets in one plane, a power of two apart in steps: every pair of facets is coplanar.
std::vector<Mesh> coplanar_sheets(std::uint64_t seed) {
  Random random(seed);
  const double dx = random.below(9) * 0.125, dy = random.below(9) * 0.125;
  return {sheet(8, 8, 2.0, 2.0), translated(sheet(16, 4, 2.0, 2.0), {dx, dy, 0.0})};
}

std::vector<Mesh> hulls(std::uint64_t seed) {
  return pair_in(1.2, random_hull(20, seed), random_hull(12, seed + 1000), seed);
}

// Boxes of whole numbers whose faces, edges and corners often touch exactly.
std::vector<Mesh> lattice_boxes(std::uint64_t seed) {
  Random random(seed);
  const auto random_box = [&] {
    Vec3 lower, upper;
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = random.below(4);
      upper[axis] = lower[axis] + 1 + random.below(3);
    }
    return gridded_box(lower, upper, 1 + random.below(3));
  };
  Mesh first = random_box();
  return {std::move(first), random_box()};
}

std::vector<Mesh> crossed_bars(std::uint64_t seed) {
  return pair_in(0.4, centered_box({2.0, 0.1, 0.1}), centered_box({0.1, 2.0, 0.1}), seed);
}

std::vector<Mesh> spikes(std::uint64_t seed) {
  Random random(seed);
  const Mesh sting = spike(2.0 * random.direction(), 1e-3);
  return {blob(2, 1.0, 0.3, seed), translated(sting, 0.5 * random.direction())};
}

std::vector<Mesh> soups(std::uint64_t seed) { return {soup(200, 1.0, seed), soup(150, 1.0, seed + 1000)}; }

std::vector<Mesh> lattice_soups(std::uint64_t seed) {
  return {lattice_soup(120, 3, seed), lattice_soup(100, 3, seed + 1000)};
}

// Needles in space hardly ever meet each other: some go through a soup, and some lie in one plane, or nearly.
std::vector<Mesh> needle_heaps(std::uint64_t seed) {
  const Mesh heap = needles(100, seed % 2 == 0 ? 1e-12 : 1e-9, seed), other = needles(40, 1e-12, seed + 1000);
  switch (seed % 3) {
    case 0: return {heap, soup(80, 1.0, seed)};
    case 1: return {stretched(heap, {1.0, 1.0, 0.0}), stretched(other, {1.0, 1.0, 0.0})};
    default: return {stretched(heap, {1.0, 1.0, 1e-14}), stretched(other, {1.0, 1.0, 1e-14})};
  }
}

std::vector<Mesh> crumpled_spheres(std::uint64_t seed) {
  return {crumpled(icosphere(1), seed), crumpled(icosphere(1), seed + 1000)};
}

// The same body twice in one place, one of them with other facets or inside out.
std::vector<Mesh> twins(std::uint64_t seed) {
  const Mesh mesh = blob(1, 1.0, 0.3, seed);
  Random random(seed);
  const std::vector<int> vertices = random.permutation(mesh.vertex_count());
  const Mesh other = permuted(mesh, vertices, random.permutation(mesh.facet_count()));
  return {mesh, random.chance(0.5) ? turned_inside_out(other) : other};
}

// A vertex of one lies on a facet of the other, give or take the last bit.
std::vector<Mesh> grazing_boxes(std::uint64_t seed) {
  Random random(seed);
  const Rotation turn = random.rotation();
  const Mesh a = rotated(centered_box({1.0, 0.7, 0.4}), turn);
  const Mesh b = rotated(translated(centered_box({0.5, 0.6, 0.8}), {1.5, 0.1 * random.below(5), 0.0}), turn);
  return {a, b};
}

// Facets and straight or point-like bodies of one facet each.
std::vector<Mesh> single_facets(std::uint64_t seed) {
  return {lattice_soup(1, 2, seed), lattice_soup(1, 2, seed + 1000)};
}

std::vector<Mesh> nested(std::uint64_t seed) { return {blob(2, 1.0, 0.2, seed), scaled(blob(2, 1.0, 0.2, seed), 0.9)}; }

constexpr BodyPairKind kBodyPairKinds[] = {
    {"blobs", blobs},
    {"organ_and_tool", organ_and_tool},
    {"tori", tori},
    {"sphere_in_cloth", sphere_in_cloth},
    {"cloths", cloths},
    {"coplanar_sheets", coplanar_sheets},
    {"hulls", hulls},
    {"lattice_boxes", lattice_boxes},
    {"crossed_bars", crossed_bars},
    {"spikes", spikes},
    {"soups", soups},
    {"lattice_soups", lattice_soups},
    {"needle_heaps", needle_heaps},
    {"crumpled_spheres", crumpled_spheres},
    {"twins", twins},
    {"grazing_boxes", grazing_boxes},
    {"single_facets", single_facets},
    {"nested", nested},
};

// A multiple of 2^-20 in each coordinate: sums of a few, and quarters, are exact.
Vec3 on_grid(Vec3 p) {
  const auto nearest = [](double x) { return std::floor(x * 0x1p20 + 0.5) * 0x1p-20; };
  return {nearest(p.x), nearest(p.y), nearest(p.z)};
}

// A tetrahedron with a corner at `tip` that lies on the side of `normal` otherwise.
Mesh tetrahedron_on(Vec3 tip, Vec3 normal, double size, Random& random) {
  MeshBuilder builder;
  builder.vertex(tip);
  while (builder.vertex_count() < 4) {
    const Vec3 offset = on_grid(size * random.direction());
    if (dot(offset, normal) > 0.1 * size * norm(normal)) builder.vertex(tip + offset);
  }
  builder.facet(0, 1, 2);
  builder.facet(0, 2, 3);
  builder.facet(0, 3, 1);
  builder.facet(1, 3, 2);
  return builder.mesh();
}

// Two parallel facets close to each other, and a tip that goes through the first and ends on the second.
std::vector<Mesh> tip_in_pit(Random& random) {
  const Vec3 p = on_grid(random.in_ball()), q = on_grid(random.in_ball()), r = on_grid(random.in_ball());
  const Vec3 normal = cross(q - p, r - p);
  const Vec3 down = on_grid((-0.02 / norm(normal)) * normal);
  MeshBuilder pit;
  pit.triangle(p, q, r);
  pit.triangle(p + down, q + down, r + down);
  return {pit.mesh(), tetrahedron_on((0.25 * p + 0.25 * q + 0.5 * r) + down, normal, 0.3, random)};
}

}  // namespace

std::span<const BodyPairKind> body_pair_kinds() { return kBodyPairKinds; }

std::vector<Mesh> kissing_bodies(std::uint64_t seed) {
  Random random(seed);
  const Vec3 far = on_grid(random.in_cube(100.0));
  std::vector<Mesh> bodies;
  if (random.chance(0.4)) {
    bodies = tip_in_pit(random);
  } else {
    const Mesh hull = snapped(random_hull(12, seed), 0x1p-20);
    const int f = random.below(hull.facet_count());
    const Vec3 p = hull.position(hull.facets(0, f)), q = hull.position(hull.facets(1, f));
    const Vec3 r = hull.position(hull.facets(2, f));
    // A corner, the middle of an edge, or a point of the facet.
    const Vec3 places[] = {p, 0.5 * p + 0.5 * q, 0.25 * p + 0.25 * q + 0.5 * r};
    bodies = {hull, tetrahedron_on(places[random.below(3)], cross(q - p, r - p), 0.5, random)};
  }
  for (Mesh& body : bodies) body = translated(std::move(body), far);
  if (random.chance(0.5)) std::swap(bodies[0], bodies[1]);
  return bodies;
}

std::vector<Mesh> crowd_of_blobs(int count, std::uint64_t seed) {
  Random random(seed);
  double half_edge = 1.0;  // the cube grows with the number of bodies
  while (half_edge * half_edge * half_edge < count) half_edge *= 1.0625;
  std::vector<Mesh> bodies;
  for (int i = 0; i < count; ++i) {
    const double radius = random.uniform(0.5, 1.2);
    const Vec3 at = random.in_cube(half_edge);
    bodies.push_back(translated(blob(1, radius, 0.3, seed + static_cast<std::uint64_t>(i)), at));
  }
  return bodies;
}

std::vector<Mesh> mixed_crowd(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Mesh> bodies = {Mesh{}};
  for (int i = 1; i < count; ++i) {
    const BodyPairKind& kind = kBodyPairKinds[random.below(static_cast<int>(std::size(kBodyPairKinds)))];
    std::vector<Mesh> pair = kind.make(seed + static_cast<std::uint64_t>(i));
    Mesh& mesh = pair[random.below(2)];
    bodies.push_back(translated(std::move(mesh), random.in_cube(3.0)));
  }
  return bodies;
}

std::vector<Mesh> brick_wall(int bricks_a_course, int courses) {
  std::vector<Mesh> bricks;
  for (int course = 0; course < courses; ++course) {
    for (int i = 0; i < bricks_a_course; ++i) {
      const double x = 4.0 * i + (course % 2 == 0 ? 0.0 : 2.0);
      bricks.push_back(box({x, 0.0, 1.0 * course}, {x + 4.0, 2.0, 1.0 * course + 1.0}));
    }
  }
  return bricks;
}

std::vector<Mesh> nested_spheres(int count) {
  std::vector<Mesh> spheres;
  for (int i = 1; i <= count; ++i) spheres.push_back(icosphere(1, i));
  return spheres;
}

}  // namespace tact::tests
