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

// Where the boxes of ab and cd have more than `gap` between them.
inline Mask boxes_lie_apart(const FlatPack& a, const FlatPack& b, const FlatPack& c, const FlatPack& d, Pack gap) {
  const auto below = [&](Pack a_along, Pack b_along, Pack c_along, Pack d_along) {
    return less(add(max(a_along, b_along), gap), min(c_along, d_along));
  };
  return either(either(below(a.x, b.x, c.x, d.x), below(c.x, d.x, a.x, b.x)),
                either(below(a.y, b.y, c.y, d.y), below(c.y, d.y, a.y, b.y)));
}

// The least `turn` that certainly is not zero, and so of a scalar product. Each factor of the two products is a
// difference of up to `size`, off by two errors and a rounding of half an error at most, so each product is off by 5
// errors times `size`; roundings of products and sums add 2 at most, and squares of errors next to nothing.
inline double least_turn(const FlatPolygon& polygon) { return 16.0 * polygon.error * polygon.size; }

// Edge i runs from vertex i to the next one. True if each edge has only a vertex in common with the next one.
bool has_no_spike(const FlatPolygon& polygon, Pack least) {
  for (int i = 0; i < polygon.count; i += kWidth) {
    const FlatPack p = points_from(polygon, i), q = points_from(polygon, i + 1), r = points_from(polygon, i + 2);
    const Pack bend = turn(p, q, r), on = add(mul(sub(q.x, p.x), sub(r.x, q.x)), mul(sub(q.y, p.y), sub(r.y, q.y)));
    const unsigned certain = bits(either(less(least, abs(bend)), less(least, on)));
    if ((~certain & lanes_left(polygon.count - i)) != 0) return false;
  }
  return true;
}

// Where each edge lies, in floats, which leave out most pairs of edges: counted from the first vertex, in a unit in
// which no coordinate exceeds 1 by more than rounding. Rounding and errors of coordinates add up to less than 2^-24;
// boxes are wider by 2^-22 on every side.
struct alignas(64) EdgeBoxes {
  float lower_x[FlatPolygon::kRoom], upper_x[FlatPolygon::kRoom];
  float lower_y[FlatPolygon::kRoom], upper_y[FlatPolygon::kRoom];

  explicit EdgeBoxes(const FlatPolygon& polygon) {
    const Pack scale = spread(1.0 / polygon.size), wider = spread(0x1p-22);
    const Pack origin_x = spread(polygon.x[0]), origin_y = spread(polygon.y[0]);
    for (int i = 0; i < polygon.count; i += kWidth) {
      const FlatPack p = points_from(polygon, i), q = points_from(polygon, i + 1);
      const Pack px = mul(sub(p.x, origin_x), scale), qx = mul(sub(q.x, origin_x), scale);
      const Pack py = mul(sub(p.y, origin_y), scale), qy = mul(sub(q.y, origin_y), scale);
      store(lower_x + i, sub(min(px, qx), wider));
      store(upper_x + i, add(max(px, qx), wider));
      store(lower_y + i, sub(min(py, qy), wider));
      store(upper_y + i, add(max(py, qy), wider));
    }
  }
  // The edges from k on whose boxes overlap that of edge i.
  unsigned near(int i, int k) const {
    const FloatMask along_x =
        both(less_equal(load(lower_x + k), spread(upper_x[i])), less_equal(spread(lower_x[i]), load(upper_x + k)));
    const FloatMask along_y =
        both(less_equal(load(lower_y + k), spread(upper_y[i])), less_equal(spread(lower_y[i]), load(upper_y + k)));
    return bits(both(along_x, along_y));
  }
};

// True if edge i certainly lies apart from those edges from k on that have a bit.
inline bool lies_apart(const FlatPolygon& polygon, int i, int k, unsigned edges, Pack least) {
  const FlatPack a = point_at(polygon, i), b = point_at(polygon, i + 1);
  const Pack gap = spread(4.0 * polygon.error);
  for (; edges != 0; edges >>= kWidth, k += kWidth) {
    if ((edges & kAllLanes) == 0) continue;
    const FlatPack c = points_from(polygon, k), d = points_from(polygon, k + 1);
    const unsigned apart = bits(either(boxes_lie_apart(a, b, c, d, gap), lie_apart(a, b, c, d, least)));
    if ((edges & kAllLanes & ~apart) != 0) return false;
  }
  return true;
}

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
    for (int k = first / kFloatWidth * kFloatWidth; k < end; k += kFloatWidth) {  // packs that cross no line
      const unsigned before = k < first ? lanes_left<kFloatWidth>(first - k) : 0;
      const unsigned near = boxes.near(i, k) & lanes_left<kFloatWidth>(end - k) & ~before;
      if (near != 0 && !lies_apart(*polygon, i, k, near, least)) return false;
    }
  }
  return true;
}

}  // namespace
}  // namespace tact::narrowphase
