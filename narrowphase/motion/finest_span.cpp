#include "narrowphase/motion/finest_span.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace tact::narrowphase {

namespace {

// How much is added to a span at either end in doubles.
constexpr double kMargin = 0x1p-30;
// Parts are halved down to this part of the step, until this many were looked at.
constexpr double kShortestPart = 0x1p-64;
constexpr int kMostParts = 2048, kMostSteps = 20;
// How far around the time at which a side turns to the origin that is proved: as near as most allow, or still less than
// is promised.
constexpr double kNarrowOpening = 0x1p-36, kWideOpening = 0x1p-23;
constexpr std::size_t kMostWaiting = 72;  // a half at each halving

// Rounding. Coordinates of corners are wrong by at most c: 12 u * 2 in doubles, 2^-99 in double-double. Sides, of at
// most e, f and g along each axis, are wrong by 2 c. Then the volume is wrong by less than 64 c (e + f + ef), and the
// product for a side by less than 256 c ((e + f) g + ef (g + 2)). The factors 3 and 6 below are included.
template <class Number>
constexpr double kRoundingOf = 0.0;
template <>
constexpr double kRoundingOf<double> = 0x1p-40;
template <>
constexpr double kRoundingOf<DoubleDouble> = 0x1p-86;

double head_of(double x) { return x; }
double head_of(DoubleDouble x) { return x.head; }
double scaled(double x, double by) { return x * by; }
double number(DoubleDouble x, double) { return x.head; }
DoubleDouble number(DoubleDouble x, DoubleDouble) { return x; }
using narrowphase::scaled;

NumberVector<double> scaled(const NumberVector<double>& v, double by) { return by * v; }

template <class Number>
double size_of(const NumberVector<Number>& a) {
  return std::max({std::abs(head_of(a.x)), std::abs(head_of(a.y)), std::abs(head_of(a.z))});
}

// A vector at the ends of a span between which it is linear.
template <class Number>
using Way = std::array<NumberVector<Number>, 2>;
template <class Number>
Way<Number> operator-(const Way<Number>& a, const Way<Number>& b) {
  return {a[0] - b[0], a[1] - b[1]};
}
template <class Number>
double size_of(const Way<Number>& a) {
  return std::max(size_of(a[0]), size_of(a[1]));
}

// Bernstein coefficients on a span.
template <class Number>
using Quadratic = std::array<NumberVector<Number>, 3>;
template <class Number>
Quadratic<Number> cross(const Way<Number>& a, const Way<Number>& b) {
  return {cross(a[0], b[0]), scaled(cross(a[0], b[1]) + cross(a[1], b[0]), 0.5), cross(a[1], b[1])};
}

template <class Number, std::size_t kCount>
struct Polynomial {
  std::array<Number, kCount> coefficient;
  double rounding = 0.0;

  bool positive() const {
    return std::ranges::all_of(coefficient, [&](const Number& c) { return head_of(c) > rounding; });
  }
  bool negative() const {
    return std::ranges::all_of(coefficient, [&](const Number& c) { return head_of(c) < -rounding; });
  }
  bool vanishes() const {
    return std::ranges::all_of(coefficient, [&](const Number& c) { return std::abs(head_of(c)) <= rounding; });
  }
  bool crosses() const {
    const double begin = head_of(coefficient.front()), end = head_of(coefficient.back());
    return (begin > rounding && end < -rounding) || (begin < -rounding && end > rounding);
  }
  // Keeps the part of the span before `t`, 0 to 1, and returns the part after it (de Casteljau).
  Polynomial split(double t) {
    Polynomial second = *this;
    auto& c = second.coefficient;
    for (std::size_t left = kCount; left-- > 1;) {
      for (std::size_t i = 0; i < left; ++i)
        c[i] = t == 0.5 ? scaled(c[i] + c[i + 1], 0.5) : c[i] + number({t}, Number{}) * (c[i + 1] - c[i]);
      coefficient[kCount - left] = c[0];
    }
    return second;
  }
  Number at(double t) const {
    Polynomial before = *this;
    before.split(t);
    return before.coefficient.back();
  }
};

template <class Number>
Number times(double factor, const Number& x) {
  return number({factor}, Number{}) * x;
}

// The corners of a polygon at both ends of a span, scaled.
template <class Number>
std::array<Way<Number>, 4> corners_on(const MovingPolygon& polygon, double scale, double from, double to) {
  std::array<Way<Number>, 4> corners;
  const auto vector = [&](const DoubleDoubleVec3& v) {
    return scaled(NumberVector<Number>{number(v.x, Number{}), number(v.y, Number{}), number(v.z, Number{})}, scale);
  };
  for (int i = 0; i < polygon.count; ++i) {
    const NumberVector<Number> begin = vector(polygon.corner[0][i]), way = vector(polygon.corner[1][i]) - begin;
    const auto at = [&](double time) {
      return begin + NumberVector<Number>{times(time, way.x), times(time, way.y), times(time, way.z)};
    };
    corners[i] = {at(from), at(to)};
  }
  return corners;
}

// The volume of the pyramid over a polygon's first corner and the sides that leave it; six times that.
template <class Number>
Polynomial<Number, 4> volume_of(const Way<Number>& corner, const Way<Number>& e, const Way<Number>& f,
                                const Quadratic<Number>& normal) {
  const auto& [d0, d1] = corner;
  const double e_size = size_of(e), f_size = size_of(f);
  return {{times(3.0, dot(d0, normal[0])), dot(d1, normal[0]) + times(2.0, dot(d0, normal[1])),
           times(2.0, dot(d1, normal[1])) + dot(d0, normal[2]), times(3.0, dot(d1, normal[2]))},
          kRoundingOf<Number> * (e_size + f_size + e_size * f_size)};
}

template <class Number>
struct SpanPolynomials {
  Polynomial<Number, 4> volume;
  std::array<Polynomial<Number, 5>, 4> inside;  // of each side: positive where the origin is on its inner side
  int sides = 0;

  SpanPolynomials(const MovingPolygon& polygon, double scale, double from, double to) : sides(polygon.count) {
    const std::array<Way<Number>, 4> corner = corners_on<Number>(polygon, scale, from, to);
    const auto last = static_cast<std::size_t>(sides - 1);
    const Way<Number> e = corner[1] - corner[0], f = corner[last] - corner[0];
    const Quadratic<Number> normal = cross(e, f);
    volume = volume_of(corner[0], e, f, normal);
    const double e_size = size_of(e), f_size = size_of(f);
    for (std::size_t i = 0; i <= last; ++i) {
      const Way<Number> side = corner[i == last ? 0 : i + 1] - corner[i];
      const Quadratic<Number> n = cross(corner[i], side);
      const auto mixed = [&](std::size_t k, std::size_t l) { return dot(normal[k], n[l]); };
      inside[i].coefficient = {times(6.0, mixed(0, 0)), times(3.0, mixed(0, 1) + mixed(1, 0)),
                               mixed(0, 2) + times(4.0, mixed(1, 1)) + mixed(2, 0),
                               times(3.0, mixed(1, 2) + mixed(2, 1)), times(6.0, mixed(2, 2))};
      const double g_size = size_of(side);
      inside[i].rounding = kRoundingOf<Number> * ((e_size + f_size) * g_size + e_size * f_size * (g_size + 2.0));
    }
  }

  bool certainly_holds_origin() const { return volume.crosses() && is_inside(); }
  // All the time, as far as these digits tell.
  bool seems_to_hold_origin() const { return volume.vanishes() && is_inside(); }
  bool is_inside() const {
    return std::all_of(inside.begin(), inside.begin() + sides, [](const auto& p) { return p.positive(); });
  }
  bool certainly_never_holds_origin() const {
    return volume.positive() || volume.negative() ||
           std::any_of(inside.begin(), inside.begin() + sides, [](const auto& p) { return p.negative(); });
  }
  SpanPolynomials split(double t) {
    SpanPolynomials second = *this;
    second.volume = volume.split(t);
    for (std::size_t i = 0; i < static_cast<std::size_t>(sides); ++i) second.inside[i] = inside[i].split(t);
    return second;
  }
};

// A point or a segment: it does not hold the origin while any of these keeps its sign, or while the last one, the
// product of the corners, is positive.
struct ThinPolynomials {
  std::array<Polynomial<DoubleDouble, 3>, 4> all;

  ThinPolynomials(const MovingPolygon& polygon, double scale, double from, double to) {
    const auto corners = corners_on<DoubleDouble>(polygon, scale, from, to);
    const Way<DoubleDouble>& p = corners[0];
    const double rounding = kRoundingOf<DoubleDouble> * size_of(p);
    if (polygon.count == 1) {
      const auto linear = [&](DoubleDouble begin, DoubleDouble end) {
        return Polynomial<DoubleDouble, 3>{{begin, scaled(begin + end, 0.5), end}, kRoundingOf<DoubleDouble>};
      };
      all = {linear(p[0].x, p[1].x), linear(p[0].y, p[1].y), linear(p[0].z, p[1].z), {{}, 1.0}};
      return;
    }
    const Way<DoubleDouble>& q = corners[1];
    const auto [n0, n1, n2] = cross(p, q - p);
    const double side = size_of(q - p);
    const double error = rounding + kRoundingOf<DoubleDouble> * side;
    all = {Polynomial<DoubleDouble, 3>{{n0.x, n1.x, n2.x}, error},
           {{n0.y, n1.y, n2.y}, error},
           {{n0.z, n1.z, n2.z}, error},
           {{dot(p[0], q[0]), scaled(dot(p[0], q[1]) + dot(p[1], q[0]), 0.5), dot(p[1], q[1])}, error}};
  }

  bool certainly_never_holds_origin() const {
    return std::any_of(all.begin(), all.begin() + 3, [](const auto& p) { return p.positive() || p.negative(); }) ||
           all[3].positive();
  }
  bool seems_to_hold_origin() const { return false; }
  bool certainly_holds_origin() const { return false; }
  ThinPolynomials split(double t) {
    ThinPolynomials second = *this;
    for (std::size_t i = 0; i < all.size(); ++i) second.all[i] = all[i].split(t);
    return second;
  }
};

// The time at which the volume changes its sign, if it does so once and is certainly not zero outside of `margin`
// around it.
std::optional<std::pair<double, double>> only_crossing(const Polynomial<DoubleDouble, 4>& volume, double margin) {
  if (!volume.crosses()) return std::nullopt;
  const double slope = volume.coefficient.back().head - volume.coefficient.front().head;  // nearly: the span is short
  double low = 0.0, high = 1.0, root = 0.5;
  for (int k = 0; k < kMostSteps; ++k) {
    const double value = volume.at(root).head;
    ((value < 0.0) == (slope > 0.0) ? low : high) = root;
    const double next = root - value / slope;
    const double last = std::exchange(root, low < next && next < high ? next : 0.5 * (low + high));
    if (std::abs(root - last) < 0.25 * margin) break;
  }
  const double from = std::max(root - margin, 0.0), to = std::min(root + margin, 1.0);
  Polynomial<DoubleDouble, 4> before = volume, after = volume;
  before.split(from);
  after = after.split(to);
  const bool rises = slope > 0.0;
  const bool is_apart =
      (rises ? before.negative() : before.positive()) && (rises ? after.positive() : after.negative());
  return is_apart ? std::optional(std::pair(from, to)) : std::nullopt;
}

// The root of a polynomial whose ends have different signs, in doubles: by Newton's method, and halving where that
// would leave the bracket.
double root_of(const Polynomial<double, 5>& p) {
  const double sign = p.coefficient.back() > 0.0 ? 1.0 : -1.0;
  double low = 0.0, high = 1.0, root = p.coefficient.front() / (p.coefficient.front() - p.coefficient.back());
  for (int k = 0; k < kMostSteps; ++k) {
    Polynomial<double, 5> before = p;
    const auto c = before.split(root).coefficient;
    (sign * c[0] < 0.0 ? low : high) = root;
    const double next = root - c[0] * (1.0 - root) / (4.0 * (c[1] - c[0]));
    const double last = std::exchange(root, low < next && next < high ? next : 0.5 * (low + high));
    if (std::abs(root - last) < 0.01 * kNarrowOpening) break;
  }
  return root;
}

// The same to the last bits: one step of Newton's method more.
double root_of(const Polynomial<DoubleDouble, 5>& p) {
  Polynomial<double, 5> rounded;
  for (std::size_t i = 0; i < 5; ++i) rounded.coefficient[i] = p.coefficient[i].head;
  double root = std::clamp(root_of(rounded), 0.0, 1.0 - 0x1p-20);
  for (int k = 0; k < 2; ++k) {
    Polynomial<DoubleDouble, 5> before = p;
    const auto c = before.split(root).coefficient;
    root = std::clamp(root - c[0].head * (1.0 - root) / (4.0 * (c[1] - c[0]).head), 0.0, 1.0);
    if (root == 1.0) break;
  }
  return root;
}

template <class Number, std::size_t kCount>
Polynomial<Number, kCount> part_before(Polynomial<Number, kCount> p, double t) {
  p.split(t);
  return p;
}
template <class Number, std::size_t kCount>
Polynomial<Number, kCount> part_after(Polynomial<Number, kCount> p, double t) {
  return p.split(t);
}

// Which side turns to the origin last, and which turns away first, and when; null if none does. Unclear if a side does
// neither, nor has the origin inside throughout.
template <class Number>
struct Turns {
  const Polynomial<Number, 5>* last_to_open = nullptr;
  const Polynomial<Number, 5>* first_to_close = nullptr;
  double opens = 0.0, closes = 1.0;
  bool is_unclear = false;
};

template <class Number>
Turns<Number> turns_of(const SpanPolynomials<Number>& span) {
  Turns<Number> turns;
  for (std::size_t i = 0; i < static_cast<std::size_t>(span.sides); ++i) {
    const Polynomial<Number, 5>& side = span.inside[i];
    if (side.positive()) continue;
    if (!side.crosses()) {
      turns.is_unclear = true;
      return turns;
    }
    const double root = root_of(side);
    if (head_of(side.coefficient.back()) > 0.0) {
      if (turns.last_to_open == nullptr || root > turns.opens) {
        turns.last_to_open = &side;
        turns.opens = root;
      }
    } else if (turns.first_to_close == nullptr || root < turns.closes) {
      turns.first_to_close = &side;
      turns.closes = root;
    }
  }
  return turns;
}

// Of a span in which the volume vanishes and a side turns to the origin: the beginning of the part in which the polygon
// may first hold the origin. Nothing if that is not so simple; the end, 1, if it certainly never does.
std::optional<double> first_opening(const SpanPolynomials<DoubleDouble>& whole, double margin) {
  if (!whole.volume.vanishes()) return std::nullopt;
  const Turns<DoubleDouble> turns = turns_of(whole);
  if (turns.is_unclear || turns.last_to_open == nullptr) return std::nullopt;
  const double from = std::max(turns.opens - margin, 0.0), to = std::min(turns.opens + margin, 1.0);
  if (!part_before(*turns.last_to_open, from).negative()) return std::nullopt;
  SpanPolynomials<DoubleDouble> middle = whole;
  middle.split(to);
  middle = middle.split(from / to);
  if (!middle.certainly_never_holds_origin()) return from;
  if (turns.first_to_close == nullptr || !part_after(*turns.first_to_close, to).negative()) return std::nullopt;
  return 1.0;
}

}  // namespace

struct FinestSpan::Part {
  SpanPolynomials<DoubleDouble> polynomials;
  double begin, length;  // of the span
};
struct FinestSpan::ThinPart {
  ThinPolynomials polynomials;
  double begin, length;
};

FinestSpan::FinestSpan() {
  parts_.reserve(kMostWaiting);
  thin_parts_.reserve(kMostWaiting);
}
FinestSpan::~FinestSpan() = default;

namespace {

// The beginning of the first part that stays open, over the length of the span. `parts` holds the whole.
template <class Part>
std::optional<double> first_open(std::vector<Part>& parts, double shortest, double short_enough) {
  for (int looked_at = 0; !parts.empty(); ++looked_at) {
    Part part = parts.back();
    parts.pop_back();
    const auto& polynomials = part.polynomials;
    if (polynomials.certainly_never_holds_origin()) continue;
    const bool is_open = polynomials.seems_to_hold_origin() || part.length <= shortest || looked_at > kMostParts;
    // The beginning of a part with a meeting is near enough.
    if (is_open || (part.length <= short_enough && polynomials.certainly_holds_origin())) return part.begin;
    part.length *= 0.5;
    Part second{part.polynomials.split(0.5), part.begin + part.length, part.length};
    parts.push_back(second);
    parts.push_back(part);
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> FinestSpan::first_open_part(const MovingPolygon& polygon, double scale, double from, double to) {
  const double shortest = kShortestPart / (to - from), short_enough = kFinestSpan / (to - from);
  std::optional<double> begin;
  if (polygon.count < 3) {
    thin_parts_.clear();
    thin_parts_.push_back({{polygon, scale, from, to}, 0.0, 1.0});
    begin = first_open(thin_parts_, shortest, short_enough);
  } else {
    parts_.clear();
    parts_.push_back({{polygon, scale, from, to}, 0.0, 1.0});
    SpanPolynomials<DoubleDouble>& whole = parts_.back().polynomials;
    if (const auto crossing = only_crossing(whole.volume, 4.0 * shortest)) {
      whole.split(crossing->second);
      if (!whole.split(crossing->first / crossing->second).certainly_never_holds_origin()) begin = crossing->first;
    } else if (const auto opening = first_opening(whole, 4.0 * shortest)) {
      if (*opening < 1.0) begin = opening;
    } else {
      begin = first_open(parts_, shortest, short_enough);
    }
  }
  if (!begin || *begin == 0.0) return begin ? std::optional(from) : std::nullopt;
  return std::max(from, std::nextafter(from + *begin * (to - from), 0.0));  // the sum rounds, perhaps up
}

namespace {

// True if, in double-doubles, the origin is in the plane of the polygon all the time between `from` and `to`.
bool stays_in_plane(const MovingPolygon& polygon, double scale, double from, double to) {
  const auto corner = corners_on<DoubleDouble>(polygon, scale, from, to);
  const Way<DoubleDouble> e = corner[1] - corner[0], f = corner[polygon.count - 1] - corner[0];
  return volume_of(corner[0], e, f, cross(e, f)).vanishes();
}

}  // namespace

MeetingInPlane meeting_in_plane(const MovingPolygon& polygon, double scale) {
  const SpanPolynomials<double> whole(polygon, scale, 0.0, 1.0);
  if (whole.certainly_never_holds_origin()) return {Verdict::no};
  const Turns<double> turns = turns_of(whole);
  if (turns.is_unclear) return {};
  for (const double margin : {kNarrowOpening, kWideOpening}) {
    const double from = std::max(turns.opens - margin, 0.0);
    if (turns.last_to_open != nullptr && !part_before(*turns.last_to_open, from).negative()) continue;
    const double to = std::min(turns.opens + margin, 1.0);
    const bool is_inside = std::all_of(whole.inside.begin(), whole.inside.begin() + whole.sides,
                                       [&](const auto& side) { return side.at(to) > side.rounding; });
    if (is_inside && stays_in_plane(polygon, scale, from, to))
      return {margin == kNarrowOpening ? Verdict::yes : Verdict::unknown, from, to};
    if (is_inside || turns.first_to_close == nullptr) continue;
    const double end = std::min(turns.closes + margin, 1.0);
    if (!part_after(*turns.first_to_close, end).negative()) continue;
    if (end <= from) return {Verdict::no};
    return {Verdict::unknown, from, end};
  }
  return {};
}

Verdict holds_origin_near(const MovingPolygon& polygon, double scale, double from, double to) {
  const SpanPolynomials<double> wider(polygon, scale, std::max(from - kMargin, 0.0), std::min(to + kMargin, 1.0));
  if (wider.certainly_holds_origin()) return Verdict::yes;
  return wider.certainly_never_holds_origin() ? Verdict::no : Verdict::unknown;
}

}  // namespace tact::narrowphase
