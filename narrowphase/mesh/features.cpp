#include "narrowphase/mesh/features.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "engine/base/hash.h"
#include "narrowphase/mesh/mesh_parts.h"
#include "narrowphase/mesh/prefetch.h"

namespace tact::narrowphase {

namespace {

constexpr int kNoEdge = -1;

// Numbers edges in the order in which they come, cluster by cluster. An edge with a vertex that its cluster owns is in
// no cluster before: it is looked for in its cluster alone, of which all is in the cache. The others stand in a table
// of all edges that several clusters may have.
class EdgeTable {
 public:
  explicit EdgeTable(const ClusteredMesh& mesh) : is_shared_(static_cast<std::size_t>(mesh.vertex_count()), 0) {
    const std::span borrowed(mesh.borrowed_vertices(), static_cast<std::size_t>(mesh.counts().borrowed));
    for (const int v : borrowed) is_shared_[v] = 1;
    shared_heads_.assign(std::bit_ceil(borrowed.size() + 1), kNoEdge);
  }

  void begin(const ClusterFacets& cluster) {
    first_ = cluster.owned_begin;
    std::fill_n(heads_.begin(), cluster.owned_count, kNoEdge);
    here_count_ = 0;
  }
  // Of two vertices of the cluster; count() before, if there was none.
  int edge_of(int u, int v) {
    if (u < v) std::swap(u, v);  // u is owned, if any of them is
    if (u < first_) return shared_edge_of(u, v);
    int& head = heads_[static_cast<std::size_t>(u - first_)];
    for (int at = head; at != kNoEdge; at = here_[at].next) {
      if (here_[at].other == v) return here_[at].edge;
    }
    here_[here_count_] = {v, count_, head};
    head = here_count_++;
    if (is_shared_[u] != 0 && is_shared_[v] != 0) add_shared(u, v);
    return count_++;
  }
  int count() const { return count_; }

 private:
  struct Here {
    int other, edge, next;
  };
  struct Shared {
    int u, v, edge, next;
  };
  int& shared_head(int u, int v) {
    const auto word = [](int vertex) { return static_cast<std::uint64_t>(vertex); };
    return shared_heads_[base::mixed(word(u) << 32 | word(v)) & (shared_heads_.size() - 1)];
  }
  int shared_edge_of(int u, int v) {
    for (int at = shared_head(u, v); at != kNoEdge; at = shared_[at].next) {
      if (shared_[at].u == u && shared_[at].v == v) return shared_[at].edge;
    }
    add_shared(u, v);
    return count_++;
  }
  void add_shared(int u, int v) {
    int& head = shared_head(u, v);
    shared_.push_back({u, v, count_, head});
    head = static_cast<int>(shared_.size()) - 1;
  }

  static constexpr std::size_t kMostSides = 3 * kClusterSize;  // of a cluster, and as many vertices
  std::array<int, kMostSides> heads_;                          // of the vertices that the cluster owns
  std::array<Here, kMostSides> here_;                          // each is set before it is read
  int first_ = 0, here_count_ = 0, count_ = 0;
  std::vector<char> is_shared_;  // of each vertex: whether a later cluster borrows it
  std::vector<int> shared_heads_;
  std::vector<Shared> shared_;
};

// Lists the numbers of each key, in the order in which for_each(visit) calls visit(key, number), twice.
template <class ForEach>
void list_by_key(std::size_t keys, const ForEach& for_each, std::vector<int>& begin, std::vector<int>& numbers) {
  begin.assign(keys + 2, 0);
  int* const ends = begin.data() + 1;  // where each list begins; once it is filled, where it ends
  for_each([&](int key, int) { ++ends[key + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  numbers.resize(static_cast<std::size_t>(begin.back()));
  int* const to = numbers.data();
  for_each([&](int key, int number) { to[ends[key]++] = number; });
  begin.pop_back();
}

}  // namespace

Features::Features(const ClusteredMesh& mesh) {
  find_corners(mesh);
  find_edges(mesh);
  find_neighbors(mesh);
  find_facets_at(mesh);
  find_firsts(mesh);
  find_repeated(mesh);
  vertex_of_source_.assign(mesh.source_vertex_count(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) vertex_of_source_[mesh.source_vertex(v)] = v;
  one_of_each_part_ = narrowphase::one_of_each_part(mesh, edges_);
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
  EdgeTable table(mesh);
  facet_edges_.resize(3 * corners_.size());
  edge_begin_.assign(1, 0);
  int* edge = facet_edges_.data();
  for (int c = 0; c < mesh.cluster_count(); ++c) {
    const ClusterFacets cluster = mesh.facets_of(c);
    table.begin(cluster);
    for (int i = 0; i < cluster.facet_count; ++i) {
      const Corners& v = corners_[static_cast<std::size_t>(cluster.facet_begin + i)];
      *edge++ = v[0] == v[1] ? kNoEdge : table.edge_of(v[0], v[1]);
      *edge++ = v[1] == v[2] ? kNoEdge : table.edge_of(v[1], v[2]);
      *edge++ = v[2] == v[0] ? kNoEdge : table.edge_of(v[2], v[0]);
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
  for (auto& corners : edge_corner_) corners.resize(edges + 64);
  std::vector<int> balances(edges, 0);  // of each edge: facets along it, less those that go the other way
  int known = 0;
  for (int c = 0; c < mesh.cluster_count(); ++c) {
    const ClusterFacets cluster = mesh.facets_of(c);
    for (int i = 0; i < cluster.facet_count; ++i) {
      const auto facet = static_cast<std::size_t>(cluster.facet_begin + i);
      const Corners corners = corners_[facet];
      for (std::size_t k = 0; k < 3; ++k) {
        const int edge = facet_edges_[3 * facet + k];
        if (edge < 0) continue;
        if (edge == known) {
          ++known;
          std::size_t from = k, to = k == 2 ? 0 : k + 1;
          if (mesh.source_vertex(corners[to]) < mesh.source_vertex(corners[from])) std::swap(from, to);
          edges_[edge] = {corners[from], corners[to]};
          edge_corner_[0][edge] = cluster.corner[from][i];
          edge_corner_[1][edge] = cluster.corner[to][i];
        }
        balances[edge] += corners[k] == edges_[edge][0] ? 1 : -1;
      }
    }
  }
  is_closed_ = std::ranges::all_of(balances, [](int balance) { return balance == 0; });
}

// In the order of the facets.
void Features::find_opposite() {
  const auto for_each_side = [&](const auto& visit) {
    const int* edge = facet_edges_.data();
    for (const Corners& c : corners_) {
      if (edge[0] >= 0) visit(edge[0], c[2]);
      if (edge[1] >= 0) visit(edge[1], c[0]);
      if (edge[2] >= 0) visit(edge[2], c[1]);
      edge += 3;
    }
  };
  list_by_key(edges_.size(), for_each_side, opposite_begin_, opposite_);
}

// In the order of the edges.
void Features::find_neighbors(const ClusteredMesh& mesh) {
  const auto for_each_end = [&](const auto& visit) {
    for (const auto& [v, w] : edges_) visit(v, w), visit(w, v);
  };
  list_by_key(static_cast<std::size_t>(mesh.vertex_count()), for_each_end, neighbors_begin_, neighbors_);
}

// A facet that names a vertex twice is at it once.
void Features::find_facets_at(const ClusteredMesh& mesh) {
  const auto for_each_corner = [&](const auto& visit) {
    int f = 0;
    for (const Corners& c : corners_) {
      visit(c[0], f);
      if (c[1] != c[0]) visit(c[1], f);
      if (c[2] != c[0] && c[2] != c[1]) visit(c[2], f);
      ++f;
    }
  };
  list_by_key(static_cast<std::size_t>(mesh.vertex_count()), for_each_corner, facets_begin_, facets_);
}

// In the order of the caller's numbers: a point in an edge or a vertex that has no direction of its own takes the
// normal of this facet, whatever the clusters.
void Features::find_firsts(const ClusteredMesh& mesh) {
  std::vector<char> edge_is_told(edges_.size(), 0), vertex_is_told(static_cast<std::size_t>(mesh.vertex_count()), 0);
  firsts_of_facet_.assign(corners_.size(), 0);
  first_facet_of_vertex_.resize(static_cast<std::size_t>(mesh.vertex_count()));
  for (int source = 0; source < mesh.facet_count(); ++source) {
    const auto f = static_cast<std::size_t>(mesh.facet_of_source(source));
    unsigned firsts = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int edge = facet_edges_[3 * f + k], vertex = corners_[f][k];
      if (edge >= 0 && std::exchange(edge_is_told[edge], 1) == 0) firsts |= 1u << k;
      if (std::exchange(vertex_is_told[vertex], 1) != 0) continue;
      firsts |= 8u << k;
      first_facet_of_vertex_[vertex] = static_cast<int>(f);
    }
    firsts_of_facet_[f] = static_cast<std::uint8_t>(firsts);
  }
}

void Features::find_repeated(const ClusteredMesh& mesh) {
  // Facets with the same vertices share their edges, with one third vertex. Few meshes have such edges.
  bool may_repeat = false;
  for (std::size_t edge = 0; edge < edges_.size() && !may_repeat; ++edge) {
    const int first = opposite_begin_[edge], third_count = opposite_begin_[edge + 1] - first;
    may_repeat = third_count > 2 || (third_count == 2 && opposite_[first] == opposite_[first + 1]);
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
