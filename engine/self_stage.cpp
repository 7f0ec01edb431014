#include "engine/self_stage.h"

#include <algorithm>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/pair/facet_pair_sort.h"
#include "engine/touching.h"

namespace tact {

namespace {

// Cluster pairs that one of several threads takes at a time: one takes 0.5 us, and between two ranges clusters are
// opened twice. With 64 the rolled sheet of 13 k took 1.35 ms instead of 1.22. A thread alone takes all of them: 0.754
// to 0.725 ms.
constexpr std::size_t kPairsAtATime = 256;

}  // namespace

void SelfStage::run(Bodies& bodies, const Settings& settings, bool all, PointStage& points,
                    narrowphase::EmbreeDevice& device) {
  gone_patches_.clear();
  began_.clear();
  ended_.clear();
  if (!bodies.any_self_contact() && records_.empty()) return;
  const auto look_at = [&](std::uint32_t slot) {
    const bool is_wanted = bodies.used(slot) && bodies.in_slot(slot).self_contact;
    if (slot < records_.size() && records_[slot] != nullptr &&
        (!is_wanted || records_[slot]->body != bodies.in_slot(slot).id)) {
      SelfRecord& gone = *records_[slot];
      gone.patches.end_all(gone.body, gone.body, gone_patches_);
      records_[slot].reset();
    }
    if (!is_wanted) return;
    bodies.placed(slot);
    any_ = true;
    SelfRecord& one = record(slot);
    one.body = bodies.in_slot(slot).id;
    one.facet_pairs.clear();
    std::swap(one.points, one.last_points);
    one.points.clear();
    one.looked_at = true;
    const narrowphase::ClusterNeighbors& neighbors = bodies.neighbors(slot);
    clusters_.find({bodies.featured(slot), &neighbors}, settings.outputs.points ? bodies.reach(slot, slot) : 0.0,
                   bodies.tuning(), settings.threads, device);
    if (settings.accuracy != Accuracy::hulls) find_facet_pairs(one, bodies, settings.threads);
    if (settings.outputs.points) find_points(one, bodies, settings, points);
    one.touching = is_touching(one.facet_pairs, one.points, bodies.reach(slot, slot));
  };
  if (all) {
    const auto slots = static_cast<std::uint32_t>(bodies.boxes().size());
    for (std::uint32_t slot = 0; slot < slots; ++slot) look_at(slot);
  } else {
    for (const std::uint32_t slot : bodies.changed()) look_at(slot);
  }
  if (any_) {
    select();
  } else {
    same_ = true;
  }
}

SelfRecord& SelfStage::record(std::uint32_t slot) {
  if (records_.size() <= slot) records_.resize(slot + 1);
  if (records_[slot] == nullptr) records_[slot] = std::make_unique<SelfRecord>();
  return *records_[slot];
}

void SelfStage::find_facet_pairs(SelfRecord& record, const Bodies& bodies, int threads) {
  const narrowphase::ClusteredMesh& mesh = bodies.in_slot(record.body.index).mesh;
  const auto pairs = clusters_.may_meet();
  const std::size_t at_a_time = threads == 1 ? std::max<std::size_t>(pairs.size(), 1) : kPairsAtATime;
  const std::size_t ranges = (pairs.size() + at_a_time - 1) / at_a_time;
  if (ranges_.size() < ranges) ranges_.resize(ranges);
  if (searches_.size() < static_cast<std::size_t>(threads)) searches_.resize(threads);
  base::parallel_for(ranges, 1, threads, [&](std::size_t i, int thread) {
    const std::size_t begin = i * at_a_time, count = std::min(at_a_time, pairs.size() - begin);
    ranges_[i].clear();
    searches_[thread].run(mesh, pairs.subspan(begin, count), bodies.tuning(), ranges_[i]);
  });
  for (std::size_t i = 0; i < ranges; ++i)
    record.facet_pairs.insert(record.facet_pairs.end(), ranges_[i].begin(), ranges_[i].end());
  sort_facet_pairs(record.facet_pairs, mesh.facet_count(), mesh.facet_count(), sorter_, threads);
}

void SelfStage::find_points(SelfRecord& record, Bodies& bodies, const Settings& settings, PointStage& points) {
  // A sheet with a margin keeps the side on which it is: see ContactPoint.
  const std::uint32_t slot = record.body.index;
  const bool has_side = bodies.in_slot(slot).surface == Surface::closed || bodies.reach(slot, slot) == 0.0;
  const bool crosses = has_side && !record.facet_pairs.empty();
  if (crosses && record.crossing == nullptr) record.crossing = std::make_unique<narrowphase::SelfCrossing>();
  points.run_self({.slot = slot,
                   .cluster_pairs = clusters_.may_contact(),
                   .facet_pairs = record.facet_pairs,
                   .last_points = record.last_points,
                   .crossing = crosses ? record.crossing.get() : nullptr},
                  bodies, settings, record.points);
}

void SelfStage::select() {
  std::swap(contacts_, last_contacts_);
  contacts_.clear();
  any_ = false;
  for (const std::unique_ptr<SelfRecord>& one : records_) {
    any_ = any_ || one != nullptr;
    if (one != nullptr && one->in_contact()) contacts_.push_back(one.get());
  }
  same_ = contacts_ == last_contacts_;
  std::swap(touching_, last_touching_);
  touching_.clear();
  for (const SelfRecord* one : contacts_) {
    if (one->touching) touching_.push_back(one->body);
  }
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

void SelfStage::find_patches(const Bodies& bodies, PatchStage& stage, std::vector<PatchEvent>& events) {
  events.insert(events.end(), gone_patches_.begin(), gone_patches_.end());
  for (const std::unique_ptr<SelfRecord>& one : records_) {
    if (one == nullptr || !std::exchange(one->looked_at, false)) continue;
    const std::uint32_t slot = one->body.index;
    stage.find_self(bodies.in_slot(slot), bodies.reach(slot, slot), one->facet_pairs, one->points, one->patches);
    stage.name(one->body, one->body, one->patches, events);
  }
}

void SelfStage::forget_patches() {
  for (const std::unique_ptr<SelfRecord>& one : records_) {
    if (one != nullptr) one->patches = {};
  }
}

}  // namespace tact
