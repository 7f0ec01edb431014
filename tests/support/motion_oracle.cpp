#include "tests/support/motion_oracle.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace tact::tests {
namespace {

using narrowphase::MovingVertex;
using Rational = CGAL::Exact_rational;

// Coefficients of powers of time, from the lowest; none on top is zero.
using Polynomial = std::vector<Rational>;

Polynomial trimmed(Polynomial p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

Polynomial operator+(const Polynomial& p, const Polynomial& q) {
  Polynomial sum(std::max(p.size(), q.size()), Rational(0));
  for (std::size_t i = 0; i < p.size(); ++i) sum[i] += p[i];
  for (std::size_t i = 0; i < q.size(); ++i) sum[i] += q[i];
  return trimmed(sum);
}

Polynomial operator*(const Polynomial& p, const Polynomial& q) {
  if (p.empty() || q.empty()) return {};
  Polynomial product(p.size() + q.size() - 1, Rational(0));
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t k = 0; k < q.size(); ++k) product[i + k] += p[i] * q[k];
  }
  return trimmed(product);
}

Polynomial negative(Polynomial p) {
  for (Rational& c : p) c = -c;
  return p;
}

Polynomial operator-(const Polynomial& p, const Polynomial& q) { return p + negative(q); }

Rational value(const Polynomial& p, const Rational& t) {
  Rational sum(0);
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * t + p[i];
  return sum;
}

int sign_of(const Rational& x) { return static_cast<int>(CGAL::sign(x)); }

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(Rational(static_cast<int>(i)) * p[i]);
  return d;
}

// p = q * quotient + rest.
std::pair<Polynomial, Polynomial> divided(Polynomial p, const Polynomial& q) {
  if (p.size() < q.size()) return {{}, p};
  Polynomial quotient(p.size() - q.size() + 1, Rational(0));
  for (std::size_t i = quotient.size(); i-- > 0;) {
    quotient[i] = p[i + q.size() - 1] / q.back();
    for (std::size_t k = 0; k < q.size(); ++k) p[i + k] -= quotient[i] * q[k];
  }
  return {trimmed(quotient), trimmed(p)};
}

Polynomial common_divisor(Polynomial p, Polynomial q) {
  while (!q.empty()) p = std::exchange(q, divided(p, q).second);
  return p;
}

// A root of `f`, which has no double one: its only one in (low, high], and if low = high it is that.
struct Root {
  Polynomial f;
  Rational low, high;

  void halve() {
    if (low == high) return;
    const Rational middle = (low + high) / 2;
    const int sign = sign_of(value(f, middle));
    if (sign == 0) {
      low = high = middle;
    } else if (sign == sign_of(value(f, low))) {
      low = middle;
    } else {
      high = middle;
    }
  }
};

// How often the signs of a Sturm chain change.
int sign_changes(const std::vector<Polynomial>& chain, const Rational& t) {
  int changes = 0, last = 0;
  for (const Polynomial& p : chain) {
    const int sign = sign_of(value(p, t));
    if (sign != 0 && last != 0 && sign != last) ++changes;
    if (sign != 0) last = sign;
  }
  return changes;
}

// The roots in [0, 1] of a polynomial that is not zero.
std::vector<Root> roots_of(const Polynomial& p) {
  std::vector<Root> roots;
  Polynomial f = divided(p, common_divisor(p, derivative(p))).first;
  for (const int end : {0, 1}) {
    if (f.empty() || value(f, Rational(end)) != 0) continue;
    roots.push_back({f, Rational(end), Rational(end)});
    f = divided(f, {Rational(-end), Rational(1)}).first;
  }
  if (f.size() < 2) return roots;
  std::vector<Polynomial> chain{f, derivative(f)};
  while (chain.back().size() > 1) chain.push_back(negative(divided(chain[chain.size() - 2], chain.back()).second));
  std::vector<std::pair<Rational, Rational>> spans{{Rational(0), Rational(1)}};
  while (!spans.empty()) {
    const auto [low, high] = spans.back();
    spans.pop_back();
    const int count = sign_changes(chain, low) - sign_changes(chain, high);
    if (count == 0) continue;
    if (count == 1) {
      const bool at_end = value(f, high) == 0;
      roots.push_back({f, at_end ? high : low, high});
      continue;
    }
    const Rational middle = (low + high) / 2;
    spans.emplace_back(low, middle);
    spans.emplace_back(middle, high);
  }
  // The lower end of a span may be the root of another one: move it off.
  for (Root& root : roots) {
    while (root.low != root.high && value(root.f, root.low) == 0) {
      const Rational middle = (root.low + root.high) / 2;
      if (value(root.f, middle) == 0) {
        root.low = root.high = middle;
      } else if (sign_changes(chain, middle) - sign_changes(chain, root.high) == 1) {
        root.low = middle;
      } else {
        root.high = middle;
      }
    }
  }
  return roots;
}

// The sign of g at a root.
int sign_at(const Polynomial& g, Root root) {
  if (g.empty()) return 0;
  if (root.low == root.high) return sign_of(value(g, root.low));
  const Polynomial both = common_divisor(root.f, g);
  if (both.size() > 1 && sign_of(value(both, root.low)) * sign_of(value(both, root.high)) <= 0) return 0;
  // In [0, 1] g is nowhere steeper than this.
  Rational slope(0);
  for (const Rational& c : derivative(g)) slope += CGAL::abs(c);
  while (root.low != root.high) {
    const Rational at = value(g, root.low);
    if (CGAL::abs(at) > slope * (root.high - root.low)) return sign_of(at);
    root.halve();
  }
  return sign_of(value(g, root.low));
}

using PolynomialVector = std::array<Polynomial, 3>;

PolynomialVector operator-(const PolynomialVector& a, const PolynomialVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Polynomial dot(const PolynomialVector& a, const PolynomialVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
PolynomialVector cross(const PolynomialVector& a, const PolynomialVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

PolynomialVector way_of(const MovingVertex& vertex) {
  PolynomialVector way;
  for (int axis = 0; axis < 3; ++axis) {
    const Rational begin(vertex.at[0][axis]), end(vertex.at[1][axis]);
    way[static_cast<std::size_t>(axis)] = trimmed({begin, end - begin});
  }
  return way;
}

// A triangle, or a parallelogram in the order of its outline: when does it hold the origin?
class ExactPolygon {
 public:
  explicit ExactPolygon(std::vector<PolynomialVector> corners) : corners_(std::move(corners)) {
    const std::size_t count = corners_.size();
    normal_ = cross(corners_[1] - corners_[0], corners_[count - 1] - corners_[0]);
    volume_ = dot(normal_, corners_[0]);
    for (std::size_t i = 0; i < count; ++i) {
      const PolynomialVector& from = corners_[i];
      inside_.push_back(negative(dot(normal_, cross(corners_[(i + 1) % count] - from, from))));
      for (std::size_t k = 0; k < i; ++k) {
        line_.push_back(cross(from, corners_[k]));
        between_.push_back(dot(from, corners_[k]));
      }
    }
  }

  std::optional<TimeEnclosure> first_time() const {
    const Root begin{{}, Rational(0), Rational(0)};
    if (holds_origin(begin)) return TimeEnclosure{0.0, 0.0};
    std::optional<Root> first;
    for (Root& root : candidates()) {
      if (!holds_origin(root)) continue;
      while (root.high - root.low > Rational(0x1p-60)) root.halve();
      if (!first || root.high < first->high) first = root;
    }
    if (!first) return std::nullopt;
    return TimeEnclosure{CGAL::to_interval(first->low).first, CGAL::to_interval(first->high).second};
  }

 private:
  // Times at which it may begin to hold the origin.
  std::vector<Root> candidates() const {
    if (!volume_.empty()) return roots_of(volume_);
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

  bool holds_origin(const Root& at) const {
    if (sign_at(volume_, at) != 0) return false;
    const auto vanishes = [&](const PolynomialVector& v) {
      return std::ranges::all_of(v, [&](const Polynomial& p) { return sign_at(p, at) == 0; });
    };
    if (!vanishes(normal_))
      return std::ranges::all_of(inside_, [&](const Polynomial& p) { return sign_at(p, at) >= 0; });
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

std::optional<TimeEnclosure> first_time_of_vertex_and_facet(const MovingVertex& vertex,
                                                            const MovingVertex (&facet)[3]) {
  std::vector<PolynomialVector> corners;
  for (const MovingVertex& corner : facet) corners.push_back(way_of(corner) - way_of(vertex));
  return ExactPolygon(corners).first_time();
}

std::optional<TimeEnclosure> first_time_of_edges(const MovingVertex (&edge)[2], const MovingVertex (&other)[2]) {
  const auto p = way_of(edge[0]), q = way_of(edge[1]), r = way_of(other[0]), s = way_of(other[1]);
  return ExactPolygon({r - p, s - p, s - q, r - q}).first_time();
}

}  // namespace tact::tests
