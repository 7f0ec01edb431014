#include "narrowphase/hull/hull_verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "narrowphase/numeric/wide_vector.h"

namespace tact::narrowphase {

namespace {

// Coordinates of up to 2^300 in units of 2^-1074.
constexpr int kCoordinate = 22;             // limbs
using Point = WideVector<kCoordinate + 1>;  // of M
using Edge = WideVector<kCoordinate + 2>;
// Of any length, from the nearest point of a simplex to the origin. That of an edge has the most limbs.
using Direction = WideVector<3 * kCoordinate + 9>;

// An exact direction, and the same as a unit vector: each component is off by at most four roundoffs of itself, and is
// zero if it is below kNothing.
struct BothDirections {
  Direction exact;
  Vec3 rounded;
};

constexpr double kUnitRoundoff = 0x1p-53;
constexpr double kNothing = 0x1p-1000;

BothDirections both(const Direction& d) {
  const int bits = std::max({d.x.bit_count(), d.y.bit_count(), d.z.bit_count()});
  Vec3 n = base::normalized({d.x.times_power(bits), d.y.times_power(bits), d.z.times_power(bits)});
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(n[axis]) < kNothing) n[axis] = 0.0;
  }
  return {d, n};
}

// The sign of d · (p - q).
int compare_along(const BothDirections& d, const Vec3& p, const Vec3& q) {
  const Vec3 n = d.rounded, e = p - q, size{std::abs(e.x), std::abs(e.y), std::abs(e.z)};
  const double height = dot(n, e);
  // The difference has a rounding a component, the direction four, the product and the sums three; two for the rounding
  // of the bound. Products may vanish, and components of n that are not zero may count as zero.
  const double error = 10.0 * kUnitRoundoff * dot({std::abs(n.x), std::abs(n.y), std::abs(n.z)}, size) +
                       2.0 * kNothing * (size.x + size.y + size.z) + 8.0 * std::numeric_limits<double>::denorm_min();
  if (std::abs(height) > error) return height > 0.0 ? 1 : -1;
  if (p == q) return 0;
  const int unit = std::min(lowest_bit(p), lowest_bit(q));
  return dot(d.exact, in_units<kCoordinate>(p, unit) - in_units<kCoordinate>(q, unit)).sign();
}

// The point nearest to the origin in a simplex of up to four points, by signs alone. It is the nearest of the face that
// it lies in, and no corner lies nearer than the plane across it.
class ExactSimplex {
 public:
  void load(const MinkowskiDifference& m, const GjkSimplex& simplex) {
    count_ = simplex.count;
    int unit = std::numeric_limits<int>::max();
    const auto each = [&](const auto& work) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
        work(i, m.a().position(simplex.a[i]), m.b().position(simplex.b[i]));
    };
    each([&](std::size_t, const Vec3& a, const Vec3& b) { unit = std::min({unit, lowest_bit(a), lowest_bit(b)}); });
    each([&](std::size_t i, const Vec3& a, const Vec3& b) {
      y_[i] = in_units<kCoordinate>(a, unit) - in_units<kCoordinate>(b, unit);
    });
  }

  // Finds the face that carries the nearest point: carrier() and, if that is not the origin itself, toward_origin().
  void reduce() {
    holds_origin_ = count_ == 4 && inside_tetrahedron();
    if (holds_origin_) return keep({0, 1, 2, 3}, 4);
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) {
        for (int k = j + 1; k < count_; ++k) {
          if (triangle(i, j, k)) return keep({i, j, k}, 3);
        }
      }
    }
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) {
        if (edge(i, j)) return keep({i, j}, 2);
      }
    }
    for (int i = 0; i < count_; ++i) {
      if (corner(i)) return keep({i}, 1);
    }
  }

  bool holds_origin() const { return holds_origin_; }
  const std::array<int, 4>& carrier() const { return carrier_; }
  int carrier_count() const { return carrier_count_; }
  const Direction& toward_origin() const { return toward_origin_; }

 private:
  const Point& y(int i) const { return y_[i]; }

  void keep(std::array<int, 4> carrier, int count) {
    carrier_ = carrier;
    carrier_count_ = count;
  }

  // Is the origin on the same side of every face as the corner across from it, or in its plane?
  bool inside_tetrahedron() const {
    return same_side(0, 1, 2, 3) && same_side(0, 1, 3, 2) && same_side(0, 2, 3, 1) && same_side(1, 2, 3, 0);
  }

  bool same_side(int i, int j, int k, int opposite) const {
    const auto n = cross(y(j) - y(i), y(k) - y(i));
    const int of_corner = dot(n, y(opposite) - y(i)).sign(), of_origin = -dot(n, y(i)).sign();
    return of_corner != 0 && (of_origin == 0 || of_origin == of_corner);
  }

  // Is the nearest point in the triangle, not on its border? Not if it has no area.
  bool triangle(int i, int j, int k) {
    const Edge e = y(j) - y(i), f = y(k) - y(i);
    const auto n = cross(e, f);
    if (n.is_zero()) return false;
    const Point o = -y(i);
    const auto of_j = dot(cross(o, f), n), of_k = dot(cross(e, o), n);
    if (of_j.sign() <= 0 || of_k.sign() <= 0 || (dot(n, n) - (of_j + of_k)).sign() <= 0) return false;
    const int height = dot(n, y(i)).sign();
    holds_origin_ = height == 0;
    return holds_origin_ || is_nearest(Direction(height > 0 ? -n : n), i);
  }

  bool edge(int i, int j) {
    const Edge e = y(j) - y(i);
    const auto length = dot(e, e);
    const auto along = -dot(y(i), e);
    if (along.sign() <= 0 || (length - along).sign() <= 0) return false;
    const auto nearest = length * y(i) + along * e;
    holds_origin_ = nearest.is_zero();
    return holds_origin_ || is_nearest(Direction(-nearest), i);
  }

  bool corner(int i) {
    holds_origin_ = y(i).is_zero();
    return holds_origin_ || is_nearest(Direction(-y(i)), i);
  }

  // Is no corner beyond corner i along d?
  bool is_nearest(const Direction& d, int i) {
    for (int k = 0; k < count_; ++k) {
      if (k != i && dot(d, y(k) - y(i)).sign() > 0) return false;
    }
    toward_origin_ = d;
    return true;
  }

  std::array<Point, 4> y_;
  int count_ = 0;
  bool holds_origin_ = false;
  std::array<int, 4> carrier_{};
  int carrier_count_ = 0;
  Direction toward_origin_;
};

class VerdictSearch {
 public:
  VerdictSearch(const MinkowskiDifference& m, const GjkSimplex& start) : m_(m) {
    verdict_.simplex = start;
    if (start.count > 0) return;
    const MinkowskiVertex any = m.support({1.0, 0.0, 0.0});
    append(any.a, any.b);
  }

  // Every round brings the simplex nearer to the origin, and there are so many simplices: it ends.
  HullVerdict run() {
    while (true) {
      simplex_.load(m_, verdict_.simplex);
      simplex_.reduce();
      keep_carrier();
      if (simplex_.holds_origin()) return verdict_;
      const BothDirections d = both(simplex_.toward_origin());
      const int a = farthest(m_.a(), d, verdict_.simplex.a[0]);
      const int b = farthest(m_.b(), {-d.exact, -d.rounded}, verdict_.simplex.b[0]);
      ++verdict_.support_queries;
      if (compare_along(d, m_.a().position(a), m_.b().position(b)) < 0) {
        verdict_.apart = true;
        verdict_.direction = d.rounded;
        return verdict_;
      }
      append(a, b);
    }
  }

 private:
  void append(int a, int b) {
    const auto i = static_cast<std::size_t>(verdict_.simplex.count++);
    verdict_.simplex.a[i] = a;
    verdict_.simplex.b[i] = b;
  }

  void keep_carrier() {
    GjkSimplex& s = verdict_.simplex;
    for (std::size_t i = 0; i < static_cast<std::size_t>(simplex_.carrier_count()); ++i) {
      const auto from = static_cast<std::size_t>(simplex_.carrier()[i]);
      s.a[i] = s.a[from];
      s.b[i] = s.b[from];
    }
    s.count = simplex_.carrier_count();
  }

  // The vertex farthest along d: of those that doubles find within their rounding of the farthest, the farthest. Only
  // the ones in a plane across d, or nearly, need integers.
  int farthest(const ClusteredMesh& mesh, const BothDirections& d, int near) {
    // A height along the rounded direction is off by vertex_height_error(), 4 roundoffs of the size, and the direction
    // by as many.
    const double least = support(mesh, d.rounded, m_.origin(), near).height - 4.0 * m_.vertex_height_error();
    select_vertices(mesh, d.rounded, m_.origin(), least, chosen_);
    int best = chosen_.front();
    for (const int v : chosen_) {
      const int above = compare_along(d, mesh.position(v), mesh.position(best));
      if (above > 0 || (above == 0 && mesh.source_vertex(v) < mesh.source_vertex(best))) best = v;
    }
    return best;
  }

  const MinkowskiDifference& m_;
  ExactSimplex simplex_;
  HullVerdict verdict_;
  std::vector<int> chosen_;
};

}  // namespace

HullVerdict hull_verdict(const MinkowskiDifference& m, const GjkSimplex& start) {
  return VerdictSearch(m, start).run();
}

}  // namespace tact::narrowphase
