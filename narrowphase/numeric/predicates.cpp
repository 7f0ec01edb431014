#include "narrowphase/numeric/predicates.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "narrowphase/numeric/double_parts.h"
#include "narrowphase/numeric/wide_integer.h"

namespace tact::narrowphase {
namespace {

// The filters' error bounds, in the manner of Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust
// Geometric Predicates", 1997, §4.
//
// An operation has a relative error of at most u = 2^-52 in any rounding mode. A product of three in orient3d collects
// the errors of three differences, two products, the difference in the minor and the first of the two sums; the last
// sum keeps the sign of what it adds. So the sign of the computed determinant is right if it exceeds (7u + O(u²)) *
// permanent, where the permanent is the same expression of absolute values, itself computed a few u too low at worst:
// 8u leaves room for that and for rounding the bound. A product of two in orient2d collects three errors: 4u.
//
// kAbsolute covers underflow. If inputs or results below 2^-1022 are flushed to zero, a difference is wrong by up to
// 3 * 2^-1022 beyond its rounding. With coordinates up to 2^300 a minor is below 2^604, so nine such errors, and those
// of the products, together stay below 2^-410.
constexpr double kRelative3 = 0x1p-49;
constexpr double kRelative2 = 0x1p-50;
constexpr double kAbsolute = 0x1p-400;

constexpr int kUnknown = 2;

int filtered_sign(double determinant, double permanent, double relative) {
  const double bound = relative * permanent + kAbsolute;
  if (determinant > bound) return 1;
  if (-determinant > bound) return -1;
  return kUnknown;
}

// The sign of a determinant of differences does not change if all coordinates of one axis are multiplied by a power of
// two. So each axis gets a unit of its own, and its coordinates and their differences become integers.

// The integers if they have at most 61 bits, which they have unless an axis spans more than about eight binary orders
// of magnitude and uses every bit. Returns false if some bit was lost.
template <int N>
bool narrow_integers(const double (&x)[N], std::int64_t (&value)[N]) {
  std::uint64_t mantissa[N];
  int exponent[N];
  std::int64_t sign[N];
  for (int i = 0; i < N; ++i) {
    const DoubleParts parts(x[i]);
    mantissa[i] = parts.mantissa << 8;
    exponent[i] = parts.exponent;
    sign[i] = -static_cast<std::int64_t>(parts.negative);
  }
  const int top = *std::max_element(exponent, exponent + N);
  std::uint64_t lost = 0;
  for (int i = 0; i < N; ++i) {
    const int shift = std::min(top - exponent[i], 63);
    const std::uint64_t kept = mantissa[i] >> shift;
    lost |= (kept << shift) ^ mantissa[i];
    value[i] = (static_cast<std::int64_t>(kept) ^ sign[i]) - sign[i];
  }
  return lost == 0;
}

// The integers whatever they are: the bits of a finite double stand between 2^-1074 and 2^1023.
using Difference = WideInteger<34>;

template <int N>
void wide_differences(const double (&x)[N], Difference (&difference)[N - 1]) {
  int unit = std::numeric_limits<int>::max();
  for (int i = 0; i < N; ++i) unit = std::min(unit, lowest_bit(x[i]));
  const auto last = in_units<33>(x[N - 1], unit);
  for (int i = 0; i + 1 < N; ++i) difference[i] = in_units<33>(x[i], unit) - last;
}

// The sign of the sum of p[i] * q[i], where |p[i]| < 2^62 and |q[i]| < 2^125. The sum is kept as high * 2^64 + low.
int sign_of_dot(const std::int64_t (&p)[3], const Int128 (&q)[3]) {
  Int128 high = 0;
  UInt128 low = 0;
  for (int i = 0; i < 3; ++i) {
    const Int128 part = static_cast<Int128>(p[i]) * static_cast<std::uint64_t>(q[i]);
    high += static_cast<Int128>(p[i]) * static_cast<std::int64_t>(q[i] >> 64) + (part >> 64);
    low += static_cast<std::uint64_t>(part);
  }
  high += static_cast<Int128>(low >> 64);
  if (high != 0) return high < 0 ? -1 : 1;
  return static_cast<std::uint64_t>(low) != 0 ? 1 : 0;
}

Int128 cross(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
  return static_cast<Int128>(a) * d - static_cast<Int128>(b) * c;
}

int wide_orient3d(const double (&x)[4], const double (&y)[4], const double (&z)[4]) {
  Difference dx[3];
  Difference dy[3];
  Difference dz[3];
  wide_differences(x, dx);
  wide_differences(y, dy);
  wide_differences(z, dz);
  const auto bc = dx[1] * dy[2] - dx[2] * dy[1];
  const auto ca = dx[2] * dy[0] - dx[0] * dy[2];
  const auto ab = dx[0] * dy[1] - dx[1] * dy[0];
  return (dz[0] * bc + dz[1] * ca + dz[2] * ab).sign();
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

template <int N>
bool all_same(const double (&x)[N]) {
  bool same = true;
  for (int i = 1; i < N; ++i) same &= same_bits(x[0], x[i]);
  return same;
}

bool same_point(const Vec3& a, const Vec3& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

int exact_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double x[4] = {a.x, b.x, c.x, d.x};
  const double y[4] = {a.y, b.y, c.y, d.y};
  const double z[4] = {a.z, b.z, c.z, d.z};
  // Faces that lie flat in an axis plane and bodies that share vertices are common, and need no arithmetic.
  if (all_same(x) || all_same(y) || all_same(z)) return 0;
  if (same_point(a, d) || same_point(b, d) || same_point(c, d) || same_point(a, b) || same_point(b, c) ||
      same_point(c, a))
    return 0;
  std::int64_t ix[4];
  std::int64_t iy[4];
  std::int64_t iz[4];
  if (!(narrow_integers(x, ix) && narrow_integers(y, iy) && narrow_integers(z, iz))) return wide_orient3d(x, y, z);
  const std::int64_t dx[3] = {ix[0] - ix[3], ix[1] - ix[3], ix[2] - ix[3]};
  const std::int64_t dy[3] = {iy[0] - iy[3], iy[1] - iy[3], iy[2] - iy[3]};
  const std::int64_t dz[3] = {iz[0] - iz[3], iz[1] - iz[3], iz[2] - iz[3]};
  const Int128 crosses[3] = {cross(dx[1], dx[2], dy[1], dy[2]), cross(dx[2], dx[0], dy[2], dy[0]),
                             cross(dx[0], dx[1], dy[0], dy[1])};
  return sign_of_dot(dz, crosses);
}

int exact_orient2d(const Point2& a, const Point2& b, const Point2& c) {
  const double x[3] = {a.x, b.x, c.x};
  const double y[3] = {a.y, b.y, c.y};
  if (all_same(x) || all_same(y)) return 0;
  std::int64_t ix[3];
  std::int64_t iy[3];
  if (narrow_integers(x, ix) && narrow_integers(y, iy)) {
    const Int128 determinant = cross(ix[0] - ix[2], ix[1] - ix[2], iy[0] - iy[2], iy[1] - iy[2]);
    return determinant < 0 ? -1 : determinant > 0 ? 1 : 0;
  }
  Difference dx[2];
  Difference dy[2];
  wide_differences(x, dx);
  wide_differences(y, dy);
  return (dx[0] * dy[1] - dx[1] * dy[0]).sign();
}

// Compares as integers, which no floating-point mode can disturb. The two zeros are equal.
int compare(double a, double b) {
  const auto key = [](double x) {
    const auto bits = std::bit_cast<std::int64_t>(x);
    return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
  };
  return (key(a) > key(b)) - (key(a) < key(b));
}

}  // namespace

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, PredicateCounts& counts) {
  const Vec3 p = a - d;
  const Vec3 q = b - d;
  const Vec3 r = c - d;
  const double qr[3] = {q.y * r.z, q.z * r.x, q.x * r.y};
  const double rq[3] = {q.z * r.y, q.x * r.z, q.y * r.x};
  const double determinant = (p.x * (qr[0] - rq[0]) + p.y * (qr[1] - rq[1])) + p.z * (qr[2] - rq[2]);
  const double permanent =
      (std::abs(p.x) * (std::abs(qr[0]) + std::abs(rq[0])) + std::abs(p.y) * (std::abs(qr[1]) + std::abs(rq[1]))) +
      std::abs(p.z) * (std::abs(qr[2]) + std::abs(rq[2]));
  const int sign = filtered_sign(determinant, permanent, kRelative3);
  if (sign != kUnknown) return sign;
  ++counts.exact;
  return exact_orient3d(a, b, c, d);
}

std::array<int, 3> sides_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const std::array<Vec3, 3>& points,
                                  PredicateCounts& counts) {
  // The determinant is also (c - d) · ((a - c) × (b - c)), with the same count of rounding errors.
  const Vec3 p = a - c;
  const Vec3 q = b - c;
  const double pq[3] = {p.y * q.z, p.z * q.x, p.x * q.y};
  const double qp[3] = {p.z * q.y, p.x * q.z, p.y * q.x};
  const Vec3 normal{pq[0] - qp[0], pq[1] - qp[1], pq[2] - qp[2]};
  const Vec3 size{std::abs(pq[0]) + std::abs(qp[0]), std::abs(pq[1]) + std::abs(qp[1]),
                  std::abs(pq[2]) + std::abs(qp[2])};
  std::array<int, 3> signs;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 r = c - points[i];
    const double permanent = dot(Vec3{std::abs(r.x), std::abs(r.y), std::abs(r.z)}, size);
    signs[i] = filtered_sign(dot(r, normal), permanent, kRelative3);
    if (signs[i] != kUnknown) continue;
    ++counts.exact;
    signs[i] = exact_orient3d(a, b, c, points[i]);
  }
  return signs;
}

int orient2d(const Point2& a, const Point2& b, const Point2& c, PredicateCounts& counts) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const int sign = filtered_sign(left - right, std::abs(left) + std::abs(right), kRelative2);
  if (sign != kUnknown) return sign;
  ++counts.exact;
  return exact_orient2d(a, b, c);
}

int compare_lexicographically(const Vec3& a, const Vec3& b) {
  const int by_x = compare(a.x, b.x);
  if (by_x != 0) return by_x;
  const int by_y = compare(a.y, b.y);
  return by_y != 0 ? by_y : compare(a.z, b.z);
}

}  // namespace tact::narrowphase
