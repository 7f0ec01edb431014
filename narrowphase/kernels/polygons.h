// What the loops over polygons in a plane read and write.
#pragma once

namespace tact::narrowphase {

// A closed polygon, and room for what a SIMD loop reads and writes past its end.
struct alignas(64) FlatPolygon {
  static constexpr int kMost = 128;
  static constexpr int kRoom = kMost + 16;
  double x[kRoom], y[kRoom];  // of its vertices
  int count;                  // 3 to kMost
  double error;               // of any coordinate, at most; 2^-52 to 2^-40 of `size`
  double size;                // no two coordinates differ by more; 2^-200 to 2^200
};

}  // namespace tact::narrowphase
