#include "broadphase/kernels/kernels.h"
#include "broadphase/kernels/vectors.h"

namespace tact::broadphase {
namespace {

#include "broadphase/kernels/kernels.inl"

}  // namespace

extern const Kernels kAvx512Kernels;
const Kernels kAvx512Kernels{"avx512", find_rows, find_overlaps, refresh_lanes};

}  // namespace tact::broadphase
