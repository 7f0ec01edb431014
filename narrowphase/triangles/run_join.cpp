#include "narrowphase/triangles/run_join.h"

#include <algorithm>

namespace tact::narrowphase {

namespace {

constexpr int kRun = 32;

int runs_of(int count) { return (count + kRun - 1) / kRun; }

BoxBounds bounds_of_run(const BoxArrays& boxes, int count, int run) {
  return kernels().bounds(boxes.view().pointers(run * kRun), std::min(kRun, count - run * kRun));
}

}  // namespace

void RunJoin::run(const BoxArrays& a, int count_a, const BoxArrays& b, int count_b, Runs runs, BoxPairs wanted,
                  EmbreeDevice& device, std::vector<ClusterPair>& pairs) {
  const auto size = static_cast<std::size_t>(count_b), runs_of_b = static_cast<std::size_t>(runs_of(count_b));
  run_boxes_.resize(runs_of_b);
  for (std::size_t r = 0; r < runs_of_b; ++r) run_boxes_.set(r, to_box(bounds_of_run(b, count_b, static_cast<int>(r))));
  if (runs == Runs::forest) forest_.build(device, run_boxes_.view(), runs_of(count_b));
  near_.resize(size);
  place_.reserve(size);
  found_.resize(size);
  run_count_ = runs_of_b;
  for (int r = 0; r < runs_of(count_a); ++r) {
    const BoxBounds run = bounds_of_run(a, count_a, r);
    find_near_runs(run, wanted == BoxPairs::ascending ? r : 0, runs);
    find_near(b, count_b, run);
    int first = 0;
    for (int i = r * kRun; i < std::min((r + 1) * kRun, count_a); ++i) {
      const int near = static_cast<int>(place_.size());
      while (wanted == BoxPairs::ascending && first < near && place_[first] < i) ++first;
      if (first == near) break;
      const int found = kernels().select_overlapping(near_.view().pointers(first), near - first,
                                                     a.bounds(static_cast<std::size_t>(i)), found_.data());
      for (int k = 0; k < found; ++k) pairs.push_back({i, place_[first + found_[k]]});
    }
  }
}

// The runs of B from `first` on, ascending.
void RunJoin::find_near_runs(const BoxBounds& run, int first, Runs runs) {
  if (runs == Runs::forest) {
    near_runs_.clear();
    forest_.query(to_box(run), near_runs_);
    std::erase_if(near_runs_, [&](std::int32_t one) { return one < first; });
    std::ranges::sort(near_runs_);
    return;
  }
  const int left = static_cast<int>(run_count_) - first;
  if (left <= 0) return near_runs_.clear();
  near_runs_.resize(left);
  near_runs_.resize(kernels().select_overlapping(run_boxes_.view().pointers(first), left, run, near_runs_.data()));
  for (std::int32_t& one : near_runs_) one += first;
}

void RunJoin::find_near(const BoxArrays& b, int count_b, const BoxBounds& run) {
  place_.clear();
  for (const std::int32_t near : near_runs_) {
    const int begin = near * kRun;
    const int found =
        kernels().select_overlapping(b.view().pointers(begin), std::min(kRun, count_b - begin), run, found_.data());
    for (int i = 0; i < found; ++i) {
      const std::int32_t place = begin + found_[i];
      near_.set(place_.size(), b[place]);
      place_.push_back(place);
    }
  }
}

}  // namespace tact::narrowphase
