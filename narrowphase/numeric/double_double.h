// Double-double arithmetic, a number as the sum of two doubles, for the normals of thin triangles: differences and
// cross products of points.
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

// head + tail == a + b (Knuth).
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

// The same if |a| >= |b| (Dekker).
inline DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// The upper 26 bits of a, and the rest (Veltkamp).
inline DoubleDouble split(double a) {
  const double c = 0x1.0000002p27 * a;
  const double upper = c - (c - a);
  return {upper, a - upper};
}

// head + tail == a * b (Dekker). std::fma would be a call where the machine may lack the instruction.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  const DoubleDouble x = split(a);
  const DoubleDouble y = split(b);
  return {product, ((x.head * y.head - product) + x.head * y.tail + x.tail * y.head) + x.tail * y.tail};
}

inline DoubleDouble operator-(DoubleDouble a) { return {-a.head, -a.tail}; }
inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble heads = two_sum(a.head, b.head);
  const DoubleDouble tails = two_sum(a.tail, b.tail);
  const DoubleDouble sum = fast_two_sum(heads.head, heads.tail + tails.head);
  return fast_two_sum(sum.head, sum.tail + tails.tail);
}

inline DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + -b; }

inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_product(a.head, b.head);
  return fast_two_sum(p.head, p.tail + (a.head * b.tail + a.tail * b.head));
}

// Exact for a power of two.
inline DoubleDouble scaled(DoubleDouble a, double by) { return {a.head * by, a.tail * by}; }

// The same, component by component.
struct DoubleDoubleVec3 {
  Vec3 head;
  Vec3 tail;
};

// p - q, exactly.
DoubleDoubleVec3 double_double_difference(Vec3 p, Vec3 q);

// p - q, each component to 2^-104 of itself and of its operands.
DoubleDoubleVec3 operator-(const DoubleDoubleVec3& p, const DoubleDoubleVec3& q);

// p × q, each component to 2^-52 of itself and 2^-100 of |p||q|. Components must be zero or between 2^-450 and 2^450 in
// size.
Vec3 double_double_cross(const DoubleDoubleVec3& p, const DoubleDoubleVec3& q);

// v / |v| for any finite v but zero, however large or small.
Vec3 unit_vector(Vec3 v);

}  // namespace tact::narrowphase
