#include "broadphase/kernels/kernels.inl"

namespace tact::broadphase {

extern const Kernels kBaselineKernels;
constinit const Kernels kBaselineKernels = all_kernels("scalar");

}  // namespace tact::broadphase
