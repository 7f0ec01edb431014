// Vectors of integers of a fixed number of limbs: exact differences, dot and cross products of points.
#pragma once

#include "engine/base/vec3.h"
#include "narrowphase/numeric/double_parts.h"
#include "narrowphase/numeric/wide_integer.h"

namespace tact::narrowphase {

template <int kCapacity>
struct WideVector {
  WideInteger<kCapacity> x, y, z;

  WideVector() = default;
  WideVector(const WideInteger<kCapacity>& of_x, const WideInteger<kCapacity>& of_y, const WideInteger<kCapacity>& of_z)
      : x(of_x), y(of_y), z(of_z) {}
  // The same vector with room for larger ones.
  template <int B>
  requires(B < kCapacity) explicit WideVector(const WideVector<B>& v) : x(v.x), y(v.y), z(v.z) {}

  bool is_zero() const { return x.sign() == 0 && y.sign() == 0 && z.sign() == 0; }
  WideVector operator-() const { return {-x, -y, -z}; }
};

template <int A, int B>
auto operator-(const WideVector<A>& p, const WideVector<B>& q) -> WideVector<std::max(A, B) + 1> {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}

template <int A, int B>
auto operator+(const WideVector<A>& p, const WideVector<B>& q) -> WideVector<std::max(A, B) + 1> {
  return {p.x + q.x, p.y + q.y, p.z + q.z};
}

template <int A, int B>
auto operator*(const WideInteger<A>& s, const WideVector<B>& p) -> WideVector<A + B> {
  return {s * p.x, s * p.y, s * p.z};
}

template <int A, int B>
auto dot(const WideVector<A>& p, const WideVector<B>& q) -> WideInteger<A + B + 2> {
  return (p.x * q.x + p.y * q.y) + p.z * q.z;
}

template <int A, int B>
auto cross(const WideVector<A>& p, const WideVector<B>& q) -> WideVector<A + B + 1> {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

// The lowest bit of a point's coordinates, and the point in units of that or a lower one: see double_parts.h.
inline int lowest_bit(const base::Vec3& p) { return std::min({lowest_bit(p.x), lowest_bit(p.y), lowest_bit(p.z)}); }

template <int kCapacity>
WideVector<kCapacity> in_units(const base::Vec3& p, int unit) {
  return {in_units<kCapacity>(p.x, unit), in_units<kCapacity>(p.y, unit), in_units<kCapacity>(p.z, unit)};
}

}  // namespace tact::narrowphase
