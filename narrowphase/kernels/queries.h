// What the loops of queries to the world read and write: rays and nearest points.
#pragma once

#include <cstdint>

namespace tact::narrowphase {

// A segment, for the query when it enters boxes. Where it is parallel to an axis, or as good as, `inverse` is zero;
// then `stays` tells whether it is so exactly, or else that axis rules nothing out.
struct SegmentSlabs {
  double from[3];
  double inverse[3];  // 1 / the way along each axis
  bool stays[3];
};

// Some of many boxes, with a number each: the squared distance from a point, or when a segment enters.
struct alignas(64) RankedBoxes {
  static constexpr int kMost = 512;
  double rank[kMost + 8];
  std::int32_t index[kMost + 8];
  int count = 0;
};

// A line, for the query which facets it may meet: `axis` are those of space in an order in which the way is longest
// along the last, of which it goes slope[0] and slope[1] along the others. Seen along the line a point is off by at
// most `error`.
struct LineOfSight {
  int axis[3];
  double from[3];  // in the order of space
  double slope[2];
  double error;
};

// Normals nearer to a direction, a unit vector, than the angle of this cosine, which is positive.
struct FacingNormals {
  double direction[3];
  double cosine;
};

// Facets of a cluster, and what their squared distances from a point are at least, in a unit of the caller's.
struct alignas(64) FacetDistances {
  static constexpr int kCapacity = 64;
  double least_squared[kCapacity + 8];
  std::uint8_t facet[2 * kCapacity];  // counted from the first one
  int count;
};

}  // namespace tact::narrowphase
