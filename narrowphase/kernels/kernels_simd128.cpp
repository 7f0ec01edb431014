// The kernels compiled for registers of sixteen bytes: NEON, SIMD128 of WebAssembly.
#define TACT_KERNELS_SIMD128
#include "narrowphase/kernels/kernels.inl"

namespace tact::narrowphase {

extern const Kernels kSimd128Kernels;
constinit const Kernels kSimd128Kernels = all_kernels("simd128");

}  // namespace tact::narrowphase
