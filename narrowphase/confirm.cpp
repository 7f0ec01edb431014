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

FacetPlane facet_plane(const FacetBlock& block, std::size_t i, const BoxBounds& others) {
  FacetPlane facet;
  double size = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    facet.box.lower[axis] = block.lower[axis][i];
    facet.box.upper[axis] = block.upper[axis][i];
    facet.corner[axis] = block.corner[0][axis][i];
    facet.normal[axis] = block.normal[axis][i];
    const double to_lower = others.lower[axis] - facet.corner[axis], to_upper = others.upper[axis] - facet.corner[axis];
    size += block.size[axis][i] * std::max(std::abs(to_lower), std::abs(to_upper));
  }
  facet.error = size * kRelativeRounding + kAbsoluteRounding;
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
  std::int32_t opened = -1;
  for (std::size_t i = begin; i < end; ++i) {
    const ClusterPair& pair = pairs[i];
    if (pair.a == opened && a_.kept == 0) continue;
    const OpenCluster& b = open_b(input, pair.b);
    const Box box_a = input.kept_a->boxes[static_cast<std::size_t>(pair.a)];
    const NearFacets near_b = kernels().near_facets(b.block, b.kept, bounds_of(box_a));
    if (near_b.facets == 0) continue;
    if (pair.a != opened) open_a(input, pair.a);
    opened = pair.a;
    test_clusters(input, b, near_b, found, counts);
  }
}

void FacetPairSearch::open_a(const ConfirmInput& input, std::int32_t index) {
  opened_a_.push_back({index, {}});
  const std::int32_t cluster = input.kept_a->cluster[static_cast<std::size_t>(index)];
  a_.first_facet = input.a->facet_begin(cluster);
  a_.kept = cull_facets(*input.a, cluster, input.criteria_a, input.kept_b->bounds, a_.block, opened_a_.back().counts);
}

const FacetPairSearch::OpenCluster& FacetPairSearch::open_b(const ConfirmInput& input, std::int32_t index) {
  std::int32_t& slot = slot_[static_cast<std::size_t>(index)];
  if (slot < 0) {
    slot = static_cast<std::int32_t>(opened_b_.size());
    opened_b_.push_back({index, {}});
    if (opened_b_.size() > b_.size()) b_.push_back(std::make_unique<OpenCluster>());
    OpenCluster& b = *b_[static_cast<std::size_t>(slot)];
    const std::int32_t cluster = input.kept_b->cluster[static_cast<std::size_t>(index)];
    b.first_facet = input.b->facet_begin(cluster);
    b.kept = cull_facets(*input.b, cluster, input.criteria_b, input.kept_a->bounds, b.block, opened_b_.back().counts);
  }
  return *b_[static_cast<std::size_t>(slot)];
}

// Each facet of the cluster with fewer of them near the other is held against all of the other's at once; the pairs
// that this leaves are decided many at a time.
void FacetPairSearch::test_clusters(const ConfirmInput& input, const OpenCluster& b, const NearFacets& near_b,
                                    std::vector<FacetPair>& found, ConfirmCounts& counts) {
  const NearFacets near_a = kernels().near_facets(a_.block, a_.kept, near_b.box);
  const bool a_has_fewer = std::popcount(near_a.facets) <= std::popcount(near_b.facets);
  const NearFacets &few = a_has_fewer ? near_a : near_b, &many = a_has_fewer ? near_b : near_a;
  const FacetBlock &few_block = a_has_fewer ? a_.block : b.block, &many_block = a_has_fewer ? b.block : a_.block;
  std::int32_t *few_pairs = a_has_fewer ? pairs_.a : pairs_.b, *many_pairs = a_has_fewer ? pairs_.b : pairs_.a;
  for (std::uint64_t left = few.facets; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    const FacetPlane plane = facet_plane(few_block, static_cast<std::size_t>(i), many.box);
    const CrossingFacets crossing = kernels().crossing_facets(many_block, many.facets, plane);
    counts.facet_box_pairs += crossing.box_pairs;
    for (std::uint64_t bits = crossing.facets; bits != 0; bits &= bits - 1) {
      if (pairs_.count == FacetPairList::kCapacity) decide_pairs(input, b, found, counts);
      few_pairs[pairs_.count] = i;
      many_pairs[pairs_.count++] = std::countr_zero(bits);
    }
  }
  decide_pairs(input, b, found, counts);
}

// Decides the pairs in the list and empties it.
void FacetPairSearch::decide_pairs(const ConfirmInput& input, const OpenCluster& b, std::vector<FacetPair>& found,
                                   ConfirmCounts& counts) {
  const PairMatches matches = kernels().match_pairs(a_.block, b.block, pairs_);
  std::uint64_t meeting = matches.meeting;
  for (std::uint64_t left = matches.undecided; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    ++counts.triangle_tests;
    const Triangle p = triangle_in(a_.block, static_cast<std::size_t>(pairs_.a[k]));
    const Triangle q = triangle_in(b.block, static_cast<std::size_t>(pairs_.b[k]));
    if (triangle_triangle_meet(p, q, counts.predicates)) meeting |= std::uint64_t{1} << k;
  }
  for (std::uint64_t left = meeting; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    const int facet_a = a_.first_facet + a_.block.facet[pairs_.a[k]];
    const int facet_b = b.first_facet + b.block.facet[pairs_.b[k]];
    found.push_back({input.a->source_facet(facet_a), input.b->source_facet(facet_b)});
  }
  pairs_.count = 0;
}

}  // namespace tact::narrowphase
