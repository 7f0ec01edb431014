#include "broadphase/kernels/kernels.h"
#include "broadphase/kernels/vectors.h"

namespace tact::broadphase {
namespace {

#include "broadphase/kernels/kernels.inl"

}  // namespace

extern const Kernels kBaselineKernels;
const Kernels kBaselineKernels{"scalar", find_rows, find_overlaps, refresh_lanes};

}  // namespace tact::broadphase
