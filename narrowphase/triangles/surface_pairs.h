// Facet pairs where two surfaces lie on each other over most of their area, as cloth on a body: few cluster pairs can
// be told apart by boxes, most by a plane along the surface.
#pragma once

#include <tact/facet_pair.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/criteria/criteria.h"
#include "narrowphase/triangles/block_pair.h"
#include "narrowphase/triangles/confirm_input.h"

namespace tact::narrowphase {

/// One for each thread, its memory used again.
///
/// A cluster of A is taken into floats about its middle, and with it the clusters of B near it. The mean normal of its
/// facets is nearly that of both surfaces: along it most pairs are apart by their vertices alone. Of the others the
/// facets' boxes are compared in a frame along that normal, in which facets are flat; what these leave is decided in
/// floats, and what floats leave in doubles and exactly.
class SurfacePairSearch {
 public:
  /// As FacetPairSearch::run(). The criteria are not applied to facets.
  void run(const ConfirmInput& input, const std::vector<ClusterPair>& pairs, std::size_t begin, std::size_t end,
           std::vector<FacetPair>& found, ConfirmCounts& counts);

  /// The clusters of which a facet was looked at, each once.
  const std::vector<OpenedCluster>& opened_a() const { return opened_a_; }
  const std::vector<OpenedCluster>& opened_b() const { return opened_b_; }

 private:
  // A cluster in floats about the middle of its box.
  struct LocalCluster {
    Vec3 origin;
    double reach = 0.0;      // of a vertex from the origin along each axis, in the unit
    std::size_t floats = 0;  // where they are
    int vertices = 0;
    bool taken = false;
    bool opened = false;
  };
  // The facets of a cluster in the frame of a cluster of A.
  struct PlacedFacets {
    FloatCorners corners;
    FacetCells cells;
  };

  LocalVertices vertices_of(const LocalCluster& cluster);
  std::size_t take(const ClusteredMesh& mesh, int cluster, std::size_t floats, LocalCluster& local);
  bool still_apart(const ConfirmInput& input, std::span<const ClusterPair> pairs, std::size_t first,
                   ConfirmCounts& counts);
  void look_at(const ConfirmInput& input, std::span<const ClusterPair> pairs, std::size_t first,
               std::vector<FacetPair>& found, ConfirmCounts& counts);
  double gap_along_normal(const LocalCluster& b, const LocalRange& range_a);
  void place_a(const ClusterFacets& facets, const LocalRange& along_normal);
  bool find_meeting(const ConfirmInput& input, const ClusterFacets& facets_a, const ClusterFacets& facets_b,
                    const LocalCluster& b, double slack, std::vector<FacetPair>& found, ConfirmCounts& counts);
  void decide_open(const ConfirmInput& input, std::vector<FacetPair>& found, ConfirmCounts& counts);

  BoxBounds bounds_ = {};      // of both bodies
  double scale_ = 1.0;         // from metres to the unit
  std::vector<float> floats_;  // of all clusters taken
  std::size_t floats_used_ = 0;
  LocalCluster a_;
  std::vector<LocalCluster> b_;       // of each kept cluster
  std::size_t next_certificate_ = 0;  // among the last ones, from the cluster of A on
  LocalFrame frame_ = {};             // of a_
  double cell_[3] = {};               // of its grid
  PlacedFacets placed_a_ = {}, placed_b_ = {};
  std::uint64_t met_[FacetBlock::kCapacity];
  FacetPairList listed_;
  FacetBlock open_a_, open_b_;  // facets of pairs that floats leave open, each pair in the same place of both
  BlockPair decided_;
  std::vector<OpenedCluster> opened_a_, opened_b_;
};

}  // namespace tact::narrowphase
