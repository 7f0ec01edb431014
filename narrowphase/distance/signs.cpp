#include "narrowphase/distance/signs.h"

#include <algorithm>

#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

// p - q; times a power of two that brings its length near 1, where its products might vanish or overflow.
DoubleDoubleVec3 moderate_difference(Vec3 p, Vec3 q) {
  const DoubleDoubleVec3 d = double_double_difference(p, q);
  const double largest = largest_coordinate(heads(d));
  return largest > 0x1p-50 && largest < 0x1p50 ? d : scaled(d, unit_scale(largest));
}

// a · b to 2^-100 of the lengths: what rounding took is summed in doubles.
DoubleDouble quick_dot(const DoubleDoubleVec3& a, const DoubleDoubleVec3& b) {
  const DoubleDouble x = two_product(a.x.head, b.x.head), y = two_product(a.y.head, b.y.head),
                     z = two_product(a.z.head, b.z.head), xy = two_sum(x.head, y.head), xyz = two_sum(xy.head, z.head);
  const double mixed = (a.x.head * b.x.tail + a.x.tail * b.x.head) + (a.y.head * b.y.tail + a.y.tail * b.y.head) +
                       (a.z.head * b.z.tail + a.z.tail * b.z.head);
  return fast_two_sum(xyz.head, ((x.tail + y.tail) + (z.tail + xy.tail)) + (xyz.tail + mixed));
}

double size_squared(const DoubleDoubleVec3& v) { return norm_squared(heads(v)); }

}  // namespace

int fine_side_of_edge(Vec3 v, Vec3 p, Vec3 q, Vec3 third) {
  const DoubleDoubleVec3 along = moderate_difference(q, p), away = moderate_difference(v, p),
                         across = moderate_difference(third, p);
  const DoubleDouble square = quick_dot(along, along),
                     value = quick_dot(away, across) * square - quick_dot(across, along) * quick_dot(away, along);
  return certain_sign(value.head, square.head * square.head * (size_squared(away) * size_squared(across)),
                      kEqualDistance);
}

int fine_sign_along(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const DoubleDoubleVec3 ab = moderate_difference(b, a), cd = moderate_difference(d, c);
  return certain_sign(quick_dot(ab, cd).head, size_squared(ab) * size_squared(cd), kEqualDistance);
}

}  // namespace tact::narrowphase
