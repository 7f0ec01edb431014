#include "narrowphase/motion/height_signs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "narrowphase/numeric/bounded_number.h"
#include "narrowphase/numeric/wide_vector.h"

namespace tact::narrowphase {

namespace {

// Volumes below may have lost bits: a cross product that rounds at 2^-1074, times a coordinate of up to 2^302.
constexpr double kLostVolume = 0x1p-700;

Vec3 which_are_zero(Vec3 a) { return {a.x != 0.0 ? 1.0 : 0.0, a.y != 0.0 ? 1.0 : 0.0, a.z != 0.0 ? 1.0 : 0.0}; }

// The k-th of the combinations of three ends of which `later` are the later ones.
constexpr int kCombinations[4][3][3] = {
    {{0, 0, 0}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{1, 1, 0}, {1, 0, 1}, {0, 1, 1}}, {{1, 1, 1}}};
constexpr int kCounts[4] = {1, 3, 3, 1};

// The difference at both ends in units, the later one times 2^halvings.
using Exact = WideVector<36>;
struct ExactEnds {
  Exact at[2];

  ExactEnds(const MovingWay& way, int unit, int halvings) {
    const auto difference = [&](int time) {
      return in_units<33>(way.to.at[time], unit) - in_units<33>(way.from.at[time], unit);
    };
    const WideVector<34> begin = difference(0), end = difference(1);
    at[0] = Exact(begin);
    at[1] = halvings == 0 ? Exact(end) : WideInteger<1>(false, (std::uint64_t{1} << halvings) - 1, 0) * begin + end;
  }
};

int lowest_bit_of(const MovingWay& way) {
  return std::min(
      {lowest_bit(way.from.at[0]), lowest_bit(way.from.at[1]), lowest_bit(way.to.at[0]), lowest_bit(way.to.at[1])});
}

int exact_sign(const MovingWay& u, const MovingWay& v, const MovingWay& w, int later, int halvings) {
  const int unit = std::min({lowest_bit_of(u), lowest_bit_of(v), lowest_bit_of(w)});
  const ExactEnds a(u, unit, halvings), b(v, unit, halvings), c(w, unit, halvings);
  const auto volume = [&](int k) {
    const auto& ends = kCombinations[later][k];
    return dot(a.at[ends[0]], cross(b.at[ends[1]], c.at[ends[2]]));
  };
  if (kCounts[later] == 1) return volume(0).sign();
  return (volume(0) + volume(1) + volume(2)).sign();
}

// The same ends as double-doubles.
using BoundedVector = NumberVector<BoundedNumber>;
struct BoundedEnds {
  BoundedVector at[2];
  bool is_exact[2];

  BoundedEnds(const MovingWay& way, int halvings) {
    const auto difference = [&](int time) {
      const auto [x, y, z] = double_double_difference(way.to.at[time], way.from.at[time]);
      return BoundedVector{BoundedNumber(x), BoundedNumber(y), BoundedNumber(z)};
    };
    at[0] = difference(0), at[1] = difference(1);
    is_exact[0] = true, is_exact[1] = halvings == 0;
    if (halvings != 0) at[1] = at[0] + BoundedNumber(DoubleDouble{std::ldexp(1.0, -halvings)}) * (at[1] - at[0]);
  }
};

// Nothing where double-doubles do not tell either: where a volume is zero for another reason than equal ways.
std::optional<int> bounded_sign(const MovingWay& u, const MovingWay& v, const MovingWay& w, int later, int halvings) {
  const BoundedEnds ends[3] = {{u, halvings}, {v, halvings}, {w, halvings}};
  BoundedNumber sum;
  for (int k = 0; k < kCounts[later]; ++k) {
    const auto& at = kCombinations[later][k];
    const auto are_one = [&](int i, int j) {
      return ends[i].is_exact[at[i]] && ends[j].is_exact[at[j]] && ends[i].at[at[i]] == ends[j].at[at[j]];
    };
    if (are_one(0, 1) || are_one(1, 2) || are_one(0, 2)) continue;
    sum = sum + dot(ends[0].at[at[0]], cross(ends[1].at[at[1]], ends[2].at[at[2]]));
  }
  BoundedNumber::unclear() = false;
  const int sign = sum.sign();
  return BoundedNumber::unclear() ? std::nullopt : std::optional(sign);
}

// Of the coefficient with so many later ends, where doubles do not tell.
int fine_sign(const MovingWay& u, const MovingWay& v, const MovingWay& w, int later, int halvings) {
  const WayEnds ends[3] = {{u, halvings}, {v, halvings}, {w, halvings}};
  double may_count = 0.0;
  for (int k = 0; k < kCounts[later]; ++k) {
    const auto& at = kCombinations[later][k];
    may_count += sum_of_sizes(which_are_zero(ends[0].size[at[0]]), which_are_zero(ends[1].size[at[1]]),
                              which_are_zero(ends[2].size[at[2]]));
  }
  if (may_count == 0.0) return 0;
  const std::optional<int> sign = bounded_sign(u, v, w, later, halvings);
  return sign ? *sign : exact_sign(u, v, w, later, halvings);
}

// What the terms of a cross product add up to at most.
Vec3 cross_of_sizes(Vec3 a, Vec3 b) { return {a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x}; }

bool is_certain(double volume, double sizes) { return sizes > kLostVolume && std::abs(volume) > kWayRounding * sizes; }

}  // namespace

BeginNormal::BeginNormal(const MovingWay& u, const MovingWay& v) {
  const Vec3 a = u.to.at[0] - u.from.at[0], b = v.to.at[0] - v.from.at[0];
  normal_ = cross(a, b);
  size_ = cross_of_sizes(magnitudes(a), magnitudes(b));
}

unsigned BeginNormal::sign_along(const MovingVertex& from, const MovingVertex& to) const {
  const Vec3 way = to.at[0] - from.at[0];
  const double volume = dot(normal_, way);
  if (!is_certain(volume, dot(size_, magnitudes(way)))) return 0;
  return volume > 0.0 ? kAbove : kBelow;
}

MovingNormal::MovingNormal(const MovingWay& u, const MovingWay& v, int halvings) : u_(u), v_(v), halvings_(halvings) {
  const WayEnds a(u, halvings), b(v, halvings);
  for (const int end : {0, 1}) {
    normal_[2 * end] = cross(a.at[end], b.at[end]);
    size_[2 * end] = cross_of_sizes(a.size[end], b.size[end]);
  }
  normal_[1] = cross(a.at[0], b.at[1]) + cross(a.at[1], b.at[0]);
  size_[1] = cross_of_sizes(a.size[0], b.size[1]) + cross_of_sizes(a.size[1], b.size[0]);
}

MovingNormal::Signs MovingNormal::signs_along(const MovingWay& w) const {
  const WayEnds c(w, halvings_);
  const double volume[4] = {dot(normal_[0], c.at[0]), dot(normal_[0], c.at[1]) + dot(normal_[1], c.at[0]),
                            dot(normal_[1], c.at[1]) + dot(normal_[2], c.at[0]), dot(normal_[2], c.at[1])};
  const double sizes[4] = {dot(size_[0], c.size[0]), dot(size_[0], c.size[1]) + dot(size_[1], c.size[0]),
                           dot(size_[1], c.size[1]) + dot(size_[2], c.size[0]), dot(size_[2], c.size[1])};
  Signs signs;
  for (unsigned later = 0; later < 4; ++later) {
    if (is_certain(volume[later], sizes[later]))
      signs.certain |= volume[later] > 0.0 ? kAbove : kBelow;
    else
      signs.open |= 1u << later;
  }
  return signs;
}

unsigned MovingNormal::exact_signs_along(const MovingWay& w, unsigned open, unsigned known) const {
  for (; open != 0 && known != (kAbove | kBelow); open &= open - 1) {
    const int sign = fine_sign(u_, v_, w, std::countr_zero(open), halvings_);
    known |= sign > 0 ? kAbove : sign < 0 ? kBelow : 0u;
  }
  return known;
}

bool MovingNormal::has_area() const {
  for (int axis = 0; axis < 3; ++axis) {
    const double sizes = size_[0][axis];
    if (sizes > kVanishingVolume && std::abs(normal_[0][axis]) > kWayRounding * sizes) return true;
  }
  return false;
}

}  // namespace tact::narrowphase
