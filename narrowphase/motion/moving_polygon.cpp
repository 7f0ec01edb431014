#include "narrowphase/motion/moving_polygon.h"

namespace tact::narrowphase {

namespace {

bool are_one(const MovingPolygon& polygon, int i, int k) {
  return polygon.corner[0][i] == polygon.corner[0][k] && polygon.corner[1][i] == polygon.corner[1][k];
}

void take_out_repeated(MovingPolygon& polygon) {
  int count = 0;
  for (int i = 0; i < polygon.count; ++i) {
    bool is_new = true;
    for (int k = 0; k < count; ++k) is_new = is_new && !are_one(polygon, i, k);
    if (!is_new) continue;
    for (auto& corners : polygon.corner) corners[count] = corners[i];
    ++count;
  }
  polygon.count = count;
}

}  // namespace

MovingPolygon facet_seen_from(const MovingVertex& vertex, const MovingVertex (&facet)[3]) {
  MovingPolygon polygon{.count = 3, .corner = {}};
  for (int time = 0; time < 2; ++time) {
    for (int i = 0; i < 3; ++i) polygon.corner[time][i] = double_double_difference(facet[i].at[time], vertex.at[time]);
  }
  take_out_repeated(polygon);
  return polygon;
}

MovingPolygon edge_seen_from(const MovingVertex (&edge)[2], const MovingVertex (&other)[2]) {
  MovingPolygon polygon{.count = 4, .corner = {}};
  for (int time = 0; time < 2; ++time) {
    const Vec3 p = edge[0].at[time], q = edge[1].at[time], r = other[0].at[time], s = other[1].at[time];
    polygon.corner[time][0] = double_double_difference(r, p);
    polygon.corner[time][1] = double_double_difference(s, p);
    polygon.corner[time][2] = double_double_difference(s, q);
    polygon.corner[time][3] = double_double_difference(r, q);
  }
  take_out_repeated(polygon);
  return polygon;
}

}  // namespace tact::narrowphase
