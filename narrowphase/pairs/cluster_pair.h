// A pair of clusters: what all searches of two meshes, or of one with itself, look into.
#pragma once

#include <cstdint>

namespace tact::narrowphase {

/// A cluster of A and one of B, by their numbers in the meshes or by their places in lists of kept clusters.
struct ClusterPair {
  std::int32_t a = 0;
  std::int32_t b = 0;

  friend auto operator<=>(const ClusterPair&, const ClusterPair&) = default;
};

}  // namespace tact::narrowphase
