#include "broadphase/kernels/kernels.inl"

namespace tact::broadphase {

extern const Kernels kAvx2Kernels;
constinit const Kernels kAvx2Kernels = all_kernels("avx2");

}  // namespace tact::broadphase
