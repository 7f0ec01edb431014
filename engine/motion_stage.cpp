#include "engine/motion_stage.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/text.h"
#include "engine/base/timer.h"
#include "engine/check_coordinate.h"
#include "engine/check_name.h"
#include "narrowphase/motion/meeting.h"
#include "narrowphase/pairs/box_reach.h"

namespace tact {

namespace {

using narrowphase::FeatureImpact, narrowphase::largest_coordinate;

// Microseconds that a pair of clusters takes at least (tact-bench motion).
constexpr std::size_t kMotionCost = 2;
// Of coordinates, and of times, more than sums of some of them round.
constexpr double kRounding = 0x1p-50, kLater = 0x1p-40;
// Bodies that go together are seen from what goes with them, if they go farther than this part of their size.
constexpr double kFarTogether = 0x1p-4;
// Known candidates that are searched for what a pair of clusters costs, kMotionCost.
constexpr std::size_t kCandidates = 64;
constexpr double kNever = std::numeric_limits<double>::infinity();

// When a vertex comes to a plane, as two features meet that begin as near: see meeting.h.
std::optional<double> meeting_time_with_plane(const narrowphase::HalfSpace& plane,
                                              const narrowphase::MovingVertex& vertex, double reach) {
  const auto time = narrowphase::meeting_time(plane, vertex.at[0], vertex.at[1], reach);
  if (!time || reach == 0.0) return time;
  const double height = std::abs(narrowphase::height_over(plane, vertex.at[0]));
  if (height > reach + narrowphase::kJustAbove * reach) return time;
  return narrowphase::meeting_time(plane, vertex.at[0], vertex.at[1], narrowphase::kShareOfGap * height);
}

}  // namespace

void check_motion_options(const MotionOptions& options) {
  check_name(options.wanted, Impacts::first, "impacts");
  if (options.bounds && options.wanted != Impacts::all)
    throw Error(ErrorCode::invalid_argument, "bounds of motion require all impacts");
  if (options.distance && !(*options.distance >= 0.0 && *options.distance <= kLargestCoordinate))
    throw Error(ErrorCode::invalid_argument,
                "distance of motion is " + base::text_of(*options.distance) + ", not 0 to 2^300");
}

std::span<const double> MotionReport::bounds(BodyId body) const {
  const auto found =
      std::ranges::lower_bound(bounds_, body.index, {}, [](const BodyBounds& b) { return b.body.index; });
  if (found == bounds_.end() || found->body != body) return {};
  return found->of_vertices;
}

const MotionReport& MotionStage::run(Bodies& bodies, const Settings& settings, const MotionOptions& options) {
  base::Timer timer;
  report_.stats_ = {};
  bodies.update_order();
  bounds_.begin(0);
  note_call(bodies);
  const Call call{bodies, settings.threads, options};
  sweep(call);
  select(call);
  report_.stats_.sweep_ms = timer.lap();
  find(call);
  make_report(call);
  report_.bounds_.clear();
  if (options.bounds) find_bounds(call);
  report_.stats_.search_ms = timer.lap();
  return report_;
}

void MotionStage::note_call(const Bodies& bodies) {
  if (std::exchange(step_, bodies.steps()) != bodies.steps() && calls_ > 0) {
    expects_more_ = calls_ > 1;
    calls_ = 0;
  }
  if (++calls_ > 1) expects_more_ = true;
}

void MotionStage::find(const Call& call) {
  make_features(call);
  find_known(call);
  begin_search(call);
  find_clusters(call);
  search(call);
  if (keeps_ways_) keep_ways(call);
}

double MotionStage::Call::wider(double held) const {
  return options.distance ? std::max(0.5 * *options.distance - held, 0.0) * (1.0 + kRounding) : 0.0;
}

narrowphase::FeatureRules MotionStage::Call::rules(std::uint32_t a, std::uint32_t b) const {
  const auto& distance = options.distance;
  return {.reach = distance ? narrowphase::FeatureReach{.a = {.largest = *distance}, .b = {}} : bodies.rest(a, b),
          .filter = bodies.feature_filter(a, b)};
}

// Where each body is at both ends, with its margin, or half of the distance that is asked for if that is more.
void MotionStage::find_ways(const Call& call) {
  const Bodies& bodies = call.bodies;
  const std::size_t slots = bodies.boxes().size();
  ways_.resize(slots);
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    base::MovingBox& way = ways_[slot];
    way.begin = way.end = bodies.boxes()[slot];
    if (!bodies.used(slot)) continue;
    if (bodies.on_its_way(slot)) {
      if (!call.only_changed) ++report_.stats_.moved_bodies;
      way.begin = bodies.begin_box(slot);
      if (bounds_.is_bounded(slot)) way.end = base::grown(moving(bodies, slot).end.box, bodies.margin(slot));
    }
    const double wider = call.wider(bodies.margin(slot));
    if (wider > 0.0) way = {base::grown(way.begin, wider), base::grown(way.end, wider)};
  }
}

// What most bodies have in common of their ways, along each axis; zero if the boxes of ways are not far smaller seen
// from there.
base::Vec3 MotionStage::frame_of_ways(const Bodies& bodies) const {
  base::Vec3 frame;
  double size = 0.0;
  std::size_t moving = 0, all = 0;
  for (std::uint32_t slot = 0; slot < ways_.size(); ++slot) {
    if (ways_[slot].begin.empty()) continue;
    ++all;
    if (!bodies.on_its_way(slot)) continue;
    ++moving;
    frame = frame + way_of(ways_[slot]);
    size += narrowphase::longest_side(ways_[slot].begin);
  }
  if (moving == 0) return {};
  frame = (1.0 / static_cast<double>(moving)) * frame;
  for (int axis = 0; axis < 3; ++axis) {
    double still = 0.0, seen = static_cast<double>(all - moving) * std::abs(frame[axis]);
    for (std::uint32_t slot = 0; slot < ways_.size(); ++slot) {
      if (ways_[slot].begin.empty() || !bodies.on_its_way(slot)) continue;
      const double way = way_of(ways_[slot])[axis];
      still += std::abs(way);
      seen += std::abs(way - frame[axis]);
    }
    if (!(2.0 * seen < still && still > kFarTogether * size)) frame[axis] = 0.0;
  }
  return frame;
}

void MotionStage::sweep(const Call& call) {
  const Bodies& bodies = call.bodies;
  const std::size_t slots = bodies.boxes().size();
  const std::size_t known = boxes_.size();
  find_ways(call);
  if (!call.only_changed) frame_ = frame_of_ways(bodies);
  boxes_.resize(slots);
  filters_.resize(slots);
  changed_.clear();
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    const base::MovingBox& way = ways_[slot];
    const base::Box box = merged(way.begin, narrowphase::seen_from(frame_, way.end));
    const broadphase::Filter& filter = bodies.filters()[slot];
    if (slot < known && boxes_[slot] == box && filters_[slot] == filter) continue;
    boxes_[slot] = box;
    filters_[slot] = filter;
    changed_.push_back(slot);
  }
  sweep_.update(boxes_, filters_, changed_, call.threads, bodies.tuning());
  sweep_planes(call);
}

// Planes see ways as they are, wider by half of the distance that is asked for: a plane holds its margin alone.
void MotionStage::sweep_planes(const Call& call) {
  const double wider = call.wider(0.0);
  const std::size_t known = whole_ways_.size();
  if (!call.bodies.planes().empty()) {
    whole_ways_.resize(ways_.size());
    for (std::uint32_t slot = 0; slot < ways_.size(); ++slot) {
      const base::Box whole = base::grown(merged(ways_[slot].begin, ways_[slot].end), wider);
      if (slot < known && whole_ways_[slot] == whole) continue;
      whole_ways_[slot] = whole;
      changed_.push_back(slot);
    }
  }
  planes_.update(call.bodies, whole_ways_, changed_, sweep_.pairs(), sweep_.pairs_changed());
}

void MotionStage::select(const Call& call) {
  Bodies& bodies = call.bodies;
  passing_.clear();
  if (report_.stats_.moved_bodies == 0) return;
  const auto moves = [&](std::uint32_t slot) { return bodies.used(slot) && bodies.on_its_way(slot); };
  const auto counts = [&](std::uint32_t slot) { return call.only_changed ? bounds_.changed(slot) : moves(slot); };
  const auto reach = [&](std::uint32_t a, std::uint32_t b) { return call.rules(a, b).reach.largest(); };
  for (const broadphase::IndexPair& pair : planes_.pairs()) {
    if (bodies.excluded_pairs().contains(pair) || !bodies.is_chosen(pair)) continue;
    const auto [a, b] = bodies.keys().ordered(pair);
    if (counts(a) || counts(b)) passing_.push_back({.a = a, .b = b, .reach = reach(a, b)});
  }
  leave_out_apart(call);
  const auto slots = static_cast<std::uint32_t>(boxes_.size());
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    if (counts(slot) && bodies.in_slot(slot).self_contact)
      passing_.push_back({.a = slot, .b = slot, .reach = reach(slot, slot)});
  }
  if (bodies.any_rigid()) place(call);
  std::ranges::sort(passing_, {}, [&](const Passing& p) { return bodies.keys().ranks({p.a, p.b}); });
  report_.stats_.body_pairs = static_cast<std::int64_t>(passing_.size());
}

// Of rigid bodies the sweep saw boxes that may be too large: where they pass in truth.
base::MovingBox MotionStage::way_box(const Call& call, std::uint32_t slot) const {
  const Bodies& bodies = call.bodies;
  if (!bodies.is_rigid(slot) || bounds_.is_bounded(slot)) return ways_[slot];
  const double wider = call.wider(bodies.margin(slot));
  const base::Box end = bodies.exact_box(slot), begin = bodies.on_its_way(slot) ? bodies.begin_box(slot) : end;
  return {base::grown(begin, wider), base::grown(end, wider)};
}

// Pairs whose boxes, which go straight, stay apart; they hold the margins, or half of the distance if that is more.
void MotionStage::leave_out_apart(const Call& call) {
  const Bodies& bodies = call.bodies;
  std::erase_if(passing_, [&](const Passing& one) {
    if (one.a == one.b) return false;
    if (const BodyAndPlane plane = body_and_plane(bodies, one.a, one.b)) return stays_apart(call, plane, one);
    const base::MovingBox a = way_box(call, one.a), b = way_box(call, one.b);
    const double half = call.options.distance ? 0.5 * *call.options.distance : 0.0;
    const auto held = [&](std::uint32_t slot) { return std::max(bodies.margin(slot), half); };
    const double reach = one.reach - held(one.a) - held(one.b);
    const double largest =
        std::max(largest_coordinate(merged(a.begin, a.end)), largest_coordinate(merged(b.begin, b.end)));
    const base::TimeSpan near = near_span(a, b, reach + kRounding * largest);
    return near.from > near.to + kLater;
  });
}

bool MotionStage::stays_apart(const Call& call, const BodyAndPlane& pair, const Passing& one) const {
  const base::MovingBox way = way_box(call, pair.body->id.index);
  const double wider = call.wider(0.0);
  return !reaches_plane(call.bodies, pair.slot_of_plane(one.a, one.b), base::grown(merged(way.begin, way.end), wider));
}

void MotionStage::place(const Call& call) {
  slots_.clear();
  for (const Passing& one : passing_) slots_.insert(slots_.end(), {one.a, one.b});
  call.bodies.place_ways(slots_, call.threads);
  leave_out_apart(call);
}

void MotionStage::make_features(const Call& call) {
  slots_.clear();
  for (const auto& one : passing_) slots_.insert(slots_.end(), {one.a, one.b});
  call.bodies.make_features(slots_, call.threads);
}

// Looks which pairs go a part of their ways in an earlier call. If none does, this call is kept for others, if there
// may be some.
void MotionStage::find_known(const Call& call) {
  keeps_ways_ = false;
  if (call.only_changed) return;
  known_.look(call.bodies, call.options.distance, call.threads);
  bool any = false;
  for (Passing& one : passing_) {
    const auto candidates = known_.find(one.a, one.b);
    one.is_known = candidates.has_value();
    if (one.is_known) one.known = *candidates;
    any |= one.is_known;
  }
  keeps_ways_ = !any && expects_more_;
}

// Of a call for the first impacts, up to the first one: what is later was not searched.
void MotionStage::keep_ways(const Call& call) {
  const Bodies& bodies = call.bodies;
  const Impacts wanted = call.options.wanted;
  known_.begin(bodies, call.options.distance, largest_);
  for (const Work::Shared& shared : work_.items()) {
    const Passing& one = passing_[shared.item];
    if (body_and_plane(bodies, one.a, one.b)) continue;
    if (!bodies.seen(one.a) || !bodies.seen(one.b)) continue;  // it may be put elsewhere and still have no way
    for (const Work::Range& range : work_.ranges(shared)) known_.add(range.found.kept);
    const double first = wanted == Impacts::all ? 1.0 : first_[wanted == Impacts::first ? 0 : shared.item].load();
    const std::span<const narrowphase::ClusterPair> opened = clusters_of(one);
    known_.add_pair(bodies, one.a, one.b, std::min(first, 1.0), one.has_planes ? nullptr : &opened);
  }
  known_.finish(bodies, call.threads);
}

std::span<const narrowphase::ClusterPair> MotionStage::clusters_of(const Passing& passing) const {
  return std::span(memory_[passing.thread].clusters).subspan(passing.begin, passing.end - passing.begin);
}

// Of the cluster pairs of a thread from `begin` on leaves out those that never meet. If only the first impacts are
// wanted, the others are sorted by the time from which they may.
void MotionStage::leave_out_clusters(Passing& passing, const Call& call, std::size_t begin, Memory& memory) const {
  const narrowphase::MovingMesh a = moving(call.bodies, passing.a), b = moving(call.bodies, passing.b);
  const double reach = passing.reach + (keeps_ways_ ? memory.finder.kept_reach(a, b) : 0.0);
  memory.timed.clear();
  for (const narrowphase::ClusterPair& pair : std::span(memory.clusters).subspan(begin)) {
    if (call.only_changed && !bounds_.changed(passing.a, pair.a) && !bounds_.changed(passing.b, pair.b)) continue;
    const double earliest = narrowphase::earliest_time(a, pair.a, b, pair.b, reach);
    if (earliest <= 1.0) memory.timed.push_back({earliest, pair});
  }
  const std::size_t by_boxes = memory.timed.size();
  const narrowphase::MeshWay way_a = a.seen_from({}), way_b = b.seen_from({});
  memory.passing.leave_out_separated({.mesh = a.mesh, .way = &way_a}, {.mesh = b.mesh, .way = &way_b}, reach,
                                     call.bodies.tuning(), memory.timed, [](const TimedPair& t) { return t.pair; });
  if (!call.wants_all())
    std::ranges::sort(memory.timed, {}, [](const TimedPair& t) { return std::tuple(t.earliest, t.pair.a, t.pair.b); });
  passing.has_planes = memory.timed.size() < by_boxes;
  memory.clusters.resize(begin);
  for (const TimedPair& one : memory.timed) memory.clusters.push_back(one.pair);
}

void MotionStage::begin_search(const Call& call) {
  base::Box all;
  for (const Passing& one : passing_) {
    for (const std::uint32_t slot : {one.a, one.b}) {
      const base::MovingBox way = way_box(call, slot);
      all = merged(all, merged(way.begin, way.end));
    }
  }
  largest_ = largest_coordinate(all);
  memory_.resize(call.threads);
  for (Memory& memory : memory_) {
    memory.clusters.clear();
    memory.cluster_pairs = 0;
    memory.finder.begin(all);
    memory.counts = {};
  }
}

void MotionStage::find_clusters(const Call& call) {
  const Bodies& bodies = call.bodies;
  const auto facets_of = [&](std::size_t i) {
    const Passing& one = passing_[i];
    return std::min(bodies.in_slot(one.a).mesh.facet_count(), bodies.in_slot(one.b).mesh.facet_count());
  };
  const std::size_t grain = items_at_a_time(passing_.size(), call.threads, bodies.tuning(), facets_of);
  base::parallel_for(passing_.size(), grain, call.threads, [&](std::size_t i, int thread) {
    Passing& one = passing_[i];
    Memory& memory = memory_[thread];
    const std::size_t begin = memory.clusters.size();
    if (one.is_known) {
      for (std::size_t k = 0; k < one.known.size(); k += kCandidates)
        memory.clusters.push_back({static_cast<int>(k / kCandidates), 0});
    } else if (const BodyAndPlane plane = body_and_plane(bodies, one.a, one.b)) {
      find_clusters_near_plane(plane, moving(bodies, plane.body->id.index), one.reach, memory.clusters);
    } else {
      const narrowphase::MovingMesh a = moving(bodies, one.a), b = moving(bodies, one.b);
      const base::Vec3 frame = narrowphase::common_frame(a, b);
      const narrowphase::MeshWay way_a = a.seen_from(frame), way_b = b.seen_from(frame);
      const double reach = one.reach + (keeps_ways_ ? memory.finder.kept_reach(a, b) : 0.0);
      const auto pairs = memory.passing.find({.mesh = a.mesh, .way = &way_a}, {.mesh = b.mesh, .way = &way_b}, reach,
                                             bodies.tuning(), device_);
      memory.clusters.insert(memory.clusters.end(), pairs.begin(), pairs.end());
      leave_out_clusters(one, call, begin, memory);
    }
    one.thread = static_cast<std::size_t>(thread);
    one.begin = begin;
    one.end = memory.clusters.size();
    if (!one.is_known) memory.cluster_pairs += static_cast<std::int64_t>(one.end - one.begin);
  });
  cut_into_ranges(call);
}

// Into the smallest that are worth a thread: a pair takes far longer where something meets.
void MotionStage::cut_into_ranges(const Call& call) {
  const Bodies& bodies = call.bodies;
  const std::size_t at_a_time = std::max<std::size_t>(bodies.tuning().fewest_in_range / kMotionCost, 1);
  work_.begin();
  for (std::size_t i = 0; i < passing_.size(); ++i) {
    const Passing& one = passing_[i];
    const std::span<const narrowphase::ClusterPair> clusters = clusters_of(one);
    std::size_t item = i;
    const Work::Shared& shared = work_.put_aside(item, clusters, (clusters.size() + at_a_time - 1) / at_a_time);
    if (call.wants_all()) continue;
    for (Work::Range& range : work_.ranges(shared)) range.found.earliest = 0.0;
    if (one.is_known || body_and_plane(bodies, one.a, one.b)) continue;
    for (Work::Range& range : work_.ranges(shared)) {
      if (range.begin == range.end) continue;
      const narrowphase::ClusterPair& first = clusters[range.begin];
      range.found.earliest =
          narrowphase::earliest_time(moving(bodies, one.a), first.a, moving(bodies, one.b), first.b, one.reach);
    }
  }
}

void MotionStage::search(const Call& call) {
  const Impacts wanted = call.options.wanted;
  const std::size_t firsts = wanted == Impacts::all ? 0 : wanted == Impacts::first ? 1 : passing_.size();
  if (first_.size() < firsts) first_ = std::vector<std::atomic<double>>(2 * firsts);
  for (std::size_t i = 0; i < firsts; ++i) first_[i] = kNever;
  // Of bodies that meet at the very beginning the first pair is reported: what comes after it need not be searched.
  std::atomic<std::size_t> meets_at_once = passing_.size();
  const auto search_next = [&](const Work::Shared& shared, Work::Range& range, int thread) {
    const std::size_t place = shared.item;
    range.found.impacts.clear();
    range.found.kept.clear();
    if (wanted == Impacts::first && place > meets_at_once.load(std::memory_order_relaxed)) return;
    search_range(passing_[place], call, firsts == 0 ? nullptr : &first_[firsts == 1 ? 0 : place], range,
                 memory_[thread]);
    if (wanted == Impacts::first &&
        std::ranges::any_of(range.found.impacts, [](const FeatureImpact& impact) { return impact.time == 0.0; }))
      base::lower_to(meets_at_once, place);
  };
  // Where only the first impact counts, what may meet early is searched first: what is found leaves out most others.
  if (wanted == Impacts::all) {
    work_.search(call.threads, search_next);
  } else {
    work_.search_by([](const Work::Range& range) { return range.found.earliest; }, call.threads, search_next);
  }
}

void MotionStage::search_range(const Passing& passing, const Call& call, std::atomic<double>* first, Work::Range& range,
                               Memory& memory) const {
  const Bodies& bodies = call.bodies;
  const narrowphase::FeatureRules rules = call.rules(passing.a, passing.b);
  const auto clusters = clusters_of(passing).subspan(range.begin, range.end - range.begin);
  std::vector<FeatureImpact>& found = range.found.impacts;
  if (passing.is_known) {
    const std::size_t begin = range.begin * kCandidates, end = std::min(range.end * kCandidates, passing.known.size());
    if (begin < end)
      memory.finder.run_again(moving(bodies, passing.a), moving(bodies, passing.b), rules,
                              passing.known.subspan(begin, end - begin), first, found, memory.counts);
  } else if (const BodyAndPlane plane = body_and_plane(bodies, passing.a, passing.b)) {
    search_plane(plane, moving(bodies, plane.body->id.index), rules, clusters, first, range.found);
  } else {
    memory.finder.run(moving(bodies, passing.a), moving(bodies, passing.b), rules, clusters, first, found,
                      memory.counts, keeps_ways_ ? &range.found.kept : nullptr);
  }
}

// The clusters of a body that may come as near to the plane as `reach`; the second of a pair says nothing.
void MotionStage::find_clusters_near_plane(const BodyAndPlane& pair, const narrowphase::MovingMesh& body, double reach,
                                           std::vector<narrowphase::ClusterPair>& clusters) {
  const narrowphase::HalfSpace other_side{-pair.plane->normal, -pair.plane->offset};
  for (int c = 0; c < body.mesh->cluster_count(); ++c) {
    const base::Box way = merged(body.begin.cluster_boxes[static_cast<std::size_t>(c)],
                                 body.end.cluster_boxes[static_cast<std::size_t>(c)]);
    if (narrowphase::reaches(*pair.plane, way, reach) && narrowphase::reaches(other_side, way, reach))
      clusters.push_back({c, 0});
  }
}

// Of what moves straight vertices come to a plane first. What is in it at the beginning stops if it goes down.
void MotionStage::search_plane(const BodyAndPlane& pair, const narrowphase::MovingMesh& body,
                               const narrowphase::FeatureRules& rules,
                               std::span<const narrowphase::ClusterPair> clusters, std::atomic<double>* first,
                               Found& found) {
  for (const narrowphase::ClusterPair& cluster : clusters) {
    for (int v = body.mesh->vertex_begin(cluster.a); v < body.mesh->vertex_end(cluster.a); ++v) {
      const narrowphase::MovingVertex vertex = body.vertex(v);
      const std::array<int, 3> of_body{body.mesh->source_vertex(v), -1, -1}, of_plane{-1, -1, -1};
      const auto &of_a = pair.plane_is_a ? of_plane : of_body, &of_b = pair.plane_is_a ? of_body : of_plane;
      if (!rules.filter.allows(of_a, of_b)) continue;
      const double distance = rules.reach.of(of_a, of_b);
      const auto time = meeting_time_with_plane(*pair.plane, vertex, distance);
      if (!time) continue;
      FeatureImpact impact{.kind = pair.plane_is_a ? FeaturePair::plane_vertex : FeaturePair::vertex_plane,
                           .time = *time,
                           .stops = *time > 0.0 || narrowphase::goes_down(*pair.plane, vertex.at[0], vertex.at[1])};
      if (first != nullptr && !impact.stops) continue;
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

void MotionStage::make_report(const Call& call) {
  const Impacts wanted = call.options.wanted;
  report_.impacts_.clear();
  report_.pairs_.clear();
  report_.first_time_ = kNever;
  for (const Work::Shared& shared : work_.items()) {
    gather(shared, call.bodies);
    if (gathered_.empty()) continue;
    const auto stopping = std::ranges::find_if(gathered_, &FeatureImpact::stops);
    const double first = stopping == gathered_.end() ? kNever : stopping->time;
    if (wanted == Impacts::first) {
      if (!(first < report_.first_time_)) continue;
      report_.impacts_.clear();
      report_.pairs_.clear();
    }
    if (wanted != Impacts::all) gathered_.resize(1);
    report_.first_time_ = std::min(report_.first_time_, first);
    const Passing& one = passing_[shared.item];
    const BodyId a = call.bodies.in_slot(one.a).id, b = call.bodies.in_slot(one.b).id;
    report_.pairs_.push_back({a, b, first, {}});
    for (const FeatureImpact& impact : gathered_)
      report_.impacts_.push_back({a, b, impact.kind, impact.time, impact.a, impact.b, impact.stops});
  }
  std::span<const Impact> left = report_.impacts_;
  for (ImpactPair& pair : report_.pairs_) {
    const auto is_other = [&](const Impact& impact) { return !(impact.a == pair.a && impact.b == pair.b); };
    const auto size = static_cast<std::size_t>(std::ranges::find_if(left, is_other) - left.begin());
    pair.impacts = left.first(size);
    left = left.subspan(size);
  }
  report_.stats_.impacts = static_cast<std::int64_t>(report_.impacts_.size());
  count_found();
}

void MotionStage::count_found() {
  for (const Memory& memory : memory_) {
    report_.stats_.cluster_pairs += memory.cluster_pairs;
    report_.stats_.candidates += memory.counts.candidates;
    report_.stats_.searched += memory.counts.searched;
    report_.stats_.spans += memory.counts.spans;
  }
}

bool MotionStage::lower_bounds(const Bodies& bodies) {
  bool any = false;
  for (const Work::Shared& shared : work_.items()) {
    const Passing& one = passing_[shared.item];
    for (const Work::Range& range : work_.ranges(shared)) {
      for (const FeatureImpact& impact : range.found.impacts) {
        if (impact.stops && bounds_.lower(bodies, one.a, one.b, impact)) any = true;
      }
    }
  }
  return any;
}

void MotionStage::find_bounds(Call call) {
  const Bodies& bodies = call.bodies;
  const std::int64_t body_pairs = report_.stats_.body_pairs;
  call.only_changed = true;
  bounds_.begin(bodies.boxes().size());
  while (lower_bounds(bodies)) {
    bounds_.place(bodies);
    sweep(call);
    select(call);
    find(call);
    count_found();
  }
  report_.stats_.body_pairs = body_pairs;
  for (std::uint32_t slot = 0; slot < ways_.size(); ++slot) {
    if (!bodies.used(slot) || !bodies.on_its_way(slot)) continue;
    bounds_.copy(bodies, slot,
                 report_.bounds_.emplace_back(MotionReport::BodyBounds{bodies.in_slot(slot).id, {}}).of_vertices);
  }
}

}  // namespace tact
