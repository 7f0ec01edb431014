// Contact points: where two surfaces, or two parts of one, are nearest to each other and nearer than a reach. See
// nearest.h for which points these are. Beside them all pairs of features within that reach.
#pragma once

#include <tact/reach_pair.h>

#include <memory>
#include <span>
#include <vector>

#include "narrowphase/contact_points/feature_point.h"
#include "narrowphase/pairs/cluster_pairs.h"

namespace tact::narrowphase {

struct Crossing;

/// What the search for near features knows of both surfaces.
struct NearRules {
  const Crossing* crossing = nullptr;  // if they cross: what is past the other surface has no such points
  Vec3 touching{};  // if they do not: where a gap is zero, the normal is turned along it; zero: it stays as it is
  bool a_is_solid = false, b_is_solid = false;  // encloses an inside, through which no point leads: see own_inside.h
};

class ContactPointSearch {
 public:
  /// Which of the cluster pairs are given.
  enum class Given { some, all };

  ContactPointSearch();
  ~ContactPointSearch();
  ContactPointSearch(ContactPointSearch&&) noexcept;
  ContactPointSearch& operator=(ContactPointSearch&&) noexcept;

  /// Appends the points of some cluster pairs of `a` and `b`, which may be one mesh, in no particular order. All pairs
  /// together give each point once; where it is known that they are all, few clusters are searched together.
  ///
  /// Of one mesh, features that share a vertex have none, nor do those that are nearer than pi/2 times `reach` along
  /// the edges of the mesh: so far apart lie, on a sheet folded as tightly as its thickness lets it, the places that
  /// are one reach apart.
  void run(const FeaturedMesh& a, const FeaturedMesh& b, double reach, std::span<const ClusterPair> pairs,
           std::vector<FeaturePoint>& found, const NearRules& rules = {}, Given given = Given::some);

  /// Appends every vertex and facet, and every two edges, that are nearer than `reach`, whatever else is near: of one
  /// mesh, those without a common vertex, the vertex first and the edge of lesser vertices. All pairs together give
  /// each once.
  void run_within_reach(const FeaturedMesh& a, const FeaturedMesh& b, double reach, std::span<const ClusterPair> pairs,
                        std::vector<ReachPair>& found, Given given = Given::some);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace tact::narrowphase
