#include "engine/base/instruction_set.h"
#include "narrowphase/kernels/kernels.h"

namespace tact::narrowphase {

extern const Kernels kScalarKernels;
#if defined(__x86_64__)
extern const Kernels kAvx2Kernels;
extern const Kernels kAvx512Kernels;
#endif

const Kernels* scalar_kernels() { return &kScalarKernels; }

#if defined(TACT_HAS_SIMD128)
extern const Kernels kSimd128Kernels;
const Kernels* simd128_kernels() { return &kSimd128Kernels; }
#else
const Kernels* simd128_kernels() { return nullptr; }
#endif

#if defined(__x86_64__)
namespace {
// Checks for every extension that a file is compiled for: a virtual machine may hide any of them.
bool has_bit_operations() {
  return __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt");
}
}  // namespace

const Kernels* avx2_kernels() {
  const bool has = has_bit_operations() && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has ? &kAvx2Kernels : nullptr;
}
const Kernels* avx512_kernels() {
  const bool has = has_bit_operations() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vbmi2");
  return has ? &kAvx512Kernels : nullptr;
}
#else
const Kernels* avx2_kernels() { return nullptr; }
const Kernels* avx512_kernels() { return nullptr; }
#endif

const Kernels& kernels() {
  // The same for the whole process.
  static const Kernels& chosen =
      base::wanted_kernels({scalar_kernels(), simd128_kernels(), avx2_kernels(), avx512_kernels()});
  return chosen;
}

}  // namespace tact::narrowphase
