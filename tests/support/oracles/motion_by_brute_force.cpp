#include "tests/support/oracles/motion_by_brute_force.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "engine/base/box.h"
#include "narrowphase/motion/meeting.h"

namespace tact::tests {
namespace {

using base::Box;
using narrowphase::MovingVertex;

MovingVertex way_of_vertex(const MovingMesh& mesh, int v) {
  return {{mesh.begin.position(v), {mesh.end(0, v), mesh.end(1, v), mesh.end(2, v)}}};
}

Box box_of_ways(const MovingMesh& mesh, std::span<const int> vertices) {
  Box box;
  for (const int v : vertices) {
    for (const Vec3& p : way_of_vertex(mesh, v).at) box = extended(box, p);
  }
  return box;
}

std::vector<std::array<int, 2>> edges_of(const Mesh& mesh) {
  std::set<std::array<int, 2>> edges;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.facets(k, f), w = mesh.facets((k + 1) % 3, f);
      if (v != w) edges.insert({std::min(v, w), std::max(v, w)});
    }
  }
  return {edges.begin(), edges.end()};
}

class BruteForce {
 public:
  explicit BruteForce(double reach) : reach_(reach) {}

  // The vertices that facets use, with the facets of another mesh.
  void vertices_with_facets(const MovingMesh& m, const MovingMesh& surface, bool vertex_is_a, bool same) {
    const auto used = m.begin.facets.reshaped();
    const std::set<int> vertices(used.begin(), used.end());
    for (int f = 0; f < surface.begin.facet_count(); ++f) {
      const std::array<int, 3> c{surface.begin.facets(0, f), surface.begin.facets(1, f), surface.begin.facets(2, f)};
      const Box box = grown(box_of_ways(surface, c), reach_);
      const MovingVertex facet[3] = {way_of_vertex(surface, c[0]), way_of_vertex(surface, c[1]),
                                     way_of_vertex(surface, c[2])};
      for (const int v : vertices) {
        if (same && (c[0] == v || c[1] == v || c[2] == v)) continue;
        const MovingVertex vertex = way_of_vertex(m, v);
        if (!overlaps(box, box_of_ways(m, {&v, 1}))) continue;
        const std::array<int, 3> one{v, -1, -1};
        const auto kind = vertex_is_a ? FeaturePair::vertex_facet : FeaturePair::facet_vertex;
        add({kind, vertex_is_a ? one : c, vertex_is_a ? c : one}, narrowphase::facet_seen_from(vertex, facet));
      }
    }
  }

  void edges_with_edges(const MovingMesh& a, const MovingMesh& b, bool same) {
    const auto edges_a = edges_of(a.begin), edges_b = edges_of(b.begin);
    for (const auto& e : edges_a) {
      const Box box = grown(box_of_ways(a, e), reach_);
      for (const auto& f : edges_b) {
        if (same && (f <= e || e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1])) continue;
        if (!overlaps(box, box_of_ways(b, f))) continue;
        add({FeaturePair::edge_edge, {e[0], e[1], -1}, {f[0], f[1], -1}},
            narrowphase::edge_seen_from({way_of_vertex(a, e[0]), way_of_vertex(a, e[1])},
                                        {way_of_vertex(b, f[0]), way_of_vertex(b, f[1])}));
      }
    }
  }

  std::map<ImpactKey, double> found;

 private:
  void add(const ImpactKey& key, const narrowphase::MovingPolygon& polygon) {
    const double time = search_.first(polygon, reach_).time;
    if (time <= 1.0) found[key] = time;
  }

  double reach_;
  narrowphase::MeetingSearch search_;
};

}  // namespace

std::map<ImpactKey, double> impacts_by_brute_force(const MovingMesh& a, const MovingMesh& b, double reach) {
  BruteForce search(reach);
  search.vertices_with_facets(a, b, true, false);
  search.vertices_with_facets(b, a, false, false);
  search.edges_with_edges(a, b, false);
  return std::move(search.found);
}

std::map<ImpactKey, double> self_impacts_by_brute_force(const MovingMesh& mesh, double reach) {
  BruteForce search(reach);
  search.vertices_with_facets(mesh, mesh, true, true);
  search.edges_with_edges(mesh, mesh, true);
  return std::move(search.found);
}

}  // namespace tact::tests
