// Contact points: where two surfaces, or two parts of one, are nearest to each other and nearer than a reach. See
// nearest.h for which points these are.
#pragma once

#include <tact/feature_pair.h>

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "narrowphase/distance/nearest.h"
#include "narrowphase/mesh/features.h"
#include "narrowphase/triangles/cluster_pairs.h"

namespace tact::narrowphase {

/// A point on each surface. Vertices have the caller's numbers; those of an edge ascend, those of a facet stand in its
/// own order; -1 fills up.
struct FeaturePoint {
  FeaturePair kind = FeaturePair::vertex_facet;
  std::array<int, 3> a{-1, -1, -1};
  std::array<int, 3> b{-1, -1, -1};
  std::array<double, 3> weight_a{};  // of the vertices of `a`; their sum is 1
  std::array<double, 3> weight_b{};
  Vec3 normal;       // unit, from the point of a to that of b; zero where they are one point in a vertex or an edge
  double gap = 0.0;  // metres
  int edge_a = -1, edge_b = -1;  // between two edges: these, as Features counts them

  /// Which features these are, whatever lies between them.
  auto features() const { return std::tie(kind, a, b); }
};

/// The point of two edges, by Features' numbers, with the ends `a` and `b` and this gap in metres, at their nearest
/// places.
inline FeaturePoint point_of_edges(const Nearest& nearest, const std::array<int, 3>& a, const std::array<int, 3>& b,
                                   int edge_a, int edge_b, double gap) {
  return {.kind = FeaturePair::edge_edge,
          .a = a,
          .b = b,
          .weight_a = {nearest.first[0], nearest.first[1], 0.0},
          .weight_b = {nearest.weight[0], nearest.weight[1], 0.0},
          .normal = nearest.normal,
          .gap = gap,
          .edge_a = edge_a,
          .edge_b = edge_b};
}

/// The cluster pairs of `a` and `b` that come within `reach` (metres); for one mesh with itself each pair once, the
/// smaller first.
class NearClusters {
 public:
  std::span<const ClusterPair> find(const FeaturedMesh& a, const FeaturedMesh& b, double reach,
                                    const base::Tuning& tuning, EmbreeDevice& device);

 private:
  ClusterPairFinder finder_;
};

/// A bit for each vertex, by the mesh's numbers: those that have crossed the other surface. Empty: none has.
struct CrossedVertices {
  std::span<const std::uint64_t> a, b;
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
  /// together give each point once; where it is known that they are all, few clusters are searched together. Vertices
  /// that have `crossed` get none.
  ///
  /// Of one mesh, features that share a vertex have none, nor do those that are nearer than pi/2 times `reach` along
  /// the edges of the mesh: so far apart lie, on a sheet folded as tightly as its thickness lets it, the places that
  /// are one reach apart.
  void run(const FeaturedMesh& a, const FeaturedMesh& b, double reach, std::span<const ClusterPair> pairs,
           std::vector<FeaturePoint>& found, const CrossedVertices& crossed = {}, Given given = Given::some);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace tact::narrowphase
