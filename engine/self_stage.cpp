#include "engine/self_stage.h"

#include <algorithm>

#include "engine/base/parallel.h"

namespace tact {

namespace {

// Cluster pairs that a thread takes at a time: one takes a microsecond or two.
constexpr std::size_t kPairsAtATime = 32;

}  // namespace

void SelfStage::run(Bodies& bodies, const Settings& settings, bool all, PointStage& points,
                    narrowphase::EmbreeDevice& device) {
  const auto look_at = [&](std::uint32_t slot) {
    if (slot < records_.size() && (!bodies.used(slot) || !bodies.in_slot(slot).self_contact)) records_[slot].reset();
    if (!bodies.used(slot) || !bodies.in_slot(slot).self_contact) return;
    any_ = true;
    SelfRecord& one = record(slot);
    one.body = bodies.in_slot(slot).id;
    one.facet_pairs.clear();
    one.points.clear();
    if (settings.accuracy != Accuracy::hulls) find_facet_pairs(one, bodies, settings.threads, device);
    if (settings.outputs.points) points.run_self(slot, bodies, settings, device, one.points);
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

void SelfStage::find_facet_pairs(SelfRecord& record, const Bodies& bodies, int threads,
                                 narrowphase::EmbreeDevice& device) {
  const narrowphase::ClusteredMesh& mesh = bodies.in_slot(record.body.index).mesh;
  const auto pairs = clusters_.find(mesh, device);
  const std::size_t ranges = (pairs.size() + kPairsAtATime - 1) / kPairsAtATime;
  if (ranges_.size() < ranges) ranges_.resize(ranges);
  base::parallel_for(ranges, 1, threads, [&](std::size_t i) {
    const std::size_t begin = i * kPairsAtATime, count = std::min(kPairsAtATime, pairs.size() - begin);
    ranges_[i].clear();
    find_self_facet_pairs(mesh, pairs.subspan(begin, count), ranges_[i]);
  });
  for (std::size_t i = 0; i < ranges; ++i)
    record.facet_pairs.insert(record.facet_pairs.end(), ranges_[i].begin(), ranges_[i].end());
  std::ranges::sort(record.facet_pairs);
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
}

}  // namespace tact
