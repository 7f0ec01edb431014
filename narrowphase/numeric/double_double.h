// Double-double arithmetic, a number as the sum of two doubles: for signs and places near which doubles lose all
// digits, and for the normals of thin triangles.
//
// The normal of a triangle whose corners nearly lie on a line is a difference of nearly equal products: in plain
// doubles its direction is off by the aspect of the triangle times the rounding. Here it is right to the last bits.
#pragma once

#include <cmath>

#include "engine/base/vec3.h"
#include "narrowphase/numeric/number_vector.h"

namespace tact::narrowphase {

using base::Vec3;

// head + tail, |tail| at most half a unit in the last place of head. Sums and differences are right to 2^-104 of their
// operands, products to 2^-102 of themselves; what is multiplied must be zero or between 2^-450 and 2^450 in size.
struct DoubleDouble {
  double head = 0.0;
  double tail = 0.0;
  friend bool operator==(const DoubleDouble&, const DoubleDouble&) = default;
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

// Right to 2^-100 of itself.
inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double first = a.head / b.head;
  const DoubleDouble rest = a - DoubleDouble{first} * b;
  return fast_two_sum(first, rest.head / b.head);
}

// Of a number that is not negative; right to 2^-100 of itself.
inline DoubleDouble square_root(DoubleDouble a) {
  const double root = std::sqrt(a.head);
  if (!(root > 0.0)) return {};
  const DoubleDouble rest = a - two_product(root, root);
  return fast_two_sum(root, rest.head / (2.0 * root));
}

using DoubleDoubleVec3 = NumberVector<DoubleDouble>;

inline Vec3 heads(const DoubleDoubleVec3& v) { return {v.x.head, v.y.head, v.z.head}; }
inline DoubleDoubleVec3 scaled(const DoubleDoubleVec3& v, double by) {
  return {scaled(v.x, by), scaled(v.y, by), scaled(v.z, by)};
}

// p - q, exactly.
inline DoubleDoubleVec3 double_double_difference(Vec3 p, Vec3 q) {
  return {two_sum(p.x, -q.x), two_sum(p.y, -q.y), two_sum(p.z, -q.z)};
}

// p × q, each component to 2^-52 of itself and 2^-100 of |p||q|. Components must be zero or between 2^-450 and 2^450 in
// size.
inline Vec3 double_double_cross(const DoubleDoubleVec3& p, const DoubleDoubleVec3& q) { return heads(cross(p, q)); }

// |v| and v / |v| for any finite v but zero, however large or small. The length is off by at most 2^-51 of itself.
double length_of(Vec3 v);
Vec3 unit_vector(Vec3 v);

// p × q; times a power of two where products would vanish or overflow, so that its length and direction can be taken.
// Zero only if p and q are parallel, or nearer to it than 2^-1000.
Vec3 moderate_cross(Vec3 p, Vec3 q);

}  // namespace tact::narrowphase
