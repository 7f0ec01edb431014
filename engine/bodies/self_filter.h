// Which features of a body are too near to each other to be tested against each other: SelfContactFilter, kept.
#pragma once

#include <tact/body.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "narrowphase/mesh/features.h"
#include "narrowphase/self/excluded_neighbors.h"

namespace tact {

struct SelfFilter {
  int rings = 0;
  double rest_distance = 0.0;
  std::vector<double> rest_positions;                                    // three a vertex; none without a distance
  std::unique_ptr<const narrowphase::ExcludedNeighbors> neighbors = {};  // made of the others, and of the features

  SelfContactFilter view() const;
};

/// Errors: invalid_argument.
void check_self_filter(int rings, double rest_distance, const std::string& name);

/// Reads what a caller gives; null where it leaves out nothing. `now` are the positions that a body has. Errors:
/// wrong_size, non_finite_position, position_out_of_range, and as above.
std::unique_ptr<SelfFilter> made_of(const SelfContactFilter& given, std::vector<double> now, const std::string& name);

/// What new vertices have of those that they were; -1: they rest where they are. Null if there is no last one.
std::unique_ptr<SelfFilter> carried(const SelfFilter* last, std::span<const int> vertex_map,
                                    std::span<const double> positions);

/// Whether two filters leave out the same; null leaves out nothing.
bool are_same(const SelfFilter* x, const SelfFilter* y);

/// Finds the neighbours, once the filter keeps its place.
void find_neighbors(SelfFilter& filter, const narrowphase::FeaturedMesh& mesh);

}  // namespace tact
