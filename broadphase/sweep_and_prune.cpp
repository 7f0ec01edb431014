#include "broadphase/sweep_and_prune.h"

#include <algorithm>
#include <numeric>

namespace tact::broadphase {
namespace {

bool tested(const Filter& a, const Filter& b) {
  return (a.layer & b.mask) != 0 && (b.layer & a.mask) != 0 && !(a.fixed && b.fixed);
}

}  // namespace

std::span<const IndexPair> SweepAndPrune::update(std::span<const Box> boxes, std::span<const Filter> filters,
                                                 std::span<const std::uint32_t> changed, int /*threads*/) {
  if (changed.empty() && boxes.size() == size_) return pairs_;
  size_ = boxes.size();
  pairs_.clear();
  order_.clear();
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].empty()) order_.push_back(i);
  }
  std::sort(order_.begin(), order_.end(),
            [&](std::uint32_t i, std::uint32_t j) { return boxes[i].lower.x < boxes[j].lower.x; });
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const std::uint32_t a = order_[i];
    for (std::size_t j = i + 1; j < order_.size() && boxes[order_[j]].lower.x <= boxes[a].upper.x; ++j) {
      const std::uint32_t b = order_[j];
      if (overlaps(boxes[a], boxes[b]) && tested(filters[a], filters[b]))
        pairs_.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace tact::broadphase
