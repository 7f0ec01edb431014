#include "narrowphase/motion/moving_polygon.h"

namespace tact::narrowphase {

MovingPolygon facet_seen_from(const MovingVertex& vertex, const MovingVertex (&facet)[3]) {
  MovingPolygon polygon{.count = 3, .corner = {}};
  for (int time = 0; time < 2; ++time) {
    for (int i = 0; i < 3; ++i) polygon.corner[time][i] = wide_difference(facet[i].at[time], vertex.at[time]);
  }
  return polygon;
}

MovingPolygon edge_seen_from(const MovingVertex (&edge)[2], const MovingVertex (&other)[2]) {
  MovingPolygon polygon{.count = 4, .corner = {}};
  for (int time = 0; time < 2; ++time) {
    const Vec3 p = edge[0].at[time], q = edge[1].at[time], r = other[0].at[time], s = other[1].at[time];
    polygon.corner[time][0] = wide_difference(r, p);
    polygon.corner[time][1] = wide_difference(s, p);
    polygon.corner[time][2] = wide_difference(s, q);
    polygon.corner[time][3] = wide_difference(r, q);
  }
  return polygon;
}

}  // namespace tact::narrowphase
