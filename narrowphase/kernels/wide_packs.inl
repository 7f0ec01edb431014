// Double-doubles in lanes.
#pragma once

#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

// A double-double: high + low, where high is the sum rounded. The arithmetic is that of Dekker, "A floating-point
// technique for extending the available precision", 1971, but for sums, which leave out a step that matters only to the
// relative error of what cancels (Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic building
// blocks of double-word arithmetic", 2017).
struct WidePack {
  Pack high, low;
};

// a + b where |a| >= |b|, or nearly so.
inline WidePack quick_sum(Pack a, Pack b) {
  const Pack sum = add(a, b);
  return {sum, sub(b, sub(sum, a))};
}

inline WidePack difference(Pack a, Pack b) {
  const Pack d = sub(a, b), part_b = sub(a, d), part_a = add(d, part_b);
  return {d, add(sub(part_b, b), sub(a, part_a))};
}

inline WidePack add(const WidePack& a, const WidePack& b) {
  const Pack sum = add(a.high, b.high), part_b = sub(sum, a.high), part_a = sub(sum, part_b);
  const Pack error = add(sub(a.high, part_a), sub(b.high, part_b));
  return quick_sum(sum, add(error, add(a.low, b.low)));
}

inline WidePack mul(const WidePack& a, const WidePack& b) {
  const Pack product = mul(a.high, b.high), error = fused(a.high, b.high, product);
  return quick_sum(product, add(error, add(mul(a.high, b.low), mul(a.low, b.high))));
}

inline WidePack sub(const WidePack& a, const WidePack& b) {
  const Pack zero = spread(0.0);
  return add(a, {sub(zero, b.high), sub(zero, b.low)});
}

inline WidePack div(const WidePack& a, const WidePack& b) {
  const Pack zero = spread(0.0), first = div(a.high, b.high);
  return quick_sum(first, div(sub(a, mul(WidePack{first, zero}, b)).high, b.high));
}

struct WideVector {
  WidePack x, y, z;
};

inline WideVector difference(const VectorPack& a, const VectorPack& b) {
  return {difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)};
}

inline WidePack dot(const WideVector& p, const WideVector& q) {
  return add(add(mul(p.x, q.x), mul(p.y, q.y)), mul(p.z, q.z));
}

inline WideVector cross(const WideVector& p, const WideVector& q) {
  return {sub(mul(p.y, q.z), mul(p.z, q.y)), sub(mul(p.z, q.x), mul(p.x, q.z)), sub(mul(p.x, q.y), mul(p.y, q.x))};
}

inline Pack largest_of(const WideVector& v) { return max(max(abs(v.x.high), abs(v.y.high)), abs(v.z.high)); }

}  // namespace
}  // namespace tact::narrowphase
