// The loops over polygons in a plane.
#pragma once

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

struct FlatPack {
  Pack x, y;
};

inline FlatPack points_from(const FlatPolygon& polygon, int i) { return {load(polygon.x + i), load(polygon.y + i)}; }
inline FlatPack point_at(const FlatPolygon& polygon, int i) { return {spread(polygon.x[i]), spread(polygon.y[i])}; }

// Twice the area of a triangle, positive if it is counter-clockwise.
inline Pack turn(const FlatPack& a, const FlatPack& b, const FlatPack& c) {
  return sub(mul(sub(b.x, a.x), sub(c.y, a.y)), mul(sub(b.y, a.y), sub(c.x, a.x)));
}

// Where two values certainly are not zero and have one sign.
inline Mask on_one_side(Pack turn_p, Pack turn_q, Pack least) {
  const Pack most = sub(spread(0.0), least);
  return either(both(less(least, turn_p), less(least, turn_q)), both(less(turn_p, most), less(turn_q, most)));
}

// Where one of the edges ab and cd certainly lies beyond the line through the other.
inline Mask lie_apart(const FlatPack& a, const FlatPack& b, const FlatPack& c, const FlatPack& d, Pack least) {
  return either(on_one_side(turn(a, b, c), turn(a, b, d), least), on_one_side(turn(c, d, a), turn(c, d, b), least));
}

// The least `turn` that certainly is not zero, and so of a scalar product. Each factor of the two products is a
// difference of up to `size`, off by two errors and a rounding of half an error at most, so each product is off by 5
// errors times `size`; roundings of products and sums add 2 at most, and squares of errors next to nothing.
inline double least_turn(const FlatPolygon& polygon) { return 16.0 * polygon.error * polygon.size; }

// Edge i runs from vertex i to the next one. Have all edges nothing in common with the next one but a vertex?
bool has_no_spike(const FlatPolygon& polygon, Pack least) {
  for (int i = 0; i < polygon.count; i += kWidth) {
    const FlatPack p = points_from(polygon, i), q = points_from(polygon, i + 1), r = points_from(polygon, i + 2);
    const Pack bend = turn(p, q, r), on = add(mul(sub(q.x, p.x), sub(r.x, q.x)), mul(sub(q.y, p.y), sub(r.y, q.y)));
    const unsigned certain = bits(either(less(least, abs(bend)), less(least, on)));
    if ((~certain & lanes_left(polygon.count - i)) != 0) return false;
  }
  return true;
}

// Where each edge lies.
struct alignas(64) EdgeBoxes {
  double lower_x[FlatPolygon::kRoom], upper_x[FlatPolygon::kRoom];
  double lower_y[FlatPolygon::kRoom], upper_y[FlatPolygon::kRoom];

  explicit EdgeBoxes(const FlatPolygon& polygon) {
    const Pack wider = spread(4.0 * polygon.error);
    for (int i = 0; i < polygon.count; i += kWidth) {
      const FlatPack p = points_from(polygon, i), q = points_from(polygon, i + 1);
      store(lower_x + i, min(p.x, q.x));
      store(upper_x + i, add(max(p.x, q.x), wider));
      store(lower_y + i, min(p.y, q.y));
      store(upper_y + i, add(max(p.y, q.y), wider));
    }
  }
  // The edges from k on whose boxes overlap that of edge i.
  unsigned near(int i, int k) const {
    const Mask along_x =
        both(less_equal(load(lower_x + k), spread(upper_x[i])), less_equal(spread(lower_x[i]), load(upper_x + k)));
    const Mask along_y =
        both(less_equal(load(lower_y + k), spread(upper_y[i])), less_equal(spread(lower_y[i]), load(upper_y + k)));
    return bits(both(along_x, along_y));
  }
};

bool comes_nowhere_twice(FlatPolygon* polygon) {
  const int count = polygon->count;
  for (int k = 0; k < FlatPolygon::kRoom - FlatPolygon::kMost; ++k) {  // once more from the first vertex on
    polygon->x[count + k] = polygon->x[k];
    polygon->y[count + k] = polygon->y[k];
  }
  const Pack least = spread(least_turn(*polygon));
  if (!has_no_spike(*polygon, least)) return false;
  const EdgeBoxes boxes(*polygon);
  for (int i = 0; i < count; ++i) {
    const int end = i == 0 ? count - 1 : count;  // the last edge is the one before the first
    const int first = i + 2;
    for (int k = first / kWidth * kWidth; k < end; k += kWidth) {  // loads that cross no line take half the time
      const unsigned before = k < first ? lanes_left(first - k) : 0;
      const unsigned near = boxes.near(i, k) & lanes_left(end - k) & ~before;
      if (near == 0) continue;
      const Mask apart = lie_apart(point_at(*polygon, i), point_at(*polygon, i + 1), points_from(*polygon, k),
                                   points_from(*polygon, k + 1), least);
      if ((near & ~bits(apart)) != 0) return false;
    }
  }
  return true;
}

}  // namespace
}  // namespace tact::narrowphase
