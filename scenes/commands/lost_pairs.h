// How many facet pairs a level of accuracy loses in a scene, against the exact answer on the same positions.
#pragma once

#include <tact/tact.h>

#include <cstdint>
#include <ostream>

#include "scenes/dynamics/simulation.h"

namespace tact::scenes {

// Detects beside a simulation, exactly, and compares. It is in none of the simulation's times.
class LostPairs {
 public:
  // Of a simulation before its first step.
  LostPairs(const Simulation& simulation, int threads);

  // After every step.
  void add_step(const Simulation& simulation);

  std::int64_t all() const { return all_; }    // facet pairs that meet, over all steps
  std::int64_t lost() const { return lost_; }  // those of them that the simulation was not told
  // "facet pairs lost: 120 of 400 (30.0 %)", and how many contacts lost all of theirs.
  void print(std::ostream& out) const;

 private:
  World exact_;
  std::vector<BodyId> ids_;
  std::int64_t all_ = 0;
  std::int64_t lost_ = 0;
  std::int64_t contacts_ = 0;
  std::int64_t lost_contacts_ = 0;
};

}  // namespace tact::scenes
