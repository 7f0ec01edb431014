// Vertices of one surface that are too near to each other, along its edges or at rest, for their features to be tested.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "narrowphase/mesh/features.h"

namespace tact::narrowphase {

/// Vertices have the caller's numbers.
class ExcludedNeighbors {
 public:
  /// Excludes vertices that are at most `rings` edges apart, 0: none; and those that are at most `distance` apart in
  /// `rest`, which holds three coordinates a vertex and stays where it is; 0: none.
  ExcludedNeighbors(const FeaturedMesh& surface, int rings, double distance, std::span<const double> rest);

  bool has(int v, int w) const {
    return (v == w && rings_ > 0) || (rings_ > 0 && std::ranges::binary_search(near(v), w)) ||
           (distance_ > 0.0 && is_near_at_rest(v, w));
  }

 private:
  std::span<const int> near(int v) const {
    const auto i = static_cast<std::size_t>(v);
    return std::span(near_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
  }
  bool is_near_at_rest(int v, int w) const;

  int rings_;
  double distance_;
  std::span<const double> rest_;
  std::vector<std::size_t> begin_;  // of each vertex, and one more
  std::vector<int> near_;           // the vertices in the rings of each, sorted
};

}  // namespace tact::narrowphase
