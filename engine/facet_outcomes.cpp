#include "engine/facet_outcomes.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/base/floating_point_mode.h"
#include "engine/bodies/bodies.h"
#include "engine/pair/confirm.h"
#include "engine/pair/cull.h"
#include "engine/pair/pair_table.h"
#include "engine/report_writer.h"
#include "narrowphase/criteria/facet_outcomes.h"

namespace tact {
namespace {

using namespace narrowphase;

// Empty where no pairs of clusters were left.
std::vector<std::int32_t> indices_of(const std::vector<OpenedCluster>& opened, const CulledPair& culled) {
  std::vector<std::int32_t> indices;
  if (culled.cluster_pairs.empty()) return indices;
  for (const OpenedCluster& one : opened) indices.push_back(one.index);
  return indices;
}

// What the clusters of b were held against: that of a before b dropped more of them.
Box first_bounds_of_a(const CulledPair& culled) {
  KeptClusters first;
  cull_clusters(*culled.a, culled.criteria_a, culled.b->box(), first);
  return first.bounds;
}

// Of a pair that was culled and confirmed.
FacetOutcomes outcomes_of(const PairWork& work) {
  const CulledPair& culled = work.culled;
  std::vector<std::int32_t> opened_a = indices_of(work.search.opened_a(), culled);
  std::vector<std::int32_t> opened_b = indices_of(work.search.opened_b(), culled);
  if (culled.swapped) std::swap(opened_a, opened_b);
  FacetOutcomes outcomes{.a = criteria_outcomes({.mesh = culled.a,
                                                 .criteria = culled.criteria_a,
                                                 .first_box = culled.b->box(),
                                                 .last_box = culled.kept_b.bounds,
                                                 .kept = &culled.kept_a,
                                                 .opened = opened_a,
                                                 .whole = culled.as_surfaces}),
                         .b = criteria_outcomes({.mesh = culled.b,
                                                 .criteria = culled.criteria_b,
                                                 .first_box = first_bounds_of_a(culled),
                                                 .last_box = culled.kept_a.bounds,
                                                 .kept = &culled.kept_b,
                                                 .opened = opened_b,
                                                 .whole = culled.as_surfaces})};
  for (const FacetPair& pair : culled.record->facet_pairs) {
    outcomes.a[pair.a] = FacetOutcome::meets;
    outcomes.b[pair.b] = FacetOutcome::meets;
  }
  return outcomes;
}

// Stages 5 and 6 of the last step once more; the answers go to the record of `pair`.
void repeat(const PairRecord& record, const PairTask& pair, EmbreeDevice& device) {
  const MinkowskiDifference& m = pair.difference;
  const Slab slab =
      make_slab(record.history.direction, m.origin(), record.slab_lower, record.slab_upper, m.vertex_height_error());
  pair.record.facet_pairs.clear();
  pair.record.bare_pairs.clear();
  pair.record.surfaces.reset();  // of another contact, or of this one looked at before
  cull(pair, slab, device);
  if (!pair.work.culled.cluster_pairs.empty()) confirm(pair.tuning, pair.work);
}

// The record of a pair of the table, or null. `keys` are those of the report.
const PairRecord* record_of(PairTable& table, BodyId a, BodyId b, std::span<const std::uint64_t> keys) {
  const std::span<const CandidatePair> candidates = table.candidates();
  const auto key = [&](BodyId body) { return keys.empty() ? body.index : keys[body.index]; };
  const auto place =
      std::ranges::lower_bound(candidates, std::tuple(key(a), key(b)), {},
                               [&](const CandidatePair& pair) { return std::tuple(key(pair.a), key(pair.b)); });
  if (place == candidates.end() || place->a != a || place->b != b) return nullptr;
  return &table.record(static_cast<std::size_t>(place - candidates.begin()));
}

}  // namespace

struct FacetOutcomeFinder::Work {
  const ReportSources* sources;
  PairRecord record;  // of what is done once more
  PairWork pair;
  EmbreeDevice device;
};

FacetOutcomeFinder::FacetOutcomeFinder(const Report& report) : work_(std::make_unique<Work>()) {
  work_->sources = report.sources_;
  work_->pair.prefetches = false;
}

FacetOutcomeFinder::~FacetOutcomeFinder() = default;

std::optional<FacetOutcomes> FacetOutcomeFinder::find(const Contact& contact) {
  const base::FloatingPointMode mode;
  const ReportSources* const sources = work_->sources;
  if (sources == nullptr || contact.a == contact.b || sources->settings->accuracy == Accuracy::hulls) return {};
  const PairRecord* record = record_of(*sources->table, contact.a, contact.b, *sources->keys);
  if (record == nullptr || !record->hulls_overlap) return {};
  if (sources->bodies->plane(contact.a.index) != nullptr || sources->bodies->plane(contact.b.index) != nullptr)
    return {};
  work_->record.a = contact.a;
  work_->record.b = contact.b;
  repeat(*record, PairTask(*sources->bodies, work_->record, *sources->settings, work_->pair), work_->device);
  FacetOutcomes outcomes = outcomes_of(work_->pair);
  outcomes.a.resize(static_cast<std::size_t>(work_->pair.culled.a->surface_facet_count()));
  outcomes.b.resize(static_cast<std::size_t>(work_->pair.culled.b->surface_facet_count()));
  return outcomes;
}

std::vector<int> FacetOutcomeFinder::clusters(BodyId body) const {
  const ClusteredMesh& mesh = work_->sources->bodies->at(body).mesh;
  std::vector<int> clusters(static_cast<std::size_t>(mesh.surface_facet_count()));
  for (int i = 0; i < mesh.surface_facet_count(); ++i) {
    clusters[i] = mesh.facet_of_source(i) / kClusterSize;
  }
  return clusters;
}

}  // namespace tact
