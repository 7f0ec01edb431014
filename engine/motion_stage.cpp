#include "engine/motion_stage.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>

#include "engine/base/parallel.h"
#include "engine/base/timer.h"

namespace tact {

namespace {

using narrowphase::FeatureImpact;

// What a thread takes at a time: a pair of clusters takes some microseconds, to find those of two small bodies one.
constexpr std::size_t kClusterPairsAtATime = 16, kBodyPairsAtATime = 8;
constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

const MotionReport& MotionStage::run(Bodies& bodies, const Settings& settings, Impacts wanted) {
  base::Timer timer;
  report_.stats_ = {};
  sweep(bodies, settings.threads);
  select(bodies, settings.threads);
  report_.stats_.sweep_ms = timer.lap();
  make_features(bodies, settings.threads);
  find_clusters(bodies, settings.threads, wanted);
  search(bodies, settings.threads, wanted);
  make_report(bodies, wanted);
  report_.stats_.search_ms = timer.lap();
  return report_;
}

void MotionStage::sweep(const Bodies& bodies, int threads) {
  const std::size_t slots = bodies.boxes().size();
  const std::size_t known = boxes_.size();
  boxes_.resize(slots);
  filters_.resize(slots);
  changed_.clear();
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    base::Box box = bodies.boxes()[slot];
    if (bodies.used(slot) && bodies.on_its_way(slot)) {
      ++report_.stats_.moved_bodies;
      box = merged(box, bodies.begin_box(slot));
    }
    const broadphase::Filter& filter = bodies.filters()[slot];
    if (slot < known && boxes_[slot] == box && filters_[slot] == filter) continue;
    boxes_[slot] = box;
    filters_[slot] = filter;
    changed_.push_back(slot);
  }
  sweep_.update(boxes_, filters_, changed_, threads, bodies.tuning());
}

void MotionStage::select(Bodies& bodies, int threads) {
  passing_.clear();
  if (report_.stats_.moved_bodies == 0) return;
  const auto moves = [&](std::uint32_t slot) { return bodies.used(slot) && bodies.on_its_way(slot); };
  for (const auto& [a, b] : sweep_.pairs()) {
    if (bodies.excluded_pairs().contains({a, b})) continue;
    if (moves(a) || moves(b)) passing_.push_back({.a = a, .b = b, .reach = bodies.reach(a, b)});
  }
  const auto slots = static_cast<std::uint32_t>(boxes_.size());
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    if (moves(slot) && bodies.in_slot(slot).self_contact)
      passing_.push_back({.a = slot, .b = slot, .reach = bodies.reach(slot, slot)});
  }
  if (bodies.any_rigid()) place(bodies, threads);
  std::ranges::sort(passing_, {}, [](const Passing& p) { return std::pair(p.a, p.b); });
  report_.stats_.body_pairs = static_cast<std::int64_t>(passing_.size());
}

// Of rigid bodies the sweep saw boxes that may be too large: where they pass in truth.
base::Box MotionStage::way_box(const Bodies& bodies, std::uint32_t slot) const {
  if (!bodies.is_rigid(slot)) return boxes_[slot];
  return merged(bodies.exact_box(slot), bodies.begin_box(slot));
}

void MotionStage::place(Bodies& bodies, int threads) {
  slots_.clear();
  for (const Passing& one : passing_) slots_.insert(slots_.end(), {one.a, one.b});
  bodies.place_ways(slots_, threads);
  std::erase_if(passing_, [&](const Passing& one) {
    return one.a != one.b && !overlaps(way_box(bodies, one.a), way_box(bodies, one.b));
  });
}

void MotionStage::make_features(Bodies& bodies, int threads) {
  slots_.clear();
  for (const auto& one : passing_) slots_.insert(slots_.end(), {one.a, one.b});
  bodies.make_features(slots_, threads);
}

// Sorts the cluster pairs of a thread from `begin` on by the time from which they may meet, and leaves out those that
// never do.
void MotionStage::sort_by_time(const Passing& passing, const Bodies& bodies, std::size_t begin, Work& work) {
  work.timed.clear();
  for (const narrowphase::ClusterPair& pair : std::span(work.clusters).subspan(begin)) {
    const double earliest =
        narrowphase::earliest_time(bodies.moving(passing.a), pair.a, bodies.moving(passing.b), pair.b, passing.reach);
    if (earliest <= 1.0) work.timed.push_back({earliest, pair});
  }
  std::ranges::sort(work.timed, {}, [](const TimedPair& t) { return std::tuple(t.earliest, t.pair.a, t.pair.b); });
  work.clusters.resize(begin);
  for (const TimedPair& one : work.timed) work.clusters.push_back(one.pair);
}

void MotionStage::find_clusters(const Bodies& bodies, int threads, Impacts wanted) {
  work_.resize(threads);
  for (Work& work : work_) {
    work.clusters.clear();
    work.cluster_pairs = 0;
  }
  base::parallel_for(passing_.size(), kBodyPairsAtATime, threads, [&](std::size_t i, int thread) {
    Passing& one = passing_[i];
    Work& work = work_[thread];
    const auto pairs =
        work.passing.find(bodies.moving(one.a), bodies.moving(one.b), one.reach, bodies.tuning(), device_);
    const std::size_t begin = work.clusters.size();
    work.clusters.insert(work.clusters.end(), pairs.begin(), pairs.end());
    work.cluster_pairs += static_cast<std::int64_t>(pairs.size());
    if (wanted != Impacts::all) sort_by_time(one, bodies, begin, work);
    one.clusters = {static_cast<std::size_t>(thread), begin, work.clusters.size()};
  });
  cut_into_parts(bodies, wanted);
}

// Where only the first impact counts, parts that may meet early are searched first: what is found leaves out most
// others.
void MotionStage::cut_into_parts(const Bodies& bodies, Impacts wanted) {
  parts_.clear();
  for (std::size_t i = 0; i < passing_.size(); ++i) {
    const Passing& one = passing_[i];
    const Range& all = one.clusters;
    for (std::size_t at = all.begin; at < all.end; at += kClusterPairsAtATime) {
      double earliest = 0.0;
      if (wanted != Impacts::all) {
        const narrowphase::ClusterPair& first = work_[all.thread].clusters[at];
        earliest = narrowphase::earliest_time(bodies.moving(one.a), first.a, bodies.moving(one.b), first.b, one.reach);
      }
      parts_.push_back({i, at, std::min(at + kClusterPairsAtATime, all.end), earliest});
    }
  }
  order_.resize(parts_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (wanted != Impacts::all)
    std::ranges::sort(order_, {}, [&](std::size_t i) { return std::pair(parts_[i].earliest, i); });
}

void MotionStage::search(const Bodies& bodies, int threads, Impacts wanted) {
  const std::size_t firsts = wanted == Impacts::all ? 0 : wanted == Impacts::first ? 1 : passing_.size();
  if (first_.size() < firsts) first_ = std::vector<std::atomic<double>>(2 * firsts);
  for (std::size_t i = 0; i < firsts; ++i) first_[i] = kNever;
  base::Box all;
  for (const Passing& one : passing_) all = merged(all, merged(way_box(bodies, one.a), way_box(bodies, one.b)));
  for (Work& work : work_) {
    work.finder.begin(all);
    work.impacts.clear();
    work.counts = {};
  }
  // Of bodies that meet at the very beginning the first pair is reported: what comes after it need not be searched.
  std::atomic<std::size_t> meets_at_once = passing_.size();
  base::parallel_for(parts_.size(), 1, threads, [&](std::size_t i, int thread) {
    Part& part = parts_[order_[i]];
    const Passing& one = passing_[part.passing];
    Work& work = work_[thread];
    const std::span<const narrowphase::ClusterPair> clusters = work_[one.clusters.thread].clusters;
    std::atomic<double>* const first = firsts == 0 ? nullptr : &first_[firsts == 1 ? 0 : part.passing];
    const std::size_t begin = work.impacts.size();
    part.impacts = {static_cast<std::size_t>(thread), begin, begin};
    if (wanted == Impacts::first && part.passing > meets_at_once.load(std::memory_order_relaxed)) return;
    work.finder.run(bodies.moving(one.a), bodies.moving(one.b), one.reach,
                    clusters.subspan(part.begin, part.end - part.begin), first, work.impacts, work.counts);
    part.impacts.end = work.impacts.size();
    const auto found = std::span(work.impacts).subspan(begin);
    if (wanted == Impacts::first &&
        std::ranges::any_of(found, [](const FeatureImpact& impact) { return impact.time == 0.0; }))
      base::lower_to(meets_at_once, part.passing);
  });
}

// Puts the impacts of a pair of bodies into gathered_, in order. `part` is its first part, and then that of the next.
void MotionStage::gather(std::size_t passing, std::size_t& part) {
  gathered_.clear();
  for (; part < parts_.size() && parts_[part].passing == passing; ++part) {
    const auto [thread, begin, end] = parts_[part].impacts;
    const std::span found = std::span(work_[thread].impacts).subspan(begin, end - begin);
    gathered_.insert(gathered_.end(), found.begin(), found.end());
  }
  std::ranges::sort(gathered_, std::less<>());
}

void MotionStage::make_report(const Bodies& bodies, Impacts wanted) {
  report_.impacts_.clear();
  report_.pairs_.clear();
  report_.first_time_ = kNever;
  std::size_t part = 0;
  for (std::size_t i = 0; i < passing_.size(); ++i) {
    gather(i, part);
    if (gathered_.empty()) continue;
    const double first = gathered_.front().time;
    if (wanted == Impacts::first) {
      if (!(first < report_.first_time_)) continue;
      report_.impacts_.clear();
      report_.pairs_.clear();
    }
    if (wanted != Impacts::all) gathered_.resize(1);
    report_.first_time_ = std::min(report_.first_time_, first);
    const BodyId a = bodies.in_slot(passing_[i].a).id, b = bodies.in_slot(passing_[i].b).id;
    report_.pairs_.push_back({a, b, first, {}});
    for (const FeatureImpact& one : gathered_) report_.impacts_.push_back({a, b, one.kind, one.time, one.a, one.b});
  }
  std::span<const Impact> left = report_.impacts_;
  for (ImpactPair& pair : report_.pairs_) {
    const auto is_other = [&](const Impact& impact) { return !(impact.a == pair.a && impact.b == pair.b); };
    const auto size = static_cast<std::size_t>(std::ranges::find_if(left, is_other) - left.begin());
    pair.impacts = left.first(size);
    left = left.subspan(size);
  }
  report_.stats_.impacts = static_cast<std::int64_t>(report_.impacts_.size());
  for (const Work& work : work_) {
    report_.stats_.cluster_pairs += work.cluster_pairs;
    report_.stats_.candidates += work.counts.candidates;
    report_.stats_.searched += work.counts.searched;
    report_.stats_.spans += work.counts.spans;
  }
}

}  // namespace tact
