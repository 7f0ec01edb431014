// The header of the Embree that the build found.
#pragma once

#if TACT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
