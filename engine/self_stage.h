// Bodies that are held against themselves: their contacts, from step to step.
#pragma once

#include <tact/contact_point.h>
#include <tact/facet_pair.h>
#include <tact/settings.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/key_sort.h"
#include "engine/bodies/bodies.h"
#include "engine/patch_stage.h"
#include "engine/point_stage.h"
#include "narrowphase/self/self_clusters.h"
#include "narrowphase/self/self_crossing.h"
#include "narrowphase/self/self_facet_pairs.h"

namespace tact {

/// What was found of a body with itself in the last step in which it had moved.
struct SelfRecord {
  BodyId body;
  std::vector<FacetPair> facet_pairs;  // sorted, a < b
  std::vector<ContactPoint> points, last_points;
  std::unique_ptr<narrowphase::SelfCrossing> crossing;  // made when facets meet for the first time
  PatchMemory patches;
  bool looked_at = false;  // in this step
  bool touching = false;   // see is_touching()
  bool in_contact() const { return !facet_pairs.empty() || !points.empty(); }
};

class SelfStage {
 public:
  /// Looks at every body that wants it and has changed since the last step, or at all of them.
  void run(Bodies& bodies, const Settings& settings, bool all, PointStage& points, narrowphase::EmbreeDevice& device);
  /// Nothing has changed.
  void keep() {
    same_ = true;
    began_.clear();
    ended_.clear();
  }
  /// The bodies in contact with themselves, ascending by slot.
  std::span<const SelfRecord* const> contacts() const { return contacts_; }
  /// Finds and names the patches of the bodies that were looked at.
  void find_patches(const Bodies& bodies, PatchStage& stage, std::vector<PatchEvent>& events);
  void forget_patches();
  /// Bodies that began to touch themselves in the last run(), or ceased to; those that are no more among them.
  std::span<const ContactEvent> began() const { return began_; }
  std::span<const ContactEvent> ended() const { return ended_; }
  /// Whether these are the bodies of the step before.
  bool same_contacts() const { return same_; }

 private:
  SelfRecord& record(std::uint32_t slot);
  void find_facet_pairs(SelfRecord& record, const Bodies& bodies, int threads);
  void find_points(SelfRecord& record, Bodies& bodies, const Settings& settings, PointStage& points);
  void select();

  std::vector<std::unique_ptr<SelfRecord>> records_;  // by slot; null where none is wanted
  std::vector<const SelfRecord*> contacts_, last_contacts_;
  std::vector<BodyId> touching_, last_touching_;
  std::vector<ContactEvent> began_, ended_;
  std::vector<PatchEvent> gone_patches_;
  bool same_ = true;
  bool any_ = false;
  narrowphase::SelfClusters clusters_;
  std::vector<narrowphase::SelfFacetSearch> searches_;  // a thread each
  std::vector<std::vector<FacetPair>> ranges_;
  base::KeySorter sorter_;
};

}  // namespace tact
