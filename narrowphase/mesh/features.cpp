#include "narrowphase/mesh/features.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "narrowphase/mesh/prefetch.h"

namespace tact::narrowphase {

namespace {

// A side of a facet: from corner k to the next one.
struct Side {
  EdgeVertices vertices;  // the smaller first
  int facet;
  int k;
  friend bool operator<(const Side& x, const Side& y) {
    return std::tie(x.vertices, x.facet, x.k) < std::tie(y.vertices, y.facet, y.k);
  }
};

std::vector<Side> sides_of(const std::vector<Corners>& corners) {
  std::vector<Side> sides;
  sides.reserve(3 * corners.size());
  for (int f = 0; f < static_cast<int>(corners.size()); ++f) {
    const Corners& c = corners[f];
    for (int k = 0; k < 3; ++k) {
      const int from = c[k], to = c[(k + 1) % 3];
      if (from != to) sides.push_back({{std::min(from, to), std::max(from, to)}, f, k});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace

Features::Features(const ClusteredMesh& mesh) {
  corners_.reserve(mesh.facet_count());
  for (int f = 0; f < mesh.facet_count(); ++f) corners_.push_back(mesh.corners(f));
  find_edges(mesh);
  find_neighbors(mesh);
  find_firsts(mesh);
  find_repeated(mesh);
  find_parts();
  vertex_of_source_.assign(mesh.source_vertex_count(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) vertex_of_source_[mesh.source_vertex(v)] = v;
}

void Features::find_edges(const ClusteredMesh& mesh) {
  const std::vector<Side> sides = sides_of(corners_);
  // Where the sides of each edge begin, in the order of the first facets.
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i == 0 || sides[i].vertices != sides[i - 1].vertices) begins.push_back(i);
  }
  std::ranges::sort(begins, {}, [&](std::size_t i) { return std::pair(sides[i].facet, sides[i].k); });
  facet_edges_.assign(3 * static_cast<std::size_t>(mesh.facet_count()), -1);
  edge_begin_.assign(static_cast<std::size_t>(mesh.cluster_count()) + 1, 0);
  opposite_begin_.push_back(0);
  for (const std::size_t begin : begins) {
    const int edge = edge_count();
    const Corners& corners = corners_[sides[begin].facet];
    auto from = static_cast<std::size_t>(sides[begin].k), to = (from + 1) % 3;
    if (mesh.source_vertex(corners[to]) < mesh.source_vertex(corners[from])) std::swap(from, to);
    edges_.push_back({corners[from], corners[to]});
    const ClusterFacets cluster = mesh.facets_of(sides[begin].facet / kClusterSize);
    const int facet = sides[begin].facet % kClusterSize;
    edge_corner_[0].push_back(cluster.corner[from][facet]);
    edge_corner_[1].push_back(cluster.corner[to][facet]);
    first_facet_of_edge_.push_back(sides[begin].facet);
    ++edge_begin_[static_cast<std::size_t>(sides[begin].facet / kClusterSize) + 1];
    for (std::size_t i = begin; i < sides.size() && sides[i].vertices == sides[begin].vertices; ++i) {
      const auto [_, f, k] = sides[i];
      facet_edges_[3 * static_cast<std::size_t>(f) + static_cast<std::size_t>(k)] = edge;
      opposite_.push_back(corners_[f][(k + 2) % 3]);
    }
    opposite_begin_.push_back(static_cast<int>(opposite_.size()));
  }
  for (std::size_t c = 1; c < edge_begin_.size(); ++c) edge_begin_[c] += edge_begin_[c - 1];
  for (auto& corners : edge_corner_) corners.resize(corners.size() + 64);
}

void Features::find_neighbors(const ClusteredMesh& mesh) {
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  first_facet_of_vertex_.assign(vertices, -1);
  for (int f = mesh.facet_count() - 1; f >= 0; --f) {
    for (const int v : corners_[f]) first_facet_of_vertex_[v] = f;
  }
  neighbors_begin_.assign(vertices + 1, 0);
  for (const EdgeVertices& edge : edges_) {
    for (const int v : edge) ++neighbors_begin_[static_cast<std::size_t>(v) + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) neighbors_begin_[v + 1] += neighbors_begin_[v];
  neighbors_.resize(2 * edges_.size());
  std::vector<int> next(neighbors_begin_.begin(), neighbors_begin_.end() - 1);
  for (const auto& [v, w] : edges_) {
    neighbors_[next[v]++] = w;
    neighbors_[next[w]++] = v;
  }
}

// In the order of the caller's numbers: a point in an edge or a vertex that has no direction of its own takes the
// normal of this facet, whatever the clusters.
void Features::find_firsts(const ClusteredMesh& mesh) {
  std::vector<char> edge_is_told(edges_.size(), 0), vertex_is_told(first_facet_of_vertex_.size(), 0);
  const auto tell = [](char& is_told) { return std::exchange(is_told, 1) == 0; };
  firsts_of_facet_.assign(mesh.facet_count(), 0);
  for (int source = 0; source < mesh.facet_count(); ++source) {
    const int f = mesh.facet_of_source(source);
    const Corners& corners = corners_[f];
    unsigned firsts = 0;
    for (int k = 0; k < 3; ++k) {
      const int edge = facet_edge(f, k);
      if (edge >= 0 && tell(edge_is_told[edge])) firsts |= 1u << k;
      if (tell(vertex_is_told[corners[k]])) firsts |= 8u << k;
    }
    firsts_of_facet_[f] = static_cast<std::uint8_t>(firsts);
  }
}

void Features::find_repeated(const ClusteredMesh& mesh) {
  // Facets with the same vertices share their edges, with one third vertex. Few meshes have such edges.
  bool may_repeat = false;
  for (int edge = 0; edge < edge_count() && !may_repeat; ++edge) {
    const std::span<const int> third = opposite(edge);
    may_repeat = third.size() > 2 || (third.size() == 2 && third[0] == third[1]);
  }
  const auto is_one_vertex = [](const Corners& c) { return c[0] == c[1] && c[0] == c[2]; };  // which has no edge
  if (!may_repeat && std::ranges::none_of(corners_, is_one_vertex)) return;
  std::vector<std::pair<Corners, int>> sorted;  // vertices, ascending, and the caller's number
  for (int f = 0; f < mesh.facet_count(); ++f) {
    sorted.emplace_back(corners_[f], mesh.source_facet(f));
    std::ranges::sort(sorted.back().first);
  }
  mark_repeated(mesh, sorted, kRepeatsFacet);
  for (auto& [c, source] : sorted) {
    if (c[0] == c[1]) c[1] = c[2];  // whichever vertex is named twice
  }
  mark_repeated(mesh, sorted, kRepeatsVertices);
}

void Features::mark_repeated(const ClusteredMesh& mesh, std::vector<std::pair<Corners, int>>& sorted, unsigned mark) {
  std::ranges::sort(sorted);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first)
      firsts_of_facet_[mesh.facet_of_source(sorted[i].second)] |= static_cast<std::uint8_t>(mark);
  }
}

void Features::find_parts() {
  std::vector<bool> reached(first_facet_of_vertex_.size());
  std::vector<int> next;
  for (std::size_t v = 0; v < reached.size(); ++v) {
    if (reached[v]) continue;
    one_of_each_part_.push_back(static_cast<int>(v));
    reached[v] = true;
    for (next.assign(1, static_cast<int>(v)); !next.empty();) {
      const int from = next.back();
      next.pop_back();
      for (const int to : neighbors(from)) {
        if (reached[to]) continue;
        reached[to] = true;
        next.push_back(to);
      }
    }
  }
}

void Features::prefetch(const ClusteredMesh& mesh, int cluster) const {
  const auto lines = [](const auto& array, int begin, int end) {
    prefetch_lines(array.data() + begin, static_cast<std::size_t>(end - begin));
  };
  const int edge = edge_begin(cluster), end = edge_end(cluster);
  const int facet = mesh.facet_begin(cluster), facet_end = mesh.facet_end(cluster);
  const int vertex = mesh.vertex_begin(cluster), vertex_end = mesh.vertex_end(cluster);
  lines(edges_, edge, end);
  lines(edge_corner_[0], edge, end);
  lines(edge_corner_[1], edge, end);
  lines(opposite_begin_, edge, end + 1);
  lines(corners_, facet, facet_end);
  lines(facet_edges_, 3 * facet, 3 * facet_end);
  lines(firsts_of_facet_, facet, facet_end);
  lines(neighbors_begin_, vertex, vertex_end + 1);
  lines(opposite_, opposite_begin_[edge], opposite_begin_[end]);
  lines(neighbors_, neighbors_begin_[vertex], neighbors_begin_[vertex_end]);
}

std::array<int, 3> source_vertices(const ClusteredMesh& mesh, std::span<const int> vertices) {
  std::array<int, 3> result{-1, -1, -1};
  std::ranges::transform(vertices, result.begin(), [&](int v) { return mesh.source_vertex(v); });
  return result;
}

}  // namespace tact::narrowphase
