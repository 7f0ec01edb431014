#include "narrowphase/confirm.h"

#include <algorithm>
#include <bit>

#include "narrowphase/triangle_triangle.h"

namespace tact::narrowphase {

namespace {

// A loop over all pairs of boxes takes about a nanosecond each in SIMD; building and asking a tree some 100 a box.
constexpr std::int64_t kLargestLoop = std::int64_t{1} << 20;

BoxBounds bounds_of(const Box& box) {
  return {{box.lower.x, box.lower.y, box.lower.z}, {box.upper.x, box.upper.y, box.upper.z}};
}

Triangle triangle_in(const FacetBlock& block, std::size_t i) {
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) t[k] = {block.corner[k][0][i], block.corner[k][1][i], block.corner[k][2][i]};
  return t;
}

}  // namespace

FilterFacet filter_facet(const FacetBlock& block, std::size_t i) {
  FilterFacet facet;
  for (int axis = 0; axis < 3; ++axis) {
    facet.box.lower[axis] = block.lower[axis][i];
    facet.box.upper[axis] = block.upper[axis][i];
    for (int k = 0; k < 3; ++k) facet.corner[k][axis] = block.corner[k][axis][i];
  }
  const auto side = [&](int k, int axis) { return facet.corner[k][axis] - facet.corner[0][axis]; };
  for (int axis = 0; axis < 3; ++axis) {
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    const double p = side(1, y) * side(2, z), q = side(1, z) * side(2, y);
    facet.normal[axis] = p - q;
    facet.normal_bound[axis] = std::abs(p) + std::abs(q);
  }
  return facet;
}

bool find_cluster_pairs(const KeptClusters& a, const KeptClusters& b, ClusterPairSource source, EmbreeDevice& device,
                        std::vector<ClusterPair>& pairs, std::vector<std::int32_t>& found) {
  pairs.clear();
  const std::int64_t all = static_cast<std::int64_t>(a.count()) * b.count();
  const bool forest =
      source == ClusterPairSource::forest || (source == ClusterPairSource::automatic && all > kLargestLoop);
  if (all == 0) return false;
  ClusterForest trees;
  if (forest) trees.build(device, b.boxes, b.count());
  for (std::int32_t i = 0; i < a.count(); ++i) {
    const Box box = a.boxes[static_cast<std::size_t>(i)];
    if (forest) {
      found.clear();
      trees.query(box, found);
      std::sort(found.begin(), found.end());
    } else {
      found.resize(static_cast<std::size_t>(b.count()));
      found.resize(static_cast<std::size_t>(
          kernels().select_overlapping(b.boxes.pointers(), b.count(), bounds_of(box), found.data())));
    }
    for (const std::int32_t k : found) pairs.push_back({i, k});
  }
  return forest;
}

void FacetPairSearch::run(const ConfirmInput& input, const std::vector<ClusterPair>& pairs, std::size_t begin,
                          std::size_t end, std::vector<FacetPair>& found, ConfirmCounts& counts) {
  opened_a_.clear();
  opened_b_.clear();
  slot_.assign(static_cast<std::size_t>(input.kept_b->count()), -1);
  std::int32_t open_a = -1;
  for (std::size_t i = begin; i < end; ++i) {
    const ClusterPair& pair = pairs[i];
    if (pair.a != open_a) {
      open_a = pair.a;
      const std::int32_t cluster = input.kept_a->cluster[static_cast<std::size_t>(pair.a)];
      opened_a_.push_back({pair.a, {}});
      a_.kept =
          cull_facets(*input.a, cluster, input.criteria_a, input.kept_b->bounds, a_.block, opened_a_.back().counts);
    }
    if (a_.kept == 0) continue;
    const OpenCluster& b = open_b(input, pair.b);
    if (b.kept != 0) test_clusters(input, pair, a_, b, found, counts);
  }
}

const FacetPairSearch::OpenCluster& FacetPairSearch::open_b(const ConfirmInput& input, std::int32_t index) {
  std::int32_t& slot = slot_[static_cast<std::size_t>(index)];
  if (slot < 0) {
    slot = static_cast<std::int32_t>(opened_b_.size());
    opened_b_.push_back({index, {}});
    if (opened_b_.size() > b_.size()) b_.push_back(std::make_unique<OpenCluster>());
    OpenCluster& b = *b_[static_cast<std::size_t>(slot)];
    const std::int32_t cluster = input.kept_b->cluster[static_cast<std::size_t>(index)];
    b.kept = cull_facets(*input.b, cluster, input.criteria_b, input.kept_a->bounds, b.block, opened_b_.back().counts);
  }
  return *b_[static_cast<std::size_t>(slot)];
}

void FacetPairSearch::test_clusters(const ConfirmInput& input, const ClusterPair& pair, const OpenCluster& a,
                                    const OpenCluster& b, std::vector<FacetPair>& found, ConfirmCounts& counts) {
  const int first_a = input.a->facet_begin(input.kept_a->cluster[static_cast<std::size_t>(pair.a)]);
  const int first_b = input.b->facet_begin(input.kept_b->cluster[static_cast<std::size_t>(pair.b)]);
  const Box box_a = input.kept_a->boxes[static_cast<std::size_t>(pair.a)];
  const NearFacets near_b = kernels().near_facets(b.block, b.kept, bounds_of(box_a));
  if (near_b.facets == 0) return;
  const NearFacets near_a = kernels().near_facets(a.block, a.kept, near_b.box);
  const auto add = [&](std::size_t i, std::size_t j) {
    found.push_back(
        {input.a->source_facet(first_a + static_cast<int>(i)), input.b->source_facet(first_b + static_cast<int>(j))});
  };
  for (std::uint64_t left_a = near_a.facets; left_a != 0; left_a &= left_a - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left_a));
    const FacetMatches matches = kernels().match_facets(b.block, near_b.facets, filter_facet(a.block, i));
    counts.facet_box_pairs += matches.box_pairs;
    for (std::uint64_t left = matches.meeting; left != 0; left &= left - 1) {
      add(i, static_cast<std::size_t>(std::countr_zero(left)));
    }
    for (std::uint64_t left = matches.undecided; left != 0; left &= left - 1) {
      const auto j = static_cast<std::size_t>(std::countr_zero(left));
      ++counts.triangle_tests;
      if (triangle_triangle_meet(triangle_in(a.block, i), triangle_in(b.block, j), counts.predicates)) add(i, j);
    }
  }
}

}  // namespace tact::narrowphase
