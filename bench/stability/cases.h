// Cases that a collision engine finds hard, by kind and seed: for the benchmark `stability` and for tests.
#pragma once

#include <tact/body.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bench/error/truth.h"

namespace tact::bench {

struct StabilityBody {
  Mesh mesh;
  Surface surface = Surface::closed;
};

// Bodies, and how they move.
struct StabilityCase {
  std::vector<StabilityBody> bodies;
  // The steps after the first: for each body its new positions, or a matrix without columns if it stays.
  std::vector<std::vector<Eigen::Matrix3Xd>> moves = {};
  // If set, whether the hulls of the first two bodies overlap, known by construction and true in every step.
  std::optional<bool> hulls_overlap = {};
  // A coordinate is beyond what the engine takes: adding the last body must fail by name and change nothing.
  bool refused = false;
};

struct StabilityKind {
  const char* name;
  StabilityCase (*make)(std::uint64_t seed);
  int rarity = 1;  // so many times fewer cases are enough: each is large
};

std::span<const StabilityKind> stability_kinds();

}  // namespace tact::bench
