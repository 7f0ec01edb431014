#include "narrowphase/self/self_facet_pairs.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace tact::narrowphase {

namespace {

constexpr std::uint64_t bit(int i) { return std::uint64_t{1} << i; }

// The facets of a cluster, and which of them have each of its vertices, owned ones first.
struct OpenFacets {
  int cluster = -1;
  ClusterFacets source;
  FacetBlock block;
  std::uint64_t facets = 0;  // a bit each
  std::uint64_t with_vertex[3 * kClusterSize];

  void open(const ClusteredMesh& mesh, int wanted, const Grid& grid) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr CullPlanes kAll{
        {0, 0, 0, 0, 0, 0}, -kInfinity, {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}};
    cluster = wanted;
    source = mesh.facets_of(wanted);
    block.count = block.cells.count = 0;
    kernels().open_cluster(source, kAll, &block);
    kernels().find_cells(grid, &block);
    facets = ~std::uint64_t{0} >> (kClusterSize - block.count);
    std::fill_n(with_vertex, source.owned_count + source.borrowed_count, 0);
    for (const std::uint8_t* corner : source.corner) {
      for (int i = 0; i < block.count; ++i) with_vertex[corner[i]] |= bit(i);
    }
  }

  // Where a vertex is among those of the cluster, or -1.
  int place_of(int vertex) const {
    const int owned = vertex - source.owned_begin;
    if (owned >= 0 && owned < source.owned_count) return owned;
    const std::int32_t* const end = source.borrowed + source.borrowed_count;
    const auto found = std::find(source.borrowed, end, vertex);
    return found == end ? -1 : source.owned_count + static_cast<int>(found - source.borrowed);
  }
};

// For each facet of `a` those of the same cluster that come before it, itself, and those that share a vertex with it.
void exclude_within(const OpenFacets& a, std::uint64_t (&excluded)[kClusterSize]) {
  for (int i = 0; i < a.block.count; ++i) {
    excluded[i] = bit(i) | (bit(i) - 1);
    for (const std::uint8_t* corner : a.source.corner) excluded[i] |= a.with_vertex[corner[i]];
  }
}

// For each facet of `a` those of a later cluster that share a vertex with it. These the later one has borrowed.
void exclude_sharing(const OpenFacets& a, const OpenFacets& b, std::uint64_t (&excluded)[kClusterSize]) {
  std::fill_n(excluded, a.block.count, 0);
  for (int k = 0; k < b.source.borrowed_count; ++k) {
    const int place = a.place_of(b.source.borrowed[k]);
    if (place < 0) continue;
    for (std::uint64_t left = a.with_vertex[place]; left != 0; left &= left - 1)
      excluded[std::countr_zero(left)] |= b.with_vertex[b.source.owned_count + k];
  }
}

}  // namespace

struct SelfFacetSearch::Memory {
  static constexpr std::size_t kOpened = 16;  // clusters that stay open: neighbours come soon again
  OpenFacets a, b[kOpened];
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
  m.a.cluster = -1;
  for (OpenFacets& one : m.b) one.cluster = -1;
  ConfirmCounts counts;
  for (const ClusterPair& pair : pairs) {
    if (m.a.cluster != pair.a) m.a.open(mesh, pair.a, grid);
    OpenFacets& other = m.b[static_cast<std::size_t>(pair.b) % Memory::kOpened];
    if (pair.b != pair.a && other.cluster != pair.b) other.open(mesh, pair.b, grid);
    const OpenFacets &a = m.a, &b = pair.b == pair.a ? m.a : other;
    const Box box_a = mesh.cluster_boxes()[static_cast<std::size_t>(pair.a)],
              box_b = mesh.cluster_boxes()[static_cast<std::size_t>(pair.b)];
    const CellBox common = cells_of(grid, bounds_of(intersection(box_a, box_b)));
    const std::uint64_t near_a = kernels().near_facets(a.block.cells, a.facets, common),
                        near_b = kernels().near_facets(b.block.cells, b.facets, common);
    if (near_a == 0 || near_b == 0) continue;
    if (pair.a == pair.b) {
      exclude_within(a, m.excluded);
    } else {
      exclude_sharing(a, b, m.excluded);
    }
    const std::size_t before = found.size();
    m.blocks.find_meeting(a.block, near_a, b.block, near_b, bounds_of(merged(box_a, box_b)), grid, tuning, found,
                          counts, m.excluded);
    for (std::size_t i = before; i < found.size(); ++i) {
      const auto [first, second] =
          std::minmax({mesh.source_facet(a.block.facet[found[i].a]), mesh.source_facet(b.block.facet[found[i].b])});
      found[i] = {first, second};
    }
  }
}

}  // namespace tact::narrowphase
