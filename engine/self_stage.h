// Bodies that are held against themselves: their contacts, from step to step.
#pragma once

#include <tact/contact_point.h>
#include <tact/facet_pair.h>
#include <tact/settings.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/bodies.h"
#include "engine/point_stage.h"
#include "narrowphase/self/self_facet_pairs.h"

namespace tact {

/// What was found of a body with itself in the last step in which it had moved.
struct SelfRecord {
  BodyId body;
  std::vector<FacetPair> facet_pairs;  // sorted, a < b
  std::vector<ContactPoint> points;
  bool in_contact() const { return !facet_pairs.empty() || !points.empty(); }
};

class SelfStage {
 public:
  /// Looks at every body that wants it and has changed since the last step, or at all of them.
  void run(Bodies& bodies, const Settings& settings, bool all, PointStage& points, narrowphase::EmbreeDevice& device);
  /// Nothing has changed.
  void keep() { same_ = true; }
  /// The bodies in contact with themselves, ascending by slot.
  std::span<const SelfRecord* const> contacts() const { return contacts_; }
  /// Are these the bodies of the step before?
  bool same_contacts() const { return same_; }

 private:
  SelfRecord& record(std::uint32_t slot);
  void find_facet_pairs(SelfRecord& record, const Bodies& bodies, int threads, narrowphase::EmbreeDevice& device);
  void select();

  std::vector<std::unique_ptr<SelfRecord>> records_;  // by slot; null where none is wanted
  std::vector<const SelfRecord*> contacts_, last_contacts_;
  bool same_ = true;
  bool any_ = false;
  narrowphase::SelfClusters clusters_;
  std::vector<std::vector<FacetPair>> ranges_;
};

}  // namespace tact
