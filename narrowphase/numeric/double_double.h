// Differences and cross products of points with twice the digits of a double, for the normals of thin triangles.
//
// The normal of a triangle whose corners nearly lie on a line is a difference of nearly equal products: in plain
// doubles its direction is off by the aspect of the triangle times the rounding. Here it is right to the last bits.
#pragma once

#include "engine/base/vec3.h"

namespace tact::narrowphase {

using base::Vec3;

// head + tail, |tail| at most half a unit in the last place of head. Sums and differences are right to 2^-104 of their
// operands, products to 2^-102 of themselves; what is multiplied must be zero or between 2^-450 and 2^450 in size.
struct DoubleDouble {
  double head = 0.0;
  double tail = 0.0;
};
DoubleDouble operator+(DoubleDouble a, DoubleDouble b);
DoubleDouble operator-(DoubleDouble a, DoubleDouble b);
DoubleDouble operator*(DoubleDouble a, DoubleDouble b);
inline DoubleDouble operator-(DoubleDouble a) { return {-a.head, -a.tail}; }
// Exact for a power of two.
inline DoubleDouble scaled(DoubleDouble a, double by) { return {a.head * by, a.tail * by}; }

// The same, component by component.
struct WideVec3 {
  Vec3 head;
  Vec3 tail;
};

// p - q, exactly.
WideVec3 wide_difference(Vec3 p, Vec3 q);

// p - q, each component to 2^-104 of itself and of what it was the difference of.
WideVec3 operator-(const WideVec3& p, const WideVec3& q);

// p × q, each component to 2^-52 of itself and 2^-100 of |p||q|. Components must be zero or between 2^-450 and 2^450 in
// size.
Vec3 wide_cross(const WideVec3& p, const WideVec3& q);

// v / |v| for any finite v but zero, however large or small.
Vec3 unit_vector(Vec3 v);

}  // namespace tact::narrowphase
