#include "tests/support/generators/hostile_hulls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "narrowphase/direction/contact_direction.h"
#include "narrowphase/mesh/refit.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/mesh_through.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::tests {
namespace {

using Points = std::vector<Vec3>;

void move(Points& points, Vec3 by) {
  for (Vec3& p : points) p = p + by;
}

void scale(Points& points, Vec3 by) {
  for (Vec3& p : points) p = {by.x * p.x, by.y * p.y, by.z * p.z};
}

void turn(Points& points, Random& random) {
  const Rotation rotation = random.rotation();
  for (Vec3& p : points) p = {dot(rotation.row[0], p), dot(rotation.row[1], p), dot(rotation.row[2], p)};
}

double power_of_ten(Random& random, double low, double high) { return std::pow(10.0, random.uniform(low, high)); }

Points cloud(Random& random, int least, int most) {
  Points points(static_cast<std::size_t>(least + random.below(most - least + 1)));
  for (Vec3& p : points) p = random.in_cube(1.0);
  return points;
}

Points corners_of_box(Vec3 half) {
  Points points;
  for (int i = 0; i < 8; ++i)
    points.push_back({i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
  return points;
}

Points flat_cloud(Random& random) {
  Points points = cloud(random, 4, 8);
  scale(points, {1.0, 1.0, power_of_ten(random, -16, -3)});
  turn(points, random);
  return points;
}

Points needle(Random& random) {
  Points points = cloud(random, 4, 8);
  const double width = power_of_ten(random, -14, -2);
  scale(points, {1.0, width, width * random.uniform(0.1, 1.0)});
  turn(points, random);
  return points;
}

Points rod(Random& random) {
  Points points = corners_of_box({1.0, power_of_ten(random, -11, -1), power_of_ten(random, -11, -1)});
  if (random.chance(0.5)) turn(points, random);
  return points;
}

Points box_of_eighths(Random& random) {
  const auto eighths = [&] { return (1 + random.below(4)) / 8.0; };
  return corners_of_box({eighths(), eighths(), eighths()});
}

Points lattice(Random&) {
  Points points;
  for (int i = 0; i < 27; ++i) points.push_back({i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0});
  return points;
}

Points ball(Random& random) {
  Points points(static_cast<std::size_t>(20 + random.below(41)));
  for (Vec3& p : points) p = random.direction();
  return points;
}

Points sheet_cloud(Random& random) {
  Points points = cloud(random, 3, 6);
  scale(points, {1.0, 1.0, 0.0});
  if (random.chance(0.5)) turn(points, random);
  return points;
}

Points segment(Random& random) { return cloud(random, 2, 2); }

Points tiny(Random& random) {
  Points points = cloud(random, 4, 8);
  const double size = power_of_ten(random, -9, -1);
  scale(points, {size, size, size});
  return points;
}

Points prism(Random& random) {
  const int sides = 5 + random.below(26);
  Points points;
  const double height = power_of_ten(random, -10, 1);
  for (int i = 0; i < 2 * sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % sides) / sides;
    points.push_back({std::cos(angle), std::sin(angle), i < sides ? 0.0 : height});
  }
  if (random.chance(0.5)) turn(points, random);
  return points;
}

Points nearly_twice(Random& random) {
  Points points = cloud(random, 4, 7);
  for (std::size_t i = 0, count = points.size(); i < count; ++i) {
    if (random.chance(0.5)) points.push_back(points[i] + 1e-15 * random.direction());
  }
  return points;
}

struct Kind {
  const char* name;
  Points (*make)(Random&);
};

Points some_cloud(Random& random) { return cloud(random, 4, 8); }

constexpr std::array<Kind, 12> kHullKinds{{{"cloud", some_cloud},
                                           {"flat", flat_cloud},
                                           {"needle", needle},
                                           {"rod", rod},
                                           {"box", box_of_eighths},
                                           {"lattice", lattice},
                                           {"ball", ball},
                                           {"sheet", sheet_cloud},
                                           {"segment", segment},
                                           {"tiny", tiny},
                                           {"prism", prism},
                                           {"nearly twice", nearly_twice}}};

Vec3 inside(const Points& points, Random& random) {
  Vec3 sum;
  double weights = 0.0;
  for (const Vec3& p : points) {
    const double weight = random.uniform();
    sum = sum + weight * p;
    weights += weight;
  }
  return (1.0 / weights) * sum;
}

Vec3 any_of(const Points& points, Random& random) { return points[random.below(static_cast<int>(points.size()))]; }

// Points inside each other, the same drawn apart until they touch, or two vertices in one place.
void place(const Points& a, Points& b, Random& random) {
  const int how = random.below(6);
  if (how == 5) return;
  move(b, how == 4 ? any_of(a, random) - any_of(b, random) : inside(a, random) - inside(b, random));
  if (how != 3) return;
  const SmallestHeight smallest = smallest_height(a, b, 0.0);
  move(b, static_cast<double>(smallest.height) * smallest.directions[0]);
}

constexpr double kUnitRoundoff = 0x1p-53;
constexpr std::size_t kFacesOfPoints = 40;

Points relative(Points points, Vec3 to) {
  move(points, -to);
  return points;
}

Points relative(std::span<const Vec3> points, Vec3 to) { return relative(Points(points.begin(), points.end()), to); }

double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0.0;
  for (const Vec3& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

// How far p lies beyond the hull of a few points, seen along their edges, across pairs of them, and across both; at
// most so far as it does.
double beyond(const Points& hull, Vec3 p) {
  Points directions;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    directions.push_back(p - hull[i]);
    for (std::size_t j = 0; j < i; ++j) directions.push_back(hull[i] - hull[j]);
  }
  for (std::size_t i = 0, edges = directions.size(); i < edges; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 n = cross(directions[i], directions[j]);
      directions.insert(directions.end(), {n, cross(n, directions[i]), cross(n, directions[j])});
    }
  }
  double farthest = 0.0;
  for (const Vec3& d : directions) {
    const double length = norm(d);
    if (!(length > 0.0)) continue;
    for (const double sign : {1.0, -1.0}) {
      const Vec3 n = (sign / length) * d;
      double least = dot(n, p - hull[0]);
      for (const Vec3& v : hull) least = std::min(least, dot(n, p - v));
      farthest = std::max(farthest, least);
    }
  }
  return farthest;
}

// A point is a sum of up to four vertices about m.origin(), which are no farther from it than the size: the difference,
// product and sum of each and the weights have 8 roundoffs of the size together. Moving it back from m.origin() rounds
// it to the coordinates. The offset is such a sum as well, of vertices up to twice the size, with edges up to four
// times.
std::string problem_of_points(std::span<const Vec3> a, std::span<const Vec3> b,
                              const narrowphase::MinkowskiDifference& m, const narrowphase::GjkResult& result) {
  const double size = m.size() / m.scale(), far = std::max(largest_coordinate(a), largest_coordinate(b));
  const double of_point = kUnitRoundoff * (8.0 * size + 2.0 * far), of_check = 8.0 * kUnitRoundoff * size;
  const narrowphase::ClosestPoints closest = closest_points(m, result);
  const auto named = [&](std::span<const Vec3> hull, const std::array<int, 4>& vertices) {
    Points points;
    for (std::size_t i = 0; i < static_cast<std::size_t>(result.simplex.count); ++i)
      points.push_back(hull[vertices[i]] - a[0]);
    return points;
  };
  const double beyond_a = beyond(named(a, result.simplex.a), closest.a - a[0]),
               beyond_b = beyond(named(b, result.simplex.b), closest.b - a[0]),
               between = norm((closest.a - closest.b) - (1.0 / m.scale()) * result.offset);
  std::ostringstream problem;
  if (!(beyond_a <= of_point + of_check)) problem << "the point of A is " << beyond_a / size << " sizes outside; ";
  if (!(beyond_b <= of_point + of_check)) problem << "the point of B is " << beyond_b / size << " sizes outside; ";
  if (!(between <= 2.0 * of_point + 3.0 * of_check))
    problem << "the points are " << between / size << " sizes from the offset; ";
  return problem.str();
}

std::vector<double> coordinates(const Points& points) {
  std::vector<double> result;
  for (const Vec3& p : points) result.insert(result.end(), {p.x, p.y, p.z});
  return result;
}

}  // namespace

HullPair hostile_hull_pair(std::uint64_t seed) {
  Random random(seed);
  const auto any_kind = [&] { return kHullKinds[random.below(kHullKinds.size())]; };
  HullPair pair;
  const Kind kind = any_kind();
  pair.a = kind.make(random);
  const Kind other = random.chance(0.3) ? kind : any_kind();
  pair.b = random.chance(0.1) ? pair.a : other.make(random);
  pair.kinds = std::string(kind.name) + " and " + other.name;
  place(pair.a, pair.b, random);
  const double size = random.chance(0.5) ? 1.0 : power_of_ten(random, -9, 9);
  const Vec3 far = random.chance(0.25) ? size * power_of_ten(random, 0, 8) * random.direction() : Vec3{};
  const Points a = pair.a, b = pair.b;
  for (Points* points : {&pair.a, &pair.b}) {
    scale(*points, {size, size, size});
    move(*points, far);
  }
  pair.b_before = pair.b;
  move(pair.b_before, power_of_ten(random, -6, -1) * size * random.direction());
  pair.start = random.direction();
  pair.b_parted = b;
  move(pair.b_parted,
       (static_cast<double>(minkowski_height(a, b, pair.start)) + power_of_ten(random, -14, 1)) * pair.start);
  scale(pair.b_parted, {size, size, size});
  move(pair.b_parted, far);
  return pair;
}

HullPair hull_pair_of_all_sizes(std::uint64_t seed) {
  Random random(seed);
  const int largest = 10 + random.below(281);
  const auto coordinate = [&] {
    return std::ldexp(random.uniform(-1.0, 1.0), random.below(2 * largest + 1) - largest);
  };
  HullPair pair;
  pair.kinds = "all sizes up to 2^" + std::to_string(largest);
  pair.start = random.direction();
  for (int i = 0; i < 4; ++i) {
    Vec3 a, before, now;
    for (int axis = 0; axis < 3; ++axis) {
      a[axis] = coordinate();
      before[axis] = coordinate();
      now[axis] = random.chance(0.5) ? before[axis] : coordinate();
    }
    pair.a.push_back(a);
    pair.b_before.push_back(before);
    pair.b.push_back(now);
  }
  return pair;
}

std::string problem_of_directions(const HullPair& pair, std::int64_t& directions) {
  using namespace narrowphase;
  const ClusteredMesh a = mesh_through(pair.a);
  ClusteredMesh b = mesh_through(pair.b_before);
  FaceFinder faces;
  GjkSimplex face;
  Vec3 start = pair.start;
  std::ostringstream problem;
  for (const Points* now : {&pair.b_before, &pair.b}) {
    refit(b, coordinates(*now).data());
    const MinkowskiDifference m(a, b);
    if (gjk(m, {}, {}, {}).status == GjkStatus::apart) continue;
    const ContactDirection found = contact_direction(m, start, face, {}, faces);
    ++directions;
    // Far from zero, heights about a near point are exact enough for the oracle.
    const Points near_a = relative(pair.a, pair.a[0]), near_b = relative(*now, pair.a[0]);
    const double size = m.size() / m.scale(), depth = found.height / m.scale();
    const auto height = [&](Vec3 n) { return static_cast<double>(minkowski_height(near_a, near_b, n)); };
    if (found.limit_reached) problem << "given up after " << found.iterations << " iterations; ";
    if (!(std::abs(depth - height(found.n)) <= 1e-13 * size)) problem << "depth " << depth << " is not w; ";
    if (!(height(found.n) <= height(start) + 1e-13 * size)) problem << "above its start; ";
    if (found.height > 8.0 * m.height_error() && !is_local_minimum(near_a, near_b, found.n, 1e-12 * size))
      problem << "no local minimum at depth " << depth / size << " of the size; ";
    start = found.n;
    face = found.face;
  }
  return problem.str().empty() ? "" : pair.kinds + ": " + problem.str();
}

std::string problem_of_distance(std::span<const Vec3> a, std::span<const Vec3> b, DistanceCounts& counts) {
  using namespace narrowphase;
  const ClusteredMesh mesh_a = mesh_through(a), mesh_b = mesh_through(b);
  const MinkowskiDifference m(mesh_a, mesh_b);
  const GjkSettings settings;
  const GjkResult result = gjk(m, {}, {}, settings);
  std::ostringstream problem;
  const bool apart = result.status == GjkStatus::apart;
  const double size = m.size() / m.scale(), error = m.height_error() / m.scale(),
               distance = result.distance / m.scale(), rounding = 32.0 * kUnitRoundoff * size;
  const double gap = settings.tolerance * distance + rounding;  // as GjkSettings says
  // Far from zero, heights about a near point are exact enough for the oracle.
  const Points near_a = relative(a, a[0]), near_b = relative(b, a[0]);
  counts.apart += apart ? 1 : 0;
  counts.touching += result.status == GjkStatus::touching ? 1 : 0;
  counts.overlapping += result.status == GjkStatus::overlapping ? 1 : 0;
  if (result.status == GjkStatus::limit_reached) problem << "given up; ";
  if (apart) {
    if (!result.closed) problem << "bounds are " << (result.distance - result.lower_bound) / m.scale() << " apart; ";
    const double height = -static_cast<double>(minkowski_height(near_a, near_b, -result.offset));
    if (!(height > 0.0)) problem << "apart by " << height << "; ";
    if (!(std::abs(distance - height) <= gap + error))
      problem << "distance " << distance << " and height " << height << " differ by " << (distance - height) / size
              << " of the size; ";
  } else if (a.size() + b.size() <= kFacesOfPoints) {
    // A touching point is within this of M.
    const double outside = result.status == GjkStatus::touching ? 2.0 * (error + rounding) : 0.0;
    const double height = static_cast<double>(smallest_height(near_a, near_b, 0.0).height);
    if (!(height >= -outside - error)) problem << "not apart at height " << height << "; ";
  }
  problem << problem_of_points(a, b, m, result);
  return problem.str();
}

}  // namespace tact::tests
