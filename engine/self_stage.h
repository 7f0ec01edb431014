// Bodies with self-contact: their facet pairs, and their contacts from step to step.
#pragma once

#include <tact/settings.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/key_sort.h"
#include "engine/bodies/bodies.h"
#include "engine/patch_stage.h"
#include "engine/self_record.h"
#include "engine/shared_work.h"
#include "narrowphase/self/self_clusters.h"
#include "narrowphase/self/self_facet_pairs.h"

namespace tact {

class SelfStage {
  friend struct StateFields;

 public:
  /// Looks at every body that wants it and has changed since the last step, or at all of them: finds the facet pairs,
  /// and the cluster pairs that may have contact points.
  void run(Bodies& bodies, const Settings& settings, bool all, narrowphase::EmbreeDevice& device);
  /// The bodies that the last run() looked at, ascending by slot.
  std::span<SelfRecord* const> looked_at() const { return looked_at_; }
  /// Lists the contacts, once the points of those are known.
  void finish(const Bodies& bodies);
  /// Nothing has changed.
  void keep();
  /// The bodies in contact with themselves, ascending by key.
  std::span<const SelfRecord* const> contacts() const { return contacts_; }
  /// What patches bodies had that are not looked at any more.
  std::span<const PatchEvent> gone_patches() const { return gone_patches_; }
  void forget_patches();
  /// What is kept of a body; null if there is nothing.
  SelfRecord* find(BodyId body) const;
  /// Bodies that began to touch themselves in the last step, or ceased to; those that are no more among them.
  std::span<const ContactEvent> began() const { return began_; }
  std::span<const ContactEvent> ended() const { return ended_; }
  /// Whether these are the bodies of the step before.
  bool same_contacts() const { return same_; }

 private:
  /// Memory of a thread, used again.
  struct Work {
    narrowphase::SelfClusters clusters;
    narrowphase::SelfFacetSearch search;
    base::KeySorter sorter;
  };
  using Large = SharedWork<SelfRecord*, std::vector<FacetPair>>;

  void select(Bodies& bodies, bool all, int threads);
  void select(std::uint32_t slot, Bodies& bodies);
  void list_contacts(const Bodies& bodies);
  void find_facet_pairs(const Bodies& bodies, const Settings& settings, narrowphase::EmbreeDevice& device);

  std::vector<std::unique_ptr<SelfRecord>> records_;  // by slot; null where none is wanted
  std::vector<SelfRecord*> looked_at_;
  std::vector<std::uint32_t> slots_;  // of those
  std::vector<const SelfRecord*> contacts_;
  std::vector<BodyId> in_contact_, last_in_contact_, touching_, last_touching_;
  std::vector<ContactEvent> began_, ended_;
  std::vector<PatchEvent> gone_patches_;
  bool same_ = true;
  std::vector<Work> work_;  // a thread each
  Large large_;
};

}  // namespace tact
