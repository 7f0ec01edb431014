#include "narrowphase/distance/segment_facet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "narrowphase/distance/rounding.h"
#include "narrowphase/distance/vertex_facet.h"
#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/rounded.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/numeric/wide_vector.h"

namespace tact::narrowphase {

namespace {

// Differences of doubles as integers of one unit, and products of two: the bits of a double stand between 2^-1074 and
// 2^1023.
using WideDifference = WideVector<34>;
using WideCross = WideVector<69>;

struct WideTriangle {
  WideDifference way, corner[3];  // from the beginning of the segment
};

WideTriangle in_integers(const Segment& segment, const Triangle& t) {
  int unit = std::min(lowest_bit(segment[0]), lowest_bit(segment[1]));
  for (const Vec3& p : t) unit = std::min(unit, lowest_bit(p));
  const auto from = in_units<33>(segment[0], unit);
  const auto about_from = [&](const Vec3& p) { return in_units<33>(p, unit) - from; };
  return {about_from(segment[1]), {about_from(t[0]), about_from(t[1]), about_from(t[2])}};
}

// The weights that integers stand for, whatever their sign.
template <class Integer>
std::array<double, 3> shares(const std::array<Integer, 3>& numbers) {
  int bits = 0;
  for (const Integer& one : numbers) bits = std::max(bits, one.bit_count());
  std::array<double, 3> size;
  for (std::size_t k = 0; k < 3; ++k) size[k] = std::abs(numbers[k].times_power(bits));
  const double sum = size[0] + size[1] + size[2];
  return {size[0] / sum, size[1] / sum, size[2] / sum};
}

template <int kCapacity>
WideInteger<kCapacity> along_axis(const WideVector<kCapacity>& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

template <int kCapacity>
WideInteger<kCapacity> magnitude(const WideInteger<kCapacity>& a) {
  return a.sign() < 0 ? -a : a;
}

// A place of a triangle that lies on the segment's line: the weights, and how far along an axis it is from the
// beginning, as a quotient.
struct PlaceOnLine {
  std::array<double, 3> weight{};
  WideInteger<104> along, whole;
};

// Where the segment's line, which lies in one plane with all, crosses the side from corner a to corner b strictly
// between them.
std::optional<PlaceOnLine> crossing(const WideTriangle& wide, const std::array<WideCross, 3>& beside, std::size_t a,
                                    std::size_t b, int axis) {
  const auto apart = beside[a] - beside[b];
  const auto longest = std::max({apart.x.bit_count(), apart.y.bit_count(), apart.z.bit_count()});
  const int across = apart.x.bit_count() == longest ? 0 : apart.y.bit_count() == longest ? 1 : 2;
  const auto of_a = along_axis(beside[a], across), of_b = along_axis(beside[b], across);
  if (of_a.sign() * of_b.sign() >= 0) return {};
  std::array<WideInteger<69>, 3> opposite{};
  opposite[a] = magnitude(of_b);
  opposite[b] = magnitude(of_a);
  return PlaceOnLine{shares(opposite),
                     opposite[a] * along_axis(wide.corner[a], axis) + opposite[b] * along_axis(wide.corner[b], axis),
                     opposite[a] + opposite[b]};
}

// All in one plane: it begins inside, or where it comes first over a side or a corner. Its line crosses the triangle
// from one such place to another, and the segment begins before both.
CommonPlace place_in_plane(const Segment& segment, const Triangle& t, const WideTriangle& wide,
                           const std::array<WideCross, 3>& beside) {
  PredicateCounts counts;
  const Vec3& from = segment[0];
  if (triangle_triangle_meet(t, {from, from, from}, counts)) return {0.0, weights_about(from, t)};
  const int axis = longest_axis(segment[1] - from);
  const auto way = along_axis(wide.way, axis);
  CommonPlace first{std::numeric_limits<double>::infinity(), {}};
  const auto take = [&](const PlaceOnLine& place) {
    const auto along = magnitude(place.along);
    const auto whole = place.whole * magnitude(way);
    if ((along - whole).sign() > 0) return;  // behind the end
    const double time = rounded_quotient(along, whole);
    if (time < first.time) first = {time, place.weight};
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (beside[k].is_zero()) {
      PlaceOnLine corner{{}, along_axis(wide.corner[k], axis), power_of_two<1>(0)};
      corner.weight[k] = 1.0;
      take(corner);
    }
    if (const auto place = crossing(wide, beside, k, (k + 1) % 3, axis)) take(*place);
  }
  return first;
}

// A segment and a triangle in double-doubles.
struct FineCrossing {
  DoubleDoubleVec3 p, q;       // sides of the triangle, from its first corner
  DoubleDoubleVec3 from, way;  // from the beginning of the segment to that corner, and to its end

  FineCrossing(const Segment& segment, const Triangle& t)
      : p(double_double_difference(t[1], t[0])),
        q(double_double_difference(t[2], t[0])),
        from(double_double_difference(t[0], segment[0])),
        way(double_double_difference(segment[1], segment[0])) {}

  // A number and a bound of its error.
  struct Bounded {
    DoubleDouble value;
    double error = 0.0;
  };

  // When the segment crosses the plane, if it is certain how that is rounded.
  std::optional<DoubleDouble> time() const {
    const auto bounded = bounded_time();
    if (!bounded) return {};
    return bounded->value;
  }

  // The same with its error. With the largest components of the four vectors the normal is off by 2^-100 of two,
  // products with it by 2^-97 of three of them.
  std::optional<Bounded> bounded_time() const {
    const double sides = largest_coordinate(heads(p)) * largest_coordinate(heads(q)),
                 size = sides * largest_coordinate(heads(from)), size_of_way = sides * largest_coordinate(heads(way));
    if (!(sides > kVanishing && size > kVanishing && size_of_way > kVanishing)) return {};
    const DoubleDoubleVec3 normal = cross(p, q);
    const DoubleDouble height = dot(normal, from), slope = dot(normal, way), time = height / slope;
    const double error =
        std::abs(time.head) * (0x1p-96 * (size / std::abs(height.head) + size_of_way / std::abs(slope.head)) + 0x1p-98);
    if (!rounds_to_head(time, error)) return {};
    return Bounded{time, error};
  }

  // The weights of the triangle's corners at a time.
  std::array<double, 3> weights_at(DoubleDouble time) const {
    const double scale = unit_scale(std::max(largest_coordinate(heads(p)), largest_coordinate(heads(q))));
    return nearest_weights(scale * heads(time * way - from), {Vec3{}, scale * heads(p), scale * heads(q)});
  }
};

// One coordinate of the place at a time, if it is certain how that is rounded: the way is exact, its product with the
// time off by 2^-102 of it, the sum by 2^-104 of both.
std::optional<double> coordinate_at(const FineCrossing::Bounded& time, double from, DoubleDouble way) {
  if (way.head == 0.0) return from;
  const DoubleDouble gone = time.value * way, at = DoubleDouble{from} + gone;
  const double error = 2.0 * std::abs(way.head) * time.error + 0x1p-100 * (std::abs(gone.head) + std::abs(from));
  if (!rounds_to_head(at, error)) return {};
  return at.head;
}

// (from * whole + way * part) / whole in units of 2^(unit - 1075), rounded.
template <int A, int B, int C>
double rounded_place(const WideInteger<A>& from, const WideInteger<B>& way, const WideInteger<C>& part,
                     const WideInteger<C>& whole, int unit) {
  const auto sum = from * whole + way * part;
  if (sum.sign() == 0) return 0.0;
  const auto above = magnitude(sum);
  const auto below = magnitude(whole);
  const int bits = above.bit_count(), bits_below = below.bit_count();
  const double near =
      std::ldexp(above.times_power(bits) / below.times_power(bits_below), bits - bits_below + unit - 1075);
  const double size = rounded(near, [&](double x, double y) {
    const SumOfNeighbors neighbors(x, y);
    const auto of_sum = power_of_two<34>(std::max(unit - neighbors.unit, 0) + 1) * above;
    return (of_sum - power_of_two<34>(std::max(neighbors.unit - unit, 0)) * (neighbors.in_units_of_it * below)).sign();
  });
  return sum.sign() * whole.sign() < 0 ? -size : size;
}

double exact_time(const WideTriangle& wide) {
  const auto& [p, q, r] = wide.corner;
  const auto normal = cross(q - p, r - p);
  return rounded_quotient(magnitude(dot(normal, p)), magnitude(dot(normal, wide.way)));
}

}  // namespace

CommonPlace first_place(const Segment& segment, const Triangle& t) {
  const FineCrossing fine(segment, t);
  if (const auto time = fine.time()) return {time->head, fine.weights_at(*time)};
  const WideTriangle wide = in_integers(segment, t);
  std::array<WideCross, 3> beside;
  for (std::size_t k = 0; k < 3; ++k) beside[k] = cross(wide.way, wide.corner[k]);
  // The volumes that the segment spans with each side: of one sign, since it meets the triangle.
  std::array<WideInteger<105>, 3> volume;
  for (std::size_t k = 0; k < 3; ++k) volume[k] = dot(beside[(k + 1) % 3], wide.corner[(k + 2) % 3]);
  if (volume[0].sign() == 0 && volume[1].sign() == 0 && volume[2].sign() == 0)
    return place_in_plane(segment, t, wide, beside);
  return {exact_time(wide), shares(volume)};
}

PlaceOfSegment place_in_facet(const Segment& segment, const Triangle& t) {
  const Vec3& from = segment[0];
  const FineCrossing fine(segment, t);
  if (const auto time = fine.bounded_time()) {
    const auto x = coordinate_at(*time, from.x, fine.way.x), y = coordinate_at(*time, from.y, fine.way.y),
               z = coordinate_at(*time, from.z, fine.way.z);
    if (x && y && z) return {time->value.head, {*x, *y, *z}};
  }
  const WideTriangle wide = in_integers(segment, t);
  const auto& [p, q, r] = wide.corner;
  const auto normal = cross(q - p, r - p);
  const auto part = dot(normal, p), whole = dot(normal, wide.way);
  if (whole.sign() == 0) {
    const double time = first_place(segment, t).time;
    return {time, time == 1.0 ? segment[1] : from + time * (segment[1] - from)};
  }
  int unit = std::min(lowest_bit(from), lowest_bit(segment[1]));
  for (const Vec3& corner : t) unit = std::min(unit, lowest_bit(corner));
  const auto begin = in_units<33>(from, unit);
  return {rounded_quotient(magnitude(part), magnitude(whole)),
          {rounded_place(begin.x, wide.way.x, part, whole, unit), rounded_place(begin.y, wide.way.y, part, whole, unit),
           rounded_place(begin.z, wide.way.z, part, whole, unit)}};
}

double crossing_time(const Segment& segment, const Triangle& triangle) {
  const auto time = FineCrossing(segment, triangle).time();
  return time ? time->head : exact_time(in_integers(segment, triangle));
}

}  // namespace tact::narrowphase
