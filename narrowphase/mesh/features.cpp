#include "narrowphase/mesh/features.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include "narrowphase/mesh/prefetch.h"

namespace tact::narrowphase {

namespace {

// Numbers edges in the order in which they come. Each stands with its vertex of fewer sides, where it is looked for one
// by one: where thousands of facets meet in a vertex, the others have few each.
class EdgeTable {
 public:
  EdgeTable(const std::vector<Corners>& corners, int vertices)
      : sides_(static_cast<std::size_t>(vertices), 0), end_(static_cast<std::size_t>(vertices)) {
    for (const Corners& c : corners) {
      for (const int v : c) sides_[v] += 2;
    }
    int room = 0;
    for (std::size_t v = 0; v < sides_.size(); ++v) end_[v] = std::exchange(room, room + sides_[v]);
    begin_ = end_;
    entries_.reset(new Entry[static_cast<std::size_t>(room)]);  // each is set before it is read
  }

  // Of two vertices; count() before, if there was none.
  int edge_of(int u, int v) {
    if (std::pair(sides_[v], v) < std::pair(sides_[u], u)) std::swap(u, v);
    Entry *const first = &entries_[begin_[u]], *const last = &entries_[end_[u]];
    for (const Entry* entry = first; entry != last; ++entry) {
      if (entry->other == v) return entry->edge;
    }
    *last = {v, count_};
    ++end_[u];
    return count_++;
  }
  int count() const { return count_; }

 private:
  struct Entry {
    int other, edge;
  };
  std::vector<int> sides_, end_, begin_;  // of each vertex
  std::unique_ptr<Entry[]> entries_;
  int count_ = 0;
};

}  // namespace

Features::Features(const ClusteredMesh& mesh) {
  find_corners(mesh);
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

void Features::find_corners(const ClusteredMesh& mesh) {
  corners_.resize(static_cast<std::size_t>(mesh.facet_count()));
  std::array<int, 3 * kClusterSize> vertices{};
  for (int c = 0; c < mesh.cluster_count(); ++c) {
    const ClusterFacets cluster = mesh.facets_of(c);
    std::iota(vertices.begin(), vertices.begin() + cluster.owned_count, cluster.owned_begin);
    std::copy_n(cluster.borrowed, cluster.borrowed_count, vertices.begin() + cluster.owned_count);
    for (int i = 0; i < cluster.facet_count; ++i) {
      Corners& corners = corners_[static_cast<std::size_t>(cluster.facet_begin + i)];
      for (std::size_t k = 0; k < 3; ++k) corners[k] = vertices[cluster.corner[k][i]];
    }
  }
}

void Features::find_edges(const ClusteredMesh& mesh) {
  EdgeTable table(corners_, mesh.vertex_count());
  facet_edges_.resize(3 * corners_.size());
  edge_begin_.assign(1, 0);
  for (int c = 0; c < mesh.cluster_count(); ++c) {
    for (int f = mesh.facet_begin(c); f < mesh.facet_end(c); ++f) {
      const Corners& corners = corners_[f];
      for (std::size_t k = 0; k < 3; ++k) {
        const int from = corners[k], to = corners[(k + 1) % 3];
        facet_edges_[3 * static_cast<std::size_t>(f) + k] = from == to ? -1 : table.edge_of(from, to);
      }
    }
    edge_begin_.push_back(table.count());
  }
  find_ends(mesh, table.count());
  find_opposite();
}

// Of each edge where it comes first.
void Features::find_ends(const ClusteredMesh& mesh, int count) {
  const auto edges = static_cast<std::size_t>(count);
  edges_.resize(edges);
  first_facet_of_edge_.resize(edges);
  opposite_begin_.assign(edges + 1, 0);
  for (auto& corners : edge_corner_) corners.resize(edges + 64);
  std::vector<int> balances(edges, 0);  // of each edge: facets along it, less those that go the other way
  int known = 0;
  for (int c = 0; c < mesh.cluster_count(); ++c) {
    const ClusterFacets cluster = mesh.facets_of(c);
    for (int i = 0; i < cluster.facet_count; ++i) {
      const auto facet = static_cast<std::size_t>(cluster.facet_begin + i);
      const Corners& corners = corners_[facet];
      for (std::size_t k = 0; k < 3; ++k) {
        const int edge = facet_edges_[3 * facet + k];
        if (edge < 0) continue;
        if (edge == known) {
          ++known;
          std::size_t from = k, to = (k + 1) % 3;
          if (mesh.source_vertex(corners[to]) < mesh.source_vertex(corners[from])) std::swap(from, to);
          edges_[edge] = {corners[from], corners[to]};
          edge_corner_[0][edge] = cluster.corner[from][i];
          edge_corner_[1][edge] = cluster.corner[to][i];
          first_facet_of_edge_[edge] = static_cast<int>(facet);
        }
        balances[edge] += corners[k] == edges_[edge][0] ? 1 : -1;
        ++opposite_begin_[static_cast<std::size_t>(edge) + 1];
      }
    }
  }
  is_closed_ = std::ranges::all_of(balances, [](int balance) { return balance == 0; });
}

// In the order of the facets.
void Features::find_opposite() {
  for (std::size_t e = 1; e < opposite_begin_.size(); ++e) opposite_begin_[e] += opposite_begin_[e - 1];
  opposite_.resize(static_cast<std::size_t>(opposite_begin_.back()));
  std::vector<int> next(opposite_begin_.begin(), opposite_begin_.end() - 1);
  for (std::size_t f = 0; f < corners_.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (const int edge = facet_edges_[3 * f + k]; edge >= 0) opposite_[next[edge]++] = corners_[f][(k + 2) % 3];
    }
  }
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

// Each vertex leads to one of its part that is not above it, in the end to the first (Tarjan, "Efficiency of a good but
// not linear set union algorithm", 1975).
void Features::find_parts() {
  std::vector<int> leads_to(first_facet_of_vertex_.size());
  std::iota(leads_to.begin(), leads_to.end(), 0);
  const auto first_of = [&](int v) {
    while (leads_to[v] != v) v = leads_to[v] = leads_to[leads_to[v]];
    return v;
  };
  for (const auto& [v, w] : edges_) {
    const auto [low, high] = std::minmax({first_of(v), first_of(w)});
    leads_to[high] = low;
  }
  for (int v = 0; v < static_cast<int>(leads_to.size()); ++v) {
    if (leads_to[v] == v) one_of_each_part_.push_back(v);
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
