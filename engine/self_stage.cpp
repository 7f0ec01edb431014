#include "engine/self_stage.h"

#include <algorithm>
#include <utility>

#include "engine/pair/facet_pair_sort.h"
#include "engine/touching.h"

namespace tact {

namespace {

// Microseconds that a pair of clusters takes (tact-bench self).
constexpr std::size_t kSelfCost = 1;

void sort(SelfRecord& record, const narrowphase::ClusteredMesh& mesh, base::KeySorter& sorter, int threads) {
  sort_facet_pairs(record.facet_pairs, mesh.facet_count(), mesh.facet_count(), sorter, threads);
  split_off_bare(mesh, mesh, record.facet_pairs, record.bare_pairs);
}

}  // namespace

void SelfStage::run(Bodies& bodies, const Settings& settings, bool all, narrowphase::EmbreeDevice& device) {
  keep();
  if (!bodies.any_self_contact() && records_.empty()) return;
  select(bodies, all, settings.threads);
  find_facet_pairs(bodies, settings, device);
}

void SelfStage::keep() {
  looked_at_.clear();
  gone_patches_.clear();
  began_.clear();
  ended_.clear();
  same_ = true;
}

void SelfStage::select(Bodies& bodies, bool all, int threads) {
  slots_.clear();
  if (all) {
    const auto slots = static_cast<std::uint32_t>(bodies.boxes().size());
    for (std::uint32_t slot = 0; slot < slots; ++slot) select(slot, bodies);
  } else {
    for (const std::uint32_t slot : bodies.changed()) select(slot, bodies);
  }
  std::ranges::sort(looked_at_, {}, [](const SelfRecord* one) { return one->body.index; });
  bodies.make_neighbors(slots_, threads);
}

void SelfStage::select(std::uint32_t slot, Bodies& bodies) {
  const bool is_wanted = bodies.used(slot) && bodies.in_slot(slot).self_contact;
  if (records_.size() <= slot) {
    if (!is_wanted) return;
    records_.resize(slot + 1);
  }
  std::unique_ptr<SelfRecord>& record = records_[slot];
  if (record != nullptr && (!is_wanted || record->body != bodies.in_slot(slot).id)) {
    record->patches.end_all(record->body, record->body, gone_patches_);
    record.reset();
  }
  if (!is_wanted) return;
  bodies.placed(slot);
  if (record == nullptr) record = std::make_unique<SelfRecord>();
  record->body = bodies.in_slot(slot).id;
  record->facet_pairs.clear();
  record->bare_pairs.clear();
  record->may_contact.clear();
  if (!std::exchange(record->is_renumbered, false)) std::swap(record->points, record->last_points);
  record->points.clear();
  record->within_reach.clear();
  record->point_limit_reached = false;
  looked_at_.push_back(record.get());
  slots_.push_back(slot);
}

void SelfStage::find_facet_pairs(const Bodies& bodies, const Settings& settings, narrowphase::EmbreeDevice& device) {
  const base::Tuning& tuning = bodies.tuning();
  const auto mesh_of = [&](const SelfRecord& record) -> const narrowphase::ClusteredMesh& {
    return bodies.in_slot(record.body.index).mesh;
  };
  if (work_.size() < static_cast<std::size_t>(settings.threads)) work_.resize(settings.threads);
  const auto search = [&](const SelfRecord& record, std::size_t begin, std::size_t end, std::vector<FacetPair>& found,
                          int thread) {
    found.clear();
    work_[thread].search.run(mesh_of(record), bodies.neighbors(record.body.index).fans(),
                             std::span(record.may_meet).subspan(begin, end - begin), tuning, found);
  };
  const auto prepare = [&](std::size_t i, int thread, int threads) {
    SelfRecord*& record = looked_at_[i];
    const std::uint32_t slot = record->body.index;
    narrowphase::SelfClusters& clusters = work_[thread].clusters;
    clusters.find({bodies.featured(slot), &bodies.neighbors(slot)},
                  settings.outputs.points ? bodies.reach(slot, slot) : 0.0, tuning, threads, device);
    record->may_contact.assign(clusters.may_contact().begin(), clusters.may_contact().end());
    if (settings.accuracy == Accuracy::hulls) return;
    record->may_meet.assign(clusters.may_meet().begin(), clusters.may_meet().end());
    const std::size_t cost = kSelfCost * record->may_meet.size();
    if (is_large(cost, looked_at_.size(), settings.threads, tuning)) {
      SelfRecord* item = record;
      large_.put_aside(item, record->may_meet, count_of_ranges(cost, settings.threads, tuning));
      return;
    }
    search(*record, 0, record->may_meet.size(), record->facet_pairs, thread);
    sort(*record, mesh_of(*record), work_[thread].sorter, 1);
  };
  large_.begin();
  const auto clusters_of = [&](std::size_t i) {
    return static_cast<std::size_t>(mesh_of(*looked_at_[i]).cluster_count());
  };
  for_each_item(looked_at_.size(), settings.threads, clusters_of, prepare);
  large_.search(settings.threads, [&](const Large::Shared& shared, Large::Range& range, int thread) {
    search(*shared.item, range.begin, range.end, range.found, thread);
  });
  large_.gather(settings.threads, [&](const Large::Shared& shared, int thread, int threads) {
    SelfRecord& record = *shared.item;
    large_.collect(shared, record.facet_pairs);
    sort(record, mesh_of(record), work_[thread].sorter, threads);
  });
}

// What changed is told by ids: of records that came and went one may lie where another was.
void SelfStage::finish(const Bodies& bodies) {
  for (SelfRecord* const one : looked_at_) {
    const narrowphase::FeatureReach rest = bodies.rest(one->body.index, one->body.index);
    one->touching = any_meet(*one) || is_touching(one->facet_pairs, one->points, rest);
  }
  std::swap(in_contact_, last_in_contact_);
  std::swap(touching_, last_touching_);
  list_contacts(bodies);
  same_ = in_contact_ == last_in_contact_;
  // Both ascend by slot, which comes first in an id.
  const auto without = [](const std::vector<BodyId>& those, const std::vector<BodyId>& others,
                          std::vector<ContactEvent>& events) {
    for (const BodyId body : those) {
      if (!std::ranges::binary_search(others, body)) events.push_back({body, body});
    }
  };
  without(touching_, last_touching_, began_);
  without(last_touching_, touching_, ended_);
}

void SelfStage::list_contacts(const Bodies& bodies) {
  contacts_.clear();
  in_contact_.clear();
  touching_.clear();
  for (const std::unique_ptr<SelfRecord>& one : records_) {
    if (one == nullptr) continue;
    if (one->touching) touching_.push_back(one->body);
    if (!in_contact(*one)) continue;
    contacts_.push_back(one.get());
    in_contact_.push_back(one->body);
  }
  if (!bodies.keys().are_slots())
    std::ranges::sort(contacts_, {}, [&](const SelfRecord* one) { return bodies.keys().of(one->body.index); });
}

SelfRecord* SelfStage::find(BodyId body) const {
  SelfRecord* const record = body.index < records_.size() ? records_[body.index].get() : nullptr;
  return record != nullptr && record->body == body ? record : nullptr;
}

void SelfStage::forget_patches() {
  for (const std::unique_ptr<SelfRecord>& one : records_) {
    if (one != nullptr) one->patches = {};
  }
}

}  // namespace tact
