#include <immintrin.h>

#include "broadphase/kernels/kernels.h"

namespace tact::broadphase {
namespace {

template <int kStride>
std::uint32_t lanes_overlapping(const Block& block, const double* lower, const double* upper) {
  __mmask8 low_half = 0xff;
  __mmask8 high_half = 0xff;
  for (int axis = 0; axis < 3; ++axis) {
    const __m512d low = _mm512_set1_pd(lower[axis * kStride]);
    const __m512d high = _mm512_set1_pd(upper[axis * kStride]);
    low_half = _mm512_mask_cmp_pd_mask(low_half, _mm512_load_pd(block.lower[axis]), high, _CMP_LE_OQ);
    high_half = _mm512_mask_cmp_pd_mask(high_half, _mm512_load_pd(block.lower[axis] + 8), high, _CMP_LE_OQ);
    low_half = _mm512_mask_cmp_pd_mask(low_half, low, _mm512_load_pd(block.upper[axis]), _CMP_LE_OQ);
    high_half = _mm512_mask_cmp_pd_mask(high_half, low, _mm512_load_pd(block.upper[axis] + 8), _CMP_LE_OQ);
  }
  return static_cast<std::uint32_t>(low_half) | static_cast<std::uint32_t>(high_half) << 8;
}

#include "broadphase/kernels/overlap_columns.inl"

}  // namespace

extern const OverlapKernel kAvx512OverlapKernel;
const OverlapKernel kAvx512OverlapKernel = overlap_columns;

}  // namespace tact::broadphase
