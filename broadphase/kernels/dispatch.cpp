#include "broadphase/kernels/kernels.h"
#include "engine/base/instruction_set.h"

namespace tact::broadphase {

extern const Kernels kBaselineKernels;
const Kernels* baseline_kernels() { return &kBaselineKernels; }

#if defined(__x86_64__)
extern const Kernels kAvx2Kernels;
extern const Kernels kAvx512Kernels;

const Kernels* avx2_kernels() {
  const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi");
  return has ? &kAvx2Kernels : nullptr;
}
const Kernels* avx512_kernels() {
  const bool has = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("bmi") &&
                   __builtin_cpu_supports("popcnt");
  return has ? &kAvx512Kernels : nullptr;
}
#else
const Kernels* avx2_kernels() { return nullptr; }
const Kernels* avx512_kernels() { return nullptr; }
#endif

const Kernels& kernels() {
  static const Kernels& chosen = base::wanted_kernels({baseline_kernels(), avx2_kernels(), avx512_kernels()});
  return chosen;
}

}  // namespace tact::broadphase
