#include "tests/support/oracles/body_oracle.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/oracles/query_oracle.h"

namespace tact::tests {

namespace {

template <class Number>
using PointOf = std::array<Number, 3>;

template <class Number>
PointOf<Number> minus(const PointOf<Number>& p, const PointOf<Number>& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
template <class Number>
Number product(const PointOf<Number>& p, const PointOf<Number>& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
template <class Number>
PointOf<Number> across(const PointOf<Number>& p, const PointOf<Number>& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
template <class Number>
PointOf<Number> as(Vec3 p) {
  return {Number(p.x), Number(p.y), Number(p.z)};
}

using Rational = CGAL::Exact_rational;
using RationalPoint = PointOf<Rational>;
using RationalTriangle = std::array<RationalPoint, 3>;

Rational square_from_edge(const RationalPoint& v, const RationalPoint& p, const RationalPoint& q) {
  const RationalPoint side = minus(q, p), way = minus(v, p);
  const Rational length = product(side, side), along = product(way, side);
  if (along <= 0) return product(way, way);
  if (along >= length) return product(minus(v, q), minus(v, q));
  const RationalPoint area = across(way, side);
  return product(area, area) / length;
}

Rational square_from_facet(const RationalPoint& v, const RationalTriangle& t) {
  const RationalPoint normal = across(minus(t[1], t[0]), minus(t[2], t[0]));
  Rational least = square_from_edge(v, t[0], t[1]);
  bool inside = product(normal, normal) != 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const RationalPoint &p = t[k], &q = t[(k + 1) % 3];
    least = std::min(least, square_from_edge(v, p, q));
    inside = inside && product(across(minus(q, p), minus(v, p)), normal) >= 0;
  }
  if (!inside) return least;
  const Rational height = product(minus(v, t[0]), normal);
  return height * height / product(normal, normal);
}

// Inside both, where they are not parallel; what is nearest at an end is seen from there.
void look_between(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r, const RationalPoint& s,
                  Rational& least) {
  const RationalPoint u = minus(q, p), w = minus(s, r), between = minus(r, p), normal = across(u, w);
  const Rational square = product(normal, normal);
  if (square == 0) return;
  const Rational on_u = product(across(between, w), normal), on_w = product(across(between, u), normal);
  if (on_u < 0 || on_u > square || on_w < 0 || on_w > square) return;
  const Rational height = product(between, normal);
  least = std::min(least, Rational(height * height / square));
}

RationalTriangle rational(const Triangle& t) { return {as<Rational>(t[0]), as<Rational>(t[1]), as<Rational>(t[2])}; }

double box_distance(const Triangle& t, const Triangle& u) {
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low_t, high_t] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    const auto [low_u, high_u] = std::minmax({u[0][axis], u[1][axis], u[2][axis]});
    const double away = std::max({low_t - high_u, low_u - high_t, 0.0});
    square += away * away;
  }
  return std::sqrt(square);
}

using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using FinePoint = PointOf<Number>;

// Turned about a unit axis.
struct Turn {
  FinePoint axis;
  FinePoint at(const FinePoint& p, const Number& angle) const {
    const Number along = product(axis, p), c = cos(angle), s = sin(angle);
    const FinePoint beside = across(axis, p);
    FinePoint turned;
    for (std::size_t k = 0; k < 3; ++k) turned[k] = along * axis[k] + c * (p[k] - along * axis[k]) + s * beside[k];
    return turned;
  }
};

// The angles from 0 to `most` at which a number that is constant + cosine + sine of it is zero.
template <class Function>
std::vector<Number> zeros(const Function& f, const Number& most) {
  const Number pi = boost::math::constants::pi<Number>();
  const Number at_0 = f(Number(0)), at_quarter = f(Number(pi / 2)), at_half = f(pi);
  const Number constant = (at_0 + at_half) / 2, cosine = (at_0 - at_half) / 2, sine = at_quarter - constant;
  const Number size = sqrt(cosine * cosine + sine * sine);
  std::vector<Number> found;
  if (size == 0 || abs(constant) > size) return found;
  const Number middle = atan2(sine, cosine), away = acos(Number(-constant / size));
  for (const Number& root : {Number(middle - away), Number(middle + away)}) {
    Number first = fmod(root, Number(2 * pi));
    if (first < 0) first += 2 * pi;
    for (; first <= most; first += 2 * pi) found.push_back(first);
  }
  return found;
}

Number volume(const FinePoint& p, const FinePoint& q, const FinePoint& r, const FinePoint& s) {
  return product(across(minus(q, p), minus(r, p)), minus(s, p));
}

bool is_over(const FinePoint& v, const std::array<FinePoint, 3>& t) {
  const FinePoint normal = across(minus(t[1], t[0]), minus(t[2], t[0]));
  for (std::size_t k = 0; k < 3; ++k) {
    if (product(across(minus(t[(k + 1) % 3], t[k]), minus(v, t[k])), normal) < 0) return false;
  }
  return true;
}

bool cross_inside(const FinePoint& p, const FinePoint& q, const FinePoint& r, const FinePoint& s) {
  const FinePoint u = minus(q, p), w = minus(s, r), between = minus(r, p), normal = across(u, w);
  const Number square = product(normal, normal), on_u = product(across(between, w), normal),
               on_w = product(across(between, u), normal);
  return on_u >= 0 && on_u <= square && on_w >= 0 && on_w <= square;
}

}  // namespace

double exact_distance(const Triangle& triangle, const Triangle& other) {
  if (cgal_meet(triangle, other)) return 0.0;
  const RationalTriangle t = rational(triangle), u = rational(other);
  Rational least = square_from_facet(t[0], u);
  for (std::size_t k = 0; k < 3; ++k) {
    least = std::min({least, square_from_facet(t[k], u), square_from_facet(u[k], t)});
    for (std::size_t m = 0; m < 3; ++m) look_between(t[k], t[(k + 1) % 3], u[m], u[(m + 1) % 3], least);
  }
  return std::sqrt(CGAL::to_double(least));
}

double exact_distance(const Mesh& a, const Mesh& b, double guess) {
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < a.facet_count(); ++f) {
    for (int g = 0; g < b.facet_count(); ++g) {
      const Triangle t = facet_at(a, f), u = facet_at(b, g);
      if (box_distance(t, u) <= std::min(guess, least) * (1.0 + 1e-12)) least = std::min(least, exact_distance(t, u));
    }
  }
  return least;
}

std::optional<double> first_on_turn(const Triangle& triangle, Vec3 axis, double angle, const Triangle& other) {
  if (cgal_meet(triangle, other)) return 0.0;
  Turn turn{as<Number>(axis)};
  const Number length = sqrt(product(turn.axis, turn.axis)), way = angle < 0.0 ? -1 : 1;
  for (Number& x : turn.axis) x = way * x / length;
  std::array<FinePoint, 3> t, u;
  for (std::size_t k = 0; k < 3; ++k) t[k] = as<Number>(triangle[k]), u[k] = as<Number>(other[k]);
  const Number most = abs(Number(angle));
  Number first = 2 * most;
  const auto take = [&](const auto& f, const auto& meets) {
    for (const Number& at : zeros(f, most)) {
      if (at < first && meets(at)) first = at;
    }
  };
  for (std::size_t k = 0; k < 3; ++k) {
    take([&](const Number& at) { return volume(u[0], u[1], u[2], turn.at(t[k], at)); },
         [&](const Number& at) { return is_over(turn.at(t[k], at), u); });
    take([&](const Number& at) { return volume(t[0], t[1], t[2], turn.at(u[k], -at)); },
         [&](const Number& at) { return is_over(turn.at(u[k], -at), t); });
    for (std::size_t m = 0; m < 3; ++m) {
      const FinePoint &p = t[k], &q = t[(k + 1) % 3], &r = u[m], &s = u[(m + 1) % 3];
      take([&](const Number& at) { return volume(turn.at(p, at), turn.at(q, at), r, s); },
           [&](const Number& at) { return cross_inside(turn.at(p, at), turn.at(q, at), r, s); });
    }
  }
  if (first > most) return {};
  return static_cast<double>(first / most);
}

}  // namespace tact::tests
