#include "narrowphase/distance/surface_distance.h"

namespace tact::narrowphase {

bool too_near_along(const ScaledMesh& mesh, double reach, const PointOnSurface& from, const PointOnSurface& to,
                    SurfaceWays& ways) {
  return too_near_along([&](int v) { return mesh.position(v); }, mesh.features, reach, from, to, ways);
}

}  // namespace tact::narrowphase
