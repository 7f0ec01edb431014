// Finds what is wrong with a surface.
#pragma once

#include <tact/surface_check.h>

#include <array>
#include <span>

#include "engine/base/vec3.h"

namespace tact {

// Of the positions of used vertices (of others NaN) and the facets' corners. A facet is a sliver whose height over its
// longest side is below `sliver` times that side. Errors: out_of_memory, backend_failure.
SurfaceCheck check_surface(std::span<const base::Vec3> positions, std::span<const std::array<int, 3>> facets,
                           double sliver, int threads);

}  // namespace tact
