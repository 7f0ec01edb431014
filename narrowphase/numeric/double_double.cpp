#include "narrowphase/numeric/double_double.h"

#include <algorithm>
#include <cmath>

namespace tact::narrowphase {
namespace {

// head + tail == a + b (Knuth).
DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

// The same if |a| >= |b| (Dekker).
DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// The upper 26 bits of a, and the rest (Veltkamp).
DoubleDouble split(double a) {
  const double c = 0x1.0000002p27 * a;
  const double upper = c - (c - a);
  return {upper, a - upper};
}

// head + tail == a * b (Dekker). std::fma would be a call where the machine may lack the instruction.
DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  const DoubleDouble x = split(a);
  const DoubleDouble y = split(b);
  return {product, ((x.head * y.head - product) + x.head * y.tail + x.tail * y.head) + x.tail * y.tail};
}

DoubleDouble component(const WideVec3& v, int axis) { return {v.head[axis], v.tail[axis]}; }

}  // namespace

DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble heads = two_sum(a.head, b.head);
  const DoubleDouble tails = two_sum(a.tail, b.tail);
  const DoubleDouble sum = fast_two_sum(heads.head, heads.tail + tails.head);
  return fast_two_sum(sum.head, sum.tail + tails.tail);
}

DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + -b; }

DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_product(a.head, b.head);
  return fast_two_sum(p.head, p.tail + (a.head * b.tail + a.tail * b.head));
}

WideVec3 wide_difference(Vec3 p, Vec3 q) {
  WideVec3 d;
  for (int axis = 0; axis < 3; ++axis) {
    const DoubleDouble exact = two_sum(p[axis], -q[axis]);
    d.head[axis] = exact.head;
    d.tail[axis] = exact.tail;
  }
  return d;
}

WideVec3 operator-(const WideVec3& p, const WideVec3& q) {
  WideVec3 d;
  for (int axis = 0; axis < 3; ++axis) {
    const DoubleDouble rounded = component(p, axis) - component(q, axis);
    d.head[axis] = rounded.head;
    d.tail[axis] = rounded.tail;
  }
  return d;
}

Vec3 wide_cross(const WideVec3& p, const WideVec3& q) {
  Vec3 n;
  for (int axis = 0; axis < 3; ++axis) {
    const int i = (axis + 1) % 3;
    const int j = (axis + 2) % 3;
    n[axis] = (component(p, i) * component(q, j) - component(p, j) * component(q, i)).head;
  }
  return n;
}

Vec3 unit_vector(Vec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest > 0x1p-400 && largest < 0x1p400) return base::normalized(v);  // the same bits
  const int exponent = std::ilogb(largest);
  return base::normalized({std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)});
}

}  // namespace tact::narrowphase
