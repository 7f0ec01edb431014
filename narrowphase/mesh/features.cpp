#include "narrowphase/mesh/features.h"

#include <algorithm>
#include <utility>

#include "narrowphase/mesh/prefetch.h"

namespace tact::narrowphase {

namespace {

// Sides of facets, each from corner k of a facet to the next one, as 3 * facet + k. Those of one edge stand together,
// in the order of the facets.
struct Sides {
  // Of an edge: from `begin` on, to `end`.
  struct Edge {
    int begin = 0, end = 0;
  };
  std::vector<std::uint64_t> keys;  // the larger vertex of the edge, then the side, of 32 bits each
  std::vector<Edge> edges;          // in the order of their first sides

  std::size_t facet(int i) const { return static_cast<std::uint32_t>(keys[i]) / 3; }
  std::size_t corner(int i) const { return static_cast<std::uint32_t>(keys[i]) % 3; }
};

// Calls visit(smaller vertex, key) for all, by facets.
template <class Visit>
void for_each_side(const std::vector<Corners>& corners, const Visit& visit) {
  std::uint64_t side = 0;
  for (const Corners& c : corners) {
    for (std::size_t k = 0; k < 3; ++k, ++side) {
      const auto [small, large] = std::minmax(c[k], c[(k + 1) % 3]);
      if (small != large) visit(small, static_cast<std::uint64_t>(large) << 32 | side);
    }
  }
}

// First by the smaller vertex, of which there are as many as vertices, then the few that have it.
Sides sides_of(const std::vector<Corners>& corners, int vertices) {
  std::vector<int> begin(static_cast<std::size_t>(vertices) + 1, 0);
  for_each_side(corners, [&](int vertex, std::uint64_t) { ++begin[static_cast<std::size_t>(vertex) + 1]; });
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  Sides sides{.keys = std::vector<std::uint64_t>(static_cast<std::size_t>(begin.back())), .edges = {}};
  std::vector<int> next(begin.begin(), begin.end() - 1);
  for_each_side(corners, [&](int vertex, std::uint64_t key) { sides.keys[next[vertex]++] = key; });
  std::vector<Sides::Edge> at_side(3 * corners.size());  // the edges that begin with a side
  std::size_t count = 0;
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
    const int end = begin[v + 1];
    std::sort(sides.keys.begin() + begin[v], sides.keys.begin() + end);
    for (int i = begin[v], first = i; i < end; first = i, ++count) {
      while (i < end && sides.keys[i] >> 32 == sides.keys[first] >> 32) ++i;
      at_side[static_cast<std::uint32_t>(sides.keys[first])] = {first, i};
    }
  }
  sides.edges.reserve(count);
  for (const Sides::Edge& edge : at_side) {
    if (edge.end > edge.begin) sides.edges.push_back(edge);
  }
  return sides;
}

}  // namespace

Features::Features(const ClusteredMesh& mesh) {
  corners_.reserve(mesh.facet_count());
  for (int f = 0; f < mesh.facet_count(); ++f) corners_.push_back(mesh.corners(f));
  find_edges(mesh);
  find_neighbors(mesh);
  find_facets_at(mesh);
  find_firsts(mesh);
  find_repeated(mesh);
  find_parts();
  vertex_of_source_.assign(mesh.source_vertex_count(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) vertex_of_source_[mesh.source_vertex(v)] = v;
  if (!mesh.has_surface_alone()) find_bare(mesh);
}

void Features::find_edges(const ClusteredMesh& mesh) {
  const Sides sides = sides_of(corners_, mesh.vertex_count());
  facet_edges_.assign(3 * static_cast<std::size_t>(mesh.facet_count()), -1);
  edge_begin_.assign(static_cast<std::size_t>(mesh.cluster_count()) + 1, 0);
  opposite_begin_.push_back(0);
  for (const auto& [begin, end] : sides.edges) {
    const int edge = edge_count(), first = static_cast<int>(sides.facet(begin));
    const Corners& corners = corners_[first];
    std::size_t from = sides.corner(begin), to = (from + 1) % 3;
    if (mesh.source_vertex(corners[to]) < mesh.source_vertex(corners[from])) std::swap(from, to);
    edges_.push_back({corners[from], corners[to]});
    const ClusterFacets cluster = mesh.facets_of(first / kClusterSize);
    edge_corner_[0].push_back(cluster.corner[from][first % kClusterSize]);
    edge_corner_[1].push_back(cluster.corner[to][first % kClusterSize]);
    first_facet_of_edge_.push_back(first);
    ++edge_begin_[static_cast<std::size_t>(first / kClusterSize) + 1];
    int balance = 0;
    for (int i = begin; i < end; ++i) {
      const std::size_t f = sides.facet(i), k = sides.corner(i);
      facet_edges_[3 * f + k] = edge;
      balance += corners_[f][k] == edges_.back()[0] ? 1 : -1;
      opposite_.push_back(corners_[f][(k + 2) % 3]);
    }
    is_closed_ &= balance == 0;
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

// A facet that names a vertex twice is at it once.
void Features::find_facets_at(const ClusteredMesh& mesh) {
  facets_begin_.assign(static_cast<std::size_t>(mesh.vertex_count()) + 1, 0);
  const auto for_each_corner = [&](const auto& visit) {
    for (int f = 0; f < mesh.facet_count(); ++f) {
      const Corners& c = corners_[f];
      visit(c[0], f);
      if (c[1] != c[0]) visit(c[1], f);
      if (c[2] != c[0] && c[2] != c[1]) visit(c[2], f);
    }
  };
  for_each_corner([&](int vertex, int) { ++facets_begin_[static_cast<std::size_t>(vertex) + 1]; });
  for (std::size_t v = 1; v < facets_begin_.size(); ++v) facets_begin_[v] += facets_begin_[v - 1];
  facets_.resize(static_cast<std::size_t>(facets_begin_.back()));
  std::vector<int> next(facets_begin_.begin(), facets_begin_.end() - 1);
  for_each_corner([&](int vertex, int f) { facets_[static_cast<std::size_t>(next[vertex]++)] = f; });
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

void Features::find_bare(const ClusteredMesh& mesh) {
  std::vector<bool> edge_is_bare(edges_.size(), true);
  vertex_is_bare_.assign(static_cast<std::size_t>(mesh.vertex_count()), true);
  for (int source = 0; source < mesh.surface_facet_count(); ++source) {
    const int f = mesh.facet_of_source(source);
    for (int k = 0; k < 3; ++k) {
      vertex_is_bare_[static_cast<std::size_t>(corners_[f][static_cast<std::size_t>(k)])] = false;
      if (const int edge = facet_edge(f, k); edge >= 0) edge_is_bare[static_cast<std::size_t>(edge)] = false;
    }
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (edge_is_bare[e]) bare_edges_.push_back({mesh.source_vertex(edges_[e][0]), mesh.source_vertex(edges_[e][1])});
  }
  std::ranges::sort(bare_edges_);
}

bool Features::is_bare(const std::array<int, 3>& source_vertices) const {
  const auto [u, v, w] = source_vertices;
  if (vertex_is_bare_.empty() || w >= 0) return false;
  return v < 0 ? vertex_is_bare_[static_cast<std::size_t>(vertex_of_source(u))]
               : std::ranges::binary_search(bare_edges_, EdgeVertices{u, v});
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
