// New positions of a mesh, copied cluster by cluster with the box of each.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/packs.h"

namespace tact::narrowphase {
namespace {

// Prefetches the positions of `count` owned vertices from the i-th on, to the second level of the cache: the first has
// room for few lines under way, and what is written needs it. Both lines in which a vertex may lie: masked loads touch
// the next double.
inline void prefetch_positions(const RefitInput& in, int i, int count) {
  for (int k = 0; k < count; ++k) {
    const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i + k]);
    __builtin_prefetch(p, 0, 2);
    __builtin_prefetch(p + 3, 0, 2);
  }
  asm volatile("");  // or GCC 12 may leave it all out
}

// How far owned vertex i goes to p, squared.
inline double step_squared(const RefitInput& in, int i, const double* p) {
  const double dx = p[0] - in.before.x[i], dy = p[1] - in.before.y[i], dz = p[2] - in.before.z[i];
  return (dx * dx + dy * dy) + dz * dz;
}

#if defined(TACT_KERNELS_AVX2) || defined(TACT_KERNELS_AVX512)

// A vertex in the low three lanes, zero in the fourth.
inline __m256d load_vertex(const double* source, std::int32_t s) {
  const __m256i three = _mm256_set_epi64x(0, -1, -1, -1);
  return _mm256_maskload_pd(source + 3 * static_cast<std::int64_t>(s), three);
}

struct Bounds {
  __m256d lower = _mm256_set1_pd(__builtin_inf()), upper = _mm256_set1_pd(-__builtin_inf());
  void widen(__m256d v) {
    lower = _mm256_min_pd(lower, v);
    upper = _mm256_max_pd(upper, v);
  }
  void widen(const Bounds& other) {
    lower = _mm256_min_pd(lower, other.lower);
    upper = _mm256_max_pd(upper, other.upper);
  }
};

inline void store_three(__m256d v, double* x, std::int64_t stride) {
  const __m128d xy = _mm256_castpd256_pd128(v);
  _mm_storel_pd(x, xy);
  _mm_storeh_pd(x + stride, xy);
  _mm_storel_pd(x + 2 * stride, _mm256_extractf128_pd(v, 1));
}

inline bool differs(const double* before, __m256d after) {
  return _mm256_movemask_pd(_mm256_cmp_pd(_mm256_loadu_pd(before), after, _CMP_NEQ_UQ)) != 0;
}

// Lanes in which a or b is not a number.
inline __m256d not_numbers(__m256d a, __m256d b) { return _mm256_cmp_pd(a, b, _CMP_UNORD_Q); }

struct RefitLoop {
  explicit RefitLoop(const RefitInput& input) : in(input) {}

  const RefitInput& in;
  Bounds even, odd;  // two, so that one need not wait for the other
  __m256d bad = _mm256_setzero_pd();
  __m256d step = _mm256_setzero_pd();  // squared
  bool changed = false;

  __m256d load(const std::int32_t* s) const { return load_vertex(in.source, *s); }

  void copy_four(int i) {
    const std::int32_t* s = in.owned + i;
    const __m256d a = load(s), b = load(s + 1), c = load(s + 2), d = load(s + 3);
    even.widen(a);
    odd.widen(b);
    even.widen(c);
    odd.widen(d);
    bad = _mm256_or_pd(bad, _mm256_or_pd(not_numbers(a, b), not_numbers(c, d)));
    const __m256d xz02 = _mm256_unpacklo_pd(a, b), y02 = _mm256_unpackhi_pd(a, b);
    const __m256d xz13 = _mm256_unpacklo_pd(c, d), y13 = _mm256_unpackhi_pd(c, d);
    const __m256d x = _mm256_permute2f128_pd(xz02, xz13, 0x20), y = _mm256_permute2f128_pd(y02, y13, 0x20);
    const __m256d z = _mm256_permute2f128_pd(xz02, xz13, 0x31);
    changed = changed || differs(in.before.x + i, x) || differs(in.before.y + i, y) || differs(in.before.z + i, z);
    if (in.steps_squared != nullptr) {
      const __m256d dx = _mm256_sub_pd(x, _mm256_loadu_pd(in.before.x + i));
      const __m256d dy = _mm256_sub_pd(y, _mm256_loadu_pd(in.before.y + i));
      const __m256d dz = _mm256_sub_pd(z, _mm256_loadu_pd(in.before.z + i));
      const __m256d flat = _mm256_add_pd(_mm256_mul_pd(dx, dx), _mm256_mul_pd(dy, dy));
      step = _mm256_max_pd(step, _mm256_add_pd(flat, _mm256_mul_pd(dz, dz)));
    }
    _mm256_storeu_pd(in.x + i, x);
    _mm256_storeu_pd(in.y + i, y);
    _mm256_storeu_pd(in.z + i, z);
  }

  void copy_one(int i) {
    const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i]);
    changed = changed || in.before.x[i] != p[0] || in.before.y[i] != p[1] || in.before.z[i] != p[2];
    step = _mm256_max_pd(step, _mm256_set1_pd(step_squared(in, i, p)));
    in.x[i] = p[0];
    in.y[i] = p[1];
    in.z[i] = p[2];
    const __m256d v = load(in.owned + i);
    even.widen(v);
    bad = _mm256_or_pd(bad, not_numbers(v, v));
  }

  // The last four may have been copied in part already.
  void copy(int begin, int end, int prefetch_until) {
    int i = begin;
    for (; i + 4 <= end; i += 4) {
      if (i + 4 <= prefetch_until) prefetch_positions(in, i + in.ahead, 4);
      copy_four(i);
    }
    if (i == end) return;
    if (i < prefetch_until) prefetch_positions(in, i + in.ahead, (end < prefetch_until ? end : prefetch_until) - i);
    if (end - begin >= 4) return copy_four(end - 4);
    for (; i < end; ++i) copy_one(i);
  }

  double take_step() {
    const __m128d two = _mm_max_pd(_mm256_castpd256_pd128(step), _mm256_extractf128_pd(step, 1));
    step = _mm256_setzero_pd();
    return _mm_cvtsd_f64(_mm_max_sd(two, _mm_unpackhi_pd(two, two)));
  }

  void borrow(int begin, int end) {
    int k = begin;
    for (; k + 2 <= end; k += 2) {
      even.widen(load(in.borrowed + k));
      odd.widen(load(in.borrowed + k + 1));
    }
    if (k < end) even.widen(load(in.borrowed + k));
  }
};

Refitted refit_clusters(const RefitInput& in) {
  const __m256d zero = _mm256_setzero_pd();
  RefitLoop loop(in);
  Bounds all;
  const int prefetch_until = in.ahead == 0 ? 0 : in.ranges[2 * in.cluster_end] - in.ahead;
  for (int c = in.cluster_begin; c < in.cluster_end; ++c) {
    const std::int32_t* range = in.ranges + 2 * c;
    loop.even = loop.odd = Bounds{};
    loop.copy(range[0], range[2], prefetch_until);
    loop.borrow(range[1], range[3]);
    Bounds box = loop.even;
    box.widen(loop.odd);
    // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
    box = {_mm256_add_pd(box.lower, zero), _mm256_add_pd(box.upper, zero)};
    if (in.steps_squared != nullptr) in.steps_squared[c] = loop.take_step();
    store_three(box.lower, in.boxes + c, in.box_stride);
    store_three(box.upper, in.boxes + c + 3 * static_cast<std::int64_t>(in.box_stride), in.box_stride);
    all.widen(box);
  }
  Refitted seen{.box = {}, .changed = loop.changed, .not_a_number = _mm256_movemask_pd(loop.bad) != 0};
  store_three(all.lower, seen.box.lower, 1);
  store_three(all.upper, seen.box.upper, 1);
  return seen;
}

#elif defined(TACT_KERNELS_SIMD128)

// Of vertices two by two: x and y of one in a pack, z of both in another.
struct Bounds {
  Pack lower_xy = spread(__builtin_inf()), upper_xy = spread(-__builtin_inf());
  Pack lower_z = spread(__builtin_inf()), upper_z = spread(-__builtin_inf());

  void widen(Pack xy, Pack z) {
    lower_xy = min(lower_xy, xy);
    upper_xy = max(upper_xy, xy);
    lower_z = min(lower_z, z);
    upper_z = max(upper_z, z);
  }
  void widen(const Bounds& other) {
    lower_xy = min(lower_xy, other.lower_xy);
    upper_xy = max(upper_xy, other.upper_xy);
    lower_z = min(lower_z, other.lower_z);
    upper_z = max(upper_z, other.upper_z);
  }
  // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
  void write(double* lower, double* upper, std::int64_t stride) const {
    const double low_z = lower_z[0] < lower_z[1] ? lower_z[0] : lower_z[1];
    const double high_z = upper_z[0] > upper_z[1] ? upper_z[0] : upper_z[1];
    const double low[3] = {lower_xy[0], lower_xy[1], low_z}, high[3] = {upper_xy[0], upper_xy[1], high_z};
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis * stride] = low[axis] + 0.0;
      upper[axis * stride] = high[axis] + 0.0;
    }
  }
};

struct RefitLoop {
  const RefitInput& in;
  Bounds box = {};
  Mask bad = {}, changed = {};
  Pack step = spread(0.0);  // squared

  const double* at(std::int32_t source) const { return in.source + 3 * static_cast<std::int64_t>(source); }

  void copy_two(int i) {
    const double *const p = at(in.owned[i]), *const q = at(in.owned[i + 1]);
    const Pack first = load(p), second = load(q), z{p[2], q[2]};
    const Pack x = __builtin_shufflevector(first, second, 0, 2), y = __builtin_shufflevector(first, second, 1, 3);
    box.widen(first, z);
    box.widen(second, z);
    bad |= (x != x) | (y != y) | (z != z);
    const Pack before_x = load(in.before.x + i), before_y = load(in.before.y + i), before_z = load(in.before.z + i);
    changed |= (x != before_x) | (y != before_y) | (z != before_z);
    if (in.steps_squared != nullptr) {
      const Pack dx = x - before_x, dy = y - before_y, dz = z - before_z;
      step = max(step, (dx * dx + dy * dy) + dz * dz);
    }
    store(in.x + i, x);
    store(in.y + i, y);
    store(in.z + i, z);
  }

  void copy_one(int i) {
    const double* const p = at(in.owned[i]);
    const Pack xy = load(p), z = spread(p[2]);
    box.widen(xy, z);
    bad |= (xy != xy) | (z != z);
    changed |= (xy != Pack{in.before.x[i], in.before.y[i]}) | (z != spread(in.before.z[i]));
    step = max(step, spread(step_squared(in, i, p)));
    in.x[i] = p[0];
    in.y[i] = p[1];
    in.z[i] = p[2];
  }

  void copy(int begin, int end, int prefetch_until) {
    int i = begin;
    for (; i + 2 <= end; i += 2) {
      if (i + 2 <= prefetch_until) prefetch_positions(in, i + in.ahead, 2);
      copy_two(i);
    }
    if (i == end) return;
    if (i < prefetch_until) prefetch_positions(in, i + in.ahead, 1);
    copy_one(i);
  }

  void borrow(int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const double* const p = at(in.borrowed[k]);
      box.widen(load(p), spread(p[2]));
    }
  }
};

Refitted refit_clusters(const RefitInput& in) {
  RefitLoop loop{in};
  Bounds all;
  const int prefetch_until = in.ahead == 0 ? 0 : in.ranges[2 * in.cluster_end] - in.ahead;
  for (int c = in.cluster_begin; c < in.cluster_end; ++c) {
    const std::int32_t* range = in.ranges + 2 * c;
    loop.box = Bounds{};
    loop.copy(range[0], range[2], prefetch_until);
    loop.borrow(range[1], range[3]);
    if (in.steps_squared != nullptr) in.steps_squared[c] = largest_lane(loop.step);
    loop.step = spread(0.0);
    loop.box.write(in.boxes + c, in.boxes + c + 3 * static_cast<std::int64_t>(in.box_stride), in.box_stride);
    all.widen(loop.box);
  }
  Refitted seen{.box = {}, .changed = bits(loop.changed) != 0, .not_a_number = bits(loop.bad) != 0};
  all.write(seen.box.lower, seen.box.upper, 1);
  return seen;
}

#else

struct Bounds {
  double lower[3] = {__builtin_inf(), __builtin_inf(), __builtin_inf()};
  double upper[3] = {-__builtin_inf(), -__builtin_inf(), -__builtin_inf()};
  void widen(const double* low, const double* high) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = min(lower[axis], low[axis]);
      upper[axis] = max(upper[axis], high[axis]);
    }
  }
};

Refitted refit_clusters(const RefitInput& in) {
  Refitted seen{.box = {}, .changed = false, .not_a_number = false};
  Bounds all;
  const int prefetch_until = in.ahead == 0 ? 0 : in.ranges[2 * in.cluster_end] - in.ahead;
  for (int c = in.cluster_begin; c < in.cluster_end; ++c) {
    const std::int32_t* range = in.ranges + 2 * c;
    Bounds box;
    double step = 0.0;
    for (int i = range[0]; i < range[2]; ++i) {
      if (i < prefetch_until) prefetch_positions(in, i + in.ahead, 1);
      const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i]);
      seen.changed = seen.changed || in.before.x[i] != p[0] || in.before.y[i] != p[1] || in.before.z[i] != p[2];
      seen.not_a_number = seen.not_a_number || p[0] != p[0] || p[1] != p[1] || p[2] != p[2];
      step = max(step, step_squared(in, i, p));
      in.x[i] = p[0];
      in.y[i] = p[1];
      in.z[i] = p[2];
      box.widen(p, p);
    }
    for (int k = range[1]; k < range[3]; ++k) {
      const double* p = in.source + 3 * static_cast<std::int64_t>(in.borrowed[k]);
      box.widen(p, p);
    }
    if (in.steps_squared != nullptr) in.steps_squared[c] = step;
    // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t stride = in.box_stride;
      in.boxes[axis * stride + c] = box.lower[axis] += 0.0;
      in.boxes[(axis + 3) * stride + c] = box.upper[axis] += 0.0;
    }
    all.widen(box.lower, box.upper);
  }
  for (int axis = 0; axis < 3; ++axis) {
    seen.box.lower[axis] = all.lower[axis];
    seen.box.upper[axis] = all.upper[axis];
  }
  return seen;
}

#endif

}  // namespace
}  // namespace tact::narrowphase
