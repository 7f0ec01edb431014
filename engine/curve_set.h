// The intersection curves of two bodies, or of one with itself.
#pragma once

#include <tact/intersection_curve.h>

#include <vector>

namespace tact {

struct CurveSet {
  std::vector<IntersectionCurve> curves;
  std::vector<CurvePoint> points;  // that the curves show, one after the other
};

}  // namespace tact
