// Pairs of facets of two meshes, best first: from boxes of groups to those of clusters to those of facets.
#pragma once

#include <algorithm>
#include <vector>

#include "narrowphase/mesh/cluster_search.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// Calls search.look_at(a, b, rank) for facets of two meshes by ascending rank, as far as boxes tell. The search has
///   double rank(box, box)         of two boxes: not above that of boxes inside them
///   bool wants(rank, a, b)        whether a pair of that rank may count still whose facets are not below a and b, by
///                                 the caller's numbers; look_at() may narrow it
///   void look_at(a, b, rank)      by the mesh's numbers
template <class Search>
class FacetPairDescent {
 public:
  FacetPairDescent(const ClusteredMesh& a, const ClusteredMesh& b, Search& search) : a_(a), b_(b), search_(search) {}

  void run() {
    if (a_.facet_count() == 0 || b_.facet_count() == 0) return;
    rank_pairs(0, a_.group_count(), 0, b_.group_count(), group_box, groups_);
    for (const Ranked& groups : groups_) {
      if (!search_.wants(groups.rank, -1, -1)) continue;
      rank_pairs(a_.cluster_begin(groups.a), a_.cluster_end(groups.a), b_.cluster_begin(groups.b),
                 b_.cluster_end(groups.b), cluster_box, clusters_);
      for (const Ranked& clusters : clusters_) {
        if (search_.wants(clusters.rank, least_facet(a_, clusters.a), least_facet(b_, clusters.b)))
          open(clusters.a, clusters.b);
      }
    }
  }

 private:
  struct Ranked {
    double rank;
    int a, b;
  };
  struct BoxedFacet {
    Box box;
    int facet, source;
  };

  static Box group_box(const ClusteredMesh& mesh, int group) {
    return mesh.group_count() == 1 ? mesh.box() : mesh.group_boxes()[static_cast<std::size_t>(group)];
  }
  static Box cluster_box(const ClusteredMesh& mesh, int cluster) {
    return mesh.cluster_boxes()[static_cast<std::size_t>(cluster)];
  }
  static int least_facet(const ClusteredMesh& mesh, int cluster) {
    const int* const sources = mesh.source_facets_of(cluster);
    return *std::min_element(sources, sources + (mesh.facet_end(cluster) - mesh.facet_begin(cluster)));
  }

  template <class BoxOf>
  void rank_pairs(int begin_a, int end_a, int begin_b, int end_b, const BoxOf& box_of, std::vector<Ranked>& pairs) {
    pairs.clear();
    for (int i = begin_a; i < end_a; ++i) {
      const Box of_a = box_of(a_, i);
      for (int k = begin_b; k < end_b; ++k) {
        const double rank = search_.rank(of_a, box_of(b_, k));
        if (search_.wants(rank, -1, -1)) pairs.push_back({rank, i, k});
      }
    }
    std::ranges::sort(pairs, {}, &Ranked::rank);
  }

  // The facets of a cluster that may count beside what is in a box of the other mesh; `of_a` says whose they are.
  void keep_facets(const ClusteredMesh& mesh, int cluster, const Box& other, bool of_a, std::vector<BoxedFacet>& kept) {
    kept.clear();
    for (int f = mesh.facet_begin(cluster); f < mesh.facet_end(cluster); ++f) {
      const Box box = narrowphase::box_of(mesh.triangle(f));
      const double rank = of_a ? search_.rank(box, other) : search_.rank(other, box);
      if (search_.wants(rank, -1, -1)) kept.push_back({box, f, mesh.source_facet(f)});
    }
  }

  void open(int cluster_a, int cluster_b) {
    keep_facets(a_, cluster_a, cluster_box(b_, cluster_b), true, facets_a_);
    keep_facets(b_, cluster_b, cluster_box(a_, cluster_a), false, facets_b_);
    facets_.clear();
    for (int i = 0; i < static_cast<int>(facets_a_.size()); ++i) {
      const BoxedFacet& a = at(facets_a_, i);
      for (int k = 0; k < static_cast<int>(facets_b_.size()); ++k) {
        const BoxedFacet& b = at(facets_b_, k);
        const double rank = search_.rank(a.box, b.box);
        if (search_.wants(rank, a.source, b.source)) facets_.push_back({rank, i, k});
      }
    }
    // Few are taken before the rest drops out, so they are not sorted.
    const auto is_later = [this](const Ranked& p, const Ranked& q) {
      if (p.rank != q.rank) return p.rank > q.rank;
      const int a_of_p = at(facets_a_, p.a).source, a_of_q = at(facets_a_, q.a).source;
      return a_of_p != a_of_q ? a_of_p > a_of_q : at(facets_b_, p.b).source > at(facets_b_, q.b).source;
    };
    std::make_heap(facets_.begin(), facets_.end(), is_later);
    for (; !facets_.empty(); facets_.pop_back()) {
      std::pop_heap(facets_.begin(), facets_.end(), is_later);
      const Ranked& pair = facets_.back();
      const BoxedFacet &a = at(facets_a_, pair.a), &b = at(facets_b_, pair.b);
      if (!search_.wants(pair.rank, -1, -1)) return;
      if (search_.wants(pair.rank, a.source, b.source)) search_.look_at(a.facet, b.facet, pair.rank);
    }
  }
  static const BoxedFacet& at(const std::vector<BoxedFacet>& facets, int i) {
    return facets[static_cast<std::size_t>(i)];
  }

  const ClusteredMesh &a_, &b_;
  Search& search_;
  std::vector<Ranked> groups_, clusters_, facets_;
  std::vector<BoxedFacet> facets_a_, facets_b_;
};

template <class Search>
void descend_to_facet_pairs(const ClusteredMesh& a, const ClusteredMesh& b, Search& search) {
  FacetPairDescent(a, b, search).run();
}

/// The best pair of facets so far: that of the least value, of equal ones the least by the caller's numbers. So the
/// answer depends on no order, if a pair's value is not below its rank.
struct BestFacetPair {
  double value;  // what is above does not count
  int a = -1, b = -1;

  bool wants(double rank, int facet_a, int facet_b) const {
    if (rank != value || a < 0) return rank <= value;
    return facet_a != a ? facet_a < a : facet_b < b;
  }
};

}  // namespace tact::narrowphase
