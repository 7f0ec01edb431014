#include "engine/point_stage.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "engine/base/parallel.h"

namespace tact {

namespace {

using narrowphase::ClusterPair;
using narrowphase::FeaturePoint;

// A pair of so many cluster pairs is searched by all threads: a pair takes some microseconds, to wake a thread as much.
constexpr std::size_t kLargePair = 64;
constexpr std::size_t kRangesPerThread = 4;

// The finisher of SplitMix64 (Steele, Lea, Flood, 2014).
std::uint64_t mixed(std::uint64_t word) {
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
  return word ^ (word >> 31);
}

std::uint64_t id_of(const FeaturePoint& point, BodyId a, BodyId b) {
  std::uint64_t id = 0;
  const auto add = [&](std::uint64_t word) { id = mixed(id + 0x9e3779b97f4a7c15u + word); };
  add(static_cast<std::uint64_t>(point.kind));
  for (const BodyId body : {a, b}) add(std::uint64_t{body.generation} << 32 | body.index);
  for (const std::array<int, 3>& vertices : {point.a, point.b}) {
    for (const int v : vertices) add(static_cast<std::uint32_t>(v));
  }
  return id;
}

ContactPoint to_point(const FeaturePoint& found, BodyId a, BodyId b) {
  ContactPoint point;
  point.kind = found.kind;
  point.a_vertices = found.a;
  point.b_vertices = found.b;
  point.a_weights = found.weight_a;
  point.b_weights = found.weight_b;
  point.normal = {found.normal.x, found.normal.y, found.normal.z};
  point.gap = found.gap;
  point.id = id_of(found, a, b);
  return point;
}

// Sets of points that are connected by common vertices of either body.
class PointPatches {
 public:
  explicit PointPatches(std::span<ContactPoint> points) : points_(points), parent_(points.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  // Numbers the patches by their first point.
  void number() {
    join_by(&ContactPoint::a_vertices);
    join_by(&ContactPoint::b_vertices);
    int count = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::size_t root = root_of(i);
      points_[i].patch = root == i ? count++ : points_[root].patch;
    }
  }

 private:
  std::size_t root_of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  // The root of a set is its first point.
  void join(std::size_t i, std::size_t k) {
    const auto [first, second] = std::minmax({root_of(i), root_of(k)});
    parent_[second] = first;
  }

  void join_by(std::array<int, 3> ContactPoint::*vertices) {
    at_.clear();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      for (const int v : points_[i].*vertices) {
        if (v >= 0) at_.emplace_back(v, i);
      }
    }
    std::ranges::sort(at_);
    for (std::size_t k = 1; k < at_.size(); ++k) {
      if (at_[k].first == at_[k - 1].first) join(at_[k].second, at_[k - 1].second);
    }
  }

  std::span<ContactPoint> points_;
  std::vector<std::size_t> parent_;
  std::vector<std::pair<int, std::size_t>> at_;  // vertex, point
};

// In an order that depends on features alone.
void publish(std::span<FeaturePoint> found, BodyId a, BodyId b, std::vector<ContactPoint>& points) {
  std::ranges::sort(found, {}, &FeaturePoint::features);
  points.clear();
  points.reserve(found.size());
  for (const FeaturePoint& one : found) points.push_back(to_point(one, a, b));
  PointPatches(points).number();
}

}  // namespace

void PointStage::select(std::span<const MovedPair> moved, const Bodies& bodies) {
  wanted_.clear();
  for (const MovedPair& pair : moved) {
    PairRecord& record = *pair.record;
    const double reach = bodies.reach(record.a.index, record.b.index);
    if (in_contact(record) && reach > 0.0) wanted_.push_back({record.a.index, record.b.index, reach, &record.points});
  }
}

void PointStage::make_features(Bodies& bodies, int threads) {
  slots_.clear();
  for (const auto& one : wanted_) slots_.insert(slots_.end(), {one.a, one.b});
  bodies.make_features(slots_, threads);
}

void PointStage::run(std::span<const MovedPair> moved, Bodies& bodies, const Settings& settings,
                     narrowphase::EmbreeDevice& device) {
  select(moved, bodies);
  make_features(bodies, settings.threads);
  work_.resize(static_cast<std::size_t>(settings.threads));
  is_large_.assign(wanted_.size(), false);
  base::parallel_for(wanted_.size(), 1, settings.threads, [&](std::size_t i, int thread) {
    Work& work = work_[static_cast<std::size_t>(thread)];
    const Wanted& wanted = wanted_[i];
    const auto a = bodies.featured(wanted.a), b = bodies.featured(wanted.b);
    const auto pairs = work.near.find(a, b, wanted.reach, device);
    is_large_[i] = settings.threads > 1 && pairs.size() > kLargePair;
    if (is_large_[i]) return;
    work.found.clear();
    work.search.run(a, b, wanted.reach, pairs, work.found);
    publish(work.found, bodies.in_slot(wanted.a).id, bodies.in_slot(wanted.b).id, *wanted.points);
  });
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    if (!is_large_[i]) continue;
    const Wanted& wanted = wanted_[i];
    search_in_ranges(wanted, bodies,
                     work_[0].near.find(bodies.featured(wanted.a), bodies.featured(wanted.b), wanted.reach, device),
                     settings.threads);
  }
}

void PointStage::run_self(std::uint32_t slot, Bodies& bodies, const Settings& settings,
                          narrowphase::EmbreeDevice& device, std::vector<ContactPoint>& points) {
  points.clear();
  const double reach = bodies.reach(slot, slot);
  if (reach == 0.0) return;
  wanted_.assign(1, {slot, slot, reach, &points});
  make_features(bodies, settings.threads);
  work_.resize(static_cast<std::size_t>(settings.threads));
  const auto mesh = bodies.featured(slot);
  search_in_ranges(wanted_[0], bodies, work_[0].near.find(mesh, mesh, reach, device), settings.threads);
}

void PointStage::search_in_ranges(const Wanted& wanted, const Bodies& bodies, std::span<const ClusterPair> pairs,
                                  int threads) {
  const auto a = bodies.featured(wanted.a), b = bodies.featured(wanted.b);
  const std::size_t ranges =
      std::clamp<std::size_t>(pairs.size() / 8, 1, kRangesPerThread * static_cast<std::size_t>(threads));
  if (ranges_.size() < ranges) ranges_.resize(ranges);
  base::parallel_for(ranges, 1, threads, [&](std::size_t i, int thread) {
    const std::size_t begin = pairs.size() * i / ranges, end = pairs.size() * (i + 1) / ranges;
    ranges_[i].clear();
    work_[static_cast<std::size_t>(thread)].search.run(a, b, wanted.reach, pairs.subspan(begin, end - begin),
                                                       ranges_[i]);
  });
  std::vector<FeaturePoint>& found = work_[0].found;
  found.clear();
  for (std::size_t i = 0; i < ranges; ++i) found.insert(found.end(), ranges_[i].begin(), ranges_[i].end());
  publish(found, bodies.in_slot(wanted.a).id, bodies.in_slot(wanted.b).id, *wanted.points);
}

}  // namespace tact
