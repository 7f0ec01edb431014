#include "narrowphase/contact_points/contact_points.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "narrowphase/contact_points/open_features.h"
#include "narrowphase/contact_points/point_finder.h"
#include "narrowphase/contact_points/waiting_edges.h"

namespace tact::narrowphase {

namespace {

double largest_coordinate(const Box& box) {
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
  return largest;
}

// A reach that box tests, which round, can take.
double box_reach(double reach, double largest) { return reach * (1.0 + 0x1p-40) + 0x1p-50 * largest; }

// So many pairs share a grid: its cells stay small beside the facets.
constexpr std::size_t kPairsOfGrid = 256;

// Memory of the search.
struct OpenClusters {
  static constexpr int kOfB = 16;  // clusters of b that stay open: neighbours come soon again
  OpenFeatures a;
  OpenFeatures b[kOfB];
};

// The clusters of b, if they are few, and where each is open.
class FewClusters {
 public:
  // False if they are many.
  bool take(std::span<const ClusterPair> pairs) {
    for (const ClusterPair& pair : pairs) {
      if (place_of(pair.b) < count_) continue;
      if (count_ == OpenClusters::kOfB) return false;
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
  int cluster_[OpenClusters::kOfB], open_[OpenClusters::kOfB], count_ = 0;
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
  void run(OpenClusters& open, PointFinder& finder) const {
    open.a.cluster = -1;
    for (OpenFeatures& one : open.b) one.cluster = -1;
    for (const ClusterPair& pair : pairs_) {
      OpenFeatures& b = open.b[pair.b % OpenClusters::kOfB];
      if (open.a.cluster != pair.a) open.a.open(a_, pair.a, near_b_, grid_, wide_);
      if (b.cluster != pair.b) b.open(b_, pair.b, near_a_, grid_, 0.0);
      finder.search(open.a, b);
    }
  }

  // Bodies that touch in a small place have a few facets there in each of several clusters: as many clusters as there
  // is room for are searched at once. The pairs are all that there are, so that no other search finds the same points.
  void run_together(FewClusters& of_b, OpenClusters& open, PointFinder& finder) const {
    open.b[0].clear();
    for (int i = 0, last = 0; i < of_b.count(); ++i) {
      if (!open.b[last].append(b_, of_b.cluster(i), near_a_, grid_, 0.0))
        open.b[++last].open(b_, of_b.cluster(i), near_a_, grid_, 0.0);
      of_b.set_open(i, last);
    }
    std::uint32_t near = 0;  // a bit for each of `open.b`
    const auto search = [&] {
      for (; near != 0; near &= near - 1) finder.search(open.a, open.b[std::countr_zero(near)]);
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

}  // namespace

std::span<const ClusterPair> NearClusters::find(const FeaturedMesh& a, const FeaturedMesh& b, double reach,
                                                const base::Tuning& tuning, EmbreeDevice& device) {
  const double both = box_reach(reach, std::max(largest_coordinate(a.mesh->box()), largest_coordinate(b.mesh->box())));
  const auto box_of = [](const ClusteredMesh& mesh, int c) { return mesh.cluster_boxes()[c]; };
  return finder_.find(
      *a.mesh, [&](int c) { return inflated(box_of(*a.mesh, c), both); },  //
      *b.mesh, [&](int c) { return box_of(*b.mesh, c); }, b.mesh->box(), tuning, device);
}

struct ContactPointSearch::Memory {
  OpenClusters open;
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
  const Box whole = merged(a.mesh->box(), b.mesh->box());
  const double scale = unit_scale_of(whole);
  const ScaledMesh scaled_a{*a.mesh, *a.features, scale}, scaled_b{*b.mesh, *b.features, scale};
  const double wide = box_reach(scale * reach, scale * std::max(largest_coordinate(a.mesh->box()),  //
                                                                largest_coordinate(b.mesh->box())));
  PointFinder finder(scaled_a, scaled_b, scale * reach, rules, memory_->edges, memory_->ways, found);
  FewClusters few;
  const bool together = given == Given::all && a.mesh != b.mesh && pairs.size() <= kPairsOfGrid && few.take(pairs);
  for (; !pairs.empty(); pairs = pairs.subspan(std::min(pairs.size(), kPairsOfGrid))) {
    const ClusterSearch search(scaled_a, scaled_b, wide, pairs.first(std::min(pairs.size(), kPairsOfGrid)));
    together ? search.run_together(few, memory_->open, finder) : search.run(memory_->open, finder);
  }
  finder.finish();
}

}  // namespace tact::narrowphase
