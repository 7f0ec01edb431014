// The kernels for any machine.
#include "narrowphase/kernels/kernels.inl"

namespace tact::narrowphase {

extern const Kernels kScalarKernels;
constinit const Kernels kScalarKernels = all_kernels("scalar");

}  // namespace tact::narrowphase
