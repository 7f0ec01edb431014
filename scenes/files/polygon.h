// Splits polygons into triangles.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace tact::scenes {

// How a polygon is split. Corners are counted from 0.
struct PolygonSplit {
  enum Kind {
    fan,        // all triangles from the first corner are right
    ears,       // `triangles`
    not_simple  // it crosses or touches itself: no triangles
  } kind = fan;
  std::vector<std::array<std::size_t, 3>> triangles = {};  // of `ears`: two fewer than corners, turning as the polygon
};

// Splits the polygon of these corners, at least three, by its shape in the plane of the two axes that its normal leans
// to least. Turns are decided exactly. The bridges that join a hole to the outline, two edges back and forth between
// two corners, are no crossing. A polygon without area, or with corners that repeat the one before, keeps its fan if
// that turns one way only. The time is quadratic in the number of corners where the fan is wrong.
PolygonSplit split_polygon(std::span<const std::array<double, 3>> corners);

}  // namespace tact::scenes
