#include "scenes/dynamics/topology.h"

#include <algorithm>

namespace tact::scenes {
namespace {

struct Side {
  int from = 0;
  int to = 0;
  int facet = 0;
  int corner = 0;
  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sorted_sides(const Eigen::Matrix3Xi& facets) {
  std::vector<Side> sides;
  sides.reserve(3 * static_cast<std::size_t>(facets.cols()));
  for (int facet = 0; facet < static_cast<int>(facets.cols()); ++facet) {
    for (int corner = 0; corner < 3; ++corner) {
      const int a = facets(corner, facet);
      const int b = facets((corner + 1) % 3, facet);
      sides.push_back({std::min(a, b), std::max(a, b), facet, corner});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace

Topology::Topology(const Eigen::Matrix3Xi& facets, int vertex_count) : facet_edges_(3, facets.cols()) {
  for (const Side& side : sorted_sides(facets)) {
    if (edges_.empty() || edges_.back().from != side.from || edges_.back().to != side.to) {
      edges_.push_back({side.from, side.to, side.facet, -1});
    } else if (edges_.back().other_facet < 0) {
      edges_.back().other_facet = side.facet;
    }
    facet_edges_(side.corner, side.facet) = static_cast<int>(edges_.size()) - 1;
  }

  first_neighbor_.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const Edge& edge : edges_) {
    ++first_neighbor_[static_cast<std::size_t>(edge.from) + 1];
    ++first_neighbor_[static_cast<std::size_t>(edge.to) + 1];
  }
  for (std::size_t v = 1; v < first_neighbor_.size(); ++v) first_neighbor_[v] += first_neighbor_[v - 1];
  neighbors_.resize(2 * edges_.size());
  std::vector<std::size_t> next(first_neighbor_.begin(), first_neighbor_.end() - 1);
  // Edges come sorted, so that each vertex meets its lower neighbours first, both kinds ascending.
  for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
    const Edge& edge = edges_[e];
    neighbors_[next[edge.to]++] = {edge.from, e};
  }
  for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
    const Edge& edge = edges_[e];
    neighbors_[next[edge.from]++] = {edge.to, e};
  }
}

std::span<const Neighbor> Topology::neighbors(int vertex) const {
  const auto v = static_cast<std::size_t>(vertex);
  return std::span(neighbors_).subspan(first_neighbor_[v], first_neighbor_[v + 1] - first_neighbor_[v]);
}

}  // namespace tact::scenes
