#include "narrowphase/contact_points/local_minimum.h"

#include <algorithm>
#include <cmath>

namespace tact::narrowphase {

namespace {

// Coordinates are off by 2^-53 of themselves, and are at most some 2^20 times as long as edges.
constexpr double kLevel = 0x1p-30;

// At least the length, at most the root of 3 times it.
double size_of(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// Whether a way of a surface leads along n, a unit vector, by more than a part of its length.
bool leads_along(Vec3 way, Vec3 n, double level) { return dot(way, n) > level * size_of(way); }

bool is_highest(const FeaturedMesh& m, int vertex, Vec3 n, double level) {
  const Vec3 at = m.mesh->position(vertex);
  return std::ranges::none_of(m.features->neighbors(vertex),
                              [&](int neighbor) { return leads_along(m.mesh->position(neighbor) - at, n, level); });
}

bool is_ridge(const FeaturedMesh& m, int edge, Vec3 n) {
  const Vec3 at = m.mesh->position(m.features->edge(edge)[0]);
  return std::ranges::none_of(m.features->opposite(edge),
                              [&](int third) { return leads_along(m.mesh->position(third) - at, n, kLevel); });
}

// The normal from a vertex to the inside of an edge is a difference of two ways: it is off by roundings of the edge's
// length, however short it is itself.
double level_beside_edge(const FeaturedMesh& m, const std::array<int, 3>& edge, double gap) {
  const auto at = [&](std::size_t k) { return m.mesh->position(m.features->vertex_of_source(edge[k])); };
  return gap == 0.0 ? kLevel : kLevel + 0x1p-50 * size_of(at(1) - at(0)) / std::abs(gap);
}

// Of a vertex of `own`, along n.
bool is_minimum_of_vertex(const FeaturedMesh& own, int source_vertex, const FeaturedMesh& other,
                          const std::array<int, 3>& feature, Vec3 n, double gap) {
  const bool is_edge = feature[1] >= 0 && feature[2] < 0;
  return is_highest(own, own.features->vertex_of_source(source_vertex), n,
                    is_edge ? level_beside_edge(other, feature, gap) : kLevel);
}

}  // namespace

bool is_local_minimum(const FeaturePoint& point, const FeaturedMesh& a, const FeaturedMesh& b) {
  const Vec3 n = point.normal;
  const auto of_vertex = [&](const FeaturedMesh& m, const std::array<int, 3>& vertex, Vec3 towards) {
    return is_highest(m, m.features->vertex_of_source(vertex[0]), towards, kLevel);
  };
  switch (point.kind) {
    case FeaturePair::vertex_facet:
    case FeaturePair::vertex_edge: return is_minimum_of_vertex(a, point.a[0], b, point.b, n, point.gap);
    case FeaturePair::facet_vertex:
    case FeaturePair::edge_vertex: return is_minimum_of_vertex(b, point.b[0], a, point.a, -n, point.gap);
    case FeaturePair::vertex_vertex: return of_vertex(a, point.a, n) && of_vertex(b, point.b, -n);
    case FeaturePair::vertex_plane: return of_vertex(a, point.a, n);
    case FeaturePair::plane_vertex: return of_vertex(b, point.b, -n);
    case FeaturePair::edge_edge: break;
  }
  return point.gap > 0.0 || (is_ridge(a, point.edge_a, n) && is_ridge(b, point.edge_b, -n));
}

}  // namespace tact::narrowphase
