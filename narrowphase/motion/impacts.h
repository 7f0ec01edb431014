// Impacts: which vertices and facets, and which edges, of two meshes whose vertices move straight come to share a
// point, and when. See meeting.h for what is proved of each pair of features.
#pragma once

#include <tact/feature_pair.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "narrowphase/motion/feature_rules.h"
#include "narrowphase/motion/meeting.h"
#include "narrowphase/motion/moving_mesh.h"
#include "narrowphase/motion/parting.h"
#include "narrowphase/pairs/cluster_pairs.h"

namespace tact::narrowphase {

/// Two features that meet. Vertices have the caller's numbers: those of an edge ascend, those of a facet stand in its
/// own order; unused entries are -1. In one mesh, `a` is the vertex or the lesser edge. An edge or a point in the place
/// of a facet (see WithoutArea) has its own vertices; it may be listed from either of two vertices.
struct FeatureImpact {
  FeaturePair kind = FeaturePair::vertex_facet;
  std::array<int, 3> a{-1, -1, -1};
  std::array<int, 3> b{-1, -1, -1};
  double time = 0.0;  // in [0, 1]
  bool stops = true;  // false where they part there, or slide along each other: parting.h

  /// By time, then by what meets.
  friend bool operator<(const FeatureImpact& x, const FeatureImpact& y) {
    return std::tie(x.time, x.kind, x.a, x.b) < std::tie(y.time, y.kind, y.a, y.b);
  }
};

/// Two features by the numbers of their meshes.
struct FeatureCandidate {
  FeaturePair kind;
  int a, b;
  PlanesAtBegin planes = PlanesAtBegin::unknown;  // the same on every part of the way
};

struct MotionCounts {
  std::int64_t candidates = 0;  // pairs of features whose boxes overlap
  std::int64_t searched = 0;    // of them, those that the filter did not settle
  std::int64_t spans = 0;       // of time, that were looked at for these

  MotionCounts& operator+=(const MotionCounts& other) {
    candidates += other.candidates;
    searched += other.searched;
    spans += other.spans;
    return *this;
  }
};

/// How far two meshes go together, along each axis: zero where that is little of their size.
Vec3 common_frame(const MovingMesh& a, const MovingMesh& b);

/// No features of two clusters, of two meshes or of one, have an impact earlier than this; infinity: never. `reach` in
/// metres. Their boxes go straight: the time at which these come within reach of each other, less what rounding and the
/// search for a meeting may make an impact earlier (meeting.h).
double earliest_time(const MovingMesh& a, int cluster_a, const MovingMesh& b, int cluster_b, double reach);

/// One for each thread; its memory is reused.
class ImpactFinder {
 public:
  ImpactFinder();
  ~ImpactFinder();
  ImpactFinder(ImpactFinder&&) noexcept;
  ImpactFinder& operator=(ImpactFinder&&) noexcept;

  /// Call it before meshes that have moved: on their ways they are all in the box.
  void begin(const Box& all);

  /// How much farther apart than their reach two meshes are to be where run() does not keep candidates of theirs,
  /// metres.
  double kept_reach(const MovingMesh& a, const MovingMesh& b) const;

  /// Appends the impacts of some cluster pairs of `a` and `b`, which may be one mesh, in no particular order. All
  /// cluster pairs together give each impact once. Features meet that come within their reach of each other, if the
  /// rules allow; those of one mesh that are no contact there meet where they share a point: contact_on_way.h. If only
  /// the first impact is wanted that stops, `first` is not null: it falls to the time of what is found, and later
  /// impacts may be left out, and all that do not stop. Give the cluster pairs that come first first. Features that
  /// part and meet again have two impacts. If `kept` is not null, and the pairs are those within reach and
  /// kept_reach(), it gets the candidates that may meet on a part of the way, from its beginning to the first impact,
  /// with positions that are wrong by kWrong of the largest coordinate.
  void run(const MovingMesh& a, const MovingMesh& b, const FeatureRules& rules, std::span<const ClusterPair> pairs,
           std::atomic<double>* first, std::vector<FeatureImpact>& found, MotionCounts& counts,
           std::vector<FeatureCandidate>* kept = nullptr);

  /// The same of some candidates that were kept.
  void run_again(const MovingMesh& a, const MovingMesh& b, const FeatureRules& rules,
                 std::span<const FeatureCandidate> kept, std::atomic<double>* first, std::vector<FeatureImpact>& found,
                 MotionCounts& counts);

  static constexpr double kWrong = 0x1p-49;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace tact::narrowphase
