#include "scenes/files/polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "engine/plane_turn.h"

namespace tact::scenes {
namespace {

using Corner = std::array<double, 3>;
using Point = std::array<double, 2>;  // ordered by x, then y
using Triangles = std::vector<std::array<std::size_t, 3>>;

// By the normal's largest coordinate; of equal ones, where the polygon is thinnest.
std::size_t axis_to_drop(std::span<const Corner> corners) {
  Corner lower = corners[0], upper = corners[0];
  double size = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const Corner& corner : corners) {
      lower[axis] = std::min(lower[axis], corner[axis]);
      upper[axis] = std::max(upper[axis], corner[axis]);
    }
    size = std::max(size, upper[axis] - lower[axis]);
  }
  if (!(size > 0.0)) return 2;
  const int exponent = std::ilogb(size);  // so that no product vanishes or overflows
  const auto offset = [&](std::size_t i, std::size_t axis) {
    return std::ldexp(corners[i % corners.size()][axis] - corners[0][axis], -exponent);
  };
  Corner normal{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      normal[axis] += offset(i, u) * offset(i + 1, v) - offset(i, v) * offset(i + 1, u);
    }
  }
  std::array<std::size_t, 3> axes{2, 1, 0};
  return *std::max_element(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) {
    const double of_a = std::abs(normal[a]), of_b = std::abs(normal[b]);
    return of_a != of_b ? of_a < of_b : upper[a] - lower[a] > upper[b] - lower[b];
  });
}

// The outline in its plane.
class Ring {
 public:
  explicit Ring(std::vector<Point> points) : points_(std::move(points)) {}

  std::size_t size() const { return points_.size(); }
  const Point& operator[](std::size_t i) const { return points_[i % size()]; }
  const Point& before(std::size_t i) const { return points_[(i + size() - 1) % size()]; }

 private:
  std::vector<Point> points_;
};

bool strictly_between(const Point& a, const Point& b, const Point& p) { return (a < p && p < b) || (b < p && p < a); }

// Whether `a` and `b`, on one line with `p`, lie on one side of it.
bool on_one_side(const Point& p, const Point& a, const Point& b) { return (a < p) == (b < p); }

// Whether the triangles of the first corner and each edge turn one way, around it less than once.
bool is_fan(const Ring& ring) {
  int turning = 0;
  bool touches_first = false;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const int turn = plane_turn(ring[0], ring[i], ring[i + 1]);
    if (turn * turning < 0) return false;
    if (turn != 0) turning = turn;
    touches_first |= turn == 0 && !on_one_side(ring[0], ring[i], ring[i + 1]);
  }
  if (turning == 0) return true;
  for (std::size_t i = 2; i + 1 < ring.size(); ++i) {
    const bool passes_start =
        turning * plane_turn(ring[0], ring[i], ring[1]) > 0 && turning * plane_turn(ring[0], ring[1], ring[i + 1]) >= 0;
    if (passes_start || ring[i] == ring[0]) return false;
  }
  return !touches_first;
}

// Where `p` lies as seen from corner `i`: 1 to the left of the outline, -1 to the right, 0 along one of its edges.
int side_at(const Ring& ring, std::size_t i, const Point& p) {
  const Point &before = ring.before(i), &corner = ring[i], &after = ring[i + 1];
  const int of_first = plane_turn(before, corner, p), of_second = plane_turn(corner, after, p);
  if ((of_first == 0 && on_one_side(corner, before, p)) || (of_second == 0 && on_one_side(corner, after, p))) return 0;
  const bool left =
      plane_turn(before, corner, after) > 0 ? of_first > 0 && of_second > 0 : of_first > 0 || of_second > 0;
  return left ? 1 : -1;
}

// Which way an outline without crossings turns: 0 if it comes back the way it went where it is outermost.
int turning_of(const Ring& ring) {
  std::size_t outermost = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    if (ring[i] < ring[outermost]) outermost = i;
  }
  return plane_turn(ring.before(outermost), ring[outermost], ring[outermost + 1]);
}

// How often the direction of the edges turns around, counter-clockwise: each time that it passes that of the x axis.
int turns_around(const Ring& ring) {
  const auto points_down = [](const Point& from, const Point& to) {
    return to[1] < from[1] || (to[1] == from[1] && to[0] < from[0]);
  };
  int turns = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const bool down_before = points_down(ring.before(i), ring[i]), down_after = points_down(ring[i], ring[i + 1]);
    if (down_before == down_after) continue;
    const int turn = plane_turn(ring.before(i), ring[i], ring[i + 1]);
    if (turn > 0 && down_before) ++turns;
    if (turn < 0 && down_after) --turns;
  }
  return turns;
}

// Whether the edges from corners `i` and `j` meet elsewhere than those of simple outlines do.
bool edges_conflict(const Ring& ring, std::size_t i, std::size_t j) {
  const Point &a = ring[i], &b = ring[i + 1], &c = ring[j], &d = ring[j + 1];
  if ((i + 1) % ring.size() == j) return plane_turn(a, b, d) == 0 && on_one_side(b, a, d);
  if ((j + 1) % ring.size() == i) return plane_turn(c, d, b) == 0 && on_one_side(d, c, b);
  const int of_c = plane_turn(a, b, c), of_d = plane_turn(a, b, d);
  if (of_c * of_d > 0) return false;
  const int of_a = plane_turn(c, d, a), of_b = plane_turn(c, d, b);
  if (of_a * of_b > 0) return false;
  if (of_c * of_d * of_a * of_b != 0) return true;
  if ((of_c == 0 && strictly_between(a, b, c)) || (of_d == 0 && strictly_between(a, b, d)) ||
      (of_a == 0 && strictly_between(c, d, a)) || (of_b == 0 && strictly_between(c, d, b)))
    return true;
  return a == c && (b == d || side_at(ring, i, ring.before(j)) * side_at(ring, i, d) < 0);
}

// An outline may come to one place again. If it crosses itself nowhere and turns around once, it does not enclose a
// part of itself.
bool is_simple(const Ring& ring, int turning) {
  if (turns_around(ring) != turning) return false;
  std::vector<std::size_t> order(ring.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto low = [&](std::size_t i, std::size_t axis) { return std::min(ring[i][axis], ring[i + 1][axis]); };
  const auto high = [&](std::size_t i, std::size_t axis) { return std::max(ring[i][axis], ring[i + 1][axis]); };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return low(i, 0) < low(j, 0); });
  for (auto i = order.begin(); i != order.end(); ++i) {
    for (auto j = i + 1; j != order.end() && low(*j, 0) <= high(*i, 0); ++j) {
      if (low(*j, 1) <= high(*i, 1) && low(*i, 1) <= high(*j, 1) && edges_conflict(ring, *i, *j)) return false;
    }
  }
  return true;
}

// Cuts corners off that no other corner is in the way of, until a triangle is left. Where the outline came to one place
// twice, what is left in the end has no area.
class EarClipper {
 public:
  EarClipper(const Ring& ring, int turning)
      : ring_(ring), before_(ring.size()), after_(ring.size()), is_ear_(ring.size()), turning_(turning) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      after_[i] = (i + 1) % ring.size();
      before_[after_[i]] = i;
    }
  }

  // Nothing if no corner can be cut off: the outline was not simple.
  std::optional<Triangles> clip() {
    for (std::size_t i = 0; i < ring_.size(); ++i) is_ear_[i] = find_ear(i);
    Triangles triangles;
    std::size_t left = ring_.size(), at = 0, passed = 0;
    while (left > 3) {
      if (!is_ear_[at]) {
        if (++passed > left) return std::nullopt;
        at = after_[at];
        continue;
      }
      const std::size_t before = before_[at], after = after_[at];
      triangles.push_back({before, at, after});
      after_[before] = after;
      before_[after] = before;
      is_ear_[before] = find_ear(before);
      is_ear_[after] = find_ear(after);
      at = after;
      --left;
      passed = 0;
    }
    if (turn(before_[at], at, ring_[after_[at]]) < 0) return std::nullopt;
    triangles.push_back({before_[at], at, after_[at]});
    return triangles;
  }

 private:
  // Positive where `p` lies inside of the edge from corner i to corner j.
  int turn(std::size_t i, std::size_t j, const Point& p) const { return turning_ * plane_turn(ring_[i], ring_[j], p); }

  bool find_ear(std::size_t tip) const {
    const std::size_t before = before_[tip], after = after_[tip];
    if (ring_[tip] == ring_[before] || ring_[tip] == ring_[after]) return true;
    const int turn_of_tip = turn(before, tip, ring_[after]);
    if (turn_of_tip == 0 && ring_[before] == ring_[after]) return true;
    if (turn_of_tip <= 0) return false;
    const auto [low_x, high_x] = std::minmax({ring_[before][0], ring_[tip][0], ring_[after][0]});
    for (std::size_t i = after_[after]; i != before; i = after_[i]) {
      const Point& p = ring_[i];
      if (p[0] >= low_x && p[0] <= high_x && is_in_the_way(i, before, tip, after)) return false;
    }
    return true;
  }

  bool is_in_the_way(std::size_t i, std::size_t before, std::size_t tip, std::size_t after) const {
    const Point& p = ring_[i];
    if (p == ring_[before] || p == ring_[after]) return false;
    const auto behind_tip = [&](const Point& q) { return turn(before, tip, q) > 0 && turn(tip, after, q) > 0; };
    if (p == ring_[tip]) return behind_tip(ring_[before_[i]]) || behind_tip(ring_[after_[i]]);
    return turn(before, tip, p) >= 0 && turn(tip, after, p) >= 0 && turn(after, before, p) >= 0;
  }

  const Ring& ring_;
  std::vector<std::size_t> before_;
  std::vector<std::size_t> after_;
  std::vector<char> is_ear_;
  int turning_;
};

}  // namespace

PolygonSplit split_polygon(std::span<const Corner> corners) {
  const std::size_t dropped = axis_to_drop(corners), u = (dropped + 1) % 3, v = (dropped + 2) % 3;
  std::vector<Point> points;
  std::vector<std::size_t> kept;  // corners that do not repeat the one before
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point point{corners[i][u], corners[i][v]};
    if (!points.empty() && point == points.back()) continue;
    points.push_back(point);
    kept.push_back(i);
  }
  while (points.size() > 1 && points.back() == points.front()) {
    points.pop_back();
    kept.pop_back();
  }
  if (points.size() < 3) return {};
  const Ring ring(std::move(points));
  if (is_fan(ring)) return {};
  std::optional<Triangles> triangles;
  const int turning = turning_of(ring);
  if (turning != 0 && is_simple(ring, turning)) triangles = EarClipper(ring, turning).clip();
  if (!triangles) return {.kind = PolygonSplit::not_simple};
  for (auto& triangle : *triangles) {
    for (std::size_t& corner : triangle) corner = kept[corner];
  }
  // Corners that were left out become triangles without area.
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::size_t end = i + 1 < kept.size() ? kept[i + 1] : corners.size();
    for (std::size_t k = kept[i] + 1; k < end; ++k) triangles->push_back({kept[i], k, (k + 1) % corners.size()});
  }
  return {.kind = PolygonSplit::ears, .triangles = std::move(*triangles)};
}

}  // namespace tact::scenes
