// A way that goes straight and turns about an axis at the same time, evenly: where points are on it, and how far it is
// certainly free.
#pragma once

#include "engine/base/vec3.h"

namespace tact::narrowphase {

using base::Vec3;

struct SineCosine {
  double sine = 0.0, cosine = 1.0;
};

/// Of an angle of at most 1000 in size, right to 2^-50: by +, -, * alone, the same bits on every machine.
SineCosine sine_cosine(double angle);

struct TurningWay {
  Vec3 way;     // how far it goes
  Vec3 axis;    // a unit vector
  Vec3 center;  // a point of the axis where it begins
  double angle = 0.0;

  /// The same in another unit, seen from the centre.
  TurningWay scaled(double scale) const { return {scale * way, axis, {}, angle}; }
};

/// A point that goes such a way, which outlives it.
class TurningPoint {
 public:
  TurningPoint(const TurningWay& way, Vec3 begin)
      : way_(&way),
        along_(dot(way.axis, begin - way.center) * way.axis),
        across_(begin - way.center - along_),
        beside_(cross(way.axis, across_)),
        radius_(norm(across_)) {}

  /// At a time from 0 to 1, of which `turn` is the turn.
  Vec3 at(double time, const SineCosine& turn) const {
    return way_->center + time * way_->way + along_ + (turn.cosine * across_ + turn.sine * beside_);
  }
  /// How fast it goes.
  Vec3 velocity(const SineCosine& turn) const {
    return way_->way + way_->angle * (turn.cosine * beside_ - turn.sine * across_);
  }
  /// Its velocity changes by no more.
  double acceleration() const { return way_->angle * way_->angle * radius_; }
  double radius() const { return radius_; }

 private:
  const TurningWay* way_;
  Vec3 along_, across_, beside_;
  double radius_;
};

/// The time that a height of at least `gap` lasts which falls at a speed that grows by no more than `acceleration`.
double time_of_fall(double gap, double speed, double acceleration);

}  // namespace tact::narrowphase
