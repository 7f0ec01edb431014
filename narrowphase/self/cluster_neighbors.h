// Which clusters of a mesh lie beside each other, and along which edges. It depends on facets alone, so it is made once
// and holds while the mesh moves.
#pragma once

#include <span>
#include <vector>

#include "narrowphase/contact_points/features.h"

namespace tact::narrowphase {

class ClusterNeighbors {
 public:
  /// An edge from one vertex to another as a facet of the cluster has it: seen from above the facet is on its left.
  struct Side {
    int from, to;
  };
  /// The edges along which a cluster ends: beyond them is the cluster `other`, or nothing if that is negative.
  struct Rim {
    int other;
    int begin, end;  // of its sides; each begins where the one before it ends, as far as that can be
  };

  ClusterNeighbors(const ClusteredMesh& mesh, const Features& features);

  /// The clusters that share a vertex with a cluster, itself among them; ascending.
  std::span<const int> around(int cluster) const { return part(around_, around_begin_, cluster); }
  /// Some clusters so chosen that most pairs of clusters that share a vertex are around one of them. Ascending.
  std::span<const int> centers() const { return centers_; }
  bool is_center(int cluster) const { return is_center_[cluster] != 0; }
  /// Ascending by the cluster beyond. All rims are counted through, those of a cluster from first_rim() on.
  std::span<const Rim> rims(int cluster) const { return part(rims_, rims_begin_, cluster); }
  std::size_t first_rim(int cluster) const { return static_cast<std::size_t>(rims_begin_[cluster]); }
  std::size_t rim_count() const { return rims_.size(); }
  std::span<const Side> sides(const Rim& rim) const {
    return std::span(sides_).subspan(rim.begin, rim.end - rim.begin);
  }
  /// Does a facet of the cluster name a vertex twice, or lie at an edge that is not that of one facet, or of two that
  /// run through it in opposite directions? Or has it more neighbours than can be listed? Its rims are not complete.
  bool irregular(int cluster) const { return irregular_[cluster] != 0; }

 private:
  struct RimSide {
    int cluster, other;
    Side side;
  };
  template <class Item>
  static std::span<const Item> part(const std::vector<Item>& all, const std::vector<int>& begin, int i) {
    const auto k = static_cast<std::size_t>(i);
    return std::span(all).subspan(begin[k], begin[k + 1] - begin[k]);
  }
  void find_around(const ClusteredMesh& mesh);
  void choose_centers(int cluster_count);
  std::vector<RimSide> find_rim_sides(const ClusteredMesh& mesh, const Features& features);
  void list_rims(std::vector<RimSide>& all, int cluster_count);

  std::vector<int> around_, around_begin_;
  std::vector<int> centers_;
  std::vector<char> is_center_;
  std::vector<Rim> rims_;
  std::vector<int> rims_begin_;
  std::vector<Side> sides_;
  std::vector<char> irregular_;
};

}  // namespace tact::narrowphase
