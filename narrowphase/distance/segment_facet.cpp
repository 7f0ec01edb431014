#include "narrowphase/distance/segment_facet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "narrowphase/distance/vertex_facet.h"
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

// When the segment comes to a place of a triangle that lies on its line, by how far that is along the longest axis.
double time_at(const Segment& segment, const Triangle& t, const std::array<double, 3>& weight) {
  const int axis = longest_axis(segment[1] - segment[0]);
  double along = 0.0;
  for (std::size_t k = 0; k < 3; ++k) along += weight[k] * (t[k][axis] - segment[0][axis]);
  return along / (segment[1][axis] - segment[0][axis]);
}

// The weights where the segment's line, which lies in one plane with all, crosses the side from corner a to corner b
// strictly between them; all zero if it does not.
std::array<double, 3> crossing(const std::array<WideCross, 3>& beside, std::size_t a, std::size_t b) {
  const auto apart = beside[a] - beside[b];
  const auto longest = std::max({apart.x.bit_count(), apart.y.bit_count(), apart.z.bit_count()});
  const auto along = [&](std::size_t k) {
    return apart.x.bit_count() == longest ? beside[k].x : apart.y.bit_count() == longest ? beside[k].y : beside[k].z;
  };
  const auto of_a = along(a), of_b = along(b);
  if (of_a.sign() * of_b.sign() >= 0) return {};
  std::array<WideInteger<69>, 3> opposite{};
  opposite[a] = of_b;
  opposite[b] = of_a;
  return shares(opposite);
}

// All in one plane: it begins inside, or where it comes first over a side or a corner. Its line crosses the triangle
// from one such place to another, and the segment begins before both.
CommonPlace place_in_plane(const Segment& segment, const Triangle& t, const std::array<WideCross, 3>& beside) {
  PredicateCounts counts;
  const Vec3& from = segment[0];
  if (triangle_triangle_meet(t, {from, from, from}, counts)) return {0.0, weights_about(from, t)};
  CommonPlace first{std::numeric_limits<double>::infinity(), {}};
  const auto take = [&](const std::array<double, 3>& weight) {
    const double time = time_at(segment, t, weight);
    if (time < first.time) first = {time, weight};
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (beside[k].is_zero()) {
      std::array<double, 3> corner{};
      corner[k] = 1.0;
      take(corner);
    }
    const std::array<double, 3> weight = crossing(beside, k, (k + 1) % 3);
    if (weight[k] > 0.0) take(weight);
  }
  return first;
}

}  // namespace

CommonPlace exact_place(const Segment& segment, const Triangle& t) {
  const WideTriangle wide = in_integers(segment, t);
  std::array<WideCross, 3> beside;
  for (std::size_t k = 0; k < 3; ++k) beside[k] = cross(wide.way, wide.corner[k]);
  // The volumes that the segment spans with each side: of one sign, since it meets the triangle.
  std::array<WideInteger<105>, 3> volume;
  for (std::size_t k = 0; k < 3; ++k) volume[k] = dot(beside[(k + 1) % 3], wide.corner[(k + 2) % 3]);
  if (volume[0].sign() == 0 && volume[1].sign() == 0 && volume[2].sign() == 0)
    return place_in_plane(segment, t, beside);
  const std::array<double, 3> weight = shares(volume);
  return {time_at(segment, t, weight), weight};
}

}  // namespace tact::narrowphase
