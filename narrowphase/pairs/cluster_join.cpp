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
  const std::size_t all = a.cluster.size() * b.cluster.size(), size = b.cluster.size();
  a_ = &a;
  b_ = &b;
  wanted_ = wanted;
  way_ = all > tuning.largest_loop ? Way::trees : all > kFewBoxPairs ? Way::runs : Way::each;
  pairs.clear();
  if (all == 0) return;
  if (found_.size() < size) found_.resize(size);
  if (way_ == Way::each) return find_in_each(pairs);
  near_.resize(size);
  place_.reserve(size);
  make_runs(device);
  for (int run = 0; run < runs_of(a.count()); ++run) find_in_run(run, pairs);
}

void ClusterJoin::find_in_each(std::vector<ClusterPair>& pairs) {
  for (int i = 0; i < a_->count(); ++i) {
    const int first = wanted_ == BoxPairs::ascending ? std::min(i, b_->count()) : 0;
    const int found = kernels().select_overlapping(b_->boxes.view().pointers(first), b_->count() - first,
                                                   a_->boxes.bounds(static_cast<std::size_t>(i)), found_.data());
    for (int k = 0; k < found; ++k) pairs.push_back({i, first + found_[k]});
  }
}

void ClusterJoin::make_runs(EmbreeDevice& device) {
  const int runs = runs_of(b_->count());
  run_boxes_.resize(static_cast<std::size_t>(runs));
  for (int r = 0; r < runs; ++r) run_boxes_.set(static_cast<std::size_t>(r), to_box(bounds_of_run(*b_, r)));
  if (way_ == Way::trees) forest_.build(device, run_boxes_.view(), runs);
}

void ClusterJoin::find_in_run(int run, std::vector<ClusterPair>& pairs) {
  const BoxBounds bounds = bounds_of_run(*a_, run);
  find_near_runs(bounds, wanted_ == BoxPairs::ascending ? run : 0);
  find_near(bounds);
  const int near = static_cast<int>(place_.size());
  int first = 0;
  for (int i = run * kRun; i < std::min((run + 1) * kRun, a_->count()); ++i) {
    while (wanted_ == BoxPairs::ascending && first < near && place_[first] < i) ++first;
    if (first == near) break;
    const int found = kernels().select_overlapping(near_.view().pointers(first), near - first,
                                                   a_->boxes.bounds(static_cast<std::size_t>(i)), found_.data());
    for (int k = 0; k < found; ++k) pairs.push_back({i, place_[first + found_[k]]});
  }
}

// The runs of B from `first` on, ascending.
void ClusterJoin::find_near_runs(const BoxBounds& run, int first) {
  near_runs_.clear();
  if (way_ == Way::trees) {
    forest_.query(to_box(run), stack_, near_runs_);
    std::erase_if(near_runs_, [&](std::int32_t one) { return one < first; });
    std::ranges::sort(near_runs_);
    return;
  }
  const int left = runs_of(b_->count()) - first;
  if (left <= 0) return;
  near_runs_.resize(left);
  near_runs_.resize(kernels().select_overlapping(run_boxes_.view().pointers(first), left, run, near_runs_.data()));
  for (std::int32_t& one : near_runs_) one += first;
}

void ClusterJoin::find_near(const BoxBounds& run) {
  place_.clear();
  for (const std::int32_t near : near_runs_) {
    const int begin = near * kRun;
    const int found = kernels().select_overlapping(b_->boxes.view().pointers(begin),
                                                   std::min(kRun, b_->count() - begin), run, found_.data());
    for (int i = 0; i < found; ++i) {
      const std::int32_t place = begin + found_[i];
      near_.set(place_.size(), b_->boxes[place]);
      place_.push_back(place);
    }
  }
}

void ClusterJoin::exchange_meshes(std::vector<ClusterPair>& pairs, int clusters) {
  found_.assign(static_cast<std::size_t>(clusters) + 1, 0);  // where the pairs of each cluster of B begin
  for (const ClusterPair& pair : pairs) ++found_[static_cast<std::size_t>(pair.b) + 1];
  std::partial_sum(found_.begin(), found_.end(), found_.begin());
  exchanged_.resize(pairs.size());
  for (const ClusterPair& pair : pairs) exchanged_[found_[pair.b]++] = {pair.b, pair.a};
  std::swap(exchanged_, pairs);
}

}  // namespace tact::narrowphase
