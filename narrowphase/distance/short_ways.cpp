#include "narrowphase/distance/short_ways.h"

#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

// q - p and the power of two that brings it near 1, by which it is multiplied.
struct UnitDifference {
  DoubleDoubleVec3 way;
  double scale = 1.0;
  UnitDifference(Vec3 p, Vec3 q) : way(double_double_difference(q, p)) {
    scale = unit_scale(largest_coordinate(heads(way)));
    way = scaled(way, scale);
  }
  double size_squared() const { return norm_squared(heads(way)); }
};

}  // namespace

Vec3 fine_way_to_line(Vec3 v, Vec3 p, Vec3 q) {
  const UnitDifference edge(p, q);
  const DoubleDoubleVec3 away = scaled(double_double_difference(v, p), edge.scale);
  const DoubleDouble t = dot(away, edge.way) / dot(edge.way, edge.way);
  const Vec3 way = heads(t * edge.way - away);
  const double rounding_squared = kFineRounding * kFineRounding * (edge.size_squared() + norm_squared(heads(away)));
  return norm_squared(way) > rounding_squared ? (1.0 / edge.scale) * way : Vec3{};
}

double fine_height(Vec3 u0, Vec3 u1, Vec3 w0, Vec3 w1, Vec3 from, Vec3 to) {
  const UnitDifference u(u0, u1), w(w0, w1), way(from, to);
  const DoubleDoubleVec3 across = cross(u.way, w.way);
  const DoubleDouble along = dot(across, way.way), length = square_root(dot(across, across));
  const double size_squared = u.size_squared() * w.size_squared() * way.size_squared();
  if (!(along.head * along.head > kFineRounding * kFineRounding * size_squared)) return 0.0;
  return (along / length).head / way.scale;
}

}  // namespace tact::narrowphase
