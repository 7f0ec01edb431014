#include "engine/motion_stage.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <span>
#include <tuple>

#include "engine/base/parallel.h"
#include "engine/base/timer.h"

namespace tact {

namespace {

using narrowphase::FeatureImpact;

// Microseconds that a pair of clusters takes at least (tact-bench motion).
constexpr std::size_t kCost = 2;
constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

const MotionReport& MotionStage::run(Bodies& bodies, const Settings& settings, Impacts wanted) {
  base::Timer timer;
  report_.stats_ = {};
  bodies.update_order();
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
  planes_.update(bodies, boxes_, changed_, sweep_.pairs(), sweep_.pairs_changed());
}

void MotionStage::select(Bodies& bodies, int threads) {
  passing_.clear();
  if (report_.stats_.moved_bodies == 0) return;
  const auto moves = [&](std::uint32_t slot) { return bodies.used(slot) && bodies.on_its_way(slot); };
  for (const broadphase::IndexPair& pair : planes_.pairs()) {
    if (bodies.excluded_pairs().contains(pair) || !bodies.is_chosen(pair)) continue;
    const auto [a, b] = bodies.keys().ordered(pair);
    if (moves(a) || moves(b)) passing_.push_back({.a = a, .b = b, .reach = bodies.reach(a, b)});
  }
  const auto slots = static_cast<std::uint32_t>(boxes_.size());
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    if (moves(slot) && bodies.in_slot(slot).self_contact)
      passing_.push_back({.a = slot, .b = slot, .reach = bodies.reach(slot, slot)});
  }
  if (bodies.any_rigid()) place(bodies, threads);
  std::ranges::sort(passing_, {}, [&](const Passing& p) { return bodies.keys().ranks({p.a, p.b}); });
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
    if (one.a == one.b) return false;
    const BodyAndPlane plane = body_and_plane(bodies, one.a, one.b);
    if (plane) return !reaches_plane(bodies, plane.slot_of_plane(one.a, one.b), way_box(bodies, plane.body->id.index));
    return !overlaps(way_box(bodies, one.a), way_box(bodies, one.b));
  });
}

void MotionStage::make_features(Bodies& bodies, int threads) {
  slots_.clear();
  for (const auto& one : passing_) slots_.insert(slots_.end(), {one.a, one.b});
  bodies.make_features(slots_, threads);
}

std::span<const narrowphase::ClusterPair> MotionStage::clusters_of(const Passing& passing) const {
  return std::span(memory_[passing.thread].clusters).subspan(passing.begin, passing.end - passing.begin);
}

// Sorts the cluster pairs of a thread from `begin` on by the time from which they may meet, and leaves out those that
// never do.
void MotionStage::sort_by_time(const Passing& passing, const Bodies& bodies, std::size_t begin, Memory& memory) {
  memory.timed.clear();
  for (const narrowphase::ClusterPair& pair : std::span(memory.clusters).subspan(begin)) {
    const double earliest =
        narrowphase::earliest_time(bodies.moving(passing.a), pair.a, bodies.moving(passing.b), pair.b, passing.reach);
    if (earliest <= 1.0) memory.timed.push_back({earliest, pair});
  }
  std::ranges::sort(memory.timed, {}, [](const TimedPair& t) { return std::tuple(t.earliest, t.pair.a, t.pair.b); });
  memory.clusters.resize(begin);
  for (const TimedPair& one : memory.timed) memory.clusters.push_back(one.pair);
}

void MotionStage::find_clusters(const Bodies& bodies, int threads, Impacts wanted) {
  memory_.resize(threads);
  for (Memory& memory : memory_) {
    memory.clusters.clear();
    memory.cluster_pairs = 0;
  }
  const auto facets_of = [&](std::size_t i) {
    const Passing& one = passing_[i];
    return std::min(bodies.in_slot(one.a).mesh.facet_count(), bodies.in_slot(one.b).mesh.facet_count());
  };
  const std::size_t grain = items_at_a_time(passing_.size(), threads, bodies.tuning(), facets_of);
  base::parallel_for(passing_.size(), grain, threads, [&](std::size_t i, int thread) {
    Passing& one = passing_[i];
    Memory& memory = memory_[thread];
    const std::size_t begin = memory.clusters.size();
    if (const BodyAndPlane plane = body_and_plane(bodies, one.a, one.b)) {
      find_clusters_near_plane(plane, bodies.moving(plane.body->id.index), one.reach, memory.clusters);
    } else {
      const narrowphase::MovingMesh a = bodies.moving(one.a), b = bodies.moving(one.b);
      const auto pairs = memory.passing.find(a.boxes(), b.boxes(), one.reach, bodies.tuning(), device_);
      memory.clusters.insert(memory.clusters.end(), pairs.begin(), pairs.end());
      if (wanted != Impacts::all) sort_by_time(one, bodies, begin, memory);
    }
    memory.cluster_pairs += static_cast<std::int64_t>(memory.clusters.size() - begin);
    one.thread = static_cast<std::size_t>(thread);
    one.begin = begin;
    one.end = memory.clusters.size();
  });
  cut_into_ranges(bodies, wanted);
}

// Into the smallest that are worth a thread: a pair takes far longer where something meets.
void MotionStage::cut_into_ranges(const Bodies& bodies, Impacts wanted) {
  const std::size_t at_a_time = std::max<std::size_t>(bodies.tuning().fewest_in_range / kCost, 1);
  work_.begin();
  for (std::size_t i = 0; i < passing_.size(); ++i) {
    const Passing& one = passing_[i];
    const std::span<const narrowphase::ClusterPair> clusters = clusters_of(one);
    std::size_t item = i;
    const Work::Shared& shared = work_.put_aside(item, clusters, (clusters.size() + at_a_time - 1) / at_a_time);
    if (wanted == Impacts::all || body_and_plane(bodies, one.a, one.b)) continue;
    for (Work::Range& range : work_.ranges(shared)) {
      if (range.begin == range.end) continue;
      const narrowphase::ClusterPair& first = clusters[range.begin];
      range.found.earliest =
          narrowphase::earliest_time(bodies.moving(one.a), first.a, bodies.moving(one.b), first.b, one.reach);
    }
  }
}

void MotionStage::search(const Bodies& bodies, int threads, Impacts wanted) {
  const std::size_t firsts = wanted == Impacts::all ? 0 : wanted == Impacts::first ? 1 : passing_.size();
  if (first_.size() < firsts) first_ = std::vector<std::atomic<double>>(2 * firsts);
  for (std::size_t i = 0; i < firsts; ++i) first_[i] = kNever;
  base::Box all;
  for (const Passing& one : passing_) all = merged(all, merged(way_box(bodies, one.a), way_box(bodies, one.b)));
  for (Memory& memory : memory_) {
    memory.finder.begin(all);
    memory.counts = {};
  }
  // Of bodies that meet at the very beginning the first pair is reported: what comes after it need not be searched.
  std::atomic<std::size_t> meets_at_once = passing_.size();
  const auto search_range = [&](const Work::Shared& shared, Work::Range& range, int thread) {
    const std::size_t place = shared.item;
    const Passing& one = passing_[place];
    Memory& memory = memory_[thread];
    std::vector<FeatureImpact>& found = range.found.impacts;
    std::atomic<double>* const first = firsts == 0 ? nullptr : &first_[firsts == 1 ? 0 : place];
    found.clear();
    if (wanted == Impacts::first && place > meets_at_once.load(std::memory_order_relaxed)) return;
    const auto clusters = clusters_of(one).subspan(range.begin, range.end - range.begin);
    if (const BodyAndPlane plane = body_and_plane(bodies, one.a, one.b)) {
      search_plane(plane, bodies.moving(plane.body->id.index), one.reach, clusters, first, range.found);
    } else {
      memory.finder.run(bodies.moving(one.a), bodies.moving(one.b), one.reach, clusters, first, found, memory.counts);
    }
    if (wanted == Impacts::first &&
        std::ranges::any_of(found, [](const FeatureImpact& impact) { return impact.time == 0.0; }))
      base::lower_to(meets_at_once, place);
  };
  // Where only the first impact counts, what may meet early is searched first: what is found leaves out most others.
  if (wanted == Impacts::all) {
    work_.search(threads, search_range);
  } else {
    work_.search_by([](const Work::Range& range) { return range.found.earliest; }, threads, search_range);
  }
}

// The clusters of a body that may come as near to the plane as `reach`; the second of a pair says nothing.
void MotionStage::find_clusters_near_plane(const BodyAndPlane& pair, const narrowphase::MovingMesh& body, double reach,
                                           std::vector<narrowphase::ClusterPair>& clusters) {
  const narrowphase::HalfSpace other_side{-pair.plane->normal, -pair.plane->offset};
  for (int c = 0; c < body.mesh->cluster_count(); ++c) {
    const base::Box way = merged(body.begin.cluster_boxes[static_cast<std::size_t>(c)],
                                 body.mesh->cluster_boxes()[static_cast<std::size_t>(c)]);
    if (narrowphase::reaches(*pair.plane, way, reach) && narrowphase::reaches(other_side, way, reach))
      clusters.push_back({c, 0});
  }
}

// Of what moves straight vertices come to a plane first.
void MotionStage::search_plane(const BodyAndPlane& pair, const narrowphase::MovingMesh& body, double reach,
                               std::span<const narrowphase::ClusterPair> clusters, std::atomic<double>* first,
                               Found& found) {
  for (const narrowphase::ClusterPair& cluster : clusters) {
    for (int v = body.mesh->vertex_begin(cluster.a); v < body.mesh->vertex_end(cluster.a); ++v) {
      const auto time = narrowphase::meeting_time(*pair.plane, body.begin_of(v), body.mesh->position(v), reach);
      if (!time) continue;
      FeatureImpact impact{.kind = pair.plane_is_a ? FeaturePair::plane_vertex : FeaturePair::vertex_plane,
                           .time = *time};
      (pair.plane_is_a ? impact.b : impact.a)[0] = body.mesh->source_vertex(v);
      found.impacts.push_back(impact);
      if (first != nullptr) base::lower_to(*first, *time);
    }
  }
}

// Puts the impacts of a pair of bodies into gathered_, in order. One of two points, or of an edge that is listed twice,
// may be there twice.
void MotionStage::gather(const Work::Shared& shared, const Bodies& bodies) {
  gathered_.clear();
  for (const Work::Range& range : work_.ranges(shared))
    gathered_.insert(gathered_.end(), range.found.impacts.begin(), range.found.impacts.end());
  const Passing& one = passing_[shared.item];
  if (!bodies.in_slot(one.a).mesh.has_surface_alone() || !bodies.in_slot(one.b).mesh.has_surface_alone()) {
    const auto features = [](const FeatureImpact& impact) { return std::tie(impact.kind, impact.a, impact.b); };
    std::ranges::sort(gathered_, [&](const FeatureImpact& x, const FeatureImpact& y) {
      return std::pair(features(x), x.time) < std::pair(features(y), y.time);
    });
    const auto are_same = [&](const FeatureImpact& x, const FeatureImpact& y) { return features(x) == features(y); };
    gathered_.erase(std::unique(gathered_.begin(), gathered_.end(), are_same), gathered_.end());
  }
  std::ranges::sort(gathered_, std::less<>());
}

void MotionStage::make_report(const Bodies& bodies, Impacts wanted) {
  report_.impacts_.clear();
  report_.pairs_.clear();
  report_.first_time_ = kNever;
  for (const Work::Shared& shared : work_.items()) {
    gather(shared, bodies);
    if (gathered_.empty()) continue;
    const double first = gathered_.front().time;
    if (wanted == Impacts::first) {
      if (!(first < report_.first_time_)) continue;
      report_.impacts_.clear();
      report_.pairs_.clear();
    }
    if (wanted != Impacts::all) gathered_.resize(1);
    report_.first_time_ = std::min(report_.first_time_, first);
    const Passing& one = passing_[shared.item];
    const BodyId a = bodies.in_slot(one.a).id, b = bodies.in_slot(one.b).id;
    report_.pairs_.push_back({a, b, first, {}});
    for (const FeatureImpact& impact : gathered_)
      report_.impacts_.push_back({a, b, impact.kind, impact.time, impact.a, impact.b});
  }
  std::span<const Impact> left = report_.impacts_;
  for (ImpactPair& pair : report_.pairs_) {
    const auto is_other = [&](const Impact& impact) { return !(impact.a == pair.a && impact.b == pair.b); };
    const auto size = static_cast<std::size_t>(std::ranges::find_if(left, is_other) - left.begin());
    pair.impacts = left.first(size);
    left = left.subspan(size);
  }
  report_.stats_.impacts = static_cast<std::int64_t>(report_.impacts_.size());
  for (const Memory& memory : memory_) {
    report_.stats_.cluster_pairs += memory.cluster_pairs;
    report_.stats_.candidates += memory.counts.candidates;
    report_.stats_.searched += memory.counts.searched;
    report_.stats_.spans += memory.counts.spans;
  }
}

}  // namespace tact
