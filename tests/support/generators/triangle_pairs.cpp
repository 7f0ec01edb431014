#include "tests/support/generators/triangle_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using base::Vec3;

// Both bounds included.
int integer(Random& random, int lower, int upper) { return lower + random.below(upper - lower + 1); }
bool one_in(Random& random, int n) { return random.below(n) == 0; }

// Between -1 and 1, every bit of the significand in use.
double real(Random& random) {
  const double size = random.uniform(0.5, 1.0);
  return size * random.uniform(-1.0, 1.0);
}

Vec3 point(Random& random) {
  const double x = real(random);
  const double y = real(random);
  return {x, y, real(random)};
}

// Integers from -8 to 8.
Vec3 lattice_point(Random& random) {
  const double x = integer(random, -8, 8);
  const double y = integer(random, -8, 8);
  return {x, y, static_cast<double>(integer(random, -8, 8))};
}

Triangle triangle(Random& random) { return {point(random), point(random), point(random)}; }
Triangle lattice_triangle(Random& random) {
  return {lattice_point(random), lattice_point(random), lattice_point(random)};
}

using Pair = std::pair<Triangle, Triangle>;

Pair crossing(Random& random) {
  const Triangle a = triangle(random);
  const double s = 0.5 + 0.6 * real(random);
  const double t = 0.5 + 0.6 * real(random);
  const Vec3 through = a[0] + s * (a[1] - a[0]) + (t * (1.0 - s)) * (a[2] - a[0]);
  const Vec3 along = point(random);
  return {a, {through + along, through - real(random) * along, point(random)}};
}

Pair coplanar(Random& random) {
  const Vec3 origin = lattice_point(random);
  const Vec3 u = lattice_point(random);
  const Vec3 v = lattice_point(random);
  const int reach = integer(random, 1, 6);
  const auto corner = [&] {
    const int i = integer(random, -reach, reach);
    const int j = integer(random, -reach, reach);
    return origin + i * u + j * v;
  };
  return {{corner(), corner(), corner()}, {corner(), corner(), corner()}};
}

Pair axis_plane(Random& random) {
  Pair pair{triangle(random), triangle(random)};
  const double level = real(random);
  for (Triangle* t : {&pair.first, &pair.second}) {
    for (Vec3& p : *t) p.z = level;
  }
  return pair;
}

Pair sharing(Random& random, std::size_t corners) {
  const bool lattice = one_in(random, 2);
  Pair pair =
      lattice ? Pair{lattice_triangle(random), lattice_triangle(random)} : Pair{triangle(random), triangle(random)};
  std::copy_n(pair.first.begin(), corners, pair.second.begin());
  return pair;
}

Pair touching(Random& random) {
  Triangle a = lattice_triangle(random);
  for (Vec3& p : a) p = 4.0 * p;
  const int i = integer(random, 0, 4);
  const int j = integer(random, 0, 4 - i);
  const Vec3 on = 0.25 * (i * a[0] + j * a[1] + (4 - i - j) * a[2]);
  return {a, {on, on + lattice_point(random), on + lattice_point(random)}};
}

Pair edge_edge(Random& random) {
  const Vec3 at = lattice_point(random);
  const Vec3 u = lattice_point(random);
  const Vec3 v = lattice_point(random);
  return {{at - integer(random, 0, 3) * u, at + integer(random, 0, 3) * u, lattice_point(random)},
          {at - integer(random, 0, 3) * v, at + integer(random, 0, 3) * v, lattice_point(random)}};
}

// A triangle with corner 2 at a distance of 1e-4 to 1e-12 from the edge 01: near its middle, or near corner 0.
Triangle thin(Random& random, const Vec3& through, bool needle) {
  const Vec3 along = point(random);
  const Vec3 start = through - 0.5 * along;
  const double width = std::pow(10.0, -integer(random, 4, 12));
  const double at = needle ? 0.0 : random.uniform();
  return {start, start + along, start + at * along + width * point(random)};
}

Pair thin_pair(Random& random, bool needle) {
  const Vec3 through = point(random);
  const Triangle a = thin(random, through, needle);
  if (one_in(random, 2)) return {a, thin(random, through, needle)};
  const Vec3 p = point(random);
  const Vec3 q = point(random);
  return {a, {through + p, through - 0.7 * p + 0.3 * q, through - 0.4 * q}};
}

Pair few_values(Random& random, int values, double unit) {
  Pair pair;
  for (Triangle* t : {&pair.first, &pair.second}) {
    for (Vec3& p : *t) {
      for (int axis = 0; axis < 3; ++axis) p[axis] = unit * integer(random, 0, values - 1);
    }
  }
  return pair;
}

Pair collinear(Random& random) {
  const Vec3 origin = lattice_point(random);
  const Vec3 along = lattice_point(random);
  const int reach = integer(random, 0, 4);
  const auto on_line = [&] { return origin + integer(random, -reach, reach) * along; };
  const Triangle a{on_line(), on_line(), on_line()};
  switch (integer(random, 0, 3)) {
    case 0: return {a, {on_line(), on_line(), on_line()}};
    case 1: return {a, {on_line(), on_line(), lattice_point(random)}};
    case 2: {
      const Vec3 from = on_line();
      const Vec3 step = lattice_point(random);
      return {a, {from - integer(random, 0, 2) * step, from + integer(random, 0, 2) * step, from}};
    }
    default: {
      const Vec3 u = lattice_point(random);
      const Vec3 v = lattice_point(random);
      const Vec3 in = on_line();
      return {a, {in + 2.0 * u - v, in + 2.0 * v - u, in - u - v}};
    }
  }
}

Pair of_kind(PairKind kind, Random& random) {
  switch (kind) {
    case PairKind::random: break;
    case PairKind::crossing: return crossing(random);
    case PairKind::coplanar: return coplanar(random);
    case PairKind::axis_plane: return axis_plane(random);
    case PairKind::shared_vertex: return sharing(random, 1);
    case PairKind::shared_edge: return sharing(random, 2);
    case PairKind::identical: return sharing(random, 3);
    case PairKind::touching: return touching(random);
    case PairKind::edge_edge: return edge_edge(random);
    case PairKind::sliver: return thin_pair(random, false);
    case PairKind::needle: return thin_pair(random, true);
    case PairKind::grid: return few_values(random, 3, 1.0);
    case PairKind::tenths: return few_values(random, 10, 0.1);
    case PairKind::collinear: return collinear(random);
  }
  return {triangle(random), triangle(random)};
}

const char* name(PairKind kind) {
  static constexpr const char* kKindNames[kPairKinds] = {
      "random",   "crossing",  "coplanar", "axis_plane", "shared_vertex", "shared_edge", "identical",
      "touching", "edge_edge", "sliver",   "needle",     "grid",          "tenths",      "collinear"};
  return kKindNames[static_cast<int>(kind)];
}

template <class Function>
void for_each_point(TrianglePair& pair, const Function& function) {
  for (Triangle* t : {&pair.a, &pair.b}) {
    for (Vec3& p : *t) function(p);
  }
}

void move_and_scale(TrianglePair& pair, Random& random) {
  if (one_in(random, 6)) {
    const double size = std::pow(10.0, integer(random, 0, 8));
    const Vec3 by{std::trunc(size * real(random)), std::trunc(size * real(random)), size};
    for_each_point(pair, [&](Vec3& p) { p = p + by; });
  }
  // The largest coordinate of any kind is below 2^7, and below 2^28 with an offset: 2^270 keeps it below 2^300.
  constexpr int kExponents[] = {-1060, -1000, -700, -290, -100, -30, 30, 100, 270};
  const bool by_axis = one_in(random, 8);
  if (!by_axis && !one_in(random, 3)) return;
  int exponent[3];
  for (int& e : exponent) e = kExponents[integer(random, 0, 8)];
  for_each_point(pair, [&](Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::ldexp(p[axis], exponent[by_axis ? axis : 0]);
  });
}

double moved_by_ulps(double x, int ulps) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return ulps == 0 ? x : std::nextafter(x, ulps > 0 ? kInfinity : -kInfinity);
}

void disturb(TrianglePair& pair, Random& random) {
  const int how = integer(random, 0, 2);
  if (how == 1) {
    Triangle& t = one_in(random, 2) ? pair.a : pair.b;
    Vec3& p = t[integer(random, 0, 2)];
    const int axis = integer(random, 0, 2);
    p[axis] = moved_by_ulps(p[axis], one_in(random, 2) ? 1 : -1);
  }
  if (how == 2) {
    for_each_point(pair, [&](Vec3& p) {
      for (int axis = 0; axis < 3; ++axis) p[axis] = moved_by_ulps(p[axis], integer(random, -1, 1));
    });
  }
}

void shuffle(TrianglePair& pair, Random& random) {
  const int first = integer(random, 0, 2);
  const int second = (first + integer(random, 1, 2)) % 3;
  const int third = 3 - first - second;
  for_each_point(pair, [&](Vec3& p) { p = {p[first], p[second], p[third]}; });
  pair = all_orders(pair)[integer(random, 0, 71)];
}

}  // namespace

TrianglePair hard_triangle_pair(std::uint64_t seed, std::uint64_t index) {
  Random random(Random(seed).bits() ^ (index * 0x9e3779b97f4a7c15u));
  const auto kind = static_cast<PairKind>(index % kPairKinds);
  const Pair shape = of_kind(kind, random);
  TrianglePair pair{shape.first, shape.second, kind};
  move_and_scale(pair, random);
  disturb(pair, random);
  shuffle(pair, random);
  return pair;
}

std::array<TrianglePair, 72> all_orders(const TrianglePair& pair) {
  constexpr std::size_t kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  std::array<TrianglePair, 72> result;
  std::size_t next = 0;
  for (const auto& i : kOrders) {
    for (const auto& j : kOrders) {
      const Triangle a{pair.a[i[0]], pair.a[i[1]], pair.a[i[2]]};
      const Triangle b{pair.b[j[0]], pair.b[j[1]], pair.b[j[2]]};
      result[next++] = {a, b, pair.kind};
      result[next++] = {b, a, pair.kind};
    }
  }
  return result;
}

std::string to_string(const TrianglePair& pair) {
  std::string text = name(pair.kind);
  for (const Triangle* t : {&pair.a, &pair.b}) {
    text += "\n  ";
    for (const Vec3& p : *t) {
      char buffer[128];
      std::snprintf(buffer, sizeof buffer, "{%a, %a, %a} ", p.x, p.y, p.z);
      text += buffer;
    }
  }
  return text;
}

}  // namespace tact::tests
