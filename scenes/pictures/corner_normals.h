// Normals for smooth shading.
#pragma once

#include <Eigen/Core>

namespace tact::scenes {

// The normals of the corners of each facet, 3 x 3F: column 3f + k belongs to corner k of facet f. A corner's normal is
// the mean, weighted by the angle of each facet at the vertex, of those facets around the vertex whose normals are
// within `crease` degrees of f's: round surfaces look round and sharp edges stay sharp. Facets of opposite turn do not
// count as close. A facet without area has the normal zero.
Eigen::Matrix3Xf corner_normals(const Eigen::Matrix3Xf& positions, const Eigen::Matrix3Xi& facets, double crease,
                                int threads);

}  // namespace tact::scenes
