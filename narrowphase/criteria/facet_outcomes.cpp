#include "narrowphase/criteria/facet_outcomes.h"

#include <bit>
#include <limits>
#include <utility>

namespace tact::narrowphase {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Box kEverywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};

class OutcomeWriter {
 public:
  explicit OutcomeWriter(const CulledBody& body)
      : body_(body), outcomes_(static_cast<std::size_t>(body.mesh->facet_count()), FacetOutcome::outside_box) {}

  void set_facet(int facet, FacetOutcome outcome) { outcomes_[body_.mesh->source_facet(facet)] = outcome; }
  void set_cluster(int cluster, FacetOutcome outcome) {
    for (int f = body_.mesh->facet_begin(cluster); f < body_.mesh->facet_end(cluster); ++f) set_facet(f, outcome);
  }

  // The facets of a cluster that pass `criteria` and `box` get another outcome.
  void pass(int cluster, const Criteria& criteria, const Box& box, FacetOutcome outcome) {
    KeptFacets& passed = passed_;
    passed.clear();
    CullCounts counts;
    append_facets(*body_.mesh, cluster, criteria, box, passed, counts);
    for (std::uint64_t left = passed.facets; left != 0; left &= left - 1) {
      set_facet(passed.block.facet[std::countr_zero(left)], outcome);
    }
  }

  // Each criterion is applied with those before it: what passes it fails the next at the earliest.
  void open(int cluster) {
    Criteria criteria = body_.criteria;
    criteria.facing_away = criteria.zone = false;
    set_cluster(cluster, FacetOutcome::outside_slab);
    pass(cluster, criteria, kEverywhere, FacetOutcome::outside_box);
    pass(cluster, criteria, body_.last_box, FacetOutcome::facing_away);
    criteria.facing_away = body_.criteria.facing_away;
    pass(cluster, criteria, body_.last_box, FacetOutcome::outside_zone);
    pass(cluster, body_.criteria, body_.last_box, FacetOutcome::kept);
  }

  std::vector<FacetOutcome> take() { return std::move(outcomes_); }

 private:
  const CulledBody& body_;
  std::vector<FacetOutcome> outcomes_;
  KeptFacets passed_;
};

// Clusters that are dropped whole, by the slab rather than by the box.
void drop_low_clusters(const CulledBody& body, OutcomeWriter& outcomes) {
  KeptClusters passed;
  cull_clusters(*body.mesh, body.criteria, body.first_box, passed);
  Criteria any_height = body.criteria;
  any_height.lowest = -kInfinity;
  KeptClusters in_box;
  cull_clusters(*body.mesh, any_height, body.first_box, in_box);
  auto next = passed.cluster.begin();
  for (const std::int32_t cluster : in_box.cluster) {
    if (next != passed.cluster.end() && *next == cluster) {
      ++next;
    } else {
      outcomes.set_cluster(cluster, FacetOutcome::outside_slab);
    }
  }
}

}  // namespace

std::vector<FacetOutcome> criteria_outcomes(const CulledBody& body) {
  OutcomeWriter outcomes(body);
  drop_low_clusters(body, outcomes);
  for (const std::int32_t cluster : body.kept->cluster) outcomes.set_cluster(cluster, FacetOutcome::far);
  for (const std::int32_t index : body.opened) {
    const std::int32_t cluster = body.kept->cluster[index];
    if (body.whole) {
      outcomes.set_cluster(cluster, FacetOutcome::kept);
    } else {
      outcomes.open(cluster);
    }
  }
  return outcomes.take();
}

}  // namespace tact::narrowphase
