#include "engine/pair/pair_work.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "engine/base/fast_paths.h"
#include "engine/base/parallel.h"
#include "narrowphase/depth/smallest_separation.h"
#include "narrowphase/direction/contact_direction.h"
#include "narrowphase/hull/hull_verdict.h"

namespace tact {

namespace {

using base::Timer;
using base::Vec3;
using namespace narrowphase;

// A pair of bodies is cut into ranges if it has many pairs of clusters, or if a step has few pairs of bodies to share
// out. A pair of clusters takes about a microsecond, and at a border between ranges a few clusters are opened twice.
constexpr std::size_t kLargePair = 4096, kFewestInRanges = 128, kFewestInRange = 32;  // pairs of clusters
constexpr std::size_t kPairsPerThread = 4;                                            // pairs of bodies
constexpr std::size_t kRangesPerThread = 4;

using base::fast_paths;
using base::FastPaths;

// What the last step knew of a pair is a start from which less is to be done; its direction is more than that.
bool starts_from_last_step() { return fast_paths() != FastPaths::off; }

Eigen::Vector3d to_eigen(Vec3 v) { return {v.x, v.y, v.z}; }

void set_apart(PairRecord& record, Vec3 direction) {
  record.hulls_overlap = record.near = false;
  record.history.kind = PairHistory::Kind::separated;
  record.history.direction = direction;
  record.history.has_surface = false;
}

// Do the vertices that showed the hulls to overlap in the last step show it still? No support query.
bool still_overlap(const PairRecord& record, const MinkowskiDifference& m, PairWork& work) {
  const PairHistory& history = record.history;
  work.surface_is_placed =
      history.has_surface && record.surface->face_count > 0 && work.smallest.surface.start(m, *record.surface);
  if (work.surface_is_placed) return true;
  return history.kind == PairHistory::Kind::overlapping && holds_origin(m, history.hulls);
}

// The hulls are apart along the history's direction, by less than the bodies' margins.
void set_near(PairRecord& record, double distance, double plane_a, double plane_b) {
  record.near = true;
  Contact& contact = record.contact;
  contact = Contact{};
  contact.a = record.a;
  contact.b = record.b;
  contact.direction = to_eigen(record.history.direction);
  contact.depth = -distance;
  contact.limit_reached = record.counts.limit_reached;
  contact.plane_a = plane_a;
  contact.plane_b = plane_b;
}

// Stage 3. What showed the hulls to overlap in the last step is asked first; or the direction that parted them: a
// plane, then one support query a body. Leaves the direction that parts the hulls in the history; returns whether they
// overlap, or nearly do.
bool hulls_overlap(PairRecord& record, const MinkowskiDifference& m, double reach, const GjkSettings& settings,
                   PairWork& work) {
  PairHistory& history = record.history;
  record.counts.still_overlapping = starts_from_last_step() && still_overlap(record, m, work);
  if (record.counts.still_overlapping) return true;
  if (starts_from_last_step() && history.kind == PairHistory::Kind::separated) {
    const int a = history.hulls.a[0], b = history.hulls.b[0];
    const bool apart = reach == 0.0 && m.separated_by_plane(history.direction, a, b);
    record.counts.gjk_iterations += apart ? 0 : 1;
    const auto w = [&] { return dot(history.direction, m.support(history.direction, m.vertex(a, b)).point); };
    if (apart || w() < -(m.height_error() + m.scale() * reach)) {
      record.counts.still_separated = true;
      set_apart(record, history.direction);
      return false;
    }
  }
  const GjkResult hulls = gjk(m, {}, starts_from_last_step() ? history.hulls : GjkSimplex{}, settings);
  history.hulls = hulls.simplex;
  record.counts.gjk_iterations += hulls.support_queries;
  record.counts.limit_reached = hulls.status == GjkStatus::limit_reached;
  if (hulls.status == GjkStatus::overlapping) return true;
  Vec3 parting = -hulls.offset;
  if (hulls.status != GjkStatus::apart) {
    const HullVerdict exact = hull_verdict(m, hulls.simplex);
    record.counts.gjk_iterations += exact.support_queries;
    history.hulls = exact.simplex;
    if (!exact.apart) return true;
    parting = exact.direction;
  }
  set_apart(record, normalized(parting));
  if (hulls.distance < m.scale() * reach) {
    const ClosestPoints closest = closest_points(m, hulls);
    set_near(record, hulls.distance / m.scale(), dot(history.direction, closest.a), dot(history.direction, closest.b));
  }
  return false;
}

struct Direction {
  ContactDirection found;
  DirectionSource source = DirectionSource::smallest;
};

// The surface that the search for the smallest separation starts from and leaves, if every step searches.
SurfaceShape* surface_of(PairRecord& record, const Settings& settings) {
  if (settings.direction != DirectionPolicy::smallest || !starts_from_last_step()) return nullptr;
  if (record.surface == nullptr) record.surface = std::make_unique<SurfaceShape>();
  if (!record.history.has_surface) record.surface->face_count = 0;
  record.history.has_surface = true;
  return record.surface.get();
}

// Stage 4. A pair that is new and already overlapping starts from its smallest separation.
Direction find_direction(PairRecord& record, const MinkowskiDifference& m, const Settings& settings, PairWork& work) {
  const DirectionSettings direction_settings{{settings.gjk_tolerance}, settings.iteration_limit};
  const PairHistory& history = record.history;
  const bool fresh_start = history.kind == PairHistory::Kind::none;
  if (!fresh_start && settings.direction == DirectionPolicy::carried) {
    const bool carried = history.kind == PairHistory::Kind::overlapping;
    const GjkSimplex face = carried && starts_from_last_step() ? record.face : GjkSimplex{};
    return {contact_direction(m, history.direction, face, direction_settings, work.faces),
            carried ? DirectionSource::carried : DirectionSource::fresh};
  }
  const SmallestStart start{.preferred = fresh_start ? Vec3{0.0, 0.0, 1.0} : history.direction,
                            .hulls = history.hulls,
                            .shape = surface_of(record, settings),
                            .is_placed = work.surface_is_placed};
  const SmallestSeparation smallest = smallest_separation(m, start, work.smallest);
  record.counts.gjk_iterations += smallest.support_queries;
  Direction direction{contact_direction(m, smallest.direction, smallest.face, direction_settings, work.faces),
                      DirectionSource::smallest};
  direction.found.limit_reached = direction.found.limit_reached || smallest.limit_reached;
  return direction;
}

// The planes go through the vertices that the last support query of the direction found.
Slab slab_of(const MinkowskiDifference& m, const ContactDirection& found) {
  const double upper = dot(found.n, m.a().position(found.top_a) - m.origin());
  const double lower = dot(found.n, m.b().position(found.top_b) - m.origin());
  return make_slab(found.n, m.origin(), lower, upper, m.vertex_height_error());
}

ZoneDisk zone_disk(const Slab& slab, const ImpactZone& zone, double height) {
  if (zone.disk.radius < 0.0) return {};
  return {to_eigen(slab.origin + zone.disk.center.x * slab.u + zone.disk.center.y * slab.v + height * slab.n),
          zone.disk.radius};
}

void fill_contact(PairRecord& record, const MinkowskiDifference& m, const Direction& direction, const Slab& slab) {
  Contact& contact = record.contact;
  contact = Contact{};
  contact.a = record.a;
  contact.b = record.b;
  contact.direction = to_eigen(slab.n);
  contact.depth = std::max(0.0, direction.found.height / m.scale());
  contact.source = direction.source;
  contact.iterations = direction.found.iterations;
  contact.limit_reached = record.counts.limit_reached || direction.found.limit_reached;
  const double base = dot(slab.n, slab.origin);
  contact.plane_a = base + slab.upper;
  contact.plane_b = base + slab.lower;
}

void count_facets(const Body& a, const Body& b, PairWork& work) {
  FacetCounts& counts = work.record->facet_counts;
  counts.facets = a.mesh.facet_count() + b.mesh.facet_count();
  counts.clusters = a.mesh.cluster_count() + b.mesh.cluster_count();
  counts.clusters_outside_slab = work.kept_a.outside_slab + work.kept_b.outside_slab;
  counts.clusters_outside_box =
      counts.clusters - counts.clusters_outside_slab - work.kept_a.count() - work.kept_b.count();
}

// Stage 5.
void cull(PairRecord& record, const Body& a, const Body& b, const Slab& slab, const Settings& settings,
          EmbreeDevice& device, PairWork& work) {
  const bool paper = settings.accuracy == Accuracy::paper;
  ImpactZone zone_a, zone_b;
  const bool zones = paper || settings.outputs.zones;
  if (zones) {
    zone_a = impact_zone(a.mesh, slab, work.zone_points);
    zone_b = impact_zone(b.mesh, slab, work.zone_points);
    record.contact.zone_a = zone_disk(slab, zone_a, slab.lower);
    record.contact.zone_b = zone_disk(slab, zone_b, slab.upper);
  }
  work.input = {.a = &a.mesh,
                .b = &b.mesh,
                .criteria_a = criteria_for_a(slab, zones ? &zone_b : nullptr, paper && a.surface == Surface::closed),
                .criteria_b = criteria_for_b(slab, zones ? &zone_a : nullptr, paper && b.surface == Surface::closed),
                .kept_a = &work.kept_a,
                .kept_b = &work.kept_b};
  cull_clusters(a.mesh, work.input.criteria_a, b.mesh.box(), work.kept_a);
  if (work.asks_ahead) prefetch_facets(a.mesh, work.kept_a);
  cull_clusters(b.mesh, work.input.criteria_b, work.kept_a.bounds, work.kept_b);
  if (work.asks_ahead) prefetch_facets(b.mesh, work.kept_b);
  cull_again(work.kept_b.bounds, work.kept_a);
  count_facets(a, b, work);
  record.facet_counts.used_trees = find_cluster_pairs(work.kept_a, work.kept_b, ClusterPairSource::automatic, device,
                                                      work.cluster_pairs, work.cluster_pair_work);
  record.facet_counts.cluster_pairs = static_cast<std::int64_t>(work.cluster_pairs.size());
}

void sort_facet_pairs(PairWork& work, int threads) {
  std::vector<FacetPair>& pairs = work.record->facet_pairs;
  if (pairs.size() <= kMostSorted) return kernels().sort_pairs(pairs.data(), static_cast<int>(pairs.size()));
  const auto bits_of = [](const ClusteredMesh& mesh) {
    return std::bit_width(static_cast<unsigned>(mesh.facet_count()));
  };
  const auto bits_a = bits_of(*work.input.a), bits_b = bits_of(*work.input.b);
  const std::span<std::uint64_t> keys = work.sorter.keys(pairs.size());
  std::ranges::transform(pairs, keys.begin(), [&](const FacetPair& pair) {
    return static_cast<std::uint64_t>(pair.a) << bits_b | static_cast<std::uint64_t>(pair.b);
  });
  std::ranges::transform(work.sorter.sort(bits_a + bits_b, threads), pairs.begin(), [&](std::uint64_t key) {
    return FacetPair{static_cast<int>(key >> bits_b), static_cast<int>(key & ((std::uint64_t{1} << bits_b) - 1))};
  });
}

void finish(PairWork& work, const ConfirmCounts& counts, int threads) {
  PairRecord& record = *work.record;
  sort_facet_pairs(work, threads);
  record.contact.kept_facets_a = work.cull_a.kept;
  record.contact.kept_facets_b = work.cull_b.kept;
  record.facet_counts.cull = work.cull_a;
  record.facet_counts.cull += work.cull_b;
  record.facet_counts.facet_box_pairs = counts.facet_box_pairs;
  record.facet_counts.triangle_tests = counts.triangle_tests;
  record.facet_counts.exact_predicates = counts.predicates.exact;
}

}  // namespace

bool find_direction_and_cull(PairRecord& record, const Body& a, const Body& b, double reach, const Settings& settings,
                             EmbreeDevice& device, PairWork& work, Timer& timer) {
  record.counts = {};
  record.counts.begin = timer.start();
  if (in_contact(record)) {
    record.facet_pairs.clear();
    record.patches.clear();
    record.points.clear();
  }
  const MinkowskiDifference m(a.mesh, b.mesh);
  const bool overlap = hulls_overlap(record, m, reach, {settings.gjk_tolerance}, work);
  record.counts.hulls_ms = static_cast<float>(timer.lap());
  if (!overlap) return false;

  const Direction direction = find_direction(record, m, settings, work);
  record.counts.gjk_iterations += direction.found.support_queries;
  record.hulls_overlap = true;
  record.near = false;
  record.facet_counts = {};
  record.history.kind = PairHistory::Kind::overlapping;
  record.history.direction = direction.found.n;
  record.face = direction.found.face;
  const Slab slab = slab_of(m, direction.found);
  fill_contact(record, m, direction, slab);
  record.counts.direction_ms = static_cast<float>(timer.lap());
  if (settings.accuracy == Accuracy::hulls) return false;

  work.record = &record;
  cull(record, a, b, slab, settings, device, work);
  record.counts.cull_ms = static_cast<float>(timer.lap());
  return !work.cluster_pairs.empty();
}

void confirm(PairWork& work, Timer& timer) {
  ConfirmCounts counts;
  work.search.run(work.input, work.cluster_pairs, 0, work.cluster_pairs.size(), work.record->facet_pairs, counts);
  work.cull_a = work.cull_b = {};
  for (const OpenedCluster& one : work.search.opened_a()) work.cull_a += one.counts;
  for (const OpenedCluster& one : work.search.opened_b()) work.cull_b += one.counts;
  finish(work, counts, 1);
  work.record->counts.confirm_ms = static_cast<float>(timer.lap());
}

bool is_large(const PairWork& work, std::size_t pairs, int threads) {
  if (threads == 1 || fast_paths() == FastPaths::off) return false;
  const std::size_t size = work.cluster_pairs.size();
  return fast_paths() == FastPaths::always || size > kLargePair ||
         (size > kFewestInRanges && pairs < kPairsPerThread * static_cast<std::size_t>(threads));
}

namespace {

// Where the i-th of `count` ranges begins: between two clusters of A.
std::size_t range_begin(const std::vector<ClusterPair>& pairs, std::size_t i, std::size_t count) {
  std::size_t begin = pairs.size() * i / count;
  while (begin > 0 && begin < pairs.size() && pairs[begin].a == pairs[begin - 1].a) ++begin;
  return begin;
}

}  // namespace

void confirm_in_ranges(PairWork& work, std::vector<PairWork>& thread_work, int threads) {
  Timer timer;
  work.ranges_begin = timer.start();
  // Equally many for each thread that has enough to do; of large pairs several, so that threads end together.
  const std::size_t pairs = work.cluster_pairs.size();
  const std::size_t fewest = fast_paths() == FastPaths::always ? 1 : kFewestInRange;
  const std::size_t at_once = std::clamp<std::size_t>(pairs / fewest, 1, static_cast<std::size_t>(threads));
  work.range_count = at_once * std::clamp<std::size_t>(pairs / (2 * fewest * at_once), 1, kRangesPerThread);
  if (work.ranges.size() < work.range_count) work.ranges.resize(work.range_count);
  base::parallel_for(work.range_count, 1, threads, [&](std::size_t i, int thread) {
    ConfirmedRange& range = work.ranges[i];
    range.thread = thread;
    range.begin = Timer::Clock::now();
    range.found.clear();
    range.counts = {};
    FacetPairSearch& search = thread_work[static_cast<std::size_t>(thread)].search;
    search.run(work.input, work.cluster_pairs, range_begin(work.cluster_pairs, i, work.range_count),
               range_begin(work.cluster_pairs, i + 1, work.range_count), range.found, range.counts);
    range.opened_a = search.opened_a();
    range.opened_b = search.opened_b();
    range.end = Timer::Clock::now();
  });
  // A cluster of B that several ranges opened counts once.
  work.seen_b.assign(static_cast<std::size_t>(work.kept_b.count()), false);
  ConfirmCounts counts;
  work.cull_a = work.cull_b = {};
  for (const ConfirmedRange& range : std::span(work.ranges).first(work.range_count)) {
    work.record->facet_pairs.insert(work.record->facet_pairs.end(), range.found.begin(), range.found.end());
    counts.facet_box_pairs += range.counts.facet_box_pairs;
    counts.triangle_tests += range.counts.triangle_tests;
    counts.predicates.exact += range.counts.predicates.exact;
    for (const OpenedCluster& one : range.opened_a) work.cull_a += one.counts;
    for (const OpenedCluster& one : range.opened_b) {
      if (!std::exchange(work.seen_b[static_cast<std::size_t>(one.index)], true)) work.cull_b += one.counts;
    }
  }
  finish(work, counts, threads);
  work.record->counts.confirm_ms = static_cast<float>(timer.lap());
}

}  // namespace tact
