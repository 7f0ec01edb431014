#include "tests/support/generators/touching_hulls.h"

#include <cmath>

#include "tests/support/generators/hostile_hulls.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using base::Vec3;
using Points = std::vector<Vec3>;

// All coordinates are small integers, the common plane is x = 0: A lies below it and B above.
struct Contact {
  const char* kind;
  Points a, b;  // the points in the plane
};

double whole_number(Random& random, int low, int high) { return low + random.below(high - low + 1); }

// Across the plane's origin: from -p to a multiple of p.
Points segment_through_origin(Random& random, Vec3 p) { return {-1.0 * p, whole_number(random, 1, 3) * p}; }

Points triangle_around_origin(Random& random) {
  return {{0, whole_number(random, -4, -1), whole_number(random, -4, -1)},
          {0, whole_number(random, 5, 8), whole_number(random, -4, 0)},
          {0, whole_number(random, -4, 0), whole_number(random, 5, 8)}};
}

Contact contact(Random& random) {
  const Vec3 along{0, whole_number(random, 1, 4), whole_number(random, -4, 4)},
      across{0, whole_number(random, -2, 2), whole_number(random, 5, 9)};
  switch (random.below(6)) {
    case 0: return {"vertices", {{0, 0, 0}}, {{0, 0, 0}}};
    case 1: return {"edges", segment_through_origin(random, along), segment_through_origin(random, across)};
    case 2: return {"an edge in a face", triangle_around_origin(random), segment_through_origin(random, along)};
    case 3: return {"faces", triangle_around_origin(random), triangle_around_origin(random)};
    case 4: return {"a vertex in a face", triangle_around_origin(random), {{0, whole_number(random, 0, 1), 0}}};
    default: return {"a vertex in an edge", segment_through_origin(random, across), {{0, 0, 0}}};
  }
}

// The rest of a hull, on one side of the plane; nothing leaves it flat, straight or a point.
void grow(Points& points, double side, Random& random) {
  const int more = random.chance(0.2) ? 0 : 1 + random.below(6);
  for (int i = 0; i < more; ++i)
    points.push_back({side * whole_number(random, 1, 8), whole_number(random, -8, 8), whole_number(random, -8, 8)});
}

template <class Map>
void map(TouchingHulls& pair, const Map& function) {
  for (Points* points : {&pair.a, &pair.b}) {
    for (Vec3& p : *points) p = function(p);
  }
}

// Small integers stay small integers.
void shear(TouchingHulls& pair, Random& random) {
  for (int i = 0; i < 4; ++i) {
    const int to = random.below(3), from = (to + 1 + random.below(2)) % 3;
    const double by = whole_number(random, -2, 2);
    map(pair, [&](Vec3 p) {
      p[to] += by * p[from];
      return p;
    });
  }
}

// Moves one coordinate of one vertex by up to three units in the last place.
void nudge(TouchingHulls& pair, Random& random) {
  Points& points = random.chance(0.5) ? pair.a : pair.b;
  double& x = points[random.below(static_cast<int>(points.size()))][random.below(3)];
  const double toward = random.chance(0.5) ? HUGE_VAL : -HUGE_VAL;
  for (int i = 1 + random.below(3); i > 0; --i) x = std::nextafter(x, toward);
}

TouchingHulls on_a_lattice(Random& random) {
  const Contact in_plane = contact(random);
  TouchingHulls pair{in_plane.kind, in_plane.a, in_plane.b, {}};
  grow(pair.a, -1.0, random);
  grow(pair.b, 1.0, random);
  if (random.chance(0.3)) {  // needles
    const double thin = std::ldexp(1.0, -random.below(31));
    map(pair, [&](Vec3 p) { return Vec3{p.x, p.y, thin * p.z}; });
  }
  shear(pair, random);
  const Vec3 far{whole_number(random, 0, 1000), whole_number(random, -1000, 1000), whole_number(random, 0, 3)};
  if (random.chance(0.5)) map(pair, [&](Vec3 p) { return p + far; });
  if (random.chance(0.25)) {  // touches but for rounding
    const Rotation turn = random.rotation();
    map(pair, [&](Vec3 p) { return Vec3{dot(turn.row[0], p), dot(turn.row[1], p), dot(turn.row[2], p)}; });
  }
  return pair;
}

}  // namespace

TouchingHulls touching_hulls(std::uint64_t seed) {
  Random random(seed);
  const int kind = random.below(10);
  TouchingHulls pair;
  if (kind == 0) {
    const HullPair hostile = hostile_hull_pair(seed);
    pair = {hostile.kinds, hostile.a, random.chance(0.5) ? hostile.b : hostile.b_parted, {}};
  } else if (kind == 1) {
    const HullPair hostile = hull_pair_of_all_sizes(seed);
    pair = {hostile.kinds, hostile.a, hostile.b, {}};
  } else {
    pair = on_a_lattice(random);
  }
  if (random.chance(0.6)) nudge(pair, random);
  if (kind > 1) {
    const int exponent = random.chance(0.5) ? 0 : random.below(671) - 400;
    map(pair, [&](Vec3 p) {
      return Vec3{std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
    });
  }
  // Before, B was a little or far away, on any side.
  double size = 0.0;
  for (const Vec3& p : pair.b)
    size = std::max({size, std::abs(p.x - pair.b[0].x), std::abs(p.y - pair.b[0].y), std::abs(p.z - pair.b[0].z)});
  const Vec3 by = std::pow(10.0, random.uniform(-8.0, 0.5)) * size * random.direction();
  for (const Vec3& p : pair.b) pair.b_before.push_back(p + by);
  return pair;
}

}  // namespace tact::tests
