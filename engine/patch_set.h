// The patches of two bodies, or of one with itself, and what is kept of them from step to step.
#pragma once

#include <tact/report.h>

#include <array>
#include <cstdint>
#include <vector>

namespace tact {

/// A vertex that a patch has, of one of the two bodies: patches of two steps are the same if they share most of these.
struct PatchVertex {
  std::int64_t vertex = 0;  // twice the caller's number, and 1 more for those of b
  int patch = 0;
  friend auto operator<=>(const PatchVertex&, const PatchVertex&) = default;
};

/// The ids of the points that span a patch; 0 fills up.
struct Spanning {
  std::array<std::uint64_t, 4> ids{};
};

struct PatchSet {
  std::vector<Patch> patches;
  std::vector<Spanning> spanning;        // of each patch
  std::vector<int> facet_pairs, points;  // that the patches show
  std::vector<PatchVertex> vertices;     // sorted, each once

  void clear() {
    patches.clear();
    spanning.clear();
    vertices.clear();
  }
};

/// Of this step and of the one before.
struct PatchMemory {
  PatchSet now, last;

  /// All have ended.
  void end_all(BodyId a, BodyId b, std::vector<PatchEvent>& events) {
    for (const Patch& patch : now.patches) events.push_back({a, b, PatchEvent::Kind::ended, patch.id, 0});
    now.clear();
    last.clear();
  }
};

}  // namespace tact
