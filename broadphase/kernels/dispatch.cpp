#include "broadphase/kernels/kernels.h"

namespace tact::broadphase {

#if defined(__x86_64__)
extern const OverlapKernel kAvx2OverlapKernel;
extern const OverlapKernel kAvx512OverlapKernel;

OverlapKernel avx2_overlap_kernel() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") ? kAvx2OverlapKernel : nullptr;
}
OverlapKernel avx512_overlap_kernel() {
  const bool has =
      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("bmi");
  return has ? kAvx512OverlapKernel : nullptr;
}
#else
OverlapKernel avx2_overlap_kernel() { return nullptr; }
OverlapKernel avx512_overlap_kernel() { return nullptr; }
#endif

OverlapKernel best_overlap_kernel() {
  if (const OverlapKernel kernel = avx512_overlap_kernel()) return kernel;
  if (const OverlapKernel kernel = avx2_overlap_kernel()) return kernel;
  return scalar_overlap_kernel();
}

}  // namespace tact::broadphase
