// A mesh whose vertices move straight from one placement to another.
#pragma once

#include "narrowphase/mesh/features.h"
#include "narrowphase/motion/moving_polygon.h"
#include "narrowphase/pairs/kept_clusters.h"

namespace tact::narrowphase {

struct MovingMesh {
  const ClusteredMesh* mesh = nullptr;
  const Features* features = nullptr;
  Placement begin, end;

  Vec3 begin_of(int vertex) const { return at(begin, vertex); }
  MovingVertex vertex(int v) const { return {{at(begin, v), at(end, v)}}; }
  /// Valid as long as this is.
  MeshWay seen_from(Vec3 frame) const { return {&begin, &end, frame}; }

 private:
  static Vec3 at(const Placement& placement, int v) {
    return {placement.points.x[v], placement.points.y[v], placement.points.z[v]};
  }
};

}  // namespace tact::narrowphase
