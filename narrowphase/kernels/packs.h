// The packs for which a file is compiled: it defines TACT_KERNELS_AVX2, TACT_KERNELS_AVX512 or TACT_KERNELS_SIMD128
// before it includes any of these headers, or none of them. All that they define is local to the file: nothing may leak
// from files that are compiled for a newer machine.
#pragma once

#if defined(TACT_KERNELS_AVX512)
#include "narrowphase/kernels/packs_avx512.h"
#elif defined(TACT_KERNELS_AVX2)
#include "narrowphase/kernels/packs_avx2.h"
#elif defined(TACT_KERNELS_SIMD128)
#include "narrowphase/kernels/packs_simd128.h"
#else
#include "narrowphase/kernels/packs_scalar.h"
#endif
