#include "narrowphase/triangles/confirm.h"

#include <algorithm>

namespace tact::narrowphase {

namespace {

// Two bodies are taken to lie on each other if one of them keeps a quarter of its clusters (tact-bench rivals: cloth
// 13 k 1.2 times as fast, sheets in layers 2.5; but two of 500 k, in shallow overlap, 0.87) and a cluster has few
// others near it: those of a soup have hundreds, and no plane separates them. A cluster of the coarser body may have
// more: where it has hundreds, one of its facets is as large as a cluster of the other body, and the boxes of facets
// tell more than a plane (cloth 152 k, 170 of them: 0.94 of the time by planes; cloth 606 k, 650: 1.10).
constexpr std::size_t kMostNeighbours = 16, kMostOfCoarser = 256;
constexpr int kMostOfBody = 4;

}  // namespace

bool worth_as_surfaces(const ConfirmInput& input, std::size_t cluster_pairs) {
  if (cluster_pairs < input.tuning->worth_as_surfaces) return false;
  const int kept_a = input.kept_a->count(), kept_b = input.kept_b->count();
  return cluster_pairs <= kMostNeighbours * static_cast<std::size_t>(std::max(kept_a, kept_b)) &&
         cluster_pairs <= kMostOfCoarser * static_cast<std::size_t>(std::min(kept_a, kept_b)) &&
         (kMostOfBody * kept_a >= input.a->cluster_count() || kMostOfBody * kept_b >= input.b->cluster_count());
}

FacetPairSearch::FacetPairSearch() {
  constexpr std::size_t kClusters = 64, kBlocks = 4;
  wanted_.reserve(kBlocks);
  wanted_by_next_.reserve(kClusters);
  place_.reserve(kClusters);
  opened_a_.reserve(kClusters);
  opened_b_.reserve(kClusters);
  b_.reserve(kClusters);
  for (std::size_t i = 0; i < kBlocks; ++i) b_.push_back(std::make_unique<BlockOfB>());
}

void FacetPairSearch::run(const ConfirmInput& input, const std::vector<ClusterPair>& pairs, std::size_t begin,
                          std::size_t end, std::vector<FacetPair>& found, ConfirmCounts& counts) {
  as_surfaces_ = input.as_surfaces;
  if (as_surfaces_) return surfaces_.run(input, pairs, begin, end, found, counts);
  grid_ = grid_over(bounds_of(intersection(input.kept_a->bounds, input.kept_b->bounds)), kLastCell);
  opened_a_.clear();
  opened_b_.clear();
  blocks_of_b_ = 0;
  wanted_.clear();
  a_.clear();
  place_.assign(input.kept_b->count(), {});
  for (std::size_t i = begin; i < end;) {
    const std::int32_t a = pairs[i].a;
    const Box box = input.kept_a->boxes[a];
    const CellBox cells = cells_of(grid_, bounds_of(box));
    wanted_by_next_.clear();
    for (; i < end && pairs[i].a == a; ++i) {
      if (reaches_b(input, pairs[i].b, box, cells)) wanted_by_next_.push_back(place_[pairs[i].b].block);
    }
    if (!wanted_by_next_.empty()) append_a(input, a, found, counts);
  }
  finish_block(input, found, counts);
}

// True if some facet of a cluster of B may meet something in a box, which reaches `cells`, by its box and the planes of
// the facets.
bool FacetPairSearch::reaches_b(const ConfirmInput& input, std::int32_t index, const Box& box, const CellBox& cells) {
  const PlaceInB place = open_b(input, index);
  if (place.facets == 0) return false;
  if (!input.tuning->asks_near_facets) return true;
  const Box both = merged(input.kept_b->boxes[index], box);
  const FacetBlock& block = b_[place.block]->kept.block;
  return kernels().any_near(block, place.facets, cells, bounds_of(box), bounds_of(both));
}

FacetPairSearch::PlaceInB FacetPairSearch::open_b(const ConfirmInput& input, std::int32_t index) {
  PlaceInB& place = place_[index];
  if (place.block >= 0) return place;
  const std::int32_t cluster = input.kept_b->cluster[index];
  opened_b_.push_back({index, {}});
  const auto append = [&](KeptFacets& kept) {
    return append_facets(*input.b, cluster, input.criteria_b, input.kept_a->bounds, kept, opened_b_.back().counts);
  };
  std::uint64_t before = blocks_of_b_ > 0 ? b_[blocks_of_b_ - 1]->kept.facets : 0;
  if (blocks_of_b_ == 0 || !append(b_[blocks_of_b_ - 1]->kept)) {
    if (b_.size() == blocks_of_b_) b_.push_back(std::make_unique<BlockOfB>());
    BlockOfB& fresh = *b_[blocks_of_b_++];
    fresh.kept.clear();
    fresh.wanted = false;
    before = 0;
    append(fresh.kept);
  }
  kernels().find_cells(grid_, &b_[blocks_of_b_ - 1]->kept.block);
  place = {static_cast<std::int32_t>(blocks_of_b_ - 1), b_[blocks_of_b_ - 1]->kept.facets & ~before};
  return place;
}

void FacetPairSearch::append_a(const ConfirmInput& input, std::int32_t index, std::vector<FacetPair>& found,
                               ConfirmCounts& counts) {
  const std::int32_t cluster = input.kept_a->cluster[index];
  opened_a_.push_back({index, {}});
  const auto append = [&] {
    return append_facets(*input.a, cluster, input.criteria_a, input.kept_b->bounds, a_, opened_a_.back().counts);
  };
  if (!append()) {
    finish_block(input, found, counts);
    append();
  }
  for (const std::int32_t block : wanted_by_next_) {
    BlockOfB& b = *b_[block];
    if (!b.wanted) wanted_.push_back(block);
    b.wanted = true;
  }
}

// Holds the block of A against those of B that it may touch, and empties it.
void FacetPairSearch::finish_block(const ConfirmInput& input, std::vector<FacetPair>& found, ConfirmCounts& counts) {
  for (const std::int32_t block : wanted_) {
    BlockOfB& b = *b_[block];
    test_blocks(input, b.kept, found, counts);
    b.wanted = false;
  }
  wanted_.clear();
  a_.clear();
}

// Of each block only the facets near the other are looked at.
void FacetPairSearch::test_blocks(const ConfirmInput& input, const KeptFacets& b, std::vector<FacetPair>& found,
                                  ConfirmCounts& counts) {
  std::uint64_t near_a = a_.facets, near_b = b.facets;
  kernels().find_cells(grid_, &a_.block);
  const std::size_t in_blocks = a_.block.count + b.block.count;
  if (in_blocks > input.tuning->few_in_blocks) {
    const CellBox common = cells_of(grid_, bounds_of(intersection(a_.bounds, b.bounds)));
    near_b = kernels().near_facets(b.block.cells, near_b, common);
    if (near_b == 0) return;
    near_a = kernels().near_facets(a_.block.cells, near_a, kernels().cells_of(b.block.cells, near_b));
  }
  const std::size_t before = found.size();
  const BoxBounds bounds = bounds_of(merged(a_.bounds, b.bounds));
  block_pair_.find_meeting(a_.block, near_a, b.block, near_b, bounds, grid_, *input.tuning, found, counts);
  for (std::size_t i = before; i < found.size(); ++i) {
    FacetPair& pair = found[i];
    pair = {input.a->source_facet(a_.block.facet[pair.a]), input.b->source_facet(b.block.facet[pair.b])};
  }
}

}  // namespace tact::narrowphase
