// The kernels compiled for AVX2, FMA, BMI and BMI2.
#define TACT_KERNELS_AVX2
#include "narrowphase/kernels/kernels.inl"

namespace tact::narrowphase {

extern const Kernels kAvx2Kernels;
constinit const Kernels kAvx2Kernels = all_kernels("avx2");

}  // namespace tact::narrowphase
