#include "narrowphase/distance/facet_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "narrowphase/distance/signs.h"
#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/rounded.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/numeric/wide_vector.h"

namespace tact::narrowphase {

namespace {

constexpr double kSmallNormal = 0x1p-400;  // the squares of shorter ones may vanish

// A vector times a power of two that scales it to a length near 1.
struct ScaledVector {
  explicit ScaledVector(const DoubleDoubleVec3& v)
      : scale(unit_scale(largest_coordinate(heads(v)))), vector(scaled(v, scale)) {}
  double scale;
  DoubleDoubleVec3 vector;
};

// A number, and how much of it rounding may have taken.
struct FineNumber {
  DoubleDouble value;
  double lost_part = 0.0;
};

FineNumber length_of(const DoubleDoubleVec3& v, double lost) {
  const DoubleDouble length = square_root(dot(v, v));
  const bool vanishes = !(length.head > kSmallNormal);
  return {length, vanishes ? std::numeric_limits<double>::infinity() : lost / length.head + 0x1p-98};
}

// The distance in double-doubles, where doubles tell on which feature of the triangle the nearest place is.
class FineDistance {
 public:
  FineDistance(Vec3 point, const Triangle& t) : point_(point), t_(t) {
    double largest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, largest_coordinate(t[k] - point));
    scale_ = unit_scale(largest);
    for (std::size_t k = 0; k < 3; ++k) {
      to_[k] = scale_ * (t[k] - point);
      side_[k] = scale_ * (t[(k + 1) % 3] - t[k]);
    }
  }

  // None where it is not certain how it is rounded.
  std::optional<double> find() const {
    const std::optional<FineNumber> distance = scaled_distance();
    if (!distance) return {};
    const double head = distance->value.head / scale_;
    const bool is_exact = head > 0x1p-1000 || (head == 0.0 && distance->lost_part == 0.0);
    if (!is_exact || !rounds_to_head(distance->value, distance->lost_part * distance->value.head)) return {};
    return head;
  }

 private:
  std::optional<FineNumber> scaled_distance() const {
    if (std::ranges::find(to_, Vec3{}) != std::end(to_)) return FineNumber{};
    int inner = 0;
    const Vec3 normal = cross(side_[0], side_[1]);
    const double sides_squared = norm_squared(side_[0]) * norm_squared(side_[1]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t last = (k + 2) % 3;
      const int begun = along(k, k), over = along(k, (k + 1) % 3);
      // In the corner: before the side that begins there, and behind the one that ends there.
      if (begun < 0 && along(last, k) > 0) return from_corner(k);
      const Vec3 inwards = cross(normal, side_[k]);
      const int side =
          certain_sign(-dot(inwards, to_[k]), sides_squared * norm_squared(side_[k]) * norm_squared(to_[k]));
      if (begun > 0 && over < 0 && side < 0) return from_side(k);
      inner += side;
    }
    return inner == 3 ? from_plane() : std::nullopt;
  }

  // Whether the point is behind a corner, seen along a side.
  int along(std::size_t side, std::size_t corner) const {
    return certain_sign(-dot(side_[side], to_[corner]), norm_squared(side_[side]) * norm_squared(to_[corner]));
  }

  DoubleDoubleVec3 fine_side(std::size_t from, std::size_t to) const {
    return ScaledVector(double_double_difference(t_[to], t_[from])).vector;
  }
  DoubleDoubleVec3 fine_way(std::size_t corner) const {
    return scaled(double_double_difference(t_[corner], point_), scale_);
  }
  std::size_t nearer(std::size_t k, std::size_t other) const {
    return norm_squared(to_[other]) < norm_squared(to_[k]) ? other : k;
  }

  std::optional<FineNumber> from_corner(std::size_t k) const { return length_of(fine_way(k), 0.0); }
  std::optional<FineNumber> from_side(std::size_t k) const {
    const std::size_t next = (k + 1) % 3;
    const DoubleDoubleVec3 side = fine_side(k, next);
    const ScaledVector way(fine_way(nearer(k, next)));
    const FineNumber area = length_of(cross(way.vector, side), 0x1p-96), width = length_of(side, 0.0);
    return quotient(area, width, way.scale);
  }
  std::optional<FineNumber> from_plane() const {
    const DoubleDoubleVec3 normal = cross(fine_side(0, 1), fine_side(0, 2));
    const ScaledVector way(fine_way(nearer(nearer(0, 1), 2)));
    const DoubleDouble volume = dot(normal, way.vector);
    const FineNumber height{volume.head < 0.0 ? -volume : volume, 0x1p-94 / std::abs(volume.head)};
    return quotient(height, length_of(normal, 0x1p-96), way.scale);
  }
  static std::optional<FineNumber> quotient(const FineNumber& p, const FineNumber& q, double scale) {
    const double lost = p.lost_part + q.lost_part + 0x1p-98;
    if (!(lost < 0x1p-50)) return {};
    return FineNumber{scaled(p.value / q.value, 1.0 / scale), lost};
  }

  Vec3 point_;
  const Triangle& t_;
  double scale_;
  Vec3 to_[3], side_[3];  // the corners from the point, and the sides, of a size near 1
};

// The square of a distance, as a quotient.
struct WideSquare {
  WideInteger<217> above;
  WideInteger<145> below;
  friend bool operator<(const WideSquare& a, const WideSquare& b) {
    return (a.above * b.below - b.above * a.below).sign() < 0;
  }
};

// In integers of a unit.
class WideDistance {
 public:
  WideDistance(Vec3 point, const Triangle& t) : unit_(lowest_bit(point)) {
    for (const Vec3& p : t) unit_ = std::min(unit_, lowest_bit(p));
    for (std::size_t k = 0; k < 3; ++k) to_[k] = in_units<33>(t[k], unit_) - in_units<33>(point, unit_);
  }

  double find() const {
    const auto normal = cross(to_[1] - to_[0], to_[2] - to_[0]);
    std::array<WideSquare, 3> of_side;
    int inner = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      of_side[k] = from_side(k, next);
      inner += dot(cross(to_[next] - to_[k], normal), to_[k]).sign();  // from the side outwards, to its beginning
    }
    WideSquare least = std::min(of_side[0], std::min(of_side[1], of_side[2]));
    if (inner == 3) {
      const auto volume = dot(normal, to_[0]);
      least = {volume * volume, dot(normal, normal)};
    }
    return rounded_root(least.above, least.below, unit_);
  }

 private:
  WideSquare from_side(std::size_t k, std::size_t next) const {
    const WideInteger<1> one = power_of_two<1>(0);
    const auto side = to_[next] - to_[k];
    if (dot(side, to_[k]).sign() >= 0) return {dot(to_[k], to_[k]), one};
    if (dot(side, to_[next]).sign() <= 0) return {dot(to_[next], to_[next]), one};
    const auto area = cross(to_[k], side);
    return {dot(area, area), dot(side, side)};
  }

  int unit_;
  WideVector<34> to_[3];  // the corners from the point
};

}  // namespace

double rounded_distance(Vec3 point, const Triangle& triangle) {
  const auto distance = FineDistance(point, triangle).find();
  return distance ? *distance : WideDistance(point, triangle).find();
}

}  // namespace tact::narrowphase
