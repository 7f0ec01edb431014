#include "narrowphase/pairs/cluster_join.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tact::narrowphase {

namespace {

// Pairs of boxes, up to which all are compared, at half a nanosecond to one each; of more, runs of boxes first, which
// of 8,000 boxes and 1,300 leaves 0.3 ms where a tree over the boxes themselves took 1.1 (tact-bench rivals, drape 606
// k).
constexpr std::size_t kFewBoxPairs = 4096;

constexpr int kRun = 32;

int runs_of(int count) { return (count + kRun - 1) / kRun; }

BoxBounds bounds_of_run(const KeptClusters& kept, int run) {
  return kernels().bounds(kept.boxes.view().pointers(run * kRun), std::min(kRun, kept.count() - run * kRun));
}

}  // namespace

void ClusterJoin::run(const KeptClusters& a, const KeptClusters& b, BoxPairs wanted, const base::Tuning& tuning,
                      EmbreeDevice& device, std::vector<ClusterPair>& pairs) {
  pairs.clear();
  find(0, begin(a, b, wanted, tuning, device), memory_, pairs);
}

int ClusterJoin::begin(const KeptClusters& a, const KeptClusters& b, BoxPairs wanted, const base::Tuning& tuning,
                       EmbreeDevice& device) {
  const std::size_t all = a.cluster.size() * b.cluster.size();
  a_ = &a;
  b_ = &b;
  wanted_ = wanted;
  way_ = all > tuning.largest_loop ? Way::trees : all > kFewBoxPairs ? Way::runs : Way::each;
  if (all == 0) return 0;
  if (way_ != Way::each) {
    const int runs = runs_of(b.count());
    run_boxes_.resize(static_cast<std::size_t>(runs));
    for (int r = 0; r < runs; ++r) run_boxes_.set(static_cast<std::size_t>(r), to_box(bounds_of_run(b, r)));
    if (way_ == Way::trees) forest_.build(device, run_boxes_.view(), runs);
  }
  return runs_of(a.count());
}

void ClusterJoin::find(int begin, int end, Memory& memory, std::vector<ClusterPair>& pairs) const {
  if (begin == end) return;
  const std::size_t size = b_->cluster.size();
  if (memory.found.size() < size) memory.found.resize(size);
  if (way_ == Way::each) return find_in_each(begin * kRun, std::min(end * kRun, a_->count()), memory, pairs);
  memory.near.resize(size);
  memory.place.reserve(size);
  for (int run = begin; run < end; ++run) find_in_run(run, memory, pairs);
}

void ClusterJoin::find_in_each(int begin, int end, Memory& memory, std::vector<ClusterPair>& pairs) const {
  for (int i = begin; i < end; ++i) {
    const int first = wanted_ == BoxPairs::ascending ? std::min(i, b_->count()) : 0;
    const int found = kernels().select_overlapping(b_->boxes.view().pointers(first), b_->count() - first,
                                                   a_->boxes.bounds(static_cast<std::size_t>(i)), memory.found.data());
    for (int k = 0; k < found; ++k) pairs.push_back({i, first + memory.found[k]});
  }
}

void ClusterJoin::find_in_run(int run, Memory& memory, std::vector<ClusterPair>& pairs) const {
  const BoxBounds bounds = bounds_of_run(*a_, run);
  find_near_runs(bounds, wanted_ == BoxPairs::ascending ? run : 0, memory);
  find_near(bounds, memory);
  const std::vector<std::int32_t>& place = memory.place;
  const int near = static_cast<int>(place.size());
  int first = 0;
  for (int i = run * kRun; i < std::min((run + 1) * kRun, a_->count()); ++i) {
    while (wanted_ == BoxPairs::ascending && first < near && place[first] < i) ++first;
    if (first == near) break;
    const int found = kernels().select_overlapping(memory.near.view().pointers(first), near - first,
                                                   a_->boxes.bounds(static_cast<std::size_t>(i)), memory.found.data());
    for (int k = 0; k < found; ++k) pairs.push_back({i, place[first + memory.found[k]]});
  }
}

// The runs of B from `first` on, ascending.
void ClusterJoin::find_near_runs(const BoxBounds& run, int first, Memory& memory) const {
  std::vector<std::int32_t>& near = memory.near_runs;
  near.clear();
  if (way_ == Way::trees) {
    forest_.query(to_box(run), memory.stack, near);
    std::erase_if(near, [&](std::int32_t one) { return one < first; });
    std::ranges::sort(near);
    return;
  }
  const int left = runs_of(b_->count()) - first;
  if (left <= 0) return;
  near.resize(left);
  near.resize(kernels().select_overlapping(run_boxes_.view().pointers(first), left, run, near.data()));
  for (std::int32_t& one : near) one += first;
}

void ClusterJoin::find_near(const BoxBounds& run, Memory& memory) const {
  memory.place.clear();
  for (const std::int32_t near : memory.near_runs) {
    const int begin = near * kRun;
    const int found = kernels().select_overlapping(b_->boxes.view().pointers(begin),
                                                   std::min(kRun, b_->count() - begin), run, memory.found.data());
    for (int i = 0; i < found; ++i) {
      const std::int32_t place = begin + memory.found[i];
      memory.near.set(memory.place.size(), b_->boxes[place]);
      memory.place.push_back(place);
    }
  }
}

void ClusterJoin::exchange_meshes(std::vector<ClusterPair>& pairs, int clusters) {
  std::vector<std::int32_t>& place = memory_.found;
  place.assign(static_cast<std::size_t>(clusters) + 1, 0);
  for (const ClusterPair& pair : pairs) ++place[static_cast<std::size_t>(pair.b) + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  exchanged_.resize(pairs.size());
  for (const ClusterPair& pair : pairs) exchanged_[place[pair.b]++] = {pair.b, pair.a};
  std::swap(exchanged_, pairs);
}

}  // namespace tact::narrowphase
