#include "tests/support/oracles/motion_oracle.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "tests/support/oracles/exact_numbers.h"

namespace tact::tests {
namespace {

using narrowphase::MovingVertex;
using Integer = ExactInteger;

// Coefficients of powers of time, from the lowest; none on top is zero. Only signs are asked for, so that a positive
// factor may be anything.
using Polynomial = std::vector<Integer>;

Polynomial trimmed(Polynomial p) {
  while (!p.empty() && sign_of(p.back()) == 0) p.pop_back();
  return p;
}

Polynomial operator+(Polynomial p, const Polynomial& q) {
  if (p.size() < q.size()) p.resize(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) p[i] += q[i];
  return trimmed(std::move(p));
}

Polynomial operator-(Polynomial p, const Polynomial& q) {
  if (p.size() < q.size()) p.resize(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) p[i] -= q[i];
  return trimmed(std::move(p));
}

Polynomial operator*(const Polynomial& p, const Polynomial& q) {
  if (p.empty() || q.empty()) return {};
  Polynomial product(p.size() + q.size() - 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t k = 0; k < q.size(); ++k) product[i + k] += p[i] * q[k];
  }
  return trimmed(std::move(product));
}

Polynomial negative(Polynomial p) {
  for (Integer& c : p) c = -c;
  return p;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(Integer(static_cast<int>(i)) * p[i]);
  return d;
}

// numerator / 2^bits, from 0 to 1.
struct Time {
  Integer numerator;
  unsigned bits = 0;
};

Time middle_of(const Time& low, const Time& high) {
  const unsigned bits = std::max(low.bits, high.bits);
  return {(low.numerator << (bits - low.bits)) + (high.numerator << (bits - high.bits)), bits + 1};
}

bool is_before(const Time& s, const Time& t) {
  const unsigned bits = std::max(s.bits, t.bits);
  return (s.numerator << (bits - s.bits)) < (t.numerator << (bits - t.bits));
}

// p at a time, times a power of two: 2^(bits * degree), `degree` not less than that of p.
Integer value(const Polynomial& p, const Time& t, std::size_t degree) {
  Integer sum(0);
  for (std::size_t i = p.size(); i-- > 0;)
    sum = sum * t.numerator + (p[i] << (t.bits * static_cast<unsigned>(p.size() - 1 - i)));
  return sum << (t.bits * static_cast<unsigned>(degree + 1 - p.size()));
}

int sign_at(const Polynomial& p, const Time& t) { return p.empty() ? 0 : sign_of(value(p, t, p.size() - 1)); }

// c p = q * quotient + rest for some positive c.
std::pair<Polynomial, Polynomial> divided(Polynomial p, const Polynomial& q) {
  if (p.size() < q.size()) return {{}, p};
  Polynomial quotient(p.size() - q.size() + 1);
  const Integer top = abs(q.back());
  for (std::size_t i = quotient.size(); i-- > 0;) {
    const Integer factor = sign_of(q.back()) < 0 ? Integer(-p[i + q.size() - 1]) : p[i + q.size() - 1];
    for (Integer& c : p) c *= top;
    for (Integer& c : quotient) c *= top;
    quotient[i] = factor;
    for (std::size_t k = 0; k < q.size(); ++k) p[i + k] -= factor * q[k];
  }
  return {trimmed(std::move(quotient)), trimmed(std::move(p))};
}

// Without the common divisor of the coefficients, which would double its digits at each division.
Polynomial primitive(Polynomial p) {
  Integer content(0);
  for (const Integer& c : p) content = gcd(content, c);
  for (Integer& c : p) c /= content;
  return p;
}

Polynomial common_divisor(Polynomial p, Polynomial q) {
  while (!q.empty()) p = std::exchange(q, primitive(divided(p, q).second));
  return primitive(std::move(p));
}

double to_double(const Time& t) { return scaled(t.numerator, -static_cast<long>(t.bits)); }

constexpr unsigned kGuessed = 44;  // bits of a root that doubles mostly get right
constexpr unsigned kSimple = 10;   // bits of a root that is looked for exactly: many are a half

// A root of `f`, at which f changes its sign: the only one in (low, high], and if the two are one time it is that.
struct Root {
  Polynomial f;
  Time low, high;
  bool is_known = false;  // low and high are one time

  void set(const Time& t) {
    low = high = t;
    is_known = true;
  }
  // Takes the bracket around the root that doubles find, if f changes its sign in it.
  void jump() {
    std::size_t digits = 0;
    for (const Integer& exact : f) digits = std::max(digits, bits_of(exact));
    std::vector<double> c;
    for (const Integer& exact : f) c.push_back(scaled(exact, -static_cast<long>(digits)));
    const auto at = [&](double t) {
      double sum = 0.0;
      for (std::size_t i = c.size(); i-- > 0;) sum = sum * t + c[i];
      return sum;
    };
    double from = to_double(low), to = to_double(high);
    const bool rises = sign_at(f, low) < 0;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (from + to);
      ((at(middle) < 0.0) == rises ? from : to) = middle;
    }
    const Time simple{Integer(std::round(std::ldexp(from, kSimple))), kSimple};
    if (is_before(low, simple) && is_before(simple, high) && sign_at(f, simple) == 0) return set(simple);
    const Integer place(std::floor(std::ldexp(from, kGuessed)));
    const Time before{place - 1, kGuessed}, after{place + 2, kGuessed};
    if (!is_before(low, before) || !is_before(after, high)) return;
    const int sign = rises ? -1 : 1;
    if (sign_at(f, before) != sign || sign_at(f, after) != -sign) return;
    low = before;
    high = after;
  }
  void halve() {
    if (is_known) return;
    const Time middle = middle_of(low, high);
    const int sign = sign_at(f, middle);
    if (sign == 0) {
      set(middle);
    } else if (sign == sign_at(f, low)) {
      low = middle;
    } else {
      high = middle;
    }
  }
  // To a width of 2^-bits or less. Doubles guess where, signs decide.
  void narrow(unsigned bits) {
    if (!is_known && std::max(low.bits, high.bits) < kGuessed) jump();
    while (!is_known && (high.numerator << (std::max(low.bits, high.bits) - high.bits)) >
                            (low.numerator << (std::max(low.bits, high.bits) - low.bits)) +
                                (Integer(1) << std::max(low.bits, high.bits)) / (Integer(1) << bits))
      halve();
  }
};

const Time kBegin{Integer(0), 0}, kEnd{Integer(1), 0};

// How often the signs of a Sturm chain change.
int sign_changes(const std::vector<Polynomial>& chain, const Time& t) {
  int changes = 0, last = 0;
  for (const Polynomial& p : chain) {
    const int sign = sign_at(p, t);
    if (sign != 0 && last != 0 && sign != last) ++changes;
    if (sign != 0) last = sign;
  }
  return changes;
}

// How often the signs of the Bernstein coefficients on [0, 1] change: no root in (0, 1) if never, one, a single one, if
// once (Descartes' rule). -1 where an end is a root.
int bernstein_sign_changes(const Polynomial& p) {
  int changes = 0, last = 0;
  Polynomial c = p;
  // Of degree n: the sum over k of C(i, k) / C(n, k) c[k]; times n!, that is the sum of C(i, k) k! (n - k)! c[k].
  constexpr int kFactorials[] = {1, 1, 2, 6, 24, 120, 720};
  const auto factorial = [&](std::size_t k) { return kFactorials[k]; };
  const std::size_t n = p.size() - 1;
  for (std::size_t i = 0; i <= n; ++i) {
    Integer sum(0);
    for (std::size_t k = 0; k <= i; ++k) {
      const int ways = factorial(i) / (factorial(k) * factorial(i - k));
      sum += Integer(ways * factorial(k) * factorial(n - k)) * p[k];
    }
    const int sign = sign_of(sum);
    if (sign == 0 && (i == 0 || i == n)) return -1;
    if (sign != 0 && last != 0 && sign != last) ++changes;
    if (sign != 0) last = sign;
  }
  return changes;
}

// The roots in [0, 1] of a polynomial that is not zero.
std::vector<Root> roots_of(const Polynomial& p) {
  const int changes = bernstein_sign_changes(p);
  if (changes == 0) return {};
  if (changes == 1) return {{p, kBegin, kEnd}};
  std::vector<Root> roots;
  Polynomial f = primitive(divided(p, common_divisor(p, derivative(p))).first);
  for (const int end : {0, 1}) {
    const Time& at = end == 0 ? kBegin : kEnd;
    if (f.empty() || sign_at(f, at) != 0) continue;
    roots.push_back({f, at, at, true});
    f = divided(f, {Integer(-end), Integer(1)}).first;
  }
  if (f.size() < 2) return roots;
  std::vector<Polynomial> chain{f, derivative(f)};
  while (chain.back().size() > 1)
    chain.push_back(negative(primitive(divided(chain[chain.size() - 2], chain.back()).second)));
  std::vector<std::pair<Time, Time>> spans{{kBegin, kEnd}};
  while (!spans.empty()) {
    const auto [low, high] = spans.back();
    spans.pop_back();
    const int count = sign_changes(chain, low) - sign_changes(chain, high);
    if (count == 0) continue;
    if (count == 1) {
      roots.push_back({f, low, high});
      if (sign_at(f, high) == 0) roots.back().set(high);
      continue;
    }
    const Time middle = middle_of(low, high);
    spans.emplace_back(low, middle);
    spans.emplace_back(middle, high);
  }
  // The lower end of a span may be the root of another one: move it off.
  for (Root& root : roots) {
    while (!root.is_known && sign_at(root.f, root.low) == 0) {
      const Time middle = middle_of(root.low, root.high);
      if (sign_at(root.f, middle) == 0) {
        root.set(middle);
      } else if (sign_changes(chain, middle) - sign_changes(chain, root.high) == 1) {
        root.low = middle;
      } else {
        root.high = middle;
      }
    }
  }
  return roots;
}

// Does g keep away from zero between two times, of which it is known at the first? In [0, 1] it is nowhere steeper than
// the sum of the sizes of its derivative's coefficients.
bool keeps_sign(const Polynomial& g, const Root& root) {
  Integer slope(0);
  for (const Integer& c : derivative(g)) slope += abs(c);
  const unsigned bits = std::max(root.low.bits, root.high.bits);
  const Integer width =
      (root.high.numerator << (bits - root.high.bits)) - (root.low.numerator << (bits - root.low.bits));
  const Time low{root.low.numerator << (bits - root.low.bits), bits};
  const std::size_t degree = g.size() - 1;
  return degree == 0 || abs(value(g, low, degree)) > slope * (width << (bits * static_cast<unsigned>(degree - 1)));
}

constexpr unsigned kNarrow = 40;  // bits: nearly all signs are plain then, without a common divisor

// The sign of g at a root, which is narrowed.
int sign_at(const Polynomial& g, Root& root) {
  if (g.empty()) return 0;
  if (root.is_known) return sign_at(g, root.low);
  root.narrow(kNarrow);
  if (!root.is_known && !keeps_sign(g, root)) {
    const Polynomial both = common_divisor(root.f, g);
    if (both.size() > 1 && sign_at(both, root.low) * sign_at(both, root.high) <= 0) return 0;
    while (!root.is_known && !keeps_sign(g, root)) root.halve();
  }
  return sign_at(g, root.low);
}

using PolynomialVector = std::array<Polynomial, 3>;

PolynomialVector operator-(const PolynomialVector& a, const PolynomialVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Polynomial dot(const PolynomialVector& a, const PolynomialVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
PolynomialVector cross(const PolynomialVector& a, const PolynomialVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The exponent of its lowest bit; the largest int for zero.
int lowest_bit(double x) {
  if (x == 0.0) return std::numeric_limits<int>::max();
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  return exponent - 53 + std::countr_zero(static_cast<std::uint64_t>(mantissa));
}

// That of any coordinate.
int lowest_bit(std::span<const MovingVertex> vertices) {
  int lowest = std::numeric_limits<int>::max();
  for (const MovingVertex& vertex : vertices) {
    for (const Vec3& p : vertex.at) {
      for (int axis = 0; axis < 3; ++axis) lowest = std::min(lowest, lowest_bit(p[axis]));
    }
  }
  return lowest;
}

// x / 2^unit, which is an integer.
Integer in_units(double x, int unit) {
  if (x == 0.0) return Integer(0);
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(x, &exponent), 53);  // an integer
  const int shift = exponent - 53 - unit;
  Integer result(mantissa);
  if (shift > 0) result <<= static_cast<unsigned>(shift);
  if (shift < 0) result >>= static_cast<unsigned>(-shift);
  return result;
}

PolynomialVector way_of(const MovingVertex& vertex, int unit) {
  PolynomialVector way;
  for (int axis = 0; axis < 3; ++axis) {
    const Integer begin = in_units(vertex.at[0][axis], unit), end = in_units(vertex.at[1][axis], unit);
    way[axis] = trimmed({begin, end - begin});
  }
  return way;
}

double rounded(const Time& t, bool up) {
  const auto [low, high] = enclosed(t.numerator, -static_cast<long>(t.bits));
  return up ? high : low;
}

// A triangle, or a parallelogram in the order of its outline: when does it hold the origin?
class ExactPolygon {
 public:
  explicit ExactPolygon(std::vector<PolynomialVector> corners) : corners_(std::move(corners)) {
    normal_ = cross(corners_[1] - corners_[0], corners_.back() - corners_[0]);
    volume_ = dot(normal_, corners_[0]);
  }

  std::optional<TimeEnclosure> first_time() {
    Root begin{{}, kBegin, kBegin, true};
    if (holds_origin(begin)) return TimeEnclosure{0.0, 0.0};
    std::optional<Root> first;
    for (Root& root : candidates()) {
      if (holds_origin(root)) take_earlier(root, first);
    }
    return enclosure(first);
  }

  // The distance to the origin is at most `reach`, which is not zero.
  std::optional<TimeEnclosure> first_time_within(const Integer& reach) {
    const std::vector<Place> places = places_within(reach);
    Root begin{{}, kBegin, kBegin, true};
    const auto is_within = [&](const Place& place) {
      return sign_at(place.beyond, begin) <= 0 && is_nearest(place, begin);
    };
    if (std::ranges::any_of(places, is_within)) return TimeEnclosure{0.0, 0.0};
    std::optional<Root> first;
    for (const Place& place : places) {
      if (place.beyond.empty()) continue;  // then it begins to be the nearest where it is a place of less dimension
      for (Root& root : roots_of(place.beyond)) {
        if (is_nearest(place, root)) take_earlier(root, first);
      }
    }
    return enclosure(first);
  }

 private:
  // A corner, the line of a side or the plane.
  struct Place {
    Polynomial beyond;               // the square of its distance less that of the reach, times `square`
    Polynomial square;               // of the side or the normal: positive where it has one
    std::vector<Polynomial> inside;  // not negative where its place nearest to the origin is in the polygon
  };

  static bool is_nearest(const Place& place, Root& at) {
    return sign_at(place.square, at) > 0 &&
           std::ranges::all_of(place.inside, [&](const Polynomial& p) { return sign_at(p, at) >= 0; });
  }
  static void take_earlier(Root& root, std::optional<Root>& first) {
    root.narrow(60);
    if (!first || is_before(root.high, first->high)) first = root;
  }
  static std::optional<TimeEnclosure> enclosure(const std::optional<Root>& first) {
    if (!first) return std::nullopt;
    return TimeEnclosure{rounded(first->low, false), rounded(first->high, true)};
  }

  std::vector<Place> places_within(const Integer& reach) {
    const Polynomial square{reach * reach};
    std::vector<Place> places;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const PolynomialVector &corner = corners_[i], side = corners_[(i + 1) % corners_.size()] - corner,
                             moment = cross(corner, side);
      const Polynomial length = dot(side, side), along = dot(corner, side);
      places.push_back({dot(corner, corner) - square, {Integer(1)}, {}});
      places.push_back({dot(moment, moment) - square * length, length, {negative(along), length + along}});
    }
    make_sides();
    const Polynomial area = dot(normal_, normal_);
    places.push_back({volume_ * volume_ - square * area, area, inside_});
    return places;
  }

  // What is needed only where the volume vanishes.
  void make_sides() {
    if (!inside_.empty()) return;
    const std::size_t count = corners_.size();
    for (std::size_t i = 0; i < count; ++i) {
      const PolynomialVector& from = corners_[i];
      inside_.push_back(negative(dot(normal_, cross(corners_[(i + 1) % count] - from, from))));
    }
  }
  void make_lines() {
    if (!line_.empty()) return;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        line_.push_back(cross(corners_[i], corners_[k]));
        between_.push_back(dot(corners_[i], corners_[k]));
      }
    }
  }

  // Times at which it may begin to hold the origin.
  std::vector<Root> candidates() {
    if (!volume_.empty()) return roots_of(volume_);
    make_sides();
    make_lines();
    std::vector<Root> all;
    const auto add = [&](const Polynomial& p) {
      if (p.empty()) return;
      for (const Root& root : roots_of(p)) all.push_back(root);
    };
    for (const Polynomial& p : inside_) add(p);
    for (const Polynomial& p : between_) add(p);
    for (const Polynomial& p : normal_) add(p);
    for (const PolynomialVector& v : line_) {
      for (const Polynomial& p : v) add(p);
    }
    return all;
  }

  bool holds_origin(Root& at) {
    const bool is_root = !at.f.empty() && !volume_.empty();  // candidates are the volume's roots, then
    if (!is_root && sign_at(volume_, at) != 0) return false;
    const auto vanishes = [&](const PolynomialVector& v) {
      return std::ranges::all_of(v, [&](const Polynomial& p) { return sign_at(p, at) == 0; });
    };
    if (!vanishes(normal_)) {
      make_sides();
      return std::ranges::all_of(inside_, [&](const Polynomial& p) { return sign_at(p, at) >= 0; });
    }
    make_lines();
    for (std::size_t i = 0; i < line_.size(); ++i) {
      if (vanishes(line_[i]) && sign_at(between_[i], at) <= 0) return true;
    }
    return false;
  }

  std::vector<PolynomialVector> corners_;
  PolynomialVector normal_;
  Polynomial volume_;
  std::vector<Polynomial> inside_;      // of each side: where the origin is on its inner side
  std::vector<PolynomialVector> line_;  // of each two corners: zero where they are on a line with the origin
  std::vector<Polynomial> between_;     // and not positive where the origin is between them then
};

}  // namespace

namespace {

ExactPolygon polygon_of(const MovingVertex& vertex, const MovingVertex (&facet)[3], int unit) {
  std::vector<PolynomialVector> corners;
  for (const MovingVertex& corner : facet) corners.push_back(way_of(corner, unit) - way_of(vertex, unit));
  return ExactPolygon(corners);
}

ExactPolygon polygon_of(const MovingVertex (&edge)[2], const MovingVertex (&other)[2], int unit) {
  const auto way = [&](const MovingVertex& vertex) { return way_of(vertex, unit); };
  const auto p = way(edge[0]), q = way(edge[1]), r = way(other[0]), s = way(other[1]);
  return ExactPolygon({r - p, s - p, s - q, r - q});
}

int unit_of(const MovingVertex& vertex, const MovingVertex (&facet)[3]) {
  return std::min(lowest_bit({&vertex, 1}), lowest_bit(facet));
}
int unit_of(const MovingVertex (&edge)[2], const MovingVertex (&other)[2]) {
  return std::min(lowest_bit(edge), lowest_bit(other));
}

template <class One, class Other>
std::optional<TimeEnclosure> time_within(const One& one, const Other& other, double reach) {
  const int unit = std::min(unit_of(one, other), lowest_bit(reach));
  ExactPolygon polygon = polygon_of(one, other, unit);
  return reach == 0.0 ? polygon.first_time() : polygon.first_time_within(in_units(reach, unit));
}

}  // namespace

std::optional<TimeEnclosure> first_time_of_vertex_and_facet(const MovingVertex& vertex,
                                                            const MovingVertex (&facet)[3]) {
  return time_within(vertex, facet, 0.0);
}

std::optional<TimeEnclosure> first_time_of_edges(const MovingVertex (&edge)[2], const MovingVertex (&other)[2]) {
  return time_within(edge, other, 0.0);
}

std::optional<TimeEnclosure> first_time_within(const MovingVertex& vertex, const MovingVertex (&facet)[3],
                                               double reach) {
  return time_within(vertex, facet, reach);
}

std::optional<TimeEnclosure> first_time_within(const MovingVertex (&edge)[2], const MovingVertex (&other)[2],
                                               double reach) {
  return time_within(edge, other, reach);
}

}  // namespace tact::tests
