#include "narrowphase/crossing/edge_hits.h"

#include <algorithm>
#include <bit>

#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

namespace {

Triangle triangle_of(const FeaturedMesh& m, int facet) {
  const Corners& c = m.features->corners(facet);
  return {m.mesh->position(c[0]), m.mesh->position(c[1]), m.mesh->position(c[2])};
}

Triangle triangle_in(const TrianglePairs& pairs, int mesh, int pair) {
  Triangle triangle;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& at = pairs.corner[mesh][k];
    triangle[k] = {at[0][pair], at[1][pair], at[2][pair]};
  }
  return triangle;
}

void set_corners(const Triangle& triangle, int mesh, TrianglePairs& pairs) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) pairs.corner[mesh][k][axis][pairs.count] = triangle[k][axis];
  }
}

bool meets(const TrianglePairs& pairs, int mesh, int k, int pair, PredicateCounts& counts) {
  const Triangle own = triangle_in(pairs, mesh, pair);
  return segment_triangle_meet({own[k], own[(k + 1) % 3]}, triangle_in(pairs, 1 - mesh, pair), counts);
}

void sort_once_each(std::vector<EdgeHit>& hits) {
  std::ranges::sort(hits);
  hits.erase(std::unique(hits.begin(), hits.end()), hits.end());
}

}  // namespace

void EdgeHitSearch::run(const FeaturedMesh& a, const FeaturedMesh& b, std::span<const FacetPair> pairs,
                        std::vector<EdgeHit>& of_a, std::vector<EdgeHit>& of_b) {
  of_a.clear();
  of_b.clear();
  triangles_.count = 0;
  int facet_a = -1;
  Triangle triangle_a;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i == 0 || pairs[i].a != pairs[i - 1].a) {
      facet_a = a.mesh->facet_of_source(pairs[i].a);
      triangle_a = triangle_of(a, facet_a);
    }
    const int facet_b = b.mesh->facet_of_source(pairs[i].b);
    set_corners(triangle_a, 0, triangles_);
    set_corners(triangle_of(b, facet_b), 1, triangles_);
    met_[triangles_.count++] = {{facet_a, facet_b}, pairs[i]};
    if (triangles_.count == TrianglePairs::kCapacity) decide(a, b, of_a, of_b);
  }
  decide(a, b, of_a, of_b);
  sort_once_each(of_a);
  if (&of_a != &of_b) sort_once_each(of_b);
}

void EdgeHitSearch::decide(const FeaturedMesh& a, const FeaturedMesh& b, std::vector<EdgeHit>& of_a,
                           std::vector<EdgeHit>& of_b) {
  const EdgesThrough through = kernels().edges_through(triangles_);
  // Of two meshes all facets that meet are known, so the first facet with an edge tells the same as each other one. Of
  // one mesh the pairs of facets that share a vertex are missing.
  const bool first_tells = a.mesh != b.mesh;
  for (int edge = 0; edge < 6; ++edge) {
    const int mesh = edge / 3, k = edge % 3;
    const FeaturedMesh& own = mesh == 0 ? a : b;
    std::vector<EdgeHit>& hits = mesh == 0 ? of_a : of_b;
    for (std::uint64_t left = through.meeting[edge] | through.undecided[edge]; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left), facet = met_[i].facet[mesh];
      if (first_tells && (own.features->firsts_of_facet(facet) >> k & 1) == 0) continue;
      const int own_edge = own.features->facet_edge(facet, k);
      if (own_edge < 0) continue;
      if ((through.undecided[edge] >> i & 1) != 0 && !meets(triangles_, mesh, k, i, counts_)) continue;
      const EdgeVertices ends = own.features->edge(own_edge);
      hits.push_back({{own.mesh->source_vertex(ends[0]), own.mesh->source_vertex(ends[1])},
                      mesh == 0 ? met_[i].source.b : met_[i].source.a,
                      own_edge});
    }
  }
  triangles_.count = 0;
}

}  // namespace tact::narrowphase
