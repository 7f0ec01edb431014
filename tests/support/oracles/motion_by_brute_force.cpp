#include "tests/support/oracles/motion_by_brute_force.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "engine/base/box.h"
#include "narrowphase/motion/meeting.h"
#include "tests/support/oracles/point_oracle.h"

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

using Long3 = Eigen::Matrix<long double, 3, 1>;

// A mesh at a time.
class MeshAtTime {
 public:
  MeshAtTime(const MovingMesh& mesh, double time) : mesh_{mesh.begin} {
    mesh_.positions += time * (mesh.end - mesh.begin.positions);
  }

  bool is_contact(const ImpactKey& key, double reach) const {
    const auto& [kind, a, b] = key;
    if (kind == FeaturePair::edge_edge) return edges_are({a[0], a[1]}, {b[0], b[1]}, reach);
    const Long3 v = at(a[0]);
    const Place place = nearest(v, b);
    return !any_leads_nearer(place.feature, v, place.distance) && !are_near_along(a, v, place.feature, place.at, reach);
  }

 private:
  struct Place {
    Long3 at;
    std::array<int, 3> feature{-1, -1, -1};
    long double distance = std::numeric_limits<long double>::infinity();
  };

  Long3 at(int v) const { return mesh_.positions.col(v).cast<long double>(); }

  Place nearest(const Long3& v, const std::array<int, 3>& facet) const {
    Place best;
    const auto take = [&](const Long3& place, const std::array<int, 3>& feature) {
      const long double distance = (place - v).norm();
      if (distance < best.distance) best = {place, feature, distance};
    };
    for (const int c : facet) take(at(c), {c, -1, -1});
    for (std::size_t k = 0; k < 3; ++k) {
      const int p = facet[k], q = facet[(k + 1) % 3];
      const Long3 side = at(q) - at(p);
      const long double place = (v - at(p)).dot(side) / side.squaredNorm();
      if (place > 0 && place < 1) take(at(p) + place * side, {p, q, -1});
    }
    const Long3 e = at(facet[1]) - at(facet[0]), f = at(facet[2]) - at(facet[0]), n = e.cross(f);
    const Long3 foot = v - n * (v - at(facet[0])).dot(n) / n.squaredNorm();
    const auto is_inside = [&](std::size_t k) {
      const Long3 p = at(facet[k]), side = at(facet[(k + 1) % 3]) - p;
      return side.cross(foot - p).dot(n) > 0;
    };
    if (n.norm() > 0 && is_inside(0) && is_inside(1) && is_inside(2)) take(foot, facet);
    return best;
  }

  // A facet that holds the feature and comes nearer to a point.
  bool any_leads_nearer(const std::array<int, 3>& feature, const Long3& from, long double distance) const {
    for (int f = 0; f < mesh_.facet_count(); ++f) {
      const std::array<int, 3> c{mesh_.facets(0, f), mesh_.facets(1, f), mesh_.facets(2, f)};
      const auto is_in = [&](int v) { return v < 0 || std::ranges::find(c, v) != c.end(); };
      if (!std::ranges::all_of(feature, is_in)) continue;
      if (nearest(from, c).distance < distance * (1 - 1e-13L)) return true;
    }
    return false;
  }

  bool are_near_along(const std::array<int, 3>& a, const Long3& on_a, const std::array<int, 3>& b, const Long3& on_b,
                      double reach) const {
    const auto vec3 = [](const Long3& p) { return Vec3{double(p.x()), double(p.y()), double(p.z())}; };
    return way_along_edges(mesh_, a, vec3(on_a), b, vec3(on_b)) < 0.5L * std::numbers::pi_v<long double> * reach;
  }

  bool edges_are(const std::array<int, 2>& e, const std::array<int, 2>& f, double reach) const {
    const Long3 p = at(e[0]), u = at(e[1]) - p, r = at(f[0]), w = at(f[1]) - r, n = u.cross(w);
    const long double s = (r - p).cross(w).dot(n) / n.squaredNorm(), t = (r - p).cross(u).dot(n) / n.squaredNorm();
    if (!(s > 0 && s < 1 && t > 0 && t < 1)) return false;
    const Long3 on_e = p + s * u, on_f = r + t * w;
    const std::array<int, 3> of_e{e[0], e[1], -1}, of_f{f[0], f[1], -1};
    const long double distance = (on_f - on_e).norm();
    return !any_leads_nearer(of_e, on_f, distance) && !any_leads_nearer(of_f, on_e, distance) &&
           !are_near_along(of_e, on_e, of_f, on_f, reach);
  }

  Mesh mesh_;
};

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
        add({kind, vertex_is_a ? one : c, vertex_is_a ? c : one}, narrowphase::facet_seen_from(vertex, facet),
            same ? &m : nullptr);
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
                                        {way_of_vertex(b, f[0]), way_of_vertex(b, f[1])}),
            same ? &a : nullptr);
      }
    }
  }

  std::map<ImpactKey, double> found;

 private:
  // `itself`: the mesh that both features are of.
  void add(const ImpactKey& key, const narrowphase::MovingPolygon& polygon, const MovingMesh* itself) {
    double time = search_.first(polygon, reach_).time;
    if (itself != nullptr && reach_ > 0.0 && time <= 1.0 && !MeshAtTime(*itself, time).is_contact(key, reach_))
      time = search_.first(polygon, 0.0).time;
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
