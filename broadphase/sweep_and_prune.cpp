#include "broadphase/sweep_and_prune.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "engine/base/floating_point_mode.h"

namespace tact::broadphase {
namespace {

constexpr std::size_t kThreadShare = 2048;  // changed boxes for which one more thread is worth waking

std::vector<std::uint32_t> all_indices(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

}  // namespace

std::span<const IndexPair> SweepAndPrune::update(std::span<const Box> boxes, std::span<const Filter> filters,
                                                 std::span<const std::uint32_t> changed, int threads,
                                                 const base::Tuning& tuning) {
  assert(boxes.size() == filters.size());
  std::vector<std::uint32_t> all;
  if (!tuning.carries_order) {  // as in the first call
    tree_is_current_ = false;
    all = all_indices(boxes.size());
    changed = all;
  }
  excluded_ = 0;
  pairs_changed_ = false;
  if (changed.empty() && boxes.size() == box_count_) return pairs_;
  const base::FloatingPointMode mode;
  box_count_ = boxes.size();
  const std::size_t changed_count = mark(filters, changed);
  const bool few = boxes.size() <= tuning.few_boxes;
  const auto fresh = few ? compare_all(boxes, filters) : join_changed(boxes, filters, changed, changed_count, threads);
  if (changed_count == boxes.size()) {
    pairs_changed_ = !std::ranges::equal(fresh, pairs_);
    if (pairs_changed_) pairs_.assign(fresh.begin(), fresh.end());
  } else {
    merge(fresh, boxes.size());
  }
  for (const std::uint32_t index : changed) is_changed_[index] = 0;
  return pairs_;
}

// Few boxes need no order.
std::span<const IndexPair> SweepAndPrune::compare_all(std::span<const Box> boxes, std::span<const Filter> filters) {
  tree_is_current_ = false;
  few_.clear();
  for (std::uint32_t a = 0; a < boxes.size(); ++a) {
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
      if ((is_changed_[a] | is_changed_[b]) == 0 || !base::overlaps(boxes[a], boxes[b])) continue;
      if (!occupied(boxes[a]) || !occupied(boxes[b])) continue;
      if (tested(filters[a], filters[b])) {
        few_.push_back({a, b});
      } else {
        ++excluded_;
      }
    }
  }
  return few_;
}

// The pairs in which a box changed.
std::span<const IndexPair> SweepAndPrune::join_changed(std::span<const Box> boxes, std::span<const Filter> filters,
                                                       std::span<const std::uint32_t> changed,
                                                       std::size_t changed_count, int threads) {
  threads = static_cast<int>(
      std::min<std::size_t>(static_cast<std::size_t>(std::max(threads, 1)), 1 + changed_count / kThreadShare));
  if (std::exchange(tree_is_current_, true)) {
    tree_.update(boxes, changed, is_changed_, threads);
  } else {
    tree_ = BlockTree();
    tree_.update(boxes, all_indices(boxes.size()), is_changed_, threads);
  }
  const auto parts = join_.run(tree_, boxes, special_count_ == 0 ? std::span<const Filter>{} : filters, threads);
  tree_.note_cost(join_.visits(), changed_count);
  excluded_ = join_.excluded();
  return sorter_.sort(parts, boxes.size(), threads);
}

// Takes over the filters of the changed boxes and marks them; returns how many there are, each counted once.
std::size_t SweepAndPrune::mark(std::span<const Filter> filters, std::span<const std::uint32_t> changed) {
  for (std::size_t index = filters.size(); index < is_special_.size(); ++index) special_count_ -= is_special_[index];
  is_changed_.resize(filters.size(), 0);
  is_special_.resize(filters.size(), 0);
  std::size_t count = 0;
  for (const std::uint32_t index : changed) {
    count += is_changed_[index] == 0;
    is_changed_[index] = 1;
    const std::uint8_t special = filters[index] != Filter{};
    special_count_ += special;
    special_count_ -= std::exchange(is_special_[index], special);
  }
  return count;
}

// Replaces the pairs in which a box changed or is gone by the fresh ones.
void SweepAndPrune::merge(std::span<const IndexPair> fresh, std::size_t box_count) {
  merged_.clear();
  auto next = fresh.begin();
  for (const IndexPair pair : pairs_) {
    if (pair.b >= box_count || is_changed_[pair.a] != 0 || is_changed_[pair.b] != 0) continue;
    for (; next != fresh.end() && *next < pair; ++next) merged_.push_back(*next);
    merged_.push_back(pair);
  }
  merged_.insert(merged_.end(), next, fresh.end());
  pairs_changed_ = pairs_ != merged_;
  std::swap(pairs_, merged_);
}

}  // namespace tact::broadphase
