#include <immintrin.h>

#include "broadphase/kernels/kernels.h"

namespace tact::broadphase {
namespace {

template <int kStride>
std::uint32_t lanes_overlapping(const Block& block, const double* lower, const double* upper) {
  __m256d low[3];
  __m256d high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = _mm256_broadcast_sd(lower + axis * kStride);
    high[axis] = _mm256_broadcast_sd(upper + axis * kStride);
  }
  std::uint32_t lanes = 0;
  for (std::uint32_t first = 0; first < kLanes; first += 4) {
    __m256d overlaps = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
    for (int axis = 0; axis < 3; ++axis) {
      const __m256d below = _mm256_cmp_pd(_mm256_load_pd(block.lower[axis] + first), high[axis], _CMP_LE_OQ);
      const __m256d above = _mm256_cmp_pd(low[axis], _mm256_load_pd(block.upper[axis] + first), _CMP_LE_OQ);
      overlaps = _mm256_and_pd(overlaps, _mm256_and_pd(below, above));
    }
    lanes |= static_cast<std::uint32_t>(_mm256_movemask_pd(overlaps)) << first;
  }
  return lanes;
}

#include "broadphase/kernels/overlap_columns.inl"

}  // namespace

extern const OverlapKernel kAvx2OverlapKernel;
const OverlapKernel kAvx2OverlapKernel = overlap_columns;

}  // namespace tact::broadphase
