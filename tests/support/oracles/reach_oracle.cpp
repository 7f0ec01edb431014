#include "tests/support/oracles/reach_oracle.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace tact::tests {

namespace {

using ReachPoint = Eigen::Matrix<long double, 3, 1>;
using ReachFeature = std::array<int, 3>;

// What of a mesh can be near.
struct ReachMesh {
  std::vector<ReachPoint> x;
  std::set<ReachFeature> vertices, edges;
  std::vector<ReachFeature> facets;

  explicit ReachMesh(const Mesh& mesh) {
    for (int v = 0; v < mesh.vertex_count(); ++v) x.push_back(mesh.positions.col(v).cast<long double>());
    std::set<std::set<int>> seen;
    for (int f = 0; f < mesh.facet_count(); ++f) {
      ReachFeature facet{-1, -1, -1};
      std::size_t count = 0;
      for (int k = 0; k < 3; ++k) {
        const int v = mesh.facets(k, f), next = mesh.facets((k + 1) % 3, f);
        vertices.insert({v, -1, -1});
        if (v != next) edges.insert({std::min(v, next), std::max(v, next), -1});
        if (std::ranges::find(facet, v) == facet.end()) facet[count++] = v;
      }
      if (seen.insert(std::set<int>(facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(count))).second)
        facets.push_back(facet);
    }
  }
  const ReachPoint& at(int v) const { return x[static_cast<std::size_t>(v)]; }
};

long double from_segment(const ReachPoint& v, const ReachPoint& p, const ReachPoint& q) {
  const ReachPoint along = q - p;
  const long double length = along.squaredNorm();
  const long double t = length > 0 ? std::clamp((v - p).dot(along) / length, 0.0L, 1.0L) : 0.0L;
  return (p + t * along - v).norm();
}

long double from_facet(const ReachPoint& v, const ReachMesh& mesh, const ReachFeature& facet) {
  const int count = facet[1] < 0 ? 1 : facet[2] < 0 ? 2 : 3;
  long double least = std::numeric_limits<long double>::infinity();
  for (int k = 0; k < count; ++k)
    least = std::min(least, from_segment(v, mesh.at(facet[static_cast<std::size_t>(k)]),
                                         mesh.at(facet[static_cast<std::size_t>((k + 1) % count)])));
  if (count < 3) return least;
  const ReachPoint p = mesh.at(facet[0]), e = mesh.at(facet[1]) - p, f = mesh.at(facet[2]) - p, n = e.cross(f),
                   w = v - p;
  const long double area = n.squaredNorm();
  if (!(area > 0)) return least;
  const long double s = w.cross(f).dot(n) / area, t = e.cross(w).dot(n) / area;
  return s >= 0 && t >= 0 && s + t <= 1 ? std::min(least, std::abs(w.dot(n)) / std::sqrt(area)) : least;
}

long double between_segments(const ReachPoint& p, const ReachPoint& q, const ReachPoint& r, const ReachPoint& s) {
  const long double least =
      std::min({from_segment(p, r, s), from_segment(q, r, s), from_segment(r, p, q), from_segment(s, p, q)});
  const ReachPoint u = q - p, w = s - r, n = u.cross(w), between = r - p;
  const long double area = n.squaredNorm();
  if (!(area > 0)) return least;
  const long double on_e = between.cross(w).dot(n) / area, on_f = between.cross(u).dot(n) / area;
  return on_e >= 0 && on_e <= 1 && on_f >= 0 && on_f <= 1 ? std::min(least, std::abs(between.dot(n)) / std::sqrt(area))
                                                          : least;
}

bool share_any(const ReachFeature& a, const ReachFeature& b) {
  return std::ranges::any_of(a, [&](int v) { return v >= 0 && std::ranges::find(b, v) != b.end(); });
}

// Two points are listed once: as the vertex of the first, or the lesser one.
bool comes_second(const ReachMesh& a, const ReachFeature& vertex, const ReachFeature& facet, FeaturePair kind,
                  bool same) {
  const bool are_points = facet[1] < 0 && std::ranges::find(a.facets, vertex) != a.facets.end();
  return are_points && (same ? facet[0] < vertex[0] : kind == FeaturePair::facet_vertex);
}

void add_of_vertices(const ReachMesh& a, const ReachMesh& b, FeaturePair kind, bool same, long double reach,
                     std::map<ReachKey, long double>& found) {
  for (const ReachFeature& vertex : a.vertices) {
    for (const ReachFeature& facet : b.facets) {
      if ((same && share_any(vertex, facet)) || comes_second(a, vertex, facet, kind, same)) continue;
      const long double distance = from_facet(a.at(vertex[0]), b, facet);
      if (!(distance < reach)) continue;
      found[kind == FeaturePair::vertex_facet ? ReachKey{kind, vertex, facet} : ReachKey{kind, facet, vertex}] =
          distance;
    }
  }
}

void add_of_edges(const ReachMesh& a, const ReachMesh& b, bool same, long double reach,
                  std::map<ReachKey, long double>& found) {
  for (const ReachFeature& e : a.edges) {
    for (const ReachFeature& f : b.edges) {
      if (same && (!(e < f) || share_any(e, f))) continue;
      const long double distance = between_segments(a.at(e[0]), a.at(e[1]), b.at(f[0]), b.at(f[1]));
      if (distance < reach) found[{FeaturePair::edge_edge, e, f}] = distance;
    }
  }
}

}  // namespace

std::map<ReachKey, long double> pairs_within_reach(const Mesh& a, const Mesh& b, double reach) {
  const ReachMesh of_a(a), of_b(b);
  std::map<ReachKey, long double> found;
  add_of_vertices(of_a, of_b, FeaturePair::vertex_facet, false, reach, found);
  add_of_vertices(of_b, of_a, FeaturePair::facet_vertex, false, reach, found);
  add_of_edges(of_a, of_b, false, reach, found);
  return found;
}

std::map<ReachKey, long double> own_pairs_within_reach(const Mesh& mesh, double reach) {
  const ReachMesh own(mesh);
  std::map<ReachKey, long double> found;
  add_of_vertices(own, own, FeaturePair::vertex_facet, true, reach, found);
  add_of_edges(own, own, true, reach, found);
  return found;
}

}  // namespace tact::tests
