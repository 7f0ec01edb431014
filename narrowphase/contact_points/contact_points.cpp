#include "narrowphase/contact_points/contact_points.h"

#include <algorithm>
#include <bit>

#include "narrowphase/contact_points/open_features.h"
#include "narrowphase/contact_points/point_finder.h"
#include "narrowphase/contact_points/reach_finder.h"
#include "narrowphase/contact_points/waiting_edges.h"
#include "narrowphase/pairs/open_clusters.h"

namespace tact::narrowphase {

namespace {

// So many pairs share a grid: its cells stay small beside the facets.
constexpr std::size_t kPairsOfGrid = 256;

// Memory of the search.
struct OpenPairs {
  static constexpr int kOfB = 16;  // clusters of b that stay open, 34 kB each
  OpenFeatures a;
  OpenClusters<OpenFeatures, kOfB> b;
};

// The clusters of b, if they are few, and where each is open.
class FewClusters {
 public:
  // False if they are many.
  bool take(std::span<const ClusterPair> pairs) {
    for (const ClusterPair& pair : pairs) {
      if (place_of(pair.b) < count_) continue;
      if (count_ == OpenPairs::kOfB) return false;
      cluster_[count_++] = pair.b;
    }
    return true;
  }
  int count() const { return count_; }
  int cluster(int i) const { return cluster_[i]; }
  void set_open(int i, int open) { open_[i] = open; }
  int open(int cluster) const { return open_[place_of(cluster)]; }

 private:
  int place_of(int cluster) const {
    return static_cast<int>(std::find(cluster_, cluster_ + count_, cluster) - cluster_);
  }
  int cluster_[OpenPairs::kOfB], open_[OpenPairs::kOfB], count_ = 0;
};

// Some cluster pairs, sorted, and the grid that they share.
class ClusterSearch {
 public:
  // Boxes of `a` are widened by `wide`.
  ClusterSearch(const ScaledMesh& a, const ScaledMesh& b, double wide, std::span<const ClusterPair> pairs)
      : a_(a), b_(b), wide_(wide), pairs_(pairs) {
    Box of_a, of_b;
    for (const ClusterPair& pair : pairs) {
      of_a = merged(of_a, box_of(a, pair.a));
      of_b = merged(of_b, box_of(b, pair.b));
    }
    near_a_ = inflated(of_a, wide);
    near_b_ = inflated(of_b, wide);
    grid_ = grid_over(intersection(near_a_, near_b_));
  }

  // Pair by pair.
  template <class Finder>
  void run(OpenPairs& open, Finder& finder) const {
    open.a.clear();
    open.b.close();
    for (const ClusterPair& pair : pairs_) {
      if (open.a.cluster != pair.a) open.a.open(a_, pair.a, near_b_, grid_, wide_);
      const auto open_b = [&](OpenFeatures& b) { b.open(b_, pair.b, near_a_, grid_, 0.0); };
      finder.search(open.a, open.b.get(pair.b, open_b));
    }
  }

  // Bodies that touch in a small place have a few facets there in each of several clusters: as many clusters as there
  // is room for are searched at once. The pairs are all that there are, so that no other search finds the same points.
  template <class Finder>
  void run_together(FewClusters& of_b, OpenPairs& open, Finder& finder) const {
    open.b.place(0).clear();
    for (int i = 0, last = 0; i < of_b.count(); ++i) {
      if (!open.b.place(last).append(b_, of_b.cluster(i), near_a_, grid_, 0.0))
        open.b.place(++last).open(b_, of_b.cluster(i), near_a_, grid_, 0.0);
      of_b.set_open(i, last);
    }
    std::uint32_t near = 0;  // a bit for each of `open.b`
    const auto search = [&] {
      for (; near != 0; near &= near - 1) finder.search(open.a, open.b.place(std::countr_zero(near)));
    };
    open.a.clear();
    for (std::size_t i = 0; i < pairs_.size();) {
      const int cluster = pairs_[i].a;
      if (!open.a.append(a_, cluster, near_b_, grid_, wide_)) {
        search();
        open.a.open(a_, cluster, near_b_, grid_, wide_);
      }
      for (; i < pairs_.size() && pairs_[i].a == cluster; ++i) near |= 1u << of_b.open(pairs_[i].b);
    }
    search();
  }

 private:
  static Box box_of(const ScaledMesh& m, int cluster) {
    const Box box = m.mesh.cluster_boxes()[cluster];
    return {m.scale * box.lower, m.scale * box.upper};
  }

  const ScaledMesh &a_, &b_;
  const double wide_;
  std::span<const ClusterPair> pairs_;
  Box near_a_, near_b_;
  Grid grid_;
};

// The scale in which two meshes are compared.
double scale_of(const FeaturedMesh& a, const FeaturedMesh& b) {
  return unit_scale_of(merged(a.mesh->box(), b.mesh->box()));
}

// Calls finder.search(a, b) for the open clusters of all pairs.
template <class Finder>
void search_all(const ScaledMesh& a, const ScaledMesh& b, double reach, std::span<const ClusterPair> pairs,
                ContactPointSearch::Given given, OpenPairs& open, Finder& finder) {
  const double wide = box_reach(a.scale * reach, a.scale * std::max(largest_coordinate(a.mesh.box()),  //
                                                                    largest_coordinate(b.mesh.box())));
  FewClusters few;
  const bool together =
      given == ContactPointSearch::Given::all && &a.mesh != &b.mesh && pairs.size() <= kPairsOfGrid && few.take(pairs);
  for (; !pairs.empty(); pairs = pairs.subspan(std::min(pairs.size(), kPairsOfGrid))) {
    const ClusterSearch search(a, b, wide, pairs.first(std::min(pairs.size(), kPairsOfGrid)));
    together ? search.run_together(few, open, finder) : search.run(open, finder);
  }
}

}  // namespace

struct ContactPointSearch::Memory {
  OpenPairs open;
  WaitingEdges edges;
  SurfaceWays ways;
};

ContactPointSearch::ContactPointSearch() : memory_(std::make_unique<Memory>()) {}
ContactPointSearch::~ContactPointSearch() = default;
ContactPointSearch::ContactPointSearch(ContactPointSearch&&) noexcept = default;
ContactPointSearch& ContactPointSearch::operator=(ContactPointSearch&&) noexcept = default;

void ContactPointSearch::run(const FeaturedMesh& a, const FeaturedMesh& b, double reach,
                             std::span<const ClusterPair> pairs, std::vector<FeaturePoint>& found,
                             const NearRules& rules, Given given) {
  const double scale = scale_of(a, b);
  const ScaledMesh scaled_a{*a.mesh, *a.features, scale}, scaled_b{*b.mesh, *b.features, scale};
  PointFinder finder(scaled_a, scaled_b, scale * reach, rules, memory_->edges, memory_->ways, found);
  search_all(scaled_a, scaled_b, reach, pairs, given, memory_->open, finder);
  finder.finish();
}

void ContactPointSearch::run_within_reach(const FeaturedMesh& a, const FeaturedMesh& b, double reach,
                                          std::span<const ClusterPair> pairs, std::vector<ReachPair>& found,
                                          Given given) {
  const double scale = scale_of(a, b);
  const ScaledMesh scaled_a{*a.mesh, *a.features, scale}, scaled_b{*b.mesh, *b.features, scale};
  ReachFinder finder(scaled_a, scaled_b, scale * reach, found);
  search_all(scaled_a, scaled_b, reach, pairs, given, memory_->open, finder);
}

}  // namespace tact::narrowphase
