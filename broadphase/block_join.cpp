#include "broadphase/block_join.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/base/parallel.h"

namespace tact::broadphase {
namespace {

constexpr std::size_t kParts = 64;     // the work is dealt out in this many parts, whatever the number of threads,
                                       // so that each keeps its memory from step to step
constexpr std::size_t kWalkLevel = 1;  // from this level down, a pair of blocks is walked to its end at once

}  // namespace

std::span<const std::vector<IndexPair>> BlockJoin::run(const BlockTree& tree, std::span<const Filter> filters,
                                                       int threads) {
  parts_.resize(kParts);
  for (auto& part : parts_) part.clear();
  std::size_t level = tree.level_count() - 1;
  if (tree.block_count(level) == 0) return {};
  work_.assign(1, {0, 0});
  for (; level > kWalkLevel; --level) expand(tree, level);
  base::parallel_for(kParts, 1, threads, [&](std::size_t part) {
    const std::size_t begin = work_.size() * part / kParts;
    const std::size_t end = work_.size() * (part + 1) / kParts;
    for (std::size_t i = begin; i < end; ++i) join(tree, level, work_[i], filters, parts_[part]);
  });
  return parts_;
}

// Calls visit(lane of a, lane of b) for each pair of lanes that overlap and of which one is active; in a block against
// itself, for each such pair once.
template <class Visit>
void BlockJoin::visit_lanes(const BlockTree& tree, std::size_t level, BlockPair pair, const Visit& visit) const {
  std::uint16_t columns[kLanes];
  const std::uint32_t active_a = tree.active(level, pair.a);
  const std::uint32_t active_b = tree.active(level, pair.b);
  std::uint32_t rows = kernel_(tree.block(level, pair.a), tree.block(level, pair.b), columns);
  for (; rows != 0; rows &= rows - 1) {
    const auto row = static_cast<std::uint32_t>(std::countr_zero(rows));
    std::uint32_t lanes = columns[row];
    if (!(active_a >> row & 1u)) lanes &= active_b;
    if (pair.a == pair.b) lanes &= ~((2u << row) - 1);
    for (; lanes != 0; lanes &= lanes - 1) visit(row, static_cast<std::uint32_t>(std::countr_zero(lanes)));
  }
}

// Replaces the pairs in work_, of blocks on `level`, by those on the level below.
void BlockJoin::expand(const BlockTree& tree, std::size_t level) {
  next_.clear();
  for (const BlockPair pair : work_) {
    if (pair.a == pair.b) {
      for (std::uint32_t active = tree.active(level, pair.a); active != 0; active &= active - 1) {
        const std::uint32_t child = pair.a * kLanes + static_cast<std::uint32_t>(std::countr_zero(active));
        next_.push_back({child, child});
      }
    }
    visit_lanes(tree, level, pair, [&](std::uint32_t row, std::uint32_t column) {
      next_.push_back({pair.a * kLanes + row, pair.b * kLanes + column});
    });
  }
  std::swap(work_, next_);
}

void BlockJoin::join(const BlockTree& tree, std::size_t level, BlockPair pair, std::span<const Filter> filters,
                     std::vector<IndexPair>& out) const {
  if (level == 0) {
    const std::uint32_t* members_a = tree.members(pair.a);
    const std::uint32_t* members_b = tree.members(pair.b);
    visit_lanes(tree, level, pair, [&](std::uint32_t row, std::uint32_t column) {
      const auto [a, b] = std::minmax(members_a[row], members_b[column]);
      if (filters.empty() || tested(filters[a], filters[b])) out.push_back({a, b});
    });
    return;
  }
  if (pair.a == pair.b) {
    for (std::uint32_t active = tree.active(level, pair.a); active != 0; active &= active - 1) {
      const std::uint32_t child = pair.a * kLanes + static_cast<std::uint32_t>(std::countr_zero(active));
      join(tree, level - 1, {child, child}, filters, out);
    }
  }
  visit_lanes(tree, level, pair, [&](std::uint32_t row, std::uint32_t column) {
    join(tree, level - 1, {pair.a * kLanes + row, pair.b * kLanes + column}, filters, out);
  });
}

}  // namespace tact::broadphase
