// The continuous collision queries with known answers of ../shared/data/ccd_unit_queries.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "narrowphase/motion/moving_polygon.h"

namespace tact::tests {

/// Two edges, or a vertex and a facet.
struct UnitQuery {
  std::string name;  // file and place in it
  bool edges = false;
  std::array<narrowphase::MovingVertex, 4> vertices;
  bool answer = false;

  narrowphase::MovingPolygon polygon() const;
};

/// Those of the files in a folder, in their order; none where the folder is missing. Errors: std::runtime_error, naming
/// file and row.
std::vector<UnitQuery> read_unit_queries(const std::string& folder);

}  // namespace tact::tests
