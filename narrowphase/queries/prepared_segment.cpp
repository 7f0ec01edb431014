#include "narrowphase/queries/prepared_segment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "narrowphase/distance/vertex_facet.h"

namespace tact::narrowphase {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

double PreparedSegment::entry(const Box& box) const {
  double first = 0.0, last = 1.0;
  bool meets = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double from = slabs_.from[axis], inverse = slabs_.inverse[axis];
    const double enter = inverse >= 0.0 ? box.lower[axis] : box.upper[axis];
    const double leave = inverse >= 0.0 ? box.upper[axis] : box.lower[axis];
    if (inverse != 0.0) {
      first = std::max(first, (enter - from) * inverse);
      last = std::min(last, (leave - from) * inverse);
    } else if (slabs_.stays[axis]) {
      meets = meets && enter <= from && from <= leave;
    }
  }
  // Rounding is that of rank_by_entry().
  first = first * (1.0 - 0x1p-50) - 0x1p-1000;
  last = last * (1.0 + 0x1p-50) + 0x1p-1000;
  return meets && first <= last ? first : kInfinity;
}

std::uint64_t PreparedSegment::facets_seen(const ClusteredMesh& mesh, int cluster) const {
  const ClusterFacets facets = mesh.facets_of(cluster);
  if (is_point_) return ~std::uint64_t{0} >> (64 - facets.facet_count);
  LineOfSight line = line_;
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double from = line_.from[axis];
    largest = std::max({largest, std::abs(mesh.box().lower[axis] - from), std::abs(mesh.box().upper[axis] - from)});
  }
  // Four times the roundings that meet() counts, and products that vanish.
  line.error = 0x1p-48 * largest + 0x1p-1000;
  return kernels().sight_facets(facets, line);
}

PreparedSegment::PreparedSegment(const Segment& segment) : segment_(segment) {
  const Vec3 from = segment[0], way = segment[1] - from;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / way[axis];
    slabs_.from[axis] = line_.from[axis] = from[axis];
    slabs_.inverse[axis] = std::isfinite(inverse) ? inverse : 0.0;
    slabs_.stays[axis] = way[axis] == 0.0;  // then the ends are equal: the difference of no others is zero
  }
  const int z = longest_axis(way);
  for (int k = 0; k < 3; ++k) line_.axis[k] = (z + 1 + k) % 3;
  way_ = way[z];
  is_point_ = way_ == 0.0;
  for (int k = 0; k < 2 && !is_point_; ++k) line_.slope[k] = way[line_.axis[k]] / way_;
}

std::optional<CommonPlace> PreparedSegment::meet_exactly(const Triangle& triangle, PredicateCounts& counts) const {
  if (!segment_triangle_meet(segment_, triangle, counts)) return std::nullopt;
  if (is_point_) return CommonPlace{0.0, weights_about(segment_[0], triangle)};
  return first_place(segment_, triangle);
}

// Seen along the line, which is at zero, a corner is at (u, v). Each weight is as twice the area between the line and
// the other two corners.
//
// With coordinates of at most m, u and v are wrong by eight roundings of 2^-53 m: of two differences, of the slope, of
// which both ways, their quotient and its product with a difference are rounded, and of a last difference, which is up
// to 2 m. Areas are wrong by that error e times the four coordinates in them, and half as much again for the rounding
// of products; more exactly, by 2 e² more.
//
// So the place that the weights give is off, in each direction, by the errors of the areas times how far the corners
// are apart in it, over the whole area; twice that where a weight was raised to zero. If that is at most 2^-41 of the
// size, as nearly always, it is good enough; otherwise first_place().
std::optional<CommonPlace> PreparedSegment::meet(const Triangle& triangle, PredicateCounts& counts) const {
  if (is_point_) {
    Box box;
    for (const Vec3& p : triangle) box = extended(box, p);
    return base::contains(box, segment_[0]) ? meet_exactly(triangle, counts) : std::nullopt;
  }
  double u[3], v[3], z[3], largest = 0.0, widest = 0.0, nearest = kInfinity, farthest = -kInfinity;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 away = triangle[k] - segment_[0];
    const double x = away[line_.axis[0]], y = away[line_.axis[1]];
    z[k] = away[line_.axis[2]];
    u[k] = x - line_.slope[0] * z[k];
    v[k] = y - line_.slope[1] * z[k];
    largest = std::max(std::max(largest, std::abs(x)), std::max(std::abs(y), std::abs(z[k])));
    widest = std::max(widest, std::max(std::abs(u[k]), std::abs(v[k])));
    nearest = std::min(nearest, z[k]);
    farthest = std::max(farthest, z[k]);
  }
  const double error = 0x1.1p-50 * largest + 0x1p-1000;
  const double bound = 5.0 * error * (widest + error) + 0x1p-900;
  double area[3], sum = 0.0;
  int positive = 0, negative = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t p = (k + 1) % 3, q = (k + 2) % 3;
    area[k] = u[p] * v[q] - u[q] * v[p];
    positive += area[k] > bound;
    negative += area[k] < -bound;
    sum += area[k];
  }
  if (positive > 0 && negative > 0) return std::nullopt;
  const double whole = std::abs(sum), off = 3.0 * bound;
  const double size = std::max(largest, std::abs(way_));
  const double extent = widest + (farthest - nearest);
  if (!(16.0 * off < whole && 3.0 * extent * off <= 0x1p-41 * size * whole)) return meet_exactly(triangle, counts);

  CommonPlace place;
  double part = 0.0, along = 0.0;
  // In this order of std::max() no weight is -0, which Clang's code for WebAssembly would turn into 0.
  for (std::size_t k = 0; k < 3; ++k) part += place.weight[k] = std::max(0.0, sum < 0.0 ? -area[k] : area[k]);
  for (std::size_t k = 0; k < 3; ++k) along += (place.weight[k] /= part) * z[k];
  place.time = along / way_;
  // Weights are wrong by three times the errors of the areas over the whole one, in all.
  const double late = (4.0 * off / whole + 0x1p-48) * largest / std::abs(way_);
  const bool within = positive == 3 || negative == 3;
  if (within && (place.time < -late || place.time > 1.0 + late)) return std::nullopt;
  if (!(within && place.time > late && place.time < 1.0 - late) && !segment_triangle_meet(segment_, triangle, counts))
    return std::nullopt;
  place.time = crossing_time(segment_, triangle);
  return place;
}

}  // namespace tact::narrowphase
