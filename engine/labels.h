// The labels of what a point, a pair or an impact names.
#pragma once

#include <tact/body.h>

#include <array>

#include "engine/bodies/bodies.h"

namespace tact {

/// Of up to three vertices of the caller's numbers; -1 fills up. Errors: invalid_argument.
FeatureLabels labels_of(const Body& body, const std::array<int, 3>& vertices);

}  // namespace tact
