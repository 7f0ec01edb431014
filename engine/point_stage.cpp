#include "engine/point_stage.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "engine/base/parallel.h"
#include "narrowphase/mesh/prefetch.h"

namespace tact {

namespace {

using narrowphase::ClusterPair;
using narrowphase::FeaturePoint;

// A pair of so many cluster pairs is searched by all threads: a pair takes some microseconds, to wake a thread as much.
constexpr std::size_t kLargePair = 64;
constexpr std::size_t kRangesPerThread = 4;
// So many pairs a thread takes at a time: it prefetches the next one of them while it searches one.
constexpr std::size_t kPairsAtATime = 8;

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

// What lasts of it.
FeaturePoint to_feature_point(const ContactPoint& point) {
  return {.kind = point.kind,
          .a = point.a_vertices,
          .b = point.b_vertices,
          .normal = {point.normal.x(), point.normal.y(), point.normal.z()},
          .gap = point.gap};
}

// Whether surfaces cross, or touch at a distance that is not known. Where hulls only touch, nothing has crossed.
bool cross_each_other(const PairRecord& record, double reach) {
  return record.hulls_overlap && (!record.facet_pairs.empty() || record.contact.containment != Containment::none) &&
         (record.contact.depth > 0.0 || reach == 0.0);
}

// What the vertices of one body remember of the last step, those of its points that were nearest.
void carry(const PairRecord& record, FeaturePair kind, std::vector<narrowphase::CarriedNormal>& carried) {
  carried.clear();
  if (!record.was_in_contact) return;
  const auto vertex_of = [&](const ContactPoint& point) {
    return kind == FeaturePair::vertex_facet ? point.a_vertices[0] : point.b_vertices[0];
  };
  for (const ContactPoint& point : record.last_points) {
    if (point.kind == kind)
      carried.push_back({vertex_of(point), {point.normal.x(), point.normal.y(), point.normal.z()}, point.gap});
  }
  std::ranges::sort(carried, {}, [](const narrowphase::CarriedNormal& one) {
    return std::tuple(one.vertex, one.gap, one.normal.x, one.normal.y, one.normal.z);
  });
  const auto same_vertex = [](const auto& one, const auto& other) { return one.vertex == other.vertex; };
  carried.erase(std::unique(carried.begin(), carried.end(), same_vertex), carried.end());
}

base::Vec3 direction_of(const PairRecord& record) {
  const Eigen::Vector3d& direction = record.contact.direction;
  return {direction.x(), direction.y(), direction.z()};
}

narrowphase::SurfaceKind kind_of(const Body& body) {
  return body.surface == Surface::closed ? narrowphase::SurfaceKind::closed : narrowphase::SurfaceKind::sheet;
}

}  // namespace

// The vertices that have crossed, which need no search for what is near them.
narrowphase::CrossedVertices PointStage::begin_crossing(const Wanted& wanted, const Bodies& bodies, Work& work) {
  if (wanted.record == nullptr || !cross_each_other(*wanted.record, wanted.reach)) return {};
  const PairRecord& record = *wanted.record;
  carry(record, FeaturePair::vertex_facet, work.carried_a);
  carry(record, FeaturePair::facet_vertex, work.carried_b);
  return work.crossing.begin({.a = bodies.featured(wanted.a),
                              .b = bodies.featured(wanted.b),
                              .surface_a = kind_of(bodies.in_slot(wanted.a)),
                              .surface_b = kind_of(bodies.in_slot(wanted.b)),
                              .direction = direction_of(record),
                              .depth = record.contact.depth,
                              .facet_pairs = record.facet_pairs,
                              .carried_a = work.carried_a,
                              .carried_b = work.carried_b});
}

void PointStage::cross_itself(const Wanted& wanted, const Bodies& bodies, Work& work) {
  work.last.clear();
  for (const ContactPoint& point : wanted.self->last_points) work.last.push_back(to_feature_point(point));
  wanted.self->crossing->run({.mesh = bodies.featured(wanted.a),
                              .surface = kind_of(bodies.in_slot(wanted.a)),
                              .reach = wanted.reach,
                              .facet_pairs = wanted.self->facet_pairs,
                              .last = work.last},
                             work.found);
}

void PointStage::finish_crossing(const Wanted& wanted, Work& work) {
  if (wanted.record == nullptr) return;
  if (cross_each_other(*wanted.record, wanted.reach)) {
    work.crossing.finish(work.found);
    return;
  }
  // What touches in a vertex or an edge has no side of its own.
  const base::Vec3 contact = direction_of(*wanted.record);
  for (FeaturePoint& point : work.found) {
    if (point.gap == 0.0 && dot(point.normal, contact) < 0.0) point.normal = -point.normal;
  }
}

// In an order that depends on features alone. Points are large: what is sorted is what tells most of them apart.
void PointStage::publish(const Wanted& wanted, const Bodies& bodies, Work& work) const {
  const std::vector<FeaturePoint>& found = work.found;
  work.order.clear();
  const auto rank = [](int vertex) { return std::uint64_t{static_cast<std::uint32_t>(vertex + 1)}; };  // of -1: 0
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& a = found[i].a;
    work.order.push_back({static_cast<std::uint64_t>(found[i].kind) << 32 | rank(a[0]), rank(a[1]) << 32 | rank(a[2]),
                          static_cast<std::uint32_t>(i)});
  }
  std::sort(work.order.begin(), work.order.end(), [&](const PointOrder& one, const PointOrder& other) {
    if (one.kind_and_first != other.kind_and_first) return one.kind_and_first < other.kind_and_first;
    if (one.others != other.others) return one.others < other.others;
    return found[one.place].b < found[other.place].b;
  });
  const Body &a = bodies.in_slot(wanted.a), &b = bodies.in_slot(wanted.b);
  std::vector<ContactPoint>& points = *wanted.points;
  points.clear();
  if (points.capacity() < found.size()) points.reserve(found.size() + found.size() / 4);
  for (const PointOrder& one : work.order) points.push_back(to_point(found[one.place], a.id, b.id));
  if (numbers_patches_) work.patches.number({}, points, &a, &b);
}

void PointStage::select(std::span<const MovedPair> moved, const Bodies& bodies) {
  wanted_.clear();
  for (const MovedPair& pair : moved) {
    PairRecord& record = *pair.record;
    const double reach = bodies.reach(record.a.index, record.b.index);
    if ((in_contact(record) && reach > 0.0) || cross_each_other(record, reach))
      wanted_.push_back({record.a.index, record.b.index, reach, &record.points, &record});
  }
}

void PointStage::make_features(Bodies& bodies, int threads) {
  slots_.clear();
  for (const auto& one : wanted_) slots_.insert(slots_.end(), {one.a, one.b});
  bodies.make_features(slots_, threads);
}

// Those of the i-th pair, found already or now.
std::span<const ClusterPair> PointStage::near_clusters(std::size_t i, const Bodies& bodies, Work& work,
                                                       narrowphase::EmbreeDevice& device) const {
  if (work.ahead == i + 1) return work.ahead_pairs;
  const Wanted& wanted = wanted_[i];
  if (!(wanted.reach > 0.0)) return {};
  return work.near[i % 2].find(bodies.featured(wanted.a), bodies.featured(wanted.b), wanted.reach, bodies.tuning(),
                               device);
}

// Finds those of a pair, and prefetches what its search reads of them.
void PointStage::look_ahead(std::size_t i, const Bodies& bodies, Work& work, narrowphase::EmbreeDevice& device) const {
  work.ahead_pairs = near_clusters(i, bodies, work, device);
  work.ahead = i + 1;
  const auto prefetch = [](const narrowphase::FeaturedMesh& m, int cluster) {
    narrowphase::prefetch_facets(*m.mesh, cluster);
    m.features->prefetch(*m.mesh, cluster);
  };
  const auto a = bodies.featured(wanted_[i].a), b = bodies.featured(wanted_[i].b);
  int last_a = -1;
  std::uint64_t done_b = 0;  // by the last bits of their numbers
  for (const ClusterPair& pair : work.ahead_pairs) {
    if (pair.a != last_a) prefetch(a, last_a = pair.a);
    const std::uint64_t bit = std::uint64_t{1} << (pair.b % 64);
    if ((done_b & bit) == 0) prefetch(b, pair.b);
    done_b |= bit;
  }
}

void PointStage::run(std::span<const MovedPair> moved, Bodies& bodies, const Settings& settings,
                     narrowphase::EmbreeDevice& device) {
  numbers_patches_ = !settings.outputs.patches;  // or that is done with the facet pairs
  select(moved, bodies);
  make_features(bodies, settings.threads);
  work_.resize(settings.threads);
  is_large_.assign(wanted_.size(), false);
  for (Work& work : work_) work.ahead = 0;
  const bool prefetches = !bodies.stay_in_cache();
  // Few pairs are shared out one by one.
  const std::size_t grain =
      wanted_.size() < 4 * kPairsAtATime * static_cast<std::size_t>(settings.threads) ? 1 : kPairsAtATime;
  base::parallel_for(wanted_.size(), grain, settings.threads, [&](std::size_t i, int thread) {
    Work& work = work_[thread];
    const Wanted& wanted = wanted_[i];
    const auto a = bodies.featured(wanted.a), b = bodies.featured(wanted.b);
    work.found.clear();
    const std::span<const ClusterPair> pairs = near_clusters(i, bodies, work, device);
    is_large_[i] = settings.threads > 1 && pairs.size() > kLargePair;
    if (is_large_[i]) return;
    const std::size_t own_end = settings.threads == 1 ? wanted_.size() : i - i % grain + grain;
    if (prefetches && i + 1 < std::min(own_end, wanted_.size())) look_ahead(i + 1, bodies, work, device);
    const narrowphase::CrossedVertices crossed = begin_crossing(wanted, bodies, work);
    work.search.run(a, b, wanted.reach, pairs, work.found, crossed, narrowphase::ContactPointSearch::Given::all);
    finish_crossing(wanted, work);
    publish(wanted, bodies, work);
  });
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    if (!is_large_[i]) continue;
    const Wanted& wanted = wanted_[i];
    search_in_ranges(wanted, bodies,
                     work_[0].near[0].find(bodies.featured(wanted.a), bodies.featured(wanted.b), wanted.reach,
                                           bodies.tuning(), device),
                     settings.threads);
  }
}

void PointStage::run_self(const Self& self, Bodies& bodies, const Settings& settings,
                          std::vector<ContactPoint>& points) {
  points.clear();
  if (self.cluster_pairs.empty() && self.crossing == nullptr) return;
  numbers_patches_ = !settings.outputs.patches;
  wanted_.assign(
      1,
      {.a = self.slot, .b = self.slot, .reach = bodies.reach(self.slot, self.slot), .points = &points, .self = &self});
  make_features(bodies, settings.threads);
  work_.resize(settings.threads);
  search_in_ranges(wanted_[0], bodies, self.cluster_pairs, settings.threads);
}

void PointStage::search_in_ranges(const Wanted& wanted, const Bodies& bodies, std::span<const ClusterPair> pairs,
                                  int threads) {
  const auto a = bodies.featured(wanted.a), b = bodies.featured(wanted.b);
  const std::size_t ranges =
      std::clamp<std::size_t>(pairs.size() / 8, 1, kRangesPerThread * static_cast<std::size_t>(threads));
  if (ranges_.size() < ranges) ranges_.resize(ranges);
  const narrowphase::CrossedVertices crossed = begin_crossing(wanted, bodies, work_[0]);
  base::parallel_for(ranges, 1, threads, [&](std::size_t i, int thread) {
    const std::size_t begin = pairs.size() * i / ranges, end = pairs.size() * (i + 1) / ranges;
    ranges_[i].clear();
    work_[thread].search.run(a, b, wanted.reach, pairs.subspan(begin, end - begin), ranges_[i], crossed);
  });
  std::vector<FeaturePoint>& found = work_[0].found;
  found.clear();
  for (std::size_t i = 0; i < ranges; ++i) found.insert(found.end(), ranges_[i].begin(), ranges_[i].end());
  finish_crossing(wanted, work_[0]);
  if (wanted.self != nullptr && wanted.self->crossing != nullptr) cross_itself(wanted, bodies, work_[0]);
  publish(wanted, bodies, work_[0]);
}

}  // namespace tact
