// The packs for which a file is compiled: it defines TACT_KERNELS_AVX2 or TACT_KERNELS_AVX512 before it includes any of
// these headers, or neither. All that they define is local to the file: nothing may leak from files that are compiled
// for a newer machine.
#pragma once

#if defined(TACT_KERNELS_AVX512)
#include "narrowphase/kernels/packs_avx512.h"
#elif defined(TACT_KERNELS_AVX2)
#include "narrowphase/kernels/packs_avx2.h"
#else
#include "narrowphase/kernels/packs_scalar.h"
#endif
