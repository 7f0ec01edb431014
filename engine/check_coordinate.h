// Validates a coordinate.
#pragma once

#include <tact/body.h>
#include <tact/error.h>

#include <cmath>
#include <string>

#include "engine/base/text.h"

namespace tact {

// Refuses the coordinate `x` along `axis` of what is called `what`, which is not finite or too large.
[[noreturn]] inline void refuse_coordinate(const std::string& what, int axis, double x) {
  const bool infinite = !std::isfinite(x);
  throw Error(infinite ? ErrorCode::non_finite_position : ErrorCode::position_out_of_range,
              what + " has " + "xyz"[axis] + " = " + base::text_of(x) +
                  (infinite ? ", which is not finite" : ", which is larger than 2^300 in size"));
}

}  // namespace tact
