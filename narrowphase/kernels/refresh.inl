// Asks for `count` of the vertices that come later, in the second level of the cache: the first has room for few under
// way, and what is written needs it. Both lines that a vertex may lie in: masked loads touch the next double.
inline void ask_ahead(const RefreshInput& in, int i, int count) {
  if (in.ahead == 0) return;
  for (int k = 0; k < count; ++k) {
    const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i + in.ahead + k]);
    __builtin_prefetch(p, 0, 2);
    __builtin_prefetch(p + 3, 0, 2);
  }
  asm volatile("");  // or GCC 12 may leave it all out
}

#if defined(TACT_KERNELS_AVX2_REFRESH)

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
};

inline bool differs(const double* before, __m256d after) {
  return _mm256_movemask_pd(_mm256_cmp_pd(_mm256_loadu_pd(before), after, _CMP_NEQ_UQ)) != 0;
}

// Lanes in which a or b is not a number.
inline __m256d not_numbers(__m256d a, __m256d b) { return _mm256_cmp_pd(a, b, _CMP_UNORD_Q); }

RefreshedCluster refresh_cluster(const RefreshInput& in) {
  Bounds even, odd;  // two, so that one need not wait for the other
  __m256d bad = _mm256_setzero_pd();
  bool changed = in.changed;
  int i = 0;
  for (; i + 4 <= in.owned_count; i += 4) {
    ask_ahead(in, i, 4);
    const __m256d a = load_vertex(in.source, in.owned[i]), b = load_vertex(in.source, in.owned[i + 1]);
    const __m256d c = load_vertex(in.source, in.owned[i + 2]), d = load_vertex(in.source, in.owned[i + 3]);
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
    _mm256_storeu_pd(in.x + i, x);
    _mm256_storeu_pd(in.y + i, y);
    _mm256_storeu_pd(in.z + i, z);
  }
  for (; i < in.owned_count; ++i) {
    ask_ahead(in, i, 1);
    const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i]);
    changed = changed || in.before.x[i] != p[0] || in.before.y[i] != p[1] || in.before.z[i] != p[2];
    in.x[i] = p[0];
    in.y[i] = p[1];
    in.z[i] = p[2];
    const __m256d v = load_vertex(in.source, in.owned[i]);
    even.widen(v);
    bad = _mm256_or_pd(bad, not_numbers(v, v));
  }
  int k = 0;
  for (; k + 2 <= in.borrowed_count; k += 2) {
    even.widen(load_vertex(in.source, in.borrowed[k]));
    odd.widen(load_vertex(in.source, in.borrowed[k + 1]));
  }
  if (k < in.borrowed_count) even.widen(load_vertex(in.source, in.borrowed[k]));
  const __m256d lower = _mm256_min_pd(even.lower, odd.lower), upper = _mm256_max_pd(even.upper, odd.upper);
  // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
  double low[4], high[4];
  _mm256_storeu_pd(low, _mm256_add_pd(lower, _mm256_setzero_pd()));
  _mm256_storeu_pd(high, _mm256_add_pd(upper, _mm256_setzero_pd()));
  return {{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}, changed, _mm256_movemask_pd(bad) != 0};
}

#else

inline void widen(BoxBounds* box, const double* p) {
  for (int axis = 0; axis < 3; ++axis) {
    box->lower[axis] = min(box->lower[axis], p[axis]);
    box->upper[axis] = max(box->upper[axis], p[axis]);
  }
}

RefreshedCluster refresh_cluster(const RefreshInput& in) {
  RefreshedCluster seen{.box = {}, .changed = in.changed, .not_a_number = false};
  for (int axis = 0; axis < 3; ++axis) {
    seen.box.lower[axis] = __builtin_inf();
    seen.box.upper[axis] = -__builtin_inf();
  }
  for (int i = 0; i < in.owned_count; ++i) {
    ask_ahead(in, i, 1);
    const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i]);
    seen.changed = seen.changed || in.before.x[i] != p[0] || in.before.y[i] != p[1] || in.before.z[i] != p[2];
    seen.not_a_number = seen.not_a_number || p[0] != p[0] || p[1] != p[1] || p[2] != p[2];
    in.x[i] = p[0];
    in.y[i] = p[1];
    in.z[i] = p[2];
    widen(&seen.box, p);
  }
  for (int k = 0; k < in.borrowed_count; ++k) {
    widen(&seen.box, in.source + 3 * static_cast<std::int64_t>(in.borrowed[k]));
  }
  // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
  for (int axis = 0; axis < 3; ++axis) {
    seen.box.lower[axis] += 0.0;
    seen.box.upper[axis] += 0.0;
  }
  return seen;
}

#endif
