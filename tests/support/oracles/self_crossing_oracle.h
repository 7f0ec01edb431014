// Contact points of a mesh that crosses itself by plain loops in long doubles: what meets by CGAL, layers by colours,
// ways out over all facets, wrong sides by normals that are weighted by angles (Baerentzen and Aanaes, 2005). It shares
// no code with the engine.
#pragma once

#include <tact/report.h>

#include <map>
#include <span>

#include "tests/support/oracles/point_oracle.h"

namespace tact::tests {

/// All points of the mesh with itself, those with negative gaps among them. `last` are those of the last step.
std::map<PointKey, ExpectedPoint> self_points_with_gaps(const Mesh& mesh, Surface surface, double reach, double band,
                                                        std::span<const ContactPoint> last);

}  // namespace tact::tests
