// Distances of points from facets and times of segments through them, against rational numbers: no double is nearer.
#include <gtest/gtest.h>

#include <cmath>

#include "narrowphase/distance/facet_distance.h"
#include "narrowphase/distance/segment_facet.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/triangle_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::Random;

// From 1e-20 to 1.
double size_below_one(Random& random) { return std::pow(10.0, -random.uniform(0.0, 20.0)); }

// Wide, narrow, small, in line, or at whole numbers.
Triangle any_facet(Random& random) {
  Triangle t{random.in_cube(1.0), random.in_cube(1.0), random.in_cube(1.0)};
  switch (random.below(5)) {
    case 0: t[2] = t[0] + 0.3 * (t[1] - t[0]) + size_below_one(random) * random.in_cube(1.0); break;
    case 1:
      for (std::size_t k = 1; k < 3; ++k) t[k] = t[0] + size_below_one(random) * random.in_cube(1.0);
      break;
    case 2: t[2] = random.chance(0.5) ? t[1] : 2.0 * t[1] - t[0]; break;
    case 3:
      for (Vec3& p : t) p = {1.0 * random.below(9) - 4, 1.0 * random.below(9) - 4, 1.0 * random.below(9) - 4};
      break;
    default: break;
  }
  return t;
}

Vec3 place_in(const Triangle& t, Random& random) {
  const double s = random.chance(0.2) ? 0.0 : random.uniform(),
               u = random.chance(0.2) ? 0.0 : random.uniform(0.0, 1.0 - s);
  return t[0] + s * (t[1] - t[0]) + u * (t[2] - t[0]);
}

Vec3 any_point(const Triangle& t, Random& random) {
  switch (random.below(5)) {
    case 0: return place_in(t, random);
    case 1: return place_in(t, random) + size_below_one(random) * random.in_cube(1.0);
    case 2: return {1.0 * random.below(17) - 8, 1.0 * random.below(17) - 8, 1.0 * random.below(17) - 8};
    case 3: return 1e3 * random.in_cube(1.0);
    default: return 2.0 * random.in_cube(1.0);
  }
}

// Of any unit, down to where hardly a digit is left.
double any_unit(Random& random) {
  return random.chance(0.6) ? 1.0
                            : std::ldexp(1.0, random.chance(0.5) ? -1040 + random.below(60) : random.below(500) - 250);
}

TEST(RoundedNumbers, NoDoubleIsNearerToADistance) {
  Random random(3);
  for (int i = 0; i < 4000; ++i) {
    const double unit = any_unit(random);
    Triangle t = any_facet(random);
    const Vec3 point = unit * any_point(t, random);
    for (Vec3& p : t) p = unit * p;
    const double distance = rounded_distance(point, t);
    ASSERT_TRUE(tests::is_nearest_to_distance(distance, point, t)) << i << ", unit " << unit << ": " << distance;
  }
}

TEST(RoundedNumbers, NoDoubleIsNearerToATime) {
  Random random(4);
  PredicateCounts counts;
  int met = 0;
  for (int i = 0; i < 8000; ++i) {
    const double unit = any_unit(random);
    Triangle t = any_facet(random);
    const Vec3 from = any_point(t, random), target = place_in(t, random);
    const Vec3 to = random.chance(0.3) ? target : from + random.uniform(0.5, 3.0) * (target - from);
    const Segment segment{unit * from, unit * to};
    for (Vec3& p : t) p = unit * p;
    const auto off = [&](Vec3 p) { return orient3d(t[0], t[1], t[2], p, counts) != 0; };
    if (!(off(segment[0]) || off(segment[1])) || !segment_triangle_meet(segment, t, counts)) continue;
    ++met;
    const double time = crossing_time(segment, t);
    ASSERT_TRUE(tests::is_nearest_to_time(time, segment[0], segment[1], t)) << i << ", unit " << unit << ": " << time;
    ASSERT_EQ(first_place(segment, t).time, time) << i;
  }
  EXPECT_GT(met, 2000);
}

}  // namespace
}  // namespace tact::narrowphase
