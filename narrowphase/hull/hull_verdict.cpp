#include "narrowphase/hull/hull_verdict.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "narrowphase/hull/nearest_face.h"
#include "narrowphase/numeric/bounded_number.h"
#include "narrowphase/numeric/number_vector.h"
#include "narrowphase/numeric/small_integer.h"
#include "narrowphase/numeric/wide_vector.h"

namespace tact::narrowphase {

namespace {

// What the corners of a simplex, and directions, are counted in; the first that can tell does.
//
// Integers of 128 bits: coordinates of M of up to kSmallBits bits in a common unit, such as those of bricks on a
// lattice. What is compared has four times as many and 9 more.
constexpr int kSmallBits = 28;
struct SmallNumbers {
  using Point = NumberVector<SmallInteger>;
  using Edge = Point;
  using Direction = Point;
};

// Double-doubles: all but what is exactly zero, or as good as.
struct BoundedNumbers {
  using Point = NumberVector<BoundedNumber>;
  using Edge = Point;
  using Direction = Point;
};

// Integers of any size: coordinates of up to 2^300 in units of 2^-1074.
struct WideNumbers {
  static constexpr int kCoordinate = 22;      // limbs
  using Point = WideVector<kCoordinate + 1>;  // of M
  using Edge = WideVector<kCoordinate + 2>;
  using Direction = WideVector<3 * kCoordinate + 9>;
};

constexpr double kNothing = 0x1p-1000;
constexpr double kBluntest = 0x1p-30;  // error of a component of a unit vector that is of use

// p in units of 2^(unit - 1075), if it has no more than kSmallBits bits.
std::optional<NumberVector<SmallInteger>> small_in_units(const Vec3& p, int unit) {
  const int power = 1075 - unit;
  if (power < -1022 || power > 1023) return {};
  const double factor = std::bit_cast<double>(static_cast<std::uint64_t>(power + 1023) << 52);
  const Vec3 scaled = factor * p;
  if (!(largest_coordinate(scaled) < 1 << kSmallBits)) return {};
  const auto integer = [](double x) { return SmallInteger{static_cast<std::int64_t>(x)}; };
  return NumberVector<SmallInteger>{integer(scaled.x), integer(scaled.y), integer(scaled.z)};
}

// scale * (p - q), if nothing vanishes or overflows.
std::optional<NumberVector<BoundedNumber>> bounded_difference(double scale, const Vec3& p, const Vec3& q) {
  const Vec3 a = scale * p, b = scale * q;
  const auto is_exact = [](double x, double scaled) {
    return x == 0.0 || (std::abs(scaled) >= 0x1p-900 && std::abs(scaled) <= 0x1p900);
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_exact(p[axis], a[axis]) || !is_exact(q[axis], b[axis])) return {};
  }
  return NumberVector<BoundedNumber>{BoundedNumber(two_sum(a.x, -b.x)), BoundedNumber(two_sum(a.y, -b.y)),
                                     BoundedNumber(two_sum(a.z, -b.z))};
}

// A unit vector with at most four roundoffs of itself in each component; zero below kNothing.
Vec3 unit_vector_along(Vec3 d) {
  Vec3 n = base::normalized(d);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(n[axis]) < kNothing) n[axis] = 0.0;
  }
  return n;
}

Vec3 rounded(const WideNumbers::Direction& d) {
  const int bits = std::max({d.x.bit_count(), d.y.bit_count(), d.z.bit_count()});
  return {d.x.times_power(bits), d.y.times_power(bits), d.z.times_power(bits)};
}
Vec3 rounded(const SmallNumbers::Direction& d) {
  return {static_cast<double>(d.x.value), static_cast<double>(d.y.value), static_cast<double>(d.z.value)};
}
Vec3 rounded(const BoundedNumbers::Direction& d) { return {d.x.rounded(), d.y.rounded(), d.z.rounded()}; }

// Where the vertices of M that a search holds span the part nearest to the origin, and in which direction it lies.
class NearestPart {
 public:
  explicit NearestPart(const MinkowskiDifference& m) : m_(m) {}

  // Keeps those vertices of the simplex that carry its nearest point.
  void reduce(GjkSimplex& simplex) {
    if (load_small(simplex)) {
      small_.reduce();
      keep(simplex, small_, Told::small);
    } else if (load_bounded(simplex) && reduce_bounded()) {
      keep(simplex, bounded_, Told::bounded);
    } else {
      reduce_wide(simplex);
      keep(simplex, wide_, Told::wide);
    }
  }
  bool holds_origin() const { return holds_origin_; }
  // Unit, from the nearest point to the origin; and what its components may be off, beyond four roundoffs of
  // themselves.
  const Vec3& toward_origin() const { return direction_; }
  double direction_error() const { return direction_error_; }
  // The same without that.
  Vec3 sharp_direction() {
    if (direction_error_ <= kUnitRoundoff) return direction_;
    if (!has_wide_) reduce_wide(carrier_);
    return unit_vector_along(rounded(wide_.toward_origin()));
  }

  // The sign of d · (p - q), d as above. Nothing may have been added to the simplex.
  int compare(const Vec3& p, const Vec3& q) {
    const Vec3 n = direction_, e = p - q, size{std::abs(e.x), std::abs(e.y), std::abs(e.z)};
    const double height = dot(n, e), sum = size.x + size.y + size.z;
    // The difference has a rounding a component, the direction four, the product and the sums three; two for the
    // rounding of the bound. Products may vanish, and components of n that are not zero may count as zero.
    const double error = 10.0 * kUnitRoundoff * dot({std::abs(n.x), std::abs(n.y), std::abs(n.z)}, size) +
                         (direction_error_ + 2.0 * kNothing) * sum + 8.0 * std::numeric_limits<double>::denorm_min();
    if (std::abs(height) > error) return height > 0.0 ? 1 : -1;
    if (p == q) return 0;
    const int unit = std::min(lowest_bit(p), lowest_bit(q));
    if (told_ == Told::small) {
      const auto u = small_in_units(p, unit), v = small_in_units(q, unit);
      if (u && v) return dot(small_.toward_origin(), *u - *v).sign();
    }
    if (told_ == Told::bounded) {
      if (const auto way = bounded_difference(m_.scale(), p, q)) {
        BoundedNumber::unclear() = false;
        const int sign = dot(bounded_.toward_origin(), *way).sign();
        if (!BoundedNumber::unclear()) return sign;
      }
    }
    if (!has_wide_) reduce_wide(carrier_);
    constexpr int kCoordinate = WideNumbers::kCoordinate;
    return dot(wide_.toward_origin(), in_units<kCoordinate>(p, unit) - in_units<kCoordinate>(q, unit)).sign();
  }

 private:
  enum class Told { small, bounded, wide };

  // Calls work(vertex of A, vertex of B) for each of the simplex, until it is false.
  template <class Work>
  bool each(const GjkSimplex& simplex, const Work& work) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(simplex.count); ++i) {
      if (!work(m_.a().position(simplex.a[i]), m_.b().position(simplex.b[i]))) return false;
    }
    return true;
  }

  int unit_of(const GjkSimplex& simplex) const {
    int unit = std::numeric_limits<int>::max();
    each(simplex, [&](const Vec3& a, const Vec3& b) {
      unit = std::min({unit, lowest_bit(a), lowest_bit(b)});
      return true;
    });
    return unit;
  }

  bool load_small(const GjkSimplex& simplex) {
    small_.clear();
    const int unit = unit_of(simplex);
    return each(simplex, [&](const Vec3& a, const Vec3& b) {
      const auto u = small_in_units(a, unit), v = small_in_units(b, unit);
      if (u && v) small_.add(*u - *v);
      return u && v;
    });
  }

  bool load_bounded(const GjkSimplex& simplex) {
    bounded_.clear();
    return each(simplex, [&](const Vec3& a, const Vec3& b) {
      const auto y = bounded_difference(m_.scale(), a, b);
      if (y) bounded_.add(*y);
      return y.has_value();
    });
  }

  // True if all signs were certain and the direction is of use.
  bool reduce_bounded() {
    BoundedNumber::unclear() = false;
    bounded_.reduce();
    if (BoundedNumber::unclear()) return false;
    if (bounded_.holds_origin()) return true;
    return norm(rounded(bounded_.toward_origin())) > 0x1p-300 && bounded_direction_error() <= kBluntest;
  }

  double bounded_direction_error() const {
    const BoundedNumbers::Direction& d = bounded_.toward_origin();
    return std::max({d.x.error(), d.y.error(), d.z.error()}) / norm(rounded(d));
  }

  void reduce_wide(const GjkSimplex& simplex) {
    wide_.clear();
    const int unit = unit_of(simplex);
    each(simplex, [&](const Vec3& a, const Vec3& b) {
      wide_.add(in_units<WideNumbers::kCoordinate>(a, unit) - in_units<WideNumbers::kCoordinate>(b, unit));
      return true;
    });
    wide_.reduce();
    has_wide_ = true;
  }

  template <class Numbers>
  void keep(GjkSimplex& simplex, const NearestFace<Numbers>& face, Told told) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(face.carrier_count()); ++i) {
      const auto from = static_cast<std::size_t>(face.carrier()[i]);
      simplex.a[i] = simplex.a[from];
      simplex.b[i] = simplex.b[from];
    }
    simplex.count = face.carrier_count();
    carrier_ = simplex;
    told_ = told;
    has_wide_ = told == Told::wide;
    holds_origin_ = face.holds_origin();
    if (holds_origin_) return;
    direction_ = unit_vector_along(rounded(face.toward_origin()));
    direction_error_ = told == Told::bounded ? 4.0 * bounded_direction_error() : 0.0;
  }

  const MinkowskiDifference& m_;
  NearestFace<SmallNumbers> small_;
  NearestFace<BoundedNumbers> bounded_;
  NearestFace<WideNumbers> wide_;
  Told told_ = Told::wide;
  bool has_wide_ = false;
  GjkSimplex carrier_;
  bool holds_origin_ = false;
  Vec3 direction_;
  double direction_error_ = 0.0;
};

class VerdictSearch {
 public:
  VerdictSearch(const MinkowskiDifference& m, const GjkSimplex& start, std::vector<std::int32_t>& chosen)
      : m_(m), nearest_(m), chosen_(chosen) {
    verdict_.simplex = start;
    if (start.count > 0) return;
    const MinkowskiVertex any = m.support({1.0, 0.0, 0.0});
    append(any.a, any.b);
  }

  // Every round brings the simplex nearer to the origin, and there are so many simplices: it ends.
  HullVerdict run() {
    while (true) {
      nearest_.reduce(verdict_.simplex);
      if (nearest_.holds_origin()) return verdict_;
      const int a = farthest(m_.a(), Along::direction, verdict_.simplex.a[0]);
      const int b = farthest(m_.b(), Along::opposite, verdict_.simplex.b[0]);
      ++verdict_.support_queries;
      if (nearest_.compare(m_.a().position(a), m_.b().position(b)) < 0) {
        verdict_.apart = true;
        verdict_.direction = nearest_.sharp_direction();
        return verdict_;
      }
      append(a, b);
    }
  }

 private:
  enum class Along { direction, opposite };

  void append(int a, int b) {
    const auto i = static_cast<std::size_t>(verdict_.simplex.count++);
    verdict_.simplex.a[i] = a;
    verdict_.simplex.b[i] = b;
  }

  // The vertex farthest along the direction, or against it: of those that doubles find within their rounding of the
  // farthest, the farthest. Only the ones in a plane across it, or nearly, need more digits.
  int farthest(const ClusteredMesh& mesh, Along along, int near) {
    const Vec3 d = along == Along::direction ? nearest_.toward_origin() : -nearest_.toward_origin();
    // A height along the rounded direction is off by vertex_height_error(), 4 roundoffs of the size, and the direction
    // by as many, and by direction_error().
    const double error = 4.0 * m_.vertex_height_error() + 4.0 * nearest_.direction_error() * (m_.size() / m_.scale());
    const double least = support(mesh, d, m_.origin(), near).height - error;
    select_vertices(mesh, d, m_.origin(), least, chosen_);
    int best = chosen_.front();
    for (const int v : chosen_) {
      const Vec3 p = mesh.position(v), q = mesh.position(best);
      const int above = along == Along::direction ? nearest_.compare(p, q) : nearest_.compare(q, p);
      if (above > 0 || (above == 0 && mesh.source_vertex(v) < mesh.source_vertex(best))) best = v;
    }
    return best;
  }

  const MinkowskiDifference& m_;
  NearestPart nearest_;
  HullVerdict verdict_;
  std::vector<std::int32_t>& chosen_;  // scratch
};

}  // namespace

HullVerdict hull_verdict(const MinkowskiDifference& m, const GjkSimplex& start, std::vector<std::int32_t>& scratch) {
  return VerdictSearch(m, start, scratch).run();
}

}  // namespace tact::narrowphase
