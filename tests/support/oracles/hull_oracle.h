// Do two hulls share a point? By a linear program in exact numbers: slow, short and independent of the engine.
#pragma once

#include <span>

#include "engine/base/vec3.h"

namespace tact::tests {

// Of the convex hulls of two sets of points, neither empty; as closed sets.
bool hulls_meet_by_oracle(std::span<const base::Vec3> a, std::span<const base::Vec3> b);

}  // namespace tact::tests
