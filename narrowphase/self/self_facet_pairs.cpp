#include "narrowphase/self/self_facet_pairs.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "narrowphase/pairs/open_clusters.h"

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
    facets = ~std::uint64_t{0} >> (kClusterSize - block.count);
    listed_ = false;
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

 private:
  bool listed_ = false;
  std::uint64_t with_vertex_[3 * kClusterSize];
};

// For each facet of `a` those of the same cluster that come before it, itself, and those that share a vertex with it.
void exclude_within(OpenFacets& a, std::uint64_t (&excluded)[kClusterSize]) {
  const std::uint64_t* const with_vertex = a.with_vertex();
  for (int i = 0; i < a.block.count; ++i) {
    excluded[i] = bit(i) | (bit(i) - 1);
    for (const std::uint8_t* corner : a.source.corner) excluded[i] |= with_vertex[corner[i]];
  }
}

// Where the vertices of a cluster are among its own, for those of all others -1.
class Places {
 public:
  void choose(const OpenFacets& cluster, int vertex_count) {
    forget();
    if (place_.size() != static_cast<std::size_t>(vertex_count)) place_.assign(vertex_count, -1);
    chosen_ = cluster.source;
    for (int i = 0; i < chosen_.borrowed_count; ++i) place(chosen_.borrowed[i]) = chosen_.owned_count + i;
  }
  void forget() {
    for (int i = 0; i < chosen_.borrowed_count; ++i) place(chosen_.borrowed[i]) = -1;
    chosen_ = {};
  }
  int operator[](int vertex) const {
    const int owned = vertex - chosen_.owned_begin;
    return owned >= 0 && owned < chosen_.owned_count ? owned : place_[vertex];
  }

 private:
  int& place(int vertex) { return place_[vertex]; }

  ClusterFacets chosen_{};
  std::vector<int> place_;  // of each vertex of the mesh among the borrowed ones
};

// For each facet of `a` those of a later cluster that share a vertex with it. These the later one has borrowed. Returns
// whether there are any; if not, nothing is written.
bool exclude_sharing(OpenFacets& a, const Places& places_in_a, OpenFacets& b, std::uint64_t (&excluded)[kClusterSize]) {
  bool any = false;
  for (int k = 0; k < b.source.borrowed_count; ++k) {
    const int place = places_in_a[b.source.borrowed[k]];
    if (place < 0) continue;
    if (!std::exchange(any, true)) std::fill_n(excluded, a.block.count, 0);
    const std::uint64_t of_b = b.with_vertex()[b.source.owned_count + k];
    for (std::uint64_t left = a.with_vertex()[place]; left != 0; left &= left - 1)
      excluded[std::countr_zero(left)] |= of_b;
  }
  return any;
}

}  // namespace

struct SelfFacetSearch::Memory {
  // Clusters that stay open, 14 kB each, of which 8 are used: neighbours come soon again. With 32 the rolled sheet of
  // 13 k took 1.22 ms instead of 1.17, with 128 as much.
  OpenClusters<OpenFacets, 64> opened;
  Places places;  // in the first cluster of a pair
  std::uint64_t excluded[kClusterSize];
  BlockPair blocks;
};

SelfFacetSearch::SelfFacetSearch() : memory_(std::make_unique<Memory>()) {}
SelfFacetSearch::~SelfFacetSearch() = default;
SelfFacetSearch::SelfFacetSearch(SelfFacetSearch&&) noexcept = default;
SelfFacetSearch& SelfFacetSearch::operator=(SelfFacetSearch&&) noexcept = default;

void SelfFacetSearch::run(const ClusteredMesh& mesh, std::span<const ClusterPair> pairs, const base::Tuning& tuning,
                          std::vector<FacetPair>& found) {
  Memory& m = *memory_;
  const Grid grid = grid_over(bounds_of(mesh.box()), kLastCell);
  m.opened.close();
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
      m.places.choose(*first, mesh.vertex_count());
    }
    OpenFacets &a = *first, &b = pair.b == pair.a ? a : open(pair.b, first);
    const Box box_a = mesh.cluster_boxes()[pair.a], box_b = mesh.cluster_boxes()[pair.b];
    const CellBox common = cells_of(grid, bounds_of(intersection(box_a, box_b)));
    const std::uint64_t near_a = kernels().near_facets(a.block.cells, a.facets, common),
                        near_b = kernels().near_facets(b.block.cells, b.facets, common);
    if (near_a == 0 || near_b == 0) continue;
    bool any_excluded = true;
    if (pair.a == pair.b) {
      exclude_within(a, m.excluded);
    } else {
      any_excluded = exclude_sharing(a, m.places, b, m.excluded);
    }
    const std::size_t before = found.size();
    m.blocks.find_meeting(a.block, near_a, b.block, near_b, bounds_of(merged(box_a, box_b)), grid, tuning, found,
                          counts, any_excluded ? m.excluded : nullptr);
    const int *const sources_a = mesh.source_facets_of(pair.a), *const sources_b = mesh.source_facets_of(pair.b);
    for (std::size_t i = before; i < found.size(); ++i) {
      const auto [low, high] = std::minmax({sources_a[found[i].a], sources_b[found[i].b]});
      found[i] = {low, high};
    }
  }
  m.places.forget();
}

}  // namespace tact::narrowphase
