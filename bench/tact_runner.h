// A workload played through tact.
#pragma once

#include <tact/world.h>

#include <vector>

#include "bench/workloads/workloads.h"

namespace tact::bench {

class TactRunner {
 public:
  // The workload outlives it. All bodies are added at frame 0. `self`: each is held against itself, and against no
  // other.
  enum class Against { others, self };
  TactRunner(const Workload& workload, const Settings& settings, Against against = Against::others,
             double margin = 0.0);
  TactRunner(const Workload& workload, int threads) : TactRunner(workload, Settings{.threads = threads}) {}

  // Sets the positions of all bodies that are not fixed, then detects.
  const Report& step(int frame);
  // The same for the `count` first bodies that are not fixed; the others keep their positions.
  const Report& step_few(int frame, std::size_t count);
  // Detects without setting anything.
  const Report& step_idle() { return world_.detect(); }

 private:
  const Workload& workload_;
  World world_;
  std::vector<BodyId> ids_;
  std::vector<PositionsUpdate> updates_;
};

}  // namespace tact::bench
