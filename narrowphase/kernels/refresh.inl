#if defined(TACT_KERNELS_AVX2_REFRESH)

// A vertex in the low three lanes, zero in the fourth.
inline __m256d load_vertex(const double* source, std::int32_t s) {
  const __m256i three = _mm256_set_epi64x(0, -1, -1, -1);
  return _mm256_maskload_pd(source + 3 * static_cast<std::int64_t>(s), three);
}

// Stores `value`; the lanes that were different.
inline __m256d replace(double* p, __m256d value) {
  const __m256d differs = _mm256_cmp_pd(_mm256_loadu_pd(p), value, _CMP_NEQ_UQ);
  _mm256_storeu_pd(p, value);
  return differs;
}

struct Bounds {
  __m256d lower = _mm256_set1_pd(__builtin_inf()), upper = _mm256_set1_pd(-__builtin_inf());
  void widen(__m256d v) {
    lower = _mm256_min_pd(lower, v);
    upper = _mm256_max_pd(upper, v);
  }
};

bool refresh_cluster(const RefreshInput& in, BoxBounds* box) {
  Bounds even, odd;  // two, so that one need not wait for the other
  __m256d differs = _mm256_setzero_pd();
  int i = 0;
  for (; i + 4 <= in.owned_count; i += 4) {
    const __m256d a = load_vertex(in.source, in.owned[i]), b = load_vertex(in.source, in.owned[i + 1]);
    const __m256d c = load_vertex(in.source, in.owned[i + 2]), d = load_vertex(in.source, in.owned[i + 3]);
    even.widen(a);
    odd.widen(b);
    even.widen(c);
    odd.widen(d);
    const __m256d xz02 = _mm256_unpacklo_pd(a, b), y02 = _mm256_unpackhi_pd(a, b);
    const __m256d xz13 = _mm256_unpacklo_pd(c, d), y13 = _mm256_unpackhi_pd(c, d);
    const __m256d x = replace(in.x + i, _mm256_permute2f128_pd(xz02, xz13, 0x20));
    const __m256d y = replace(in.y + i, _mm256_permute2f128_pd(y02, y13, 0x20));
    const __m256d z = replace(in.z + i, _mm256_permute2f128_pd(xz02, xz13, 0x31));
    differs = _mm256_or_pd(_mm256_or_pd(differs, x), _mm256_or_pd(y, z));
  }
  bool changed = _mm256_movemask_pd(differs) != 0;
  for (; i < in.owned_count; ++i) {
    const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i]);
    changed = changed || in.x[i] != p[0] || in.y[i] != p[1] || in.z[i] != p[2];
    in.x[i] = p[0];
    in.y[i] = p[1];
    in.z[i] = p[2];
    even.widen(load_vertex(in.source, in.owned[i]));
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
  for (int axis = 0; axis < 3; ++axis) {
    box->lower[axis] = low[axis];
    box->upper[axis] = high[axis];
  }
  return changed;
}

#else

inline void widen(BoxBounds* box, const double* p) {
  for (int axis = 0; axis < 3; ++axis) {
    box->lower[axis] = min(box->lower[axis], p[axis]);
    box->upper[axis] = max(box->upper[axis], p[axis]);
  }
}

bool refresh_cluster(const RefreshInput& in, BoxBounds* box) {
  for (int axis = 0; axis < 3; ++axis) {
    box->lower[axis] = __builtin_inf();
    box->upper[axis] = -__builtin_inf();
  }
  bool changed = false;
  for (int i = 0; i < in.owned_count; ++i) {
    const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i]);
    changed = changed || in.x[i] != p[0] || in.y[i] != p[1] || in.z[i] != p[2];
    in.x[i] = p[0];
    in.y[i] = p[1];
    in.z[i] = p[2];
    widen(box, p);
  }
  for (int k = 0; k < in.borrowed_count; ++k) {
    widen(box, in.source + 3 * static_cast<std::int64_t>(in.borrowed[k]));
  }
  // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
  for (int axis = 0; axis < 3; ++axis) {
    box->lower[axis] += 0.0;
    box->upper[axis] += 0.0;
  }
  return changed;
}

#endif
