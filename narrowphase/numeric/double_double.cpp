#include "narrowphase/numeric/double_double.h"

#include <algorithm>
#include <cmath>

namespace tact::narrowphase {
namespace {

DoubleDouble component(const DoubleDoubleVec3& v, int axis) { return {v.head[axis], v.tail[axis]}; }

}  // namespace

DoubleDoubleVec3 double_double_difference(Vec3 p, Vec3 q) {
  DoubleDoubleVec3 d;
  for (int axis = 0; axis < 3; ++axis) {
    const DoubleDouble exact = two_sum(p[axis], -q[axis]);
    d.head[axis] = exact.head;
    d.tail[axis] = exact.tail;
  }
  return d;
}

DoubleDoubleVec3 operator-(const DoubleDoubleVec3& p, const DoubleDoubleVec3& q) {
  DoubleDoubleVec3 d;
  for (int axis = 0; axis < 3; ++axis) {
    const DoubleDouble rounded = component(p, axis) - component(q, axis);
    d.head[axis] = rounded.head;
    d.tail[axis] = rounded.tail;
  }
  return d;
}

Vec3 double_double_cross(const DoubleDoubleVec3& p, const DoubleDoubleVec3& q) {
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
