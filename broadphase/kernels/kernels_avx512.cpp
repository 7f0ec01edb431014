#include "broadphase/kernels/kernels.inl"

namespace tact::broadphase {

extern const Kernels kAvx512Kernels;
constinit const Kernels kAvx512Kernels = all_kernels("avx512");

}  // namespace tact::broadphase
