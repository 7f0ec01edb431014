// The features of two open clusters that may be near each other: a walk that finders share.
#pragma once

#include <algorithm>
#include <bit>

#include "engine/base/lowest_bits.h"
#include "narrowphase/contact_points/feature_point.h"
#include "narrowphase/contact_points/open_features.h"

namespace tact::narrowphase {

/// The facets of a cluster that are near another one, and the cells that they reach.
struct NearFacets {
  std::uint64_t facets = 0;
  CellBox cells;
};

inline NearFacets near_facets(const OpenFeatures& one, const CellBox& other) {
  NearFacets near;
  near.facets = kernels().near_facets(one.facets.cells, base::lowest_bits(one.facets.count), other);
  if (near.facets != 0) near.cells = kernels().cells_of(one.facets.cells, near.facets);
  return near;
}

inline Vec3 point_of(const ClusterPoints& points, int i) { return {points.at[0][i], points.at[1][i], points.at[2][i]}; }

/// Edges of two clusters, by blocks, that have a bit; or of one and itself.
struct EdgeBlocks {
  const FeatureBlock &a, &b;
  PlacedFeatures of_a, of_b;
  bool of_one_cluster;
};

/// Which features of a block have each vertex of their cluster.
class FeaturesAtVertices {
 public:
  /// Of those that have a bit, with so many corners each.
  FeaturesAtVertices(const FeatureBlock& block, int corners, std::uint64_t some) {
    std::fill_n(with_vertex_, ClusterPoints::kMost, 0);
    for (; some != 0; some &= some - 1) {
      const int k = std::countr_zero(some);
      for (int c = 0; c < corners; ++c) with_vertex_[block.corner[c][k]] |= some & -some;
    }
  }
  std::uint64_t operator[](std::uint8_t vertex) const { return with_vertex_[vertex]; }

 private:
  std::uint64_t with_vertex_[ClusterPoints::kMost];
};

/// A mask for each feature of a block: those of another block that it is not held against.
struct LeftOut {
  std::uint64_t of[FeatureBlock::kCapacity];
};

/// Of edges of one cluster, opened twice: for each of `few` those of `many` that share a vertex with it, and those that
/// come before it, or after it: each pair is looked at once. Edges of a block ascend.
inline void leave_out_edges(const FeatureBlock& few, const FeatureBlock& many, bool few_are_first, LeftOut& left_out) {
  const FeaturesAtVertices at(many, 2, base::lowest_bits(many.count));
  for (int i = 0, k = 0; i < few.count; ++i) {
    const int last = few.feature[i] - (few_are_first ? 0 : 1);
    while (k < many.count && many.feature[k] <= last) ++k;
    const std::uint64_t before = base::lowest_bits(k);
    left_out.of[i] = at[few.corner[0][i]] | at[few.corner[1][i]] | (few_are_first ? before : ~before);
  }
}

/// Calls between(edges) for the blocks of edges of two clusters that may be near each other; of one cluster for each
/// two blocks once.
template <class Between>
void for_near_edges(const OpenFeatures& a, const NearFacets& near_a, const OpenFeatures& b, const NearFacets& near_b,
                    bool of_one_cluster, const Between& between) {
  std::uint64_t some_b[OpenFeatures::kMostBlocks];
  for (int k = 0; k < b.edge_blocks; ++k)
    some_b[k] = kernels().near_facets(b.edges[k].cells, base::lowest_bits(b.edges[k].count), near_a.cells);
  for (int i = 0; i < a.edge_blocks; ++i) {
    const std::uint64_t some_a =
        kernels().near_facets(a.edges[i].cells, base::lowest_bits(a.edges[i].count), near_b.cells);
    for (int k = 0; some_a != 0 && k < b.edge_blocks; ++k)
      between(EdgeBlocks{
          a.edges[i], b.edges[k], {a.points, a.edges[i], some_a}, {b.points, b.edges[k], some_b[k]}, of_one_cluster});
  }
}

/// Calls visit(edge of a, edge of b) for those of which near_edges, a kernel, finds that they may be near.
template <class Kernel, class Visit>
void for_edges_between(const EdgeBlocks& edges, const Kernel& near_edges, double reach, const Visit& visit) {
  const bool few_are_a = std::popcount(edges.of_a.some) <= std::popcount(edges.of_b.some);
  const PlacedFeatures &few = few_are_a ? edges.of_a : edges.of_b, &many = few_are_a ? edges.of_b : edges.of_a;
  std::uint64_t met[FeatureBlock::kCapacity];
  LeftOut left_out;
  if (edges.of_one_cluster) leave_out_edges(few.block, many.block, few_are_a, left_out);
  std::uint64_t left = near_edges(few, many, reach, edges.of_one_cluster ? left_out.of : nullptr, met);
  for (; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    for (std::uint64_t rest = met[i]; rest != 0; rest &= rest - 1) {
      const int k = std::countr_zero(rest), e = few_are_a ? i : k, f = few_are_a ? k : i;
      visit(edges.a.feature[e], edges.b.feature[f]);
    }
  }
}

/// Calls from_vertices(one, other, facets of other that are near, kind) and between(edges) for all that may be near of
/// two clusters, or of one and itself; of one mesh, if `same`.
template <class FromVertices, class Between>
void for_near_features(const OpenFeatures& a, const OpenFeatures& b, bool same, const FromVertices& from_vertices,
                       const Between& between) {
  if (a.facets.count == 0 || b.facets.count == 0) return;
  const NearFacets near_a = near_facets(a, b.cells), near_b = near_facets(b, a.cells);
  if (near_a.facets == 0 || near_b.facets == 0) return;
  from_vertices(a, b, near_b, FeaturePair::vertex_facet);
  if (!same) from_vertices(b, a, near_a, FeaturePair::facet_vertex);
  if (same && a.cluster != b.cluster) from_vertices(b, a, near_a, FeaturePair::vertex_facet);
  for_near_edges(a, near_a, b, near_b, same && a.cluster == b.cluster, between);
}

/// Calls visit(place of the vertex in its block, place of the facet in its own, whether a point may be inside) for
/// those of some vertices and facets that may be nearer than `reach`. Facets `without_corners` are not held against
/// their own corners, which are numbered as these are.
template <class Visit>
void for_near_vertices(const PlacedFeatures& vertices, const PlacedFeatures& facets, std::uint64_t without_corners,
                       double reach, const Visit& visit) {
  std::uint64_t met[FeatureBlock::kCapacity], inside[FeatureBlock::kCapacity];
  LeftOut left_out;
  if (without_corners != 0) {
    const FeaturesAtVertices at(facets.block, 3, without_corners);
    for (int i = 0; i < vertices.block.count; ++i) left_out.of[i] = at[vertices.block.corner[0][i]];
  }
  std::uint64_t left =
      kernels().near_vertices(vertices, facets, reach, without_corners != 0 ? left_out.of : nullptr, met, inside);
  for (; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    for (std::uint64_t rest = met[i]; rest != 0; rest &= rest - 1) {
      const int k = std::countr_zero(rest);
      visit(i, k, (inside[i] >> k & 1) != 0);
    }
  }
}

}  // namespace tact::narrowphase
