// The signs of the heights of moving points over a moving plane, exactly.
//
// The height of a point over a plane along two ways, times their area, is a volume: cubic in time. Its Bernstein
// coefficients on a span of time bound it from both sides; their signs come from doubles where these tell, else from
// double-doubles, else from integers.
#pragma once

#include "narrowphase/motion/moving_way.h"

namespace tact::narrowphase {

/// Signs that some coefficients have: of these any. None: all are zero.
inline constexpr unsigned kAbove = 1, kBelow = 2;

/// The cross product of two ways at time 0.
class BeginNormal {
 public:
  BeginNormal(const MovingWay& u, const MovingWay& v);
  /// Of the volume u × v · w at time 0, as doubles tell; none: it may be zero.
  unsigned sign_along(const MovingVertex& from, const MovingVertex& to) const;

 private:
  Vec3 normal_, size_;
};

/// Two ways, and what their cross product is on the span from time 0 to 2^-halvings. Only as long as they are.
class MovingNormal {
 public:
  /// What doubles tell: the signs of some coefficients, and which others are open.
  struct Signs {
    unsigned certain = 0;
    unsigned open = 0;  // a bit each
  };

  MovingNormal(const MovingWay& u, const MovingWay& v, int halvings);

  /// Of the volume u × v · w.
  Signs signs_along(const MovingWay& w) const;
  /// Of the open ones, up to the first with which both signs are among `known`: those and the known ones.
  unsigned exact_signs_along(const MovingWay& w, unsigned open, unsigned known) const;
  /// Whether the area of u and v is certainly not zero at the beginning.
  bool has_area() const;

 private:
  const MovingWay &u_, &v_;
  int halvings_;
  Vec3 normal_[3], size_[3];  // of both ends' and, in the middle, the sum of one end's with the other's
};

}  // namespace tact::narrowphase
