#include "tests/support/oracles/box_pairs.h"

namespace tact::tests {

std::vector<broadphase::IndexPair> all_overlapping_pairs(std::span<const base::Box> boxes,
                                                         std::span<const broadphase::Filter> filters) {
  std::vector<broadphase::IndexPair> pairs;
  for (std::uint32_t a = 0; a < boxes.size(); ++a) {
    if (boxes[a].empty()) continue;
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
      if (boxes[b].empty() || !base::overlaps(boxes[a], boxes[b])) continue;
      const bool layers_agree = (filters[a].mask & filters[b].layer) != 0 && (filters[b].mask & filters[a].layer) != 0;
      if (layers_agree && !(filters[a].fixed && filters[b].fixed)) pairs.push_back({a, b});
    }
  }
  return pairs;
}

}  // namespace tact::tests
