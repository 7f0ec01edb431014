#include "engine/point_stage.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "engine/base/hash.h"
#include "engine/feature_order.h"
#include "engine/pair/facet_pair_sort.h"
#include "narrowphase/contact_points/local_minimum.h"
#include "narrowphase/mesh/prefetch.h"

namespace tact {

namespace {

using narrowphase::ClusterPair;
using narrowphase::FeaturePoint;

// Microseconds that a pair of clusters takes (tact-bench points).
constexpr std::size_t kPointCost = 4;
// Points that a thread publishes at a time, at some 50 ns each.
constexpr std::size_t kPointsAtATime = 1024;

// What ids of points call a body and its vertices by. No two bodies have one key in one step.
struct Naming {
  std::uint64_t key = 0;
  const LastingNames* names = nullptr;
};

// Two edges, or vertices, of one body stand in the order of their names, which numbers may not have any more.
std::uint64_t id_of(const FeaturePoint& point, const Naming& a, const Naming& b) {
  constexpr std::uint64_t kFirst = std::uint64_t{1}
                                   << 32;  // the ids of keys that are indices stay those of version 0.1
  base::WordChain id;
  id.add(static_cast<std::uint64_t>(point.kind));
  for (const std::uint64_t key : {a.key, b.key}) id.add(key + kFirst);
  LastingNames::Feature of_a = LastingNames::of(a.names, point.a), of_b = LastingNames::of(b.names, point.b);
  const bool is_symmetric = point.kind == FeaturePair::edge_edge || point.kind == FeaturePair::vertex_vertex;
  if (a.key == b.key && is_symmetric && of_b < of_a) std::swap(of_a, of_b);
  for (const LastingNames::Feature& feature : {of_a, of_b}) {
    for (const std::uint64_t name : feature) id.add(name);
  }
  return id.value();
}

ContactPoint to_point(const FeaturePoint& found, const Naming& a, const Naming& b) {
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

// The surface whose vertex a point is of, by the names that the search has.
bool is_of_vertex_of_a(FeaturePair kind) {
  return kind == FeaturePair::vertex_facet || kind == FeaturePair::vertex_edge || kind == FeaturePair::vertex_vertex;
}
bool is_of_vertex_of_b(FeaturePair kind) {
  return kind == FeaturePair::facet_vertex || kind == FeaturePair::edge_vertex || kind == FeaturePair::vertex_vertex;
}

// The part of a point that is carried to the next step.
FeaturePoint to_feature_point(const ContactPoint& point) {
  return {.kind = is_of_vertex_of_a(point.kind)   ? FeaturePair::vertex_facet
                  : is_of_vertex_of_b(point.kind) ? FeaturePair::facet_vertex
                                                  : point.kind,
          .a = point.a_vertices,
          .b = point.b_vertices,
          .normal = {point.normal.x(), point.normal.y(), point.normal.z()},
          .gap = point.gap};
}

// Whether surfaces cross, or touch without a reach that would tell how near they are. Where hulls only touch, nothing
// has crossed.
bool cross_each_other(const PairRecord& record, double reach) {
  return record.hulls_overlap && (any_meet(record) || record.contact.containment != Containment::none) &&
         (record.contact.depth > 0.0 || reach == 0.0);
}

// A sheet with a margin keeps the side on which it is: see ContactPoint.
bool crosses_itself(const SelfRecord& record, const Bodies& bodies) {
  const std::uint32_t slot = record.body.index;
  const bool has_side = bodies.in_slot(slot).has_inside || bodies.reach(slot, slot) == 0.0;
  return has_side && any_meet(record);
}

// What the vertices of one body remember of the last step, those of its points that were nearest.
void carry(const PairRecord& record, FeaturePair kind, std::vector<narrowphase::CarriedNormal>& carried) {
  carried.clear();
  if (!record.was_in_contact) return;
  const bool of_a = kind == FeaturePair::vertex_facet;
  const auto vertex_of = [&](const ContactPoint& point) { return of_a ? point.a_vertices[0] : point.b_vertices[0]; };
  for (const ContactPoint& point : record.last_points) {
    if (of_a ? is_of_vertex_of_a(point.kind) : is_of_vertex_of_b(point.kind))
      carried.push_back({vertex_of(point), {point.normal.x(), point.normal.y(), point.normal.z()}, point.gap});
  }
  std::ranges::sort(carried, {}, [](const narrowphase::CarriedNormal& one) {
    return std::tuple(one.vertex, one.gap, one.normal.x, one.normal.y, one.normal.z);
  });
  const auto same_vertex = [](const auto& one, const auto& other) { return one.vertex == other.vertex; };
  carried.erase(std::unique(carried.begin(), carried.end(), same_vertex), carried.end());
}

// What two edges remember of it.
void carry_edges(const PairRecord& record, std::vector<FeaturePoint>& carried) {
  carried.clear();
  if (!record.was_in_contact) return;
  for (const ContactPoint& point : record.last_points) {
    if (point.kind == FeaturePair::edge_edge) carried.push_back(to_feature_point(point));
  }
}

base::Vec3 direction_of(const PairRecord& record) {
  const Eigen::Vector3d& direction = record.contact.direction;
  return {direction.x(), direction.y(), direction.z()};
}

narrowphase::SurfaceKind kind_of(const Body& body) {
  return body.has_inside ? narrowphase::SurfaceKind::closed : narrowphase::SurfaceKind::sheet;
}

// Names the features of which either is of no facet. Two vertices then have one point, whichever of them is nearest to
// the other; of one body the lesser comes first.
void name_features(const narrowphase::FeaturedMesh& a, const narrowphase::FeaturedMesh& b,
                   std::vector<FeaturePoint>& found) {
  if (a.mesh->has_surface_alone() && b.mesh->has_surface_alone()) return;
  const auto ends_before = [](const std::array<int, 3>& vertices, std::size_t count) { return vertices[count] < 0; };
  for (FeaturePoint& point : found) {
    if (point.kind == FeaturePair::edge_edge || !(a.features->is_bare(point.a) || b.features->is_bare(point.b)))
      continue;
    const bool of_a = point.kind == FeaturePair::vertex_facet;
    const std::array<int, 3>& other = of_a ? point.b : point.a;
    if (ends_before(other, 1)) {
      point.kind = FeaturePair::vertex_vertex;
    } else if (ends_before(other, 2)) {
      point.kind = of_a ? FeaturePair::vertex_edge : FeaturePair::edge_vertex;
    }
    if (a.mesh != b.mesh || point.kind != FeaturePair::vertex_vertex || point.a < point.b) continue;
    std::swap(point.a, point.b);
    point.normal = -point.normal + base::Vec3{};
  }
  const auto others = std::partition(
      found.begin(), found.end(), [](const FeaturePoint& point) { return point.kind == FeaturePair::vertex_vertex; });
  std::sort(found.begin(), others, [](const FeaturePoint& x, const FeaturePoint& y) {
    const auto order = [](const FeaturePoint& p) { return std::tie(p.a, p.b, p.normal.x, p.normal.y, p.normal.z); };
    return order(x) < order(y);
  });
  found.erase(std::unique(found.begin(), others,
                          [](const FeaturePoint& x, const FeaturePoint& y) { return x.a == y.a && x.b == y.b; }),
              others);
}

}  // namespace

// What of the bodies has crossed, before what is near is searched.
narrowphase::NearRules PointStage::find_crossing(const Bodies& bodies, Prepared& prepared) {
  const Wanted& wanted = *prepared.wanted;
  if (wanted.self != nullptr) return {.crossing = find_self_crossing(bodies, prepared)};
  const PairRecord& record = *wanted.record;
  if (!cross_each_other(record, wanted.reach)) return {.touching = direction_of(record)};
  carry(record, FeaturePair::vertex_facet, prepared.carried_a);
  carry(record, FeaturePair::facet_vertex, prepared.carried_b);
  carry_edges(record, prepared.last);
  return {.crossing = &prepared.crossing.find(
              {.a = bodies.featured(wanted.a),
               .b = bodies.featured(wanted.b),
               .surface_a = kind_of(bodies.in_slot(wanted.a)),
               .surface_b = kind_of(bodies.in_slot(wanted.b)),
               .direction = direction_of(record),
               .depth = record.contact.depth,
               .facet_pairs = with_bare(record.facet_pairs, record.bare_pairs, prepared.meeting),
               .carried = {.of_a = prepared.carried_a, .of_b = prepared.carried_b, .of_edges = prepared.last}})};
}

const narrowphase::Crossing* PointStage::find_self_crossing(const Bodies& bodies, Prepared& prepared) {
  const Wanted& wanted = *prepared.wanted;
  if (!crosses_itself(*wanted.self, bodies)) return nullptr;
  prepared.last.clear();
  for (const ContactPoint& point : wanted.self->last_points) prepared.last.push_back(to_feature_point(point));
  return &wanted.self->crossing->find(
      {.mesh = bodies.featured(wanted.a),
       .surface = kind_of(bodies.in_slot(wanted.a)),
       .reach = wanted.reach,
       .facet_pairs = with_bare(wanted.self->facet_pairs, wanted.self->bare_pairs, prepared.meeting),
       .last = prepared.last});
}

// Once the points of near features are in work.found.
void PointStage::finish(const Prepared& prepared, const Step& step, int threads, Work& work) {
  const narrowphase::Crossing* const crossing = prepared.wanted->plane ? nullptr : prepared.rules.crossing;
  if (crossing != nullptr) work.crossing_points.append(*crossing, work.found);
  if (SelfRecord* const self = prepared.wanted->self; self != nullptr && crossing != nullptr)
    self->point_limit_reached = crossing->limit_reached;
  const Wanted& wanted = *prepared.wanted;
  if (!wanted.plane) name_features(step.bodies.featured(wanted.a), step.bodies.featured(wanted.b), work.found);
  publish(wanted, step, threads, work);
}

// In an order that depends on features alone.
void PointStage::publish(const Wanted& wanted, const Step& step, int threads, Work& work) {
  const Body &a = step.bodies.in_slot(wanted.a), &b = step.bodies.in_slot(wanted.b);
  const Naming naming_a{step.bodies.keys().of(wanted.a), a.names.get()},
      naming_b{step.bodies.keys().of(wanted.b), b.names.get()};
  put_in_order(work.found, (a.plane == nullptr ? a : b).mesh.source_vertex_count(), kPointsAtATime, threads, work.order,
               *wanted.points, [&](const FeaturePoint& one) {
                 ContactPoint point = to_point(one, naming_a, naming_b);
                 point.minimum = is_local_minimum(one, {&a.mesh, a.features.get()}, {&b.mesh, b.features.get()});
                 return point;
               });
  if (!step.settings.outputs.patches)
    work.patches.number({}, *wanted.points, &a, &b);  // otherwise the patch stage numbers them, with the facet pairs
}

// Finds the cluster pairs of the i-th item, unless they are known.
PointStage::Prepared& PointStage::find_near(std::size_t i, const Step& step, Work& work) const {
  std::unique_ptr<Prepared>& slot = work.prepared[i % 2];
  if (slot == nullptr) slot = std::make_unique<Prepared>();
  Prepared& prepared = *slot;
  if (work.ahead == i + 1) return prepared;
  const Wanted& wanted = wanted_[i];
  prepared.wanted = &wanted;
  prepared.cluster_pairs = {};
  if (wanted.plane) {
    find_near_plane(prepared);
    prepared.cluster_pairs = prepared.vertex_blocks;
  } else if (wanted.self != nullptr) {
    prepared.cluster_pairs = wanted.self->may_contact;
  } else if (wanted.reach > 0.0) {
    prepared.cluster_pairs =
        prepared.near.find({.mesh = step.bodies.featured(wanted.a).mesh}, {.mesh = step.bodies.featured(wanted.b).mesh},
                           wanted.reach, step.bodies.tuning(), step.device);
  }
  return prepared;
}

// In blocks that threads can share.
void PointStage::find_near_plane(Prepared& prepared) {
  constexpr std::size_t kBlock = 64;  // vertices, some 40 ns each
  find_near_vertices(prepared.wanted->plane, prepared.wanted->reach, prepared.near_plane);
  prepared.vertex_blocks.clear();
  for (std::size_t begin = 0; begin < prepared.near_plane.size(); begin += kBlock)
    prepared.vertex_blocks.push_back(
        {static_cast<int>(begin), static_cast<int>(std::min(begin + kBlock, prepared.near_plane.size()))});
}

// A point of each vertex that is nearer than the margins, or not above the plane.
void PointStage::search_plane(const Prepared& prepared, std::span<const ClusterPair> blocks,
                              std::vector<FeaturePoint>& found) {
  const auto& [body, plane, plane_is_a] = prepared.wanted->plane;
  const base::Vec3 normal = prepared.wanted->plane.direction();
  for (const ClusterPair& block : blocks) {
    for (int i = block.a; i < block.b; ++i) {
      const int vertex = prepared.near_plane[static_cast<std::size_t>(i)];
      const double gap = narrowphase::height_over(*plane, body->mesh.position(vertex));
      if (!(gap < prepared.wanted->reach || gap <= 0.0)) continue;
      FeaturePoint point{
          .kind = plane_is_a ? FeaturePair::plane_vertex : FeaturePair::vertex_plane, .normal = normal, .gap = gap};
      (plane_is_a ? point.b : point.a)[0] = body->mesh.source_vertex(vertex);
      (plane_is_a ? point.weight_b : point.weight_a)[0] = 1.0;
      found.push_back(point);
    }
  }
}

// Finds those of an item, and prefetches what its search reads of them.
void PointStage::look_ahead(std::size_t i, const Step& step, Work& work) const {
  const std::span<const ClusterPair> pairs = find_near(i, step, work).cluster_pairs;
  work.ahead = i + 1;
  if (wanted_[i].plane) return;
  const auto prefetch = [](const narrowphase::FeaturedMesh& m, int cluster) {
    narrowphase::prefetch_facets(*m.mesh, cluster);
    m.features->prefetch(*m.mesh, cluster);
  };
  const auto a = step.bodies.featured(wanted_[i].a), b = step.bodies.featured(wanted_[i].b);
  int last_a = -1;
  std::uint64_t done_b = 0;  // by the last bits of their numbers
  for (const ClusterPair& pair : pairs) {
    if (pair.a != last_a) prefetch(a, last_a = pair.a);
    const std::uint64_t bit = std::uint64_t{1} << (pair.b % 64);
    if ((done_b & bit) == 0) prefetch(b, pair.b);
    done_b |= bit;
  }
}

// A large item is put aside when it is known what of it has crossed.
void PointStage::find_points(std::size_t i, const Step& step, Work& work) {
  const int threads = step.settings.threads;
  Prepared& prepared = find_near(i, step, work);
  const std::size_t cost = kPointCost * prepared.cluster_pairs.size();
  const bool large = is_large(cost, wanted_.size(), threads, step.bodies.tuning());
  const std::size_t own_end = threads == 1 ? wanted_.size() : i - i % step.grain + step.grain;
  if (!large && step.prefetches && i + 1 < std::min(own_end, wanted_.size())) look_ahead(i + 1, step, work);
  if (!prepared.wanted->plane) prepared.rules = find_crossing(step.bodies, prepared);
  prepared.rules.a_is_solid = step.bodies.is_solid(prepared.wanted->a);
  prepared.rules.b_is_solid = step.bodies.is_solid(prepared.wanted->b);
  if (large) {
    large_.put_aside(work.prepared[i % 2], prepared.cluster_pairs,
                     count_of_ranges(cost, threads, step.bodies.tuning()));
    return;
  }
  work.found.clear();
  search(prepared, prepared.cluster_pairs, step, narrowphase::ContactPointSearch::Given::all, work.found, work);
  finish(prepared, step, 1, work);
}

void PointStage::search(const Prepared& prepared, std::span<const ClusterPair> pairs, const Step& step,
                        narrowphase::ContactPointSearch::Given given, std::vector<FeaturePoint>& found, Work& work) {
  const Wanted& wanted = *prepared.wanted;
  if (wanted.plane) return search_plane(prepared, pairs, found);
  work.search.run(step.bodies.featured(wanted.a), step.bodies.featured(wanted.b), wanted.reach, pairs, found,
                  prepared.rules, given);
}

void PointStage::find_wanted(Bodies& bodies, const Settings& settings, narrowphase::EmbreeDevice& device) {
  slots_.clear();
  for (const Wanted& one : wanted_) slots_.insert(slots_.end(), {one.a, one.b});
  bodies.make_features(slots_, settings.threads);
  work_.resize(settings.threads);
  for (Work& work : work_) work.ahead = 0;
  const auto facets_of = [&](std::size_t i) {
    return std::min(bodies.in_slot(wanted_[i].a).mesh.facet_count(), bodies.in_slot(wanted_[i].b).mesh.facet_count());
  };
  const Step step{.bodies = bodies,
                  .settings = settings,
                  .device = device,
                  .grain = items_at_a_time(wanted_.size(), settings.threads, bodies.tuning(), facets_of),
                  .prefetches = !bodies.stay_in_cache()};
  const auto search_range = [&](const Large::Shared& shared, Large::Range& range, int thread) {
    const Prepared& prepared = *shared.item;
    range.found.clear();
    search(prepared, prepared.cluster_pairs.subspan(range.begin, range.end - range.begin), step,
           narrowphase::ContactPointSearch::Given::some, range.found, work_[thread]);
  };
  const bool few = is_few(wanted_.size(), settings.threads, bodies.tuning());
  large_.begin();
  large_.prepare(
      wanted_.size(), step.grain, settings.threads, few,
      [&](std::size_t i, int thread) { find_points(i, step, work_[thread]); }, search_range);
  large_.search(settings.threads, search_range);
  large_.gather(settings.threads, [&](Large::Shared& shared, int thread, int threads) {
    Work& work = work_[thread];
    large_.collect(shared, work.found);
    finish(*shared.item, step, threads, work);
  });
}

void PointStage::find(std::span<const MovedPair> moved, Bodies& bodies, const Settings& settings,
                      narrowphase::EmbreeDevice& device) {
  wanted_.clear();
  for (const MovedPair& pair : moved) {
    PairRecord& record = *pair.record;
    const std::uint32_t a = record.a.index, b = record.b.index;
    const double reach = bodies.reach(a, b);
    const BodyAndPlane plane = in_contact(record) ? body_and_plane(bodies, a, b) : BodyAndPlane{};
    if (plane || (in_contact(record) && reach > 0.0) || cross_each_other(record, reach))
      wanted_.push_back({a, b, reach, &record.points, &record, nullptr, plane});
  }
  find_wanted(bodies, settings, device);
}

void PointStage::find(std::span<SelfRecord* const> selves, Bodies& bodies, const Settings& settings,
                      narrowphase::EmbreeDevice& device) {
  wanted_.clear();
  for (SelfRecord* const one : selves) {
    const bool crosses = crosses_itself(*one, bodies);
    if (one->may_contact.empty() && !crosses) continue;
    if (crosses && one->crossing == nullptr) one->crossing = std::make_unique<narrowphase::SelfCrossing>();
    const std::uint32_t slot = one->body.index;
    wanted_.push_back({slot, slot, bodies.reach(slot, slot), &one->points, nullptr, one});
  }
  find_wanted(bodies, settings, device);
}

}  // namespace tact
