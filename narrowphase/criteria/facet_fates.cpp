#include "narrowphase/criteria/facet_fates.h"

#include <bit>
#include <limits>
#include <utility>

namespace tact::narrowphase {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Box kEverywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};

class FateWriter {
 public:
  explicit FateWriter(const CulledBody& body)
      : body_(body), fates_(static_cast<std::size_t>(body.mesh->facet_count()), FacetFate::outside_box) {}

  void set_facet(int facet, FacetFate fate) { fates_[body_.mesh->source_facet(facet)] = fate; }
  void set_cluster(int cluster, FacetFate fate) {
    for (int f = body_.mesh->facet_begin(cluster); f < body_.mesh->facet_end(cluster); ++f) set_facet(f, fate);
  }

  // The facets of a cluster that pass `criteria` and `box` get another fate.
  void pass(int cluster, const Criteria& criteria, const Box& box, FacetFate fate) {
    KeptFacets& passed = passed_;
    passed.clear();
    CullCounts counts;
    append_facets(*body_.mesh, cluster, criteria, box, passed, counts);
    for (std::uint64_t left = passed.facets; left != 0; left &= left - 1) {
      set_facet(passed.block.facet[std::countr_zero(left)], fate);
    }
  }

  // Each criterion is asked alone with those before it: what passes it fails the next at the earliest.
  void open(int cluster) {
    Criteria criteria = body_.criteria;
    criteria.facing_away = criteria.zone = false;
    set_cluster(cluster, FacetFate::outside_slab);
    pass(cluster, criteria, kEverywhere, FacetFate::outside_box);
    pass(cluster, criteria, body_.last_box, FacetFate::facing_away);
    criteria.facing_away = body_.criteria.facing_away;
    pass(cluster, criteria, body_.last_box, FacetFate::outside_zone);
    pass(cluster, body_.criteria, body_.last_box, FacetFate::kept);
  }

  std::vector<FacetFate> take() { return std::move(fates_); }

 private:
  const CulledBody& body_;
  std::vector<FacetFate> fates_;
  KeptFacets passed_;
};

// Clusters that are dropped whole, by the slab rather than by the box.
void drop_low_clusters(const CulledBody& body, FateWriter& fates) {
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
      fates.set_cluster(cluster, FacetFate::outside_slab);
    }
  }
}

}  // namespace

std::vector<FacetFate> criteria_fates(const CulledBody& body) {
  FateWriter fates(body);
  drop_low_clusters(body, fates);
  for (const std::int32_t cluster : body.kept->cluster) fates.set_cluster(cluster, FacetFate::far);
  for (const std::int32_t index : body.opened) {
    const std::int32_t cluster = body.kept->cluster[index];
    if (body.whole) {
      fates.set_cluster(cluster, FacetFate::kept);
    } else {
      fates.open(cluster);
    }
  }
  return fates.take();
}

}  // namespace tact::narrowphase
