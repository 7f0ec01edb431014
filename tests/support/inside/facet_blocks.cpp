#include "tests/support/inside/facet_blocks.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "narrowphase/triangles/triangle_triangle.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {

using narrowphase::BoxBounds;
using narrowphase::ClusteredMesh;
using narrowphase::CullPlanes;
using narrowphase::FacetBlock;
using narrowphase::FacetPairList;
using narrowphase::Grid;
using narrowphase::Kernels;
using narrowphase::PairMatches;
using narrowphase::PredicateCounts;

namespace {

Mesh turned(Mesh mesh) {
  mesh.positions =
      (Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.36, 0.48, 0.8)).toRotationMatrix() * mesh.positions).eval();
  return mesh;
}

}  // namespace

FacetBlock block_of(const Kernels& kernels, const ClusteredMesh& mesh, int cluster, const CullPlanes& planes,
                    const Grid& grid) {
  FacetBlock block{};
  kernels.open_cluster(mesh.facets_of(cluster), planes, &block);
  kernels.find_cells(grid, &block);
  return block;
}

base::Box facet_box(const ClusteredMesh& mesh, int facet) {
  base::Box box;
  for (const base::Vec3& p : mesh.triangle(facet)) box = extended(box, p);
  return box;
}

narrowphase::FloatCorners floats_of(const Kernels& kernels, const FacetBlock& block) {
  narrowphase::FloatCorners corners;
  kernels.float_corners(block, all_bits(block.count), grid_over(kEverything, 1.0), &corners);
  return corners;
}

std::vector<FacetPair> paired(const Kernels& kernels, const FacetBlock& a, const FacetBlock& b, bool few_are_b,
                              int plane_from, std::int64_t& box_pairs) {
  std::vector<FacetPair> all;
  const FacetBlock &few = few_are_b ? b : a, &many = few_are_b ? a : b;
  Met met{};
  const narrowphase::SharedCells shared =
      kernels.share_cells(few.cells, all_bits(few.count), many.cells, all_bits(many.count), met.data());
  box_pairs += shared.pairs;
  constexpr double kGap[3] = {1.0 / narrowphase::kLastCell, 1.0 / narrowphase::kLastCell, 1.0 / narrowphase::kLastCell};
  kernels.leave_aside(floats_of(kernels, few), shared.facets, floats_of(kernels, many), kGap, 0.0f, plane_from,
                      met.data());
  for (std::uint64_t left = shared.facets; left != 0;) {
    FacetPairList pairs;
    left = kernels.list_pairs(left, met.data(), few_are_b, &pairs);
    EXPECT_TRUE(left == 0 || pairs.count == FacetPairList::kCapacity) << kernels.name;
    EXPECT_EQ(left & ~shared.facets, 0u);
    for (int k = 0; k < pairs.count; ++k) all.push_back({pairs.a[k], pairs.b[k]});
  }
  std::sort(all.begin(), all.end());
  return all;
}

BoxBounds bounds_of(const FacetPairList& pairs, const FacetBlock& a, const FacetBlock& b) {
  BoxBounds bounds = box_of(a, pairs.a[0]);
  for (int k = 0; k < pairs.count; ++k) bounds = merged(merged(bounds, box_of(a, pairs.a[k])), box_of(b, pairs.b[k]));
  return bounds;
}

FacetPairList all_with(int facet, int count) {
  FacetPairList pairs;
  for (int g = 0; g < count; ++g) {
    pairs.a[pairs.count] = static_cast<std::uint8_t>(facet);
    pairs.b[pairs.count++] = static_cast<std::uint8_t>(g);
  }
  return pairs;
}

Decisions decide_all(const Kernels& kernels, const ClusteredMesh& a, const ClusteredMesh& b, Digits digits,
                     const CullPlanes& planes) {
  const FacetBlock block_a = block_of(kernels, a, 0, planes), block_b = block_of(kernels, b, 0, planes);
  Decisions decisions;
  for (int f = 0; f < a.facet_end(0); ++f) {
    const FacetPairList pairs = all_with(f, b.facet_end(0));
    const BoxBounds bounds = bounds_of(pairs, block_a, block_b);
    const PairMatches matches = digits == Digits::few ? match_float_pairs(kernels, block_a, block_b, pairs, bounds)
                                : digits == Digits::simple
                                    ? match_pairs(kernels, block_a, block_b, pairs, bounds)
                                    : kernels.match_pairs_wide(block_a, block_b, pairs, all_bits(pairs.count));
    EXPECT_EQ(matches.meeting & matches.undecided, 0u);
    EXPECT_EQ(matches.flat & ~matches.undecided, 0u);
    for (int g = 0; g < b.facet_end(0); ++g) {
      if ((matches.meeting >> g & 1) != 0) decisions.meeting.push_back({f, g});
      if ((matches.undecided >> g & 1) != 0) decisions.undecided.push_back({f, g});
      if ((matches.flat >> g & 1) != 0) decisions.flat.push_back({f, g});
    }
  }
  return decisions;
}

std::vector<FacetPair> meeting_in_truth(const ClusteredMesh& a, const ClusteredMesh& b) {
  std::vector<FacetPair> pairs;
  PredicateCounts counts;
  for (int f = 0; f < a.facet_end(0); ++f) {
    for (int g = 0; g < b.facet_end(0); ++g) {
      if (triangle_triangle_meet(a.triangle(f), b.triangle(g), counts)) pairs.push_back({f, g});
    }
  }
  return pairs;
}

std::pair<Mesh, Mesh> bodies(int seed) {
  const auto s = static_cast<std::uint64_t>(seed);
  const auto lattice = [](std::uint64_t one) { return lattice_soup(100, 2, one); };
  if (seed % 4 == 0) return {lattice(s), lattice(s + 7)};
  if (seed % 4 == 1) return {soup(100, 1.0, s), soup(100, 1.0, s + 7)};
  if (seed % 4 == 3) return {turned(lattice(s)), turned(lattice(s + 7))};
  return {blob(1, 0.5, 0.3, s), translated(blob(1, 0.5, 0.3, s + 9), {0.3, 0.2, 0.1})};
}

void expect_right(const Kernels& kernels, const ClusteredMesh& a, const ClusteredMesh& b, Digits digits,
                  const CullPlanes& planes) {
  const Decisions decisions = decide_all(kernels, a, b, digits, planes);
  std::vector<FacetPair> decided;
  for (const FacetPair& pair : meeting_in_truth(a, b)) {
    if (!std::binary_search(decisions.undecided.begin(), decisions.undecided.end(), pair)) decided.push_back(pair);
  }
  EXPECT_EQ(decisions.meeting, decided) << kernels.name;
  for (const FacetPair& pair : decisions.flat) {
    EXPECT_TRUE(lies_in_plane(a.triangle(pair.a), b.triangle(pair.b))) << kernels.name;
  }
}

}  // namespace tact::tests
