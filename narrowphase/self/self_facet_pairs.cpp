#include "narrowphase/self/self_facet_pairs.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/base/lowest_bits.h"
#include "narrowphase/mesh/cluster_places.h"
#include "narrowphase/pairs/open_clusters.h"
#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

namespace {

constexpr std::uint64_t bit(int i) { return std::uint64_t{1} << i; }

// The facets of a cluster.
struct OpenFacets {
  ClusterFacets source;
  FacetBlock block;
  std::uint64_t facets = 0;  // a bit each

  void open(const ClusteredMesh& mesh, int cluster, const Grid& grid) {
    source = mesh.facets_of(cluster);
    kernels().open_whole(source, grid, &block);
    facets = base::lowest_bits(block.count);
    listed_ = knows_open_ = false;
  }
  // Which facets have each of the vertices, owned ones first. Listed at the first use: most clusters are paired
  // only with others that are far along the surface.
  const std::uint64_t* with_vertex() {
    if (std::exchange(listed_, true)) return with_vertex_;
    std::fill_n(with_vertex_, source.owned_count + source.borrowed_count, 0);
    for (const std::uint8_t* corner : source.corner) {
      for (int i = 0; i < block.count; ++i) with_vertex_[corner[i]] |= bit(i);
    }
    return with_vertex_;
  }
  int vertex(int place) const {
    return place < source.owned_count ? source.owned_begin + place : source.borrowed[place - source.owned_count];
  }
  // Whether the facets at a vertex lie open: open_at(vertex), asked once.
  template <class OpenAt>
  bool lie_open(int place, const OpenAt& open_at) {
    if (!std::exchange(knows_open_, true)) std::fill_n(open_, source.owned_count + source.borrowed_count, kUnknown);
    if (open_[place] == kUnknown) open_[place] = open_at(vertex(place)) ? kOpen : kCrowded;
    return open_[place] == kOpen;
  }

 private:
  enum Openness : std::uint8_t { kUnknown, kOpen, kCrowded };

  bool listed_ = false, knows_open_ = false;
  std::uint64_t with_vertex_[3 * kClusterSize];
  Openness open_[3 * kClusterSize];
};

// For each facet of `a` those of the same cluster that come before it, itself, and those that share a vertex with it.
void exclude_within(OpenFacets& a, std::uint64_t (&excluded)[kClusterSize]) {
  const std::uint64_t* const with_vertex = a.with_vertex();
  for (int i = 0; i < a.block.count; ++i) {
    excluded[i] = bit(i) | (bit(i) - 1);
    for (const std::uint8_t* corner : a.source.corner) excluded[i] |= with_vertex[corner[i]];
  }
}

// A vertex of two clusters, or of one taken twice, and the facets of each that have it.
struct CommonVertex {
  int place;  // in the first
  std::uint64_t of_a, of_b;
};
struct CommonVertices {
  int count = 0;
  CommonVertex vertex[3 * kClusterSize];

  std::span<const CommonVertex> all() const { return std::span(vertex).first(count); }
};

// Those of a cluster and a later one, which has borrowed them.
void find_common(OpenFacets& a, const ClusterPlaces& places_in_a, OpenFacets& b, CommonVertices& common) {
  common.count = 0;
  for (int k = 0; k < b.source.borrowed_count; ++k) {
    const int place = places_in_a[b.source.borrowed[k]];
    if (place < 0) continue;
    common.vertex[common.count++] = {place, a.with_vertex()[place], b.with_vertex()[b.source.owned_count + k]};
  }
}

// Those of a cluster that several of its facets have.
void find_common_within(OpenFacets& a, CommonVertices& common) {
  common.count = 0;
  const std::uint64_t* const with_vertex = a.with_vertex();
  for (int place = 0; place < a.source.owned_count + a.source.borrowed_count; ++place) {
    const std::uint64_t facets = with_vertex[place];
    if ((facets & (facets - 1)) != 0) common.vertex[common.count++] = {place, facets, facets};
  }
}

void add_pairs_at(const CommonVertex& vertex, std::uint64_t (&of_a)[kClusterSize]) {
  for (std::uint64_t left = vertex.of_a; left != 0; left &= left - 1) of_a[std::countr_zero(left)] |= vertex.of_b;
}

// Puts the corners that two facets both name first in both, in the same order. Returns how many there are.
int put_common_first(Corners& a, Corners& b) {
  int common = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto first_left = b.begin() + common;
    if (std::find(b.begin(), first_left, a[i]) != first_left) continue;  // named twice
    const auto same = std::find(first_left, b.end(), a[i]);
    if (same == b.end()) continue;
    std::iter_swap(same, first_left);
    std::swap(a[i], a[static_cast<std::size_t>(common++)]);
  }
  return common;
}

Triangle triangle_of(const ClusteredMesh& mesh, const Corners& c) {
  return {mesh.position(c[0]), mesh.position(c[1]), mesh.position(c[2])};
}

}  // namespace

struct SelfFacetSearch::Memory {
  // Clusters that stay open, 14 kB each, of which 8 are used: neighbours come soon again. With 32 the rolled sheet of
  // 13 k took 1.22 ms instead of 1.17, with 128 as much.
  OpenClusters<OpenFacets, 64> opened;
  ClusterPlaces places;  // in the first cluster of a pair
  CommonVertices common;
  std::uint64_t excluded[kClusterSize], neighbors[kClusterSize];
  BlockPair blocks;
  std::vector<Vec3> sides;
  std::vector<std::pair<int, bool>> hubs;  // vertices of many facets, and whether these lie open

  bool lie_open_at(const ClusteredMesh& mesh, const VertexFans& fans, int vertex);
  bool list_neighbors(const ClusteredMesh& mesh, const VertexFans& fans, OpenFacets& a, bool within);
  void decide_neighbors(const ClusteredMesh& mesh, const OpenFacets& a, const OpenFacets& b,
                        std::vector<FacetPair>& found);
};

SelfFacetSearch::SelfFacetSearch() : memory_(std::make_unique<Memory>()) {}
SelfFacetSearch::~SelfFacetSearch() = default;
SelfFacetSearch::SelfFacetSearch(SelfFacetSearch&&) noexcept = default;
SelfFacetSearch& SelfFacetSearch::operator=(SelfFacetSearch&&) noexcept = default;

// A vertex of many facets is one of many clusters.
bool SelfFacetSearch::Memory::lie_open_at(const ClusteredMesh& mesh, const VertexFans& fans, int vertex) {
  if (fans.around(vertex).size() <= kClusterSize) return fans.lie_open(mesh, vertex, sides);
  const auto known = std::ranges::find(hubs, vertex, &std::pair<int, bool>::first);
  if (known != hubs.end()) return known->second;
  return hubs.emplace_back(vertex, fans.lie_open(mesh, vertex, sides)).second;
}

// For each facet of `a` those of the other cluster, or later ones of the same, with which it has vertices in common,
// but none at which facets lie open. Returns whether there are any.
bool SelfFacetSearch::Memory::list_neighbors(const ClusteredMesh& mesh, const VertexFans& fans, OpenFacets& a,
                                             bool within) {
  std::fill_n(neighbors, a.block.count, 0);
  const auto is_open = [&](const CommonVertex& vertex) {
    return a.lie_open(vertex.place, [&](int v) { return lie_open_at(mesh, fans, v); });
  };
  bool any = false;
  for (const CommonVertex& vertex : common.all()) {
    if (is_open(vertex)) continue;
    any = true;
    add_pairs_at(vertex, neighbors);
  }
  if (!any) return false;
  for (const CommonVertex& vertex : common.all()) {
    if (!is_open(vertex)) continue;
    for (std::uint64_t left = vertex.of_a; left != 0; left &= left - 1)
      neighbors[std::countr_zero(left)] &= ~vertex.of_b;
  }
  if (within) {
    for (int i = 0; i < a.block.count; ++i) neighbors[i] &= ~(bit(i) | (bit(i) - 1));
  }
  return true;
}

void SelfFacetSearch::Memory::decide_neighbors(const ClusteredMesh& mesh, const OpenFacets& a, const OpenFacets& b,
                                               std::vector<FacetPair>& found) {
  PredicateCounts counts;
  for (int i = 0; i < a.block.count; ++i) {
    for (std::uint64_t left = neighbors[i]; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      Corners of_a = mesh.corners(a.source.facet_begin + i), of_b = mesh.corners(b.source.facet_begin + k);
      const int count = put_common_first(of_a, of_b);
      if (triangles_meet_beyond(triangle_of(mesh, of_a), triangle_of(mesh, of_b), count, counts))
        found.push_back({i, k});
    }
  }
}

void SelfFacetSearch::run(const ClusteredMesh& mesh, const VertexFans& fans, std::span<const ClusterPair> pairs,
                          const base::Tuning& tuning, std::vector<FacetPair>& found) {
  Memory& m = *memory_;
  const Grid grid = grid_over(bounds_of(mesh.box()), kLastCell);
  m.opened.close();
  m.hubs.clear();
  const auto open = [&](int cluster, const OpenFacets* beside) -> OpenFacets& {
    return m.opened.get(
        cluster, [&](OpenFacets& one) { one.open(mesh, cluster, grid); }, beside);
  };
  OpenFacets* first = nullptr;
  int first_cluster = -1;
  ConfirmCounts counts;
  for (const ClusterPair& pair : pairs) {
    if (std::exchange(first_cluster, pair.a) != pair.a) {
      first = &open(pair.a, nullptr);
      m.places.choose(first->source, mesh.vertex_count());
    }
    OpenFacets &a = *first, &b = pair.b == pair.a ? a : open(pair.b, first);
    const Box box_a = mesh.cluster_boxes()[pair.a], box_b = mesh.cluster_boxes()[pair.b];
    const CellBox common = cells_of(grid, bounds_of(intersection(box_a, box_b)));
    const std::uint64_t near_a = kernels().near_facets(a.block.cells, a.facets, common),
                        near_b = kernels().near_facets(b.block.cells, b.facets, common);
    if (near_a == 0 || near_b == 0) continue;
    const bool within = pair.a == pair.b;
    if (within) {
      exclude_within(a, m.excluded);
      find_common_within(a, m.common);
    } else {
      find_common(a, m.places, b, m.common);
      if (m.common.count > 0) std::fill_n(m.excluded, a.block.count, 0);
      for (const CommonVertex& vertex : m.common.all()) add_pairs_at(vertex, m.excluded);
    }
    const bool any_excluded = within || m.common.count > 0;
    const std::size_t before = found.size();
    m.blocks.find_meeting(a.block, near_a, b.block, near_b, bounds_of(merged(box_a, box_b)), grid, tuning, found,
                          counts, any_excluded ? m.excluded : nullptr);
    if (m.common.count > 0 && m.list_neighbors(mesh, fans, a, within)) m.decide_neighbors(mesh, a, b, found);
    const int *const sources_a = mesh.source_facets_of(pair.a), *const sources_b = mesh.source_facets_of(pair.b);
    for (std::size_t i = before; i < found.size(); ++i) {
      const auto [low, high] = std::minmax({sources_a[found[i].a], sources_b[found[i].b]});
      found[i] = {low, high};
    }
  }
  m.places.forget();
}

}  // namespace tact::narrowphase
