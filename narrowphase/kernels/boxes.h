// What the loops over points and boxes read and write.
#pragma once

#include <cstdint>

namespace tact::narrowphase {

// Three arrays of coordinates.
struct PointArrays {
  const double* x;
  const double* y;
  const double* z;
};

// A direction n and a point o: the height of x is ((n.x (x - o.x) + n.y (y - o.y)) + n.z (z - o.z)).
struct HeightAxis {
  double nx, ny, nz;
  double ox, oy, oz;
};

struct IndexRange {
  std::int32_t begin, end;
};

struct HighestPoint {
  double height;
  std::int32_t index;
};

// Lower and upper bounds of boxes in separate arrays.
struct BoxPointers {
  const double* lower[3];
  const double* upper[3];
};

// One box.
struct BoxBounds {
  double lower[3];
  double upper[3];
};

// The extent of points along the diagonals of a cube's faces: y + z, z + x, x + y, y - z, z - x, x - y. See
// hull/kdop.h.
inline constexpr int kDiagonals = 6;
struct Kdop {
  double lower[kDiagonals];
  double upper[kDiagonals];
};

}  // namespace tact::narrowphase
