// What the paper's criteria lose of a scene.
#pragma once

#include <tact/tact.h>

#include <cstdint>
#include <ostream>
#include <vector>

#include "scenes/dynamics/simulation.h"

namespace tact::scenes {

// Two worlds beside that of a simulation, one at Accuracy::exact and one at Accuracy::paper. They see the bodies of
// each step thickened, so that what is in contact crosses: closed bodies moved out by twice their thickness, along the
// mean normal of each vertex.
class LostPairs {
 public:
  // Bodies must be those of all later steps. Errors: those of World.
  LostPairs(const Simulation& simulation, int threads);

  void add_step(const Simulation& simulation);
  std::int64_t all() const { return all_; }
  std::int64_t lost() const { return lost_; }
  // The bodies as the two worlds saw them in the last step, and what they found.
  const std::vector<Vec3>& seen(std::size_t body) const { return seen_[body]; }
  const Report& exact() const { return *exact_report_; }
  void print(std::ostream& out) const;

 private:
  void show(const Simulation& simulation);

  World exact_, paper_;
  std::vector<BodyId> exact_ids_, paper_ids_;
  std::vector<std::vector<Vec3>> seen_;
  const Report* exact_report_ = nullptr;
  std::int64_t all_ = 0;   // facet pairs
  std::int64_t lost_ = 0;  // of them, not found
  std::int64_t contacts_ = 0;
  std::int64_t lost_contacts_ = 0;  // of which all were lost
};

}  // namespace tact::scenes
