// Ways so short that roundings have a part in them: how long they are, and which way they go. A vertex on an edge has
// none, however the place on the edge is rounded.
#pragma once

#include <algorithm>
#include <cmath>

#include "narrowphase/distance/nearest.h"
#include "narrowphase/distance/rounding.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// The way from `v` to the line through two points, in double-doubles; zero where these do not tell one.
Vec3 fine_way_to_line(Vec3 v, Vec3 p, Vec3 q);
/// How far `to` is from `from` along u × w, where u leads from u0 to u1 and w from w0 to w1; likewise.
double fine_height(Vec3 u0, Vec3 u1, Vec3 w0, Vec3 w1, Vec3 from, Vec3 to);

/// Whether u × w, or a power of two times it, tells in doubles how far one leads along it that is `along` times its
/// length. Each size is a squared length, the first that of u × w.
inline bool tells_height(double along, double square, double size_u, double size_w, double size_of_way) {
  return along * along > kSignRounding * kSignRounding * size_of_way * std::max(square, size_u * size_w);
}

/// How far `v` is above the plane of a facet. `normal` is its normal, or a power of two times it, and has a length.
inline double height_above(Vec3 v, const Triangle& t, Vec3 normal, double length) {
  const Vec3 away = v - t[0];
  const double along = dot(normal, away);
  if (tells_height(along, length * length, norm_squared(t[1] - t[0]), norm_squared(t[2] - t[0]), norm_squared(away)))
    return along / length;
  return fine_height(t[0], t[1], t[0], t[2], t[0], v);
}

}  // namespace tact::narrowphase
