// Which clusters of a mesh lie beside each other, and along which edges they and the corners where they meet end. It
// depends on facets alone, so it is made once and holds while the mesh moves.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "narrowphase/mesh/features.h"
#include "narrowphase/self/vertex_fans.h"

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
  /// Corners: clusters that meet at a vertex, and that together end along one closed line of edges, which comes to no
  /// vertex twice. They are so chosen that most pairs of clusters that share a vertex meet at one of them.
  int corner_count() const { return static_cast<int>(corner_begin_.size()) - 1; }
  /// Ascending.
  std::span<const int> clusters_at(int corner) const { return part(at_corner_, corner_begin_, corner); }
  /// The vertices of that line in their order, 3 to kMostAround; seen from above the clusters are on its left.
  std::span<const int> line_around(int corner) const { return part(lines_, line_begin_, corner); }
  static constexpr int kMostAround = 128;
  /// The corners at which a cluster meets others, ascending.
  std::span<const int> corners_of(int cluster) const { return part(corners_of_, corners_of_begin_, cluster); }
  /// True if a facet of the cluster names a vertex twice, or lies at an edge that does not belong to one facet, or to
  /// two that run through it in opposite directions, or if it has more neighbours than can be listed. Its rims are then
  /// incomplete.
  bool irregular(int cluster) const { return irregular_[cluster] != 0; }
  const VertexFans& fans() const { return fans_; }

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
  // Some clusters, ascending, then -1.
  using Together = std::array<int, 6>;
  std::vector<Together> find_around(const ClusteredMesh& mesh);
  // Where around_ has the second cluster among those around the first, or -1.
  std::ptrdiff_t place_of(int cluster, int other) const;
  void choose_centers(int cluster_count);
  std::vector<RimSide> find_rim_sides(const ClusteredMesh& mesh, const Features& features);
  void list_rims(std::vector<RimSide>& all, int cluster_count);
  void choose_corners(std::vector<Together>& meeting, int cluster_count);
  std::vector<int> line_around(std::span<const int> clusters) const;

  std::vector<int> around_, around_begin_;
  std::vector<int> centers_;
  std::vector<char> is_center_;
  std::vector<Rim> rims_;
  std::vector<int> rims_begin_;
  std::vector<Side> sides_;
  std::vector<int> at_corner_, corner_begin_{0};
  std::vector<int> lines_, line_begin_{0};
  std::vector<int> corners_of_, corners_of_begin_;
  std::vector<char> irregular_;
  VertexFans fans_;
};

}  // namespace tact::narrowphase
