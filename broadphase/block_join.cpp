#include "broadphase/block_join.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "engine/base/parallel.h"

namespace tact::broadphase {
namespace {

constexpr std::size_t kMostParts = 64;  // that the work is dealt out in, whatever the number of threads, so that each
                                        // keeps its memory from step to step
constexpr std::size_t kWalkLevel = 1;   // a pair of blocks on this level is walked to its end at once

struct ChildNames {
  explicit ChildNames(std::uint32_t block) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) names[lane] = block * kLanes + lane;
  }
  std::uint32_t names[kLanes];
};

// Appends pairs of children of `blocks`, on `level` > 0, that may hold overlapping boxes of which one is active.
std::size_t child_pairs(const BlockTree& tree, const Kernels& kernels, std::size_t level, IndexPair blocks,
                        IndexPair* out) {
  const ChildNames names_a(blocks.a);
  const ChildNames names_b(blocks.b);
  const std::uint32_t active_a = tree.active(level, blocks.a);
  const std::uint32_t active_b = tree.active(level, blocks.b);
  std::size_t count = 0;
  if (blocks.a == blocks.b) {
    for (std::uint32_t active = active_a; active != 0; active &= active - 1) {
      const std::uint32_t child = names_a.names[std::countr_zero(active)];
      out[count++] = {child, child};
    }
  }
  const BlockSide side_a{tree.blocks(level) + blocks.a, names_a.names, active_a};
  const BlockSide side_b{tree.blocks(level) + blocks.b, names_b.names, active_b};
  std::uint16_t rows;
  kernels.find_rows(tree.blocks(level), &blocks, 1, &rows);
  return count + kernels.find_overlaps(side_a, side_b, rows, out + count).count;
}

constexpr std::size_t kChildRoom = kLanes + kOverlapRoom;

}  // namespace

std::span<const PairList> BlockJoin::run(const BlockTree& tree, std::span<const Box> boxes,
                                         std::span<const Filter> filters, int threads) {
  counts_.clear();
  std::size_t level = tree.level_count() - 1;
  if (tree.block_count(level) == 0) return {};
  work_.clear();
  *work_.room(1) = {0, 0};
  work_.extend(1);
  for (; level > kWalkLevel; --level) {
    next_.clear();
    for (const IndexPair blocks : work_.pairs()) {
      next_.extend(child_pairs(tree, *kernels_, level, blocks, next_.room(kChildRoom)));
    }
    std::swap(work_, next_);
  }
  const std::span<const IndexPair> work = work_.pairs();
  const std::size_t part_count = std::min(work.size(), kMostParts);
  parts_.resize(std::max(parts_.size(), part_count));
  counts_.resize(part_count);
  base::parallel_for(part_count, 1, threads, [&](std::size_t part) {
    const std::size_t begin = work.size() * part / part_count;
    const std::size_t end = work.size() * (part + 1) / part_count;
    Counts counts;
    parts_[part].clear();
    for (std::size_t i = begin; i < end; ++i) walk(tree, boxes, filters, level, work[i], parts_[part], counts);
    counts_[part] = counts;
  });
  return std::span(parts_).first(part_count);
}

std::size_t BlockJoin::visits() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::size_t{0},
                         [](std::size_t sum, const Counts& counts) { return sum + counts.visits; });
}

std::size_t BlockJoin::excluded() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::size_t{0},
                         [](std::size_t sum, const Counts& counts) { return sum + counts.excluded; });
}

// Appends the pairs below a pair of blocks.
void BlockJoin::walk(const BlockTree& tree, std::span<const Box> boxes, std::span<const Filter> filters,
                     std::size_t level, IndexPair blocks, PairList& out, Counts& counts) const {
  IndexPair children[kChildRoom] = {blocks};
  std::size_t count = 1;
  if (level > 0) count = child_pairs(tree, *kernels_, level, blocks, children);
  std::uint16_t rows[kChildRoom];
  kernels_->find_rows(tree.blocks(0), children, count, rows);
  for (std::size_t i = 0; i < count; ++i) {
    if (rows[i] != 0) visit(tree, boxes, filters, children[i], rows[i], out, counts);
  }
  counts.visits += count;
}

void BlockJoin::visit(const BlockTree& tree, std::span<const Box> boxes, std::span<const Filter> filters,
                      IndexPair blocks, std::uint32_t rows, PairList& out, Counts& counts) const {
  const BlockSide side_a{tree.blocks(0) + blocks.a, tree.members(blocks.a), tree.active(0, blocks.a)};
  const BlockSide side_b{tree.blocks(0) + blocks.b, tree.members(blocks.b), tree.active(0, blocks.b)};
  IndexPair* const found = out.room(kOverlapRoom);
  const Overlaps overlaps = kernels_->find_overlaps(side_a, side_b, rows, found);
  IndexPair* end = found + overlaps.count;
  if (!overlaps.certain && !(tree.exact(blocks.a) && tree.exact(blocks.b))) {
    end = std::remove_if(found, end, [&](IndexPair pair) { return !base::overlaps(boxes[pair.a], boxes[pair.b]); });
  }
  if (!filters.empty()) {
    IndexPair* const all = end;
    end = std::remove_if(found, end, [&](IndexPair pair) { return !tested(filters[pair.a], filters[pair.b]); });
    counts.excluded += static_cast<std::size_t>(all - end);
  }
  out.extend(static_cast<std::size_t>(end - found));
}

}  // namespace tact::broadphase
