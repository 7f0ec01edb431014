#include "scenes/dynamics/edges.h"

#include <algorithm>

namespace tact::scenes {
namespace {

struct Side {
  int from = 0;
  int to = 0;
  int facet = 0;
  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sorted_sides(const Eigen::Matrix3Xi& facets) {
  std::vector<Side> sides;
  sides.reserve(3 * static_cast<std::size_t>(facets.cols()));
  for (int facet = 0; facet < static_cast<int>(facets.cols()); ++facet) {
    for (int corner = 0; corner < 3; ++corner) {
      const int a = facets(corner, facet);
      const int b = facets((corner + 1) % 3, facet);
      sides.push_back({std::min(a, b), std::max(a, b), facet});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace

std::vector<Edge> edges_of(const Eigen::Matrix3Xi& facets) {
  std::vector<Edge> edges;
  for (const Side& side : sorted_sides(facets)) {
    if (edges.empty() || edges.back().from != side.from || edges.back().to != side.to) {
      edges.push_back({side.from, side.to, side.facet, -1});
    } else if (edges.back().other_facet < 0) {
      edges.back().other_facet = side.facet;
    }
  }
  return edges;
}

}  // namespace tact::scenes
