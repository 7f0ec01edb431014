#include "narrowphase/self/cluster_neighbors.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace tact::narrowphase {

namespace {

// Clusters that may share a vertex: in a mesh of surfaces there are three or four. A vertex in the middle of a fan of a
// million facets would make a list of every cluster beside every other.
constexpr int kMostAtVertex = 16;

// A cluster has three pairs with others, and there are a dozen around a center: one that adds a few is worth it still,
// as its boundary is no longer than that of two pairs.
constexpr int kWorthACenter[] = {10, 6, 3};

// Puts sides in an order in which each begins where the one before it ends, as far as that goes.
void chain(std::span<ClusterNeighbors::Side> sides) {
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const auto rest = sides.subspan(i);
    const auto next = std::ranges::find(rest, sides[i - 1].to, &ClusterNeighbors::Side::from);
    if (next != rest.end()) std::swap(rest.front(), *next);
  }
}

}  // namespace

ClusterNeighbors::ClusterNeighbors(const ClusteredMesh& mesh, const Features& features)
    : irregular_(static_cast<std::size_t>(mesh.cluster_count()), 0), fans_(mesh) {
  std::vector<Together> meeting = find_around(mesh);
  choose_centers(mesh.cluster_count());
  std::vector<RimSide> all = find_rim_sides(mesh, features);
  list_rims(all, mesh.cluster_count());
  choose_corners(meeting, mesh.cluster_count());
}

// Returns those that share a vertex, all different.
std::vector<ClusterNeighbors::Together> ClusterNeighbors::find_around(const ClusteredMesh& mesh) {
  std::vector<std::pair<int, int>> users;  // a vertex and a cluster that uses it
  for (int c = 0; c < mesh.cluster_count(); ++c) {
    const ClusterFacets facets = mesh.facets_of(c);
    for (int i = 0; i < facets.borrowed_count; ++i) users.emplace_back(facets.borrowed[i], c);
  }
  std::ranges::sort(users);
  std::vector<std::pair<int, int>> beside;
  beside.reserve(mesh.cluster_count());
  for (int c = 0; c < mesh.cluster_count(); ++c) beside.emplace_back(c, c);
  std::vector<Together> meeting;
  std::vector<int> at_vertex;
  int owner = 0;
  for (auto one = users.begin(); one != users.end();) {
    const int vertex = one->first;
    while (mesh.vertex_end(owner) <= vertex) ++owner;
    at_vertex.assign(1, owner);
    for (; one != users.end() && one->first == vertex; ++one) at_vertex.push_back(one->second);
    if (at_vertex.size() <= std::tuple_size_v<Together>) {
      Together those;
      those.fill(-1);
      std::ranges::sort(at_vertex);
      std::ranges::copy(at_vertex, those.begin());
      if (meeting.empty() || meeting.back() != those) meeting.push_back(those);
    }
    const bool many = at_vertex.size() > kMostAtVertex;
    for (const int c : at_vertex) {
      if (many) irregular_[c] = 1;
      for (const int d : at_vertex) {
        if (!many) beside.emplace_back(c, d);
      }
    }
  }
  std::ranges::sort(beside);
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  around_begin_.assign(static_cast<std::size_t>(mesh.cluster_count()) + 1, 0);
  for (const auto& [c, d] : beside) {
    around_.push_back(d);
    around_begin_[static_cast<std::size_t>(c) + 1] = static_cast<int>(around_.size());
  }
  std::ranges::sort(meeting);
  meeting.erase(std::unique(meeting.begin(), meeting.end()), meeting.end());
  return meeting;
}

std::ptrdiff_t ClusterNeighbors::place_of(int cluster, int other) const {
  const std::span<const int> those = around(cluster);
  const auto found = std::ranges::lower_bound(those, other);
  return found != those.end() && *found == other ? around_begin_[cluster] + (found - those.begin()) : -1;
}

void ClusterNeighbors::choose_centers(int cluster_count) {
  std::vector<char> covered(around_.size(), 0);  // of each cluster with each around it
  is_center_.assign(cluster_count, 0);
  for (const int worth : kWorthACenter) {
    for (int center = 0; center < cluster_count; ++center) {
      std::vector<std::ptrdiff_t> fresh;
      for (const int c : around(center)) {
        for (const int d : around(center)) {
          if (const std::ptrdiff_t at = d > c ? place_of(c, d) : -1; at >= 0 && !covered[at]) fresh.push_back(at);
        }
      }
      if (static_cast<int>(fresh.size()) < worth) continue;
      for (const std::ptrdiff_t at : fresh) covered[at] = 1;
      is_center_[center] = 1;
    }
  }
  for (int c = 0; c < cluster_count; ++c) {
    if (is_center(c)) centers_.push_back(c);
  }
}

std::vector<ClusterNeighbors::RimSide> ClusterNeighbors::find_rim_sides(const ClusteredMesh& mesh,
                                                                        const Features& features) {
  struct EdgeUse {
    int count = 0, facet[2] = {-1, -1};
    Side side[2] = {};
    bool regular() const {
      return count == 1 || (count == 2 && side[0].from == side[1].to && side[0].to == side[1].from);
    }
  };
  std::vector<EdgeUse> uses(static_cast<std::size_t>(features.edge_count()));
  const auto for_each_side = [&](const auto& visit) {
    for (int f = 0; f < mesh.facet_count(); ++f) {
      const Corners c = mesh.corners(f);
      for (int k = 0; k < 3; ++k) visit(f, features.facet_edge(f, k), Side{c[k], c[(k + 1) % 3]});
    }
  };
  for_each_side([&](int facet, int edge, Side side) {
    if (edge < 0) return;
    EdgeUse& use = uses[edge];
    if (use.count < 2) {
      use.facet[use.count] = facet;
      use.side[use.count] = side;
    }
    ++use.count;
  });
  std::vector<RimSide> all;
  for_each_side([&](int facet, int edge, Side side) {
    const int cluster = facet / kClusterSize;
    if (edge < 0 || !uses[edge].regular()) {
      irregular_[cluster] = 1;
      return;
    }
    const EdgeUse& use = uses[edge];
    const int beyond = use.count == 1 ? -1 : use.facet[use.facet[0] == facet ? 1 : 0] / kClusterSize;
    if (beyond != cluster) all.push_back({cluster, beyond, side});
  });
  return all;
}

void ClusterNeighbors::list_rims(std::vector<RimSide>& all, int cluster_count) {
  std::ranges::sort(all, {},
                    [](const RimSide& one) { return std::tuple(one.cluster, one.other, one.side.from, one.side.to); });
  rims_begin_.assign(static_cast<std::size_t>(cluster_count) + 1, 0);
  for (auto one = all.begin(); one != all.end();) {
    const RimSide first = *one;
    const auto begin = sides_.size();
    for (; one != all.end() && one->cluster == first.cluster && one->other == first.other; ++one)
      sides_.push_back(one->side);
    chain(std::span(sides_).subspan(begin));
    rims_.push_back({first.other, static_cast<int>(begin), static_cast<int>(sides_.size())});
    ++rims_begin_[static_cast<std::size_t>(first.cluster) + 1];
  }
  for (std::size_t c = 1; c < rims_begin_.size(); ++c) rims_begin_[c] += rims_begin_[c - 1];
}

// Those first that bring most pairs which no corner has yet.
void ClusterNeighbors::choose_corners(std::vector<Together>& meeting, int cluster_count) {
  constexpr int kWorthIt[] = {3, 2, 1};
  std::vector<char> covered(around_.size(), 0);  // of each cluster with each around it
  std::vector<std::pair<int, int>> corners_of;   // a cluster and a corner
  std::vector<std::ptrdiff_t> fresh;
  for (const int worth : kWorthIt) {
    for (const Together& all : meeting) {
      const auto those = std::span(all).first(all.size() - static_cast<std::size_t>(std::ranges::count(all, -1)));
      fresh.clear();
      for (std::size_t i = 0; i < those.size(); ++i) {
        for (std::size_t k = i + 1; k < those.size(); ++k) {
          if (const std::ptrdiff_t at = place_of(those[i], those[k]); at >= 0 && !covered[at]) fresh.push_back(at);
        }
      }
      if (static_cast<int>(fresh.size()) < worth) continue;
      const std::vector<int> line = line_around(those);
      if (line.empty()) continue;
      for (const std::ptrdiff_t at : fresh) covered[at] = 1;
      for (const int c : those) corners_of.emplace_back(c, corner_count());
      at_corner_.insert(at_corner_.end(), those.begin(), those.end());
      corner_begin_.push_back(static_cast<int>(at_corner_.size()));
      lines_.insert(lines_.end(), line.begin(), line.end());
      line_begin_.push_back(static_cast<int>(lines_.size()));
    }
  }
  std::ranges::sort(corners_of);
  corners_of_begin_.assign(static_cast<std::size_t>(cluster_count) + 1, 0);
  for (const auto& [c, corner] : corners_of) {
    corners_of_.push_back(corner);
    ++corners_of_begin_[static_cast<std::size_t>(c) + 1];
  }
  for (std::size_t c = 1; c < corners_of_begin_.size(); ++c) corners_of_begin_[c] += corners_of_begin_[c - 1];
}

// Empty if the clusters do not end as those of a corner do.
std::vector<int> ClusterNeighbors::line_around(std::span<const int> clusters) const {
  std::vector<Side> sides;
  for (const int c : clusters) {
    if (irregular(c)) return {};
    for (const Rim& rim : rims(c)) {
      if (rim.other >= 0 && std::ranges::find(clusters, rim.other) != clusters.end()) continue;
      sides.insert(sides.end(), sides_.begin() + rim.begin, sides_.begin() + rim.end);
    }
  }
  if (sides.size() < 3 || sides.size() > kMostAround) return {};
  std::ranges::sort(sides, {}, &Side::from);
  if (std::ranges::adjacent_find(sides, {}, &Side::from) != sides.end()) return {};
  std::vector<int> line;
  const Side* side = sides.data();
  do {
    line.push_back(side->from);
    const auto next = std::ranges::lower_bound(sides, side->to, {}, &Side::from);
    if (next == sides.end() || next->from != side->to) return {};
    side = &*next;
  } while (side->from != line.front() && line.size() < sides.size());
  return side->from == line.front() && line.size() == sides.size() ? line : std::vector<int>();
}

}  // namespace tact::narrowphase
