#include "narrowphase/mesh/mesh_travel.h"

#include <algorithm>
#include <cmath>

namespace tact::narrowphase {

namespace {

// More than all that rounds: squares, their sum, the root, and the sum of the steps.
constexpr double kUp = 1.0 + 0x1p-49;
// More than the square root of what vanishes in a square.
constexpr double kLeastStep = 1e-150;

}  // namespace

MeshTravel::MeshTravel(const MeshTopology& topology) {
  const auto clusters = static_cast<std::size_t>(topology.cluster_count());
  now_.assign(clusters, 0.0);
  before_.assign(clusters, 0.0);
  steps_.assign(clusters, 0.0);
  std::vector<int> ends;  // of the vertices that each cluster owns
  ends.reserve(clusters);
  for (int c = 0; c < topology.cluster_count(); ++c) ends.push_back(topology.vertex_end(c));
  for (int c = 0; c < topology.cluster_count(); ++c) {
    owners_begin_.push_back(static_cast<int>(owners_.size()));
    const ClusterFacets facets = topology.facets_of(c, {});
    for (int k = 0; k < facets.borrowed_count; ++k)
      owners_.push_back(static_cast<int>(std::ranges::upper_bound(ends, facets.borrowed[k]) - ends.begin()));
    const auto first = owners_.begin() + owners_begin_.back();
    std::sort(first, owners_.end());
    owners_.erase(std::unique(first, owners_.end()), owners_.end());
  }
  owners_begin_.push_back(static_cast<int>(owners_.size()));
}

void MeshTravel::add_steps() {
  for (double& step : steps_) step = std::sqrt(step) * kUp + kLeastStep;
  for (std::size_t c = 0; c < now_.size(); ++c) {
    double step = steps_[c];
    for (int k = owners_begin_[c]; k < owners_begin_[c + 1]; ++k) step = std::max(step, steps_[owners_[k]]);
    before_[c] = (now_[c] + step) * kUp;
  }
  now_.swap(before_);
}

}  // namespace tact::narrowphase
