#include "tests/support/oracles/point_oracle.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace tact::tests {

namespace {

using Long3 = Eigen::Matrix<long double, 3, 1>;
using VertexPair = std::pair<int, int>;

using FeatureBox = Eigen::AlignedBox3d;

struct LongMesh {
  std::vector<Long3> x;
  std::vector<FeatureBox> boxes;  // of each vertex, in doubles
  std::vector<std::array<int, 3>> facets;
  std::map<VertexPair, std::vector<int>> edges;  // with the third vertices
  std::map<int, std::set<int>> vertices;         // with their neighbours
};

LongMesh long_mesh(const Mesh& mesh) {
  LongMesh s;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    s.x.push_back(mesh.positions.col(v).cast<long double>());
    s.boxes.emplace_back(Eigen::Vector3d(mesh.positions.col(v)));
  }
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const std::array<int, 3> c{mesh.facets(0, f), mesh.facets(1, f), mesh.facets(2, f)};
    s.facets.push_back(c);
    for (std::size_t k = 0; k < 3; ++k) {
      const int p = c[k], q = c[(k + 1) % 3];
      s.vertices[p];
      if (p == q) continue;
      s.edges[std::minmax(p, q)].push_back(c[(k + 2) % 3]);
      s.vertices[p].insert(q);
      s.vertices[q].insert(p);
    }
  }
  return s;
}

// From the edge p q straight to the third vertex.
Long3 across_edge(const Long3& p, const Long3& q, const Long3& third) {
  const Long3 along = (q - p).normalized();
  return (third - p) - (third - p).dot(along) * along;
}

// How far v lies from the edge p q on the side of the third vertex; nothing where these are in line.
long double beside(const Long3& v, const Long3& p, const Long3& q, const Long3& third) {
  const Long3 across = across_edge(p, q, third);
  return across.norm() > 0 ? (v - p).dot(across.normalized()) : 0.0L;
}

Vec3 to_vec3(const Long3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

// Collects what has to be positive, and how near to zero it is.
struct Conditions {
  long double least = std::numeric_limits<long double>::infinity();
  void positive(long double value) { least = std::min(least, value); }
  void at_most_zero(long double value) { positive(-value); }
};

class PointOracle {
 public:
  PointOracle(const Mesh& a, const Mesh& b, double reach, double band)
      : a_(long_mesh(a)), b_(long_mesh(b)), reach_(reach), band_(band) {}

  std::map<PointKey, ExpectedPoint> run() {
    for (const auto& [v, _] : a_.vertices) from_vertex(a_, v, b_, FeaturePair::vertex_facet);
    for (const auto& [v, _] : b_.vertices) from_vertex(b_, v, a_, FeaturePair::facet_vertex);
    for (const auto& [e, third_e] : a_.edges) {
      const FeatureBox near = within_reach(a_, {e.first, e.second});
      for (const auto& [f, third_f] : b_.edges) {
        if (near.intersects(box_of(b_, {f.first, f.second}))) between(e, third_e, f, third_f);
      }
    }
    return std::move(found_);
  }

 private:
  static const Long3& at(const LongMesh& s, int v) { return s.x[v]; }
  static FeatureBox box_of(const LongMesh& s, std::initializer_list<int> vertices) {
    FeatureBox box;
    for (const int v : vertices) box.extend(s.boxes[v]);
    return box;
  }
  // What does not meet this box is too far away for a point with the feature of these vertices. Without it, a processor
  // that has no long double takes minutes for bodies of a thousand facets.
  FeatureBox within_reach(const LongMesh& s, std::initializer_list<int> vertices) const {
    const FeatureBox box = box_of(s, vertices);
    const double rounding = 1e-15 * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    const double margin = static_cast<double>(1.001L * reach_ + 10 * band_) + rounding;
    return {box.min().array() - margin, box.max().array() + margin};
  }

  void add(FeaturePair kind, std::array<int, 3> a, std::array<int, 3> b, const Long3& p, const Long3& q,
           Conditions conditions) {
    const long double gap = (q - p).norm();
    conditions.positive(reach_ - gap);
    if (conditions.least < -band_) return;
    found_[{kind, a, b}] = {to_vec3(p), to_vec3(q), static_cast<double>(gap), conditions.least > band_};
  }

  void add_vertex(FeaturePair kind, int vertex, const Long3& v, std::array<int, 3> feature, const Long3& p,
                  const Conditions& conditions) {
    const std::array<int, 3> own{vertex, -1, -1};
    if (kind == FeaturePair::vertex_facet) {
      add(kind, own, feature, v, p, conditions);
    } else {
      add(kind, feature, own, p, v, conditions);
    }
  }

  void from_vertex(const LongMesh& own, int vertex, const LongMesh& s, FeaturePair kind) {
    const Long3& v = own.x[vertex];
    const FeatureBox near = within_reach(own, {vertex});
    for (const auto& c : s.facets) {
      if (!near.intersects(box_of(s, {c[0], c[1], c[2]}))) continue;
      const Long3 p = at(s, c[0]), q = at(s, c[1]), r = at(s, c[2]), normal = (q - p).cross(r - p);
      if (!(normal.norm() > 0)) continue;
      Conditions inside;
      inside.positive(beside(v, p, q, r));
      inside.positive(beside(v, q, r, p));
      inside.positive(beside(v, r, p, q));
      // In line but for rounding: who knows where it faces?
      if (!(normal.norm() > band_ * std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()}))) inside.positive(0);
      const Long3 unit = normal.normalized();
      add_vertex(kind, vertex, v, c, v - unit.dot(v - p) * unit, inside);
    }
    for (const auto& [edge, third] : s.edges) {
      if (!near.intersects(box_of(s, {edge.first, edge.second}))) continue;
      const Long3 p = at(s, edge.first), q = at(s, edge.second);
      const long double length = (q - p).norm();
      if (!(length > 0)) continue;
      const Long3 along = (q - p) / length;
      const long double place = (v - p).dot(along);
      Conditions inside;
      inside.positive(place);
      inside.positive(length - place);
      for (const int t : third) {
        const long double width = across_edge(p, q, at(s, t)).norm();
        if (width > band_) inside.at_most_zero(beside(v, p, q, at(s, t)));
        // In line but for rounding: who knows on which side the facet lies?
        else if (width > 0)
          inside.positive(0);
      }
      add_vertex(kind, vertex, v, {edge.first, edge.second, -1}, p + place * along, inside);
    }
    for (const auto& [w, neighbors] : s.vertices) {
      if (!near.intersects(s.boxes[w])) continue;
      Conditions minimum;
      for (const int u : neighbors) {
        const Long3 way = at(s, u) - at(s, w);
        if (way.norm() > 0) minimum.at_most_zero((v - at(s, w)).dot(way.normalized()));
      }
      add_vertex(kind, vertex, v, {w, -1, -1}, at(s, w), minimum);
    }
  }

  void between(const VertexPair& e, const std::vector<int>& third_e, const VertexPair& f,
               const std::vector<int>& third_f) {
    const Long3 p = at(a_, e.first), u = at(a_, e.second) - p, r = at(b_, f.first), w = at(b_, f.second) - r;
    const Long3 across = u.cross(w);
    const long double square = across.squaredNorm();
    if (!(square > 0)) return;
    const long double s = (r - p).cross(w).dot(across) / square;
    // The foot of the place on e: where edges are nearly parallel, places that are rounded one by one lie apart.
    const long double t = (p + s * u - r).dot(w) / w.squaredNorm();
    Conditions inside;
    inside.positive(s * u.norm());
    inside.positive((1 - s) * u.norm());
    inside.positive(t * w.norm());
    inside.positive((1 - t) * w.norm());
    const Long3 on_e = p + s * u, on_f = r + t * w;
    const long double height = across.dot(r - p);
    // Edges that touch have no side yet: either will do, and neither is certain.
    const bool touch = std::abs(height) <= band_ * across.norm();
    Conditions best;
    best.positive(-1);
    for (const Long3& side : {across, Long3(-across)}) {
      if (!touch && side.dot(r - p) < 0) continue;
      const Long3 normal = side.normalized();
      Conditions minimum = inside;
      for (const int c : third_e) minimum.at_most_zero(normal.dot(at(a_, c) - p));
      for (const int c : third_f) minimum.at_most_zero(-normal.dot(at(b_, c) - r));
      if (minimum.least > best.least) best = minimum;
    }
    if (touch) best.positive(0);
    // The common normal of edges with such a sine is wrong by more than the band: they may have a point or none.
    if (square < 1e-14L * u.squaredNorm() * w.squaredNorm()) best.least = 0;
    add(FeaturePair::edge_edge, {e.first, e.second, -1}, {f.first, f.second, -1}, on_e, on_f, best);
  }

  LongMesh a_, b_;
  long double reach_, band_;
  std::map<PointKey, ExpectedPoint> found_;
};

}  // namespace

std::map<PointKey, ExpectedPoint> points_by_brute_force(const Mesh& a, const Mesh& b, double reach, double band) {
  return PointOracle(a, b, reach, band).run();
}

namespace {

struct LongEdge {
  int p, q;
  long double length;
};

std::vector<LongEdge> long_edges(const LongMesh& s) {
  std::vector<LongEdge> edges;
  for (const auto& [edge, _] : s.edges)
    edges.push_back({edge.first, edge.second, (s.x[edge.first] - s.x[edge.second]).norm()});
  return edges;
}

// How far it is from one point along edges to another, from and to vertices of the features that hold them: by
// relaxing all edges until nothing changes (Bellman, 1958; Ford, 1956). What is beyond the limit may come out longer.
long double way_along_edges(const LongMesh& s, const std::vector<LongEdge>& edges, const std::array<int, 3>& from,
                            const Vec3& from_point, const std::array<int, 3>& to, const Vec3& to_point,
                            long double limit) {
  constexpr long double kFar = std::numeric_limits<long double>::infinity();
  const auto distance = [&](const Vec3& p, int v) { return (Long3(p.x, p.y, p.z) - s.x[v]).norm(); };
  std::vector<long double> way(s.x.size(), kFar);
  for (const int v : from) {
    if (v >= 0) way[v] = distance(from_point, v);
  }
  for (bool changes = true; changes;) {
    changes = false;
    for (const auto& [p, q, length] : edges) {
      for (const auto& [one, other] : {std::pair(p, q), std::pair(q, p)}) {
        if (way[one] <= limit && way[one] + length < way[other]) {
          way[other] = way[one] + length;
          changes = true;
        }
      }
    }
  }
  long double best = kFar;
  for (const int v : to) {
    if (v >= 0) best = std::min(best, way[v] + distance(to_point, v));
  }
  return best;
}

}  // namespace

long double way_along_edges(const Mesh& mesh, const std::array<int, 3>& from, Vec3 from_point,
                            const std::array<int, 3>& to, Vec3 to_point) {
  const LongMesh s = long_mesh(mesh);
  return way_along_edges(s, long_edges(s), from, from_point, to, to_point,
                         std::numeric_limits<long double>::infinity());
}

std::map<PointKey, ExpectedPoint> self_points_by_brute_force(const Mesh& mesh, double reach, double band) {
  const LongMesh s = long_mesh(mesh);
  const std::vector<LongEdge> edges = long_edges(s);
  const long double least_way = 0.5L * std::numbers::pi_v<long double> * reach;
  std::map<PointKey, ExpectedPoint> points;
  for (auto [key, point] : points_by_brute_force(mesh, mesh, reach, band)) {
    const auto& [kind, a, b] = key;
    const auto in_b = [&b = b](int v) { return v >= 0 && std::ranges::find(b, v) != b.end(); };
    const bool share = std::ranges::any_of(a, in_b);
    if (share || kind == FeaturePair::facet_vertex || (kind == FeaturePair::edge_edge && b < a)) continue;
    const long double way = way_along_edges(s, edges, a, point.a, b, point.b, least_way + band);
    if (way < least_way - band) continue;
    point.certain = point.certain && way > least_way + band;
    points[key] = point;
  }
  return points;
}

}  // namespace tact::tests
