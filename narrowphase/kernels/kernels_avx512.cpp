// The kernels compiled for AVX-512 F, DQ, VL, BW, VBMI, VBMI2, and BMI2.
#define TACT_KERNELS_AVX512
#include "narrowphase/kernels/kernels.inl"

namespace tact::narrowphase {

extern const Kernels kAvx512Kernels;
constinit const Kernels kAvx512Kernels = all_kernels("avx512");

}  // namespace tact::narrowphase
