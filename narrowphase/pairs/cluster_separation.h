// Cluster pairs whose boxes overlap and that a plane separates: clusters of long facets that lie across the axes, and
// those around a vertex of many facets. Planes are tried only where boxes leave many pairs of each cluster, and go on
// only where they separate most pairs of a sample.
//
// **What is proved.** Let all vertices of A be below a plane and all of B above it by `reach` together: no feature of A
// is as near to one of B. If they move straight and that is so at both ends of their ways, with one direction of the
// plane, it is so all the way, as heights are linear in time.
//
// Of one mesh, clusters may have a vertex in common. Then the plane goes through it, and all others are `m` below or
// above: two features that do not share that vertex are at least `m` apart, as one of them is beyond by so much. If two
// vertices are in common, the plane goes through both, `e` apart, and features may reach it at one of them each: with a
// distance d they do so within d R / m of it, R the largest distance from it, so that e <= d (1 + 2 R / m): they are
// e m / (3 R) apart or more.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/tuning.h"
#include "narrowphase/mesh/cluster_places.h"
#include "narrowphase/pairs/cluster_pair.h"
#include "narrowphase/pairs/kept_clusters.h"

namespace tact::narrowphase {

/// The clusters of a mesh that pairs are made of.
struct PairedClusters {
  ClusterBoxes boxes;
  int count = 0;                          ///< of those that were kept
  const std::int32_t* numbers = nullptr;  ///< of kept ones, by which pairs name them; null: by their own numbers
};

/// One for each thread; its memory is used again.
class ClusterSeparation {
 public:
  /// Leaves out items whose cluster pairs certainly hold no two features, without a common vertex, that come within
  /// `reach`. All pairs of the two are given, those of one mesh with the smaller cluster first.
  template <class Item, class PairOf>
  void leave_out(const PairedClusters& a, const PairedClusters& b, double reach, const base::Tuning& tuning,
                 std::vector<Item>& items, const PairOf& pair_of) {
    const std::size_t count = items.size();
    if (!begin(a, b, reach, tuning, count)) return;
    const auto apart = [&](const Item& item) { return are_apart(pair_of(item)); };
    const std::size_t sample = tuning.worth_planes == 0 ? 0 : std::clamp<std::size_t>(count / 32, 4, 32);
    std::size_t separated = 0;
    for (std::size_t k = 0; k < sample; ++k) separated += apart(items[(2 * k + 1) * count / (2 * sample)]);
    if (2 * separated >= sample) std::erase_if(items, apart);
    places_.forget();
  }

 private:
  /// The vertices of a cluster at one time or two, those that it owns first.
  struct Vertices {
    std::size_t begin = 0;  ///< in points_
    int count = 0;          ///< 0: not copied yet
  };
  struct Side {
    PairedClusters clusters;
    std::vector<Vertices> of_cluster;
  };
  /// Some vertices of a cluster: all but those in common.
  struct Chosen {
    Vertices vertices;
    IndexRange ranges[3];
    int range_count = 0;
  };
  /// Of the ways from what is chosen of A to what is chosen of B, or from A to the common vertex and from it to B.
  struct Lowest {
    double height;
    Vec3 way;
  };

  bool begin(const PairedClusters& a, const PairedClusters& b, double reach, const base::Tuning& tuning,
             std::size_t pairs);
  bool are_apart(ClusterPair pair);
  int number_of(const Side& side, std::int32_t i) const;
  Vertices vertices_of(Side& side, int cluster);
  PointArrays points(const Vertices& vertices, int time) const;
  Vec3 point(const Vertices& vertices, int time, int i) const;
  bool choose(ClusterPair clusters);
  bool search();
  Lowest lowest_along(Vec3 n) const;
  bool separates(Vec3 n, double height) const;

  Side a_, b_;
  bool same_ = false;
  int times_ = 1;
  double reach_ = 0.0;
  std::vector<double> points_;
  ClusterPlaces places_;      // in cluster_a_, of one mesh
  int cluster_a_ = -1;        // that was looked at last
  Vec3 last_{};               // that separated a pair of cluster_a_; zero: none
  Chosen of_a_, of_b_;        // of the pair that is looked at
  int common_ = 0;            // vertices
  Vec3 origin_[2], edge_[2];  // at both times: a vertex of A, or a common one; from it to another common one
  double size_ = 0.0, needed_ = 0.0, shortest_edge_ = 0.0;
};

}  // namespace tact::narrowphase
