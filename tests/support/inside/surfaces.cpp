#include "tests/support/inside/surfaces.h"

#include <algorithm>
#include <limits>

namespace tact::tests {

using namespace narrowphase;

const std::vector<FacetPair>& SurfaceSearch::operator()(const ClusteredMesh& a, const ClusteredMesh& b,
                                                        SurfaceHistory* history, std::size_t ranges) {
  const Criteria all{.outward = {0, 0, 1}, .lowest = -std::numeric_limits<double>::infinity()};
  cull_clusters(a, all, b.box(), kept_a_);
  cull_clusters(b, all, kept_a_.bounds, kept_b_);
  join_.run(kept_a_, kept_b_, BoxPairs::all, base::kTuning, device_, pairs_);
  ConfirmInput input{.a = &a, .b = &b, .criteria_a = all, .criteria_b = all, .kept_a = &kept_a_, .kept_b = &kept_b_};
  input.as_surfaces = true;
  if (history != nullptr && history->start(input, pairs_)) input.history = history;
  found_.clear();
  counts_ = {};
  opened_ = 0;
  for (std::size_t i = 0, begin = 0; i < ranges; ++i) {
    std::size_t end = pairs_.size() * (i + 1) / ranges;
    while (end > begin && end < pairs_.size() && pairs_[end].a == pairs_[end - 1].a) ++end;
    search_.run(input, pairs_, begin, end, found_, counts_);
    opened_ += search_.opened_a().size();
    begin = std::max(begin, end);
  }
  if (input.history != nullptr) input.history->finish(counts_.still_apart);
  std::ranges::sort(found_);
  return found_;
}

}  // namespace tact::tests
