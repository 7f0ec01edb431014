// Three doubles. The engine computes with this and not with Eigen's vectors, for the same bits everywhere: Eigen's
// inline functions are shared with the user's program, which may be compiled with FMA or with other alignments.
#pragma once

#include <algorithm>
#include <cmath>

namespace tact::base {

struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3 operator*(Vec3 a, double s) { return s * a; }

inline double dot(Vec3 a, Vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm_squared(Vec3 a) { return dot(a, a); }
inline double norm(Vec3 a) { return std::sqrt(norm_squared(a)); }
inline double largest_coordinate(Vec3 a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); }
// a / |a|; a must not be zero, and |a|² must neither overflow nor vanish.
inline Vec3 normalized(Vec3 a) {
  const double length = norm(a);
  return {a.x / length, a.y / length, a.z / length};
}

}  // namespace tact::base
