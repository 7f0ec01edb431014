#include "tests/support/inside/motion_queries.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace tact::tests {

using narrowphase::MovingPolygon;
using narrowphase::MovingVertex;

namespace {

using LongVector = std::array<long double, 3>;

LongVector operator-(const LongVector& a, const LongVector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
long double dot(const LongVector& a, const LongVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

constexpr double kNearlyMeets = 1e-11;  // what comes so near, over its size and way, may count

// How far the polygon is from the origin at a time, over its size and way: the least over its sides and, where the
// origin lies above it, its plane.
double distance_at(const MovingPolygon& polygon, double time) {
  long double size = 0.0L, least = 0.0L;
  std::array<LongVector, 4> p;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec3 corner[2] = {narrowphase::heads(polygon.corner[0][i]), narrowphase::heads(polygon.corner[1][i])};
    for (int axis = 0; axis < 3; ++axis) {
      const long double begin = corner[0][axis], end = corner[1][axis];
      p[i][axis] = begin + time * (end - begin);
      size = std::max({size, std::abs(begin), std::abs(end)});
    }
  }
  const auto count = static_cast<std::size_t>(polygon.count);
  least = std::numeric_limits<long double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const LongVector side = p[(i + 1) % count] - p[i];
    const long double length = dot(side, side);
    const long double s = length > 0.0L ? std::clamp(-dot(p[i], side) / length, 0.0L, 1.0L) : 0.0L;
    LongVector nearest = p[i];
    for (std::size_t axis = 0; axis < 3; ++axis) nearest[axis] += s * side[axis];
    least = std::min(least, std::sqrt(dot(nearest, nearest)));
  }
  const LongVector e = p[1] - p[0], f = p[count - 1] - p[0];
  const long double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), determinant = ee * ff - ef * ef;
  if (determinant > 0.0L) {
    const long double ep = -dot(e, p[0]), fp = -dot(f, p[0]);
    const long double u = (ff * ep - ef * fp) / determinant, v = (ee * fp - ef * ep) / determinant;
    if (u >= 0.0L && v >= 0.0L && (count == 4 ? u <= 1.0L && v <= 1.0L : u + v <= 1.0L)) {
      LongVector nearest = p[0];
      for (std::size_t axis = 0; axis < 3; ++axis) nearest[axis] += u * e[axis] + v * f[axis];
      least = std::min(least, std::sqrt(dot(nearest, nearest)));
    }
  }
  return size > 0.0L ? static_cast<double>(least / size) : 0.0;
}

}  // namespace

std::optional<TimeEnclosure> exact_time(const MotionQuery& query) {
  const auto& v = query.vertices;
  return query.edges ? first_time_of_edges({v[0], v[1]}, {v[2], v[3]})
                     : first_time_of_vertex_and_facet(v[0], {v[1], v[2], v[3]});
}

std::optional<TimeEnclosure> exact_time_within(const MotionQuery& query, double reach) {
  const auto& v = query.vertices;
  return query.edges ? first_time_within({v[0], v[1]}, {v[2], v[3]}, reach)
                     : first_time_within(v[0], {v[1], v[2], v[3]}, reach);
}

MotionQuery random_query(Random& random) {
  MotionQuery query;
  query.edges = random.chance(0.5);
  // Whole numbers of few bits make what is coplanar, parallel or equal common.
  const int grid = random.chance(0.5) ? 2 + random.below(6) : 0;
  const double unit = std::ldexp(1.0, random.chance(0.1) ? random.below(1250) - 960 : random.below(40) - 20);
  const Vec3 origin = random.chance(0.3) ? 1e3 * unit * random.in_cube(1.0) : Vec3{};
  const bool rigid = random.chance(0.2), flat = random.chance(0.1);
  const Vec3 way = random.in_cube(3.0);
  for (MovingVertex& vertex : query.vertices) {
    for (Vec3& p : vertex.at) {
      if (grid > 0) {
        p = {double(random.below(grid)), double(random.below(grid)), flat ? 0.0 : double(random.below(grid))};
      } else {
        p = random.in_cube(1.0);
        if (flat) p.z = 0.0;
      }
    }
    if (rigid) vertex.at[1] = vertex.at[0] + (&vertex < &query.vertices[query.edges ? 2 : 1] ? way : Vec3{});
    if (random.chance(0.1)) vertex.at[1] = vertex.at[0];
  }
  if (random.chance(0.1)) query.vertices[3] = query.vertices[2];
  for (MovingVertex& vertex : query.vertices) {
    for (Vec3& p : vertex.at) p = origin + unit * p;
  }
  return query;
}

MotionQuery grazing_query(Random& random) {
  MotionQuery query = random_query(random);
  const double s = random.below(3) * 0.5, t = random.chance(0.5) ? 0.0 : random.uniform();
  const auto middle = [&](std::size_t k) {
    const auto& at = query.vertices[k].at;
    return 0.5 * (at[0] + at[1]);
  };
  const Vec3 target = query.edges ? middle(2) + s * (middle(3) - middle(2))
                                  : middle(1) + s * (middle(2) - middle(1)) + t * (1.0 - s) * (middle(3) - middle(1));
  auto& first = query.vertices[0].at;
  first[1] = 2.0 * target - first[0];
  return query;
}

MotionQuery query_in_plane(Random& random) {
  const auto vertex = [&](double x, double z) {
    return MovingVertex{{{x, 0.5 * x, z}, {x, 0.5 * x, z + random.uniform(-1.0, 1.0)}}};
  };
  const double left = random.below(5) * 0.25 - 0.5, up = random.uniform(-0.5, 0.5);
  MotionQuery query;
  query.edges = true;
  query.vertices = {vertex(0.0, 0.0), vertex(1.0, 0.25 * random.uniform()), vertex(left, up),
                    vertex(left + 0.5 + 0.25 * random.below(3), up + 0.25 * random.uniform())};
  return query;
}

MotionQuery query_of_layers(Random& random) {
  const int up = random.below(3);  // an axis
  const double place = random.chance(0.3) ? random.uniform(-100.0, 100.0) : 0.0;
  MotionQuery query;
  query.edges = random.chance(0.5);
  for (std::size_t i = 0; i < query.vertices.size(); ++i) {
    const bool is_above = i < (query.edges ? 2u : 1u);
    const int x = random.below(2), y = random.below(3);
    const double begin = random.uniform(0.0, 0.5), way = random.uniform(-1.0, 1.0);
    for (const int time : {0, 1}) {
      Vec3& p = query.vertices[i].at[time];
      p[(up + 1) % 3] = place + 0.1 * x;
      p[(up + 2) % 3] = 0.1 * y - place;
      p[up] = begin + time * (is_above ? way - 0.5 : way) + (is_above ? 0.5 : 0.0);
    }
  }
  return query;
}

// All coordinates are multiples of a tenth, as a program computes them.
MotionQuery query_past_corner(Random& random) {
  MotionQuery query;
  query.edges = random.chance(0.7);
  const bool is_fine = random.chance(0.5);  // so that nothing is rounded
  const auto tenths = [&](int count) { return (is_fine ? 0.125 : 0.1) * count; };
  const auto corner = [&] { return Vec3{tenths(random.below(3)), tenths(random.below(3)), tenths(random.below(2))}; };
  const auto step = [&] { return tenths(10 * (random.below(3) - 1)); };
  const Vec3 place{tenths(random.below(21) - 10), tenths(random.below(21) - 10), tenths(random.below(5) - 2)};
  const Vec3 way{step(), step(), random.chance(0.3) ? step() : 0.0};
  for (std::size_t i = 0; i < query.vertices.size(); ++i) {
    const bool moves = i < (query.edges ? 2u : 1u);
    auto& at = query.vertices[i].at;
    at[0] = corner() + (moves ? place : Vec3{});
    at[1] = at[0] + (moves ? way : Vec3{});
  }
  // An edge of a box is along an axis.
  if (query.edges && random.chance(0.7)) {
    for (const std::size_t first : {0u, 2u}) {
      const int axis = random.below(3);
      for (const int time : {0, 1}) {
        query.vertices[first + 1].at[time] = query.vertices[first].at[time];
        query.vertices[first + 1].at[time][axis] += tenths(10);
      }
    }
  }
  return query;
}

double reach_for(const MotionQuery& query, Random& random) {
  const MovingPolygon polygon = query.polygon();
  double size = 0.0;
  for (const auto& corners : polygon.corner) {
    for (int i = 0; i < polygon.count; ++i) size = std::max(size, norm(narrowphase::heads(corners[i])));
  }
  const double part = random.chance(0.3)   ? 0.125 * (1 + random.below(8))
                      : random.chance(0.5) ? std::ldexp(random.uniform(), -random.below(24))
                                           : distance_at(polygon, random.chance(0.5) ? 0.5 : random.uniform());
  return random.chance(0.3) ? 0.1 * (1 + random.below(5)) : part * size;
}

namespace {

// What is wrong with an answer.
std::string failure_of(const std::string& what, const MotionQuery& query, double time,
                       const std::optional<TimeEnclosure>& exact, double reach = 0.0) {
  std::ostringstream text;
  text.precision(17);
  text << what << ": time " << time;
  if (exact) text << ", the true one " << exact->low;
  if (reach > 0.0) text << ", reach " << reach;
  text << (query.edges ? "; edges" : "; vertex and facet");
  for (const MovingVertex& vertex : query.vertices) {
    for (const Vec3& p : vertex.at) text << "  " << p.x << " " << p.y << " " << p.z;
  }
  return text.str();
}

// The least and the largest reach that may count (MeetingSearch): that given, or the share of what is nearer, or but
// next to nothing farther away, at the start; nothing where it is either by next to nothing.
struct CountingReach {
  double least, most;
};
std::optional<CountingReach> counting_reach(const MotionQuery& query, double reach, double near) {
  const double above = (1.0 + narrowphase::kJustAbove) * reach;
  const auto starts_within = [&](double distance) {
    if (distance <= 0.0) return false;
    const auto time = exact_time_within(query, distance);
    return time && time->high == 0.0;
  };
  if (!starts_within(above + near)) return CountingReach{reach, reach + near};
  if (!starts_within(above - near)) return std::nullopt;
  const MovingPolygon polygon = query.polygon();
  const double begin = distance_at(polygon, 0.0) * near / kNearlyMeets;
  return CountingReach{std::max(narrowphase::kShareOfGap * (begin - 0.01 * near), 0.0),
                       narrowphase::kShareOfGap * begin + near};
}

}  // namespace

CheckedQuery check_within(const MotionQuery& query, double reach, narrowphase::MeetingSearch& search) {
  if (reach == 0.0) return check(query, search);
  const MovingPolygon polygon = query.polygon();
  const double time = search.first(polygon, reach).time;
  double size = 0.0;
  for (const auto& corners : polygon.corner) {
    for (int i = 0; i < polygon.count; ++i) {
      const Vec3 p = narrowphase::heads(corners[i]);
      size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  }
  const auto counts = counting_reach(query, reach, kNearlyMeets * size);
  if (!counts) return {};
  const auto exact = exact_time_within(query, counts->least), wide = exact_time_within(query, counts->most);
  if (exact && !(time <= exact->high))
    return {QueryAnswer::meets, failure_of(time > 1.0 ? "missed" : "late", query, time, exact, reach)};
  if (time > 1.0) return {};
  if (!wide) return {QueryAnswer::misses_but_counts, failure_of("reported, but stays beyond", query, time, {}, reach)};
  constexpr double kEarly = 0x1p-40;
  if (time < wide->low - kEarly) return {QueryAnswer::meets, failure_of("early", query, time, wide, reach)};
  return {exact ? QueryAnswer::meets : QueryAnswer::misses_but_counts, {}};
}

CheckedQuery check(const MotionQuery& query, narrowphase::MeetingSearch& search) {
  const MovingPolygon polygon = query.polygon();
  const double time = search.first(polygon, 0.0).time;
  const auto exact = exact_time(query);
  const auto failed = [&](const std::string& what) { return failure_of(what, query, time, exact); };
  if (!exact && time > 1.0) return {QueryAnswer::misses, {}};
  if (!exact) {
    const bool is_near = distance_at(polygon, time) < kNearlyMeets;
    return {QueryAnswer::misses_but_counts, is_near ? std::string() : failed("reported, but misses")};
  }
  if (!(time <= exact->high)) return {QueryAnswer::meets, failed(time > 1.0 ? "missed" : "late")};
  const bool is_right = time > exact->low - 1e-6 || distance_at(polygon, time) < kNearlyMeets;
  return {QueryAnswer::meets, is_right ? std::string() : failed("early")};
}

}  // namespace tact::tests
