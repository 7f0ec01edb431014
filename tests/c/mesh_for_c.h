// A mesh of the tests as the interface for C takes it; it must outlive what is made of it.
#pragma once

#include <tact/tact_c.h>

#include "tests/support/mesh.h"

namespace tact::tests {

inline tact_columns columns_of(const Eigen::Matrix3Xd& positions) {
  return {positions.data(), static_cast<size_t>(positions.cols()), 24, TACT_FLOAT64};
}

inline tact_body_definition definition_of(const Mesh& mesh) {
  tact_body_definition definition = TACT_BODY_DEFINITION_INIT;
  definition.positions = columns_of(mesh.positions);
  definition.facets = {mesh.facets.data(), static_cast<size_t>(mesh.facets.cols()), 12, TACT_INT32};
  return definition;
}

}  // namespace tact::tests
