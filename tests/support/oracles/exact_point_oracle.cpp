#include "tests/support/oracles/exact_point_oracle.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "engine/base/box.h"

namespace tact::tests {

namespace {

using Rational = CGAL::Exact_rational;
using VertexPair = std::pair<int, int>;

struct Vec {
  Rational x, y, z;
};
Vec operator-(const Vec& p, const Vec& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Vec operator-(const Vec& p) { return {-p.x, -p.y, -p.z}; }
Vec operator*(const Rational& s, const Vec& p) { return {s * p.x, s * p.y, s * p.z}; }
Rational dot(const Vec& p, const Vec& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
Vec cross(const Vec& p, const Vec& q) { return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x}; }

struct ExactMesh {
  std::vector<Vec> x;
  std::vector<Vec3> rounded;  // the same
  std::vector<std::array<int, 3>> facets;
  std::map<VertexPair, std::vector<int>> edges;  // with the third vertices
  std::map<int, std::set<int>> vertices;         // with their neighbours
};

ExactMesh exact_mesh(const Mesh& mesh) {
  ExactMesh s;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.position(v);
    s.rounded.push_back(p);
    s.x.push_back({Rational(p.x), Rational(p.y), Rational(p.z)});
  }
  std::set<std::array<int, 3>> seen;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const std::array<int, 3> c{mesh.facets(0, f), mesh.facets(1, f), mesh.facets(2, f)};
    std::array<int, 3> sorted = c;
    std::ranges::sort(sorted);
    if (seen.insert(sorted).second) s.facets.push_back(c);
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

// What has to hold for a point. Each condition is on a number of metres times a length whose square is given.
class Conditions {
 public:
  explicit Conditions(double band) : band_squared_(Rational(band) * Rational(band)) {}

  void positive(const Rational& value, const Rational& length_squared) {
    look_at(value, length_squared, CGAL::sign(value) == CGAL::POSITIVE);
  }
  void at_most_zero(const Rational& value, const Rational& length_squared) {
    look_at(value, length_squared, CGAL::sign(value) != CGAL::POSITIVE);
  }
  void uncertain() { certain_ = certain_ && band_squared_ == 0; }
  bool holds() const { return holds_; }
  bool certain() const { return certain_; }
  bool nearly_holds() const { return nearly_holds_; }

 private:
  void look_at(const Rational& value, const Rational& length_squared, bool holds) {
    const bool is_near = value * value <= band_squared_ * length_squared;
    holds_ = holds_ && holds;
    nearly_holds_ = nearly_holds_ && (holds || is_near);
    if (is_near) uncertain();
  }

  Rational band_squared_;
  bool holds_ = true, certain_ = true, nearly_holds_ = true;
};

class ExactOracle {
 public:
  ExactOracle(const Mesh& a, const Mesh& b, double reach, double band)
      : a_(exact_mesh(a)), b_(exact_mesh(b)), reach_(reach), far_(1.001 * (reach + 2.0 * band)), band_(band) {}

  std::map<PointKey, ExactPoint> run() {
    for (const auto& [v, _] : a_.vertices) from_vertex(a_, v, b_, FeaturePair::vertex_facet);
    for (const auto& [v, _] : b_.vertices) from_vertex(b_, v, a_, FeaturePair::facet_vertex);
    for (const auto& [e, third_e] : a_.edges) {
      for (const auto& [f, third_f] : b_.edges) between(e, third_e, f, third_f);
    }
    return std::move(found_);
  }

 private:
  // Nothing between two features whose boxes are far apart counts.
  template <class Some, class Others>
  bool are_far(const ExactMesh& s, const Some& some, const ExactMesh& t, const Others& others) const {
    base::Box p, q;
    for (const int v : some) p = extended(p, s.rounded[v]);
    for (const int v : others) q = extended(q, t.rounded[v]);
    return !overlaps(base::grown(p, far_), q);
  }

  void add(FeaturePair kind, std::array<int, 3> a, std::array<int, 3> b, const Rational& gap_squared,
           Conditions conditions) {
    if (!conditions.nearly_holds()) return;
    // The difference times the sum, which is near twice the reach where that matters.
    const Rational reach_squared = Rational(reach_) * Rational(reach_);
    conditions.positive(reach_squared - gap_squared, Rational(4) * reach_squared);
    if (!conditions.nearly_holds()) return;
    if (conditions.holds() || !conditions.certain())
      found_[{kind, a, b}] = {std::sqrt(CGAL::to_double(gap_squared)), conditions.holds(), conditions.certain()};
  }

  void add_vertex(FeaturePair kind, int vertex, std::array<int, 3> feature, const Rational& gap_squared,
                  const Conditions& conditions) {
    const std::array<int, 3> own{vertex, -1, -1};
    const bool of_a = kind == FeaturePair::vertex_facet;
    add(kind, of_a ? own : feature, of_a ? feature : own, gap_squared, conditions);
  }

  // From the edge p q straight to the third vertex, times the square of the edge.
  static Vec across_edge(const Vec& p, const Vec& q, const Vec& third) {
    const Vec along = q - p, to = third - p;
    return dot(along, along) * to - dot(to, along) * along;
  }

  void from_vertex(const ExactMesh& own, int vertex, const ExactMesh& s, FeaturePair kind) {
    const std::array<int, 1> alone{vertex};
    const Vec& v = own.x[vertex];
    for (const auto& c : s.facets) {
      if (!are_far(own, alone, s, c)) in_facet(v, vertex, s, c, kind);
    }
    for (const auto& [edge, third] : s.edges) {
      if (!are_far(own, alone, s, std::array{edge.first, edge.second})) in_edge(v, vertex, s, edge, third, kind);
    }
    for (const auto& [w, neighbors] : s.vertices) {
      if (are_far(own, alone, s, std::array{w})) continue;
      Conditions minimum(band_);
      const Vec to = v - s.x[w];
      for (const int u : neighbors) {
        const Vec way = s.x[u] - s.x[w];
        minimum.at_most_zero(dot(to, way), dot(way, way));
      }
      add_vertex(kind, vertex, {w, -1, -1}, dot(to, to), minimum);
    }
  }

  void in_facet(const Vec& v, int vertex, const ExactMesh& s, const std::array<int, 3>& c, FeaturePair kind) {
    const Vec &p = s.x[c[0]], normal = cross(s.x[c[1]] - p, s.x[c[2]] - p);
    const Rational square = dot(normal, normal), height = dot(normal, v - p);
    if (square == 0) return;
    Conditions inside(band_);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec &q = s.x[c[k]], &r = s.x[c[(k + 1) % 3]], across = across_edge(q, r, s.x[c[(k + 2) % 3]]);
      inside.positive(dot(v - q, across), dot(across, across));
      // In line but for rounding: it may face anywhere.
      const Rational side = dot(r - q, r - q);
      if (square <= Rational(band_) * Rational(band_) * side) inside.uncertain();
    }
    add_vertex(kind, vertex, c, height * height / square, inside);
  }

  void in_edge(const Vec& v, int vertex, const ExactMesh& s, const VertexPair& edge, const std::vector<int>& third,
               FeaturePair kind) {
    const Vec &p = s.x[edge.first], &q = s.x[edge.second], along = q - p, to = v - p;
    const Rational square = dot(along, along), place = dot(to, along);
    if (square == 0) return;
    Conditions inside(band_);
    inside.positive(place, square);
    inside.positive(square - place, square);
    for (const int t : third) {
      const Vec across = across_edge(p, q, s.x[t]);
      const Rational width = dot(across, across);
      if (width == 0) continue;
      inside.at_most_zero(dot(to, across), width);
      if (width <= Rational(band_) * Rational(band_) * square * square) inside.uncertain();
    }
    add_vertex(kind, vertex, {edge.first, edge.second, -1}, dot(to, to) - place * place / square, inside);
  }

  void between(const VertexPair& e, const std::vector<int>& third_e, const VertexPair& f,
               const std::vector<int>& third_f) {
    if (are_far(a_, std::array{e.first, e.second}, b_, std::array{f.first, f.second})) return;
    const Vec &p = a_.x[e.first], &q = b_.x[f.first], u = a_.x[e.second] - p, w = b_.x[f.second] - q, r = q - p,
              across = cross(u, w);
    const Rational square = dot(across, across), height = dot(across, r), uu = dot(u, u), ww = dot(w, w);
    if (square == 0) return;
    const Rational on_e = dot(cross(r, w), across), on_f = dot(cross(r, u), across);
    Conditions inside(band_);
    // Where the closest points are, times the length of an edge: `square` times that is the unit.
    inside.positive(on_e, square * square / uu);
    inside.positive(square - on_e, square * square / uu);
    inside.positive(on_f, square * square / ww);
    inside.positive(square - on_f, square * square / ww);
    // The common normal of nearly parallel edges is wrong by more than the band.
    if (square * Rational(1e14) < uu * ww) inside.uncertain();
    const bool touch = height * height <= Rational(band_) * Rational(band_) * square;
    if (touch) inside.uncertain();  // they have no side yet: either may do
    Conditions best = on_side(CGAL::sign(height) == CGAL::NEGATIVE ? -across : across, inside, p, third_e, q, third_f);
    if (touch && !best.holds()) {
      const Conditions other =
          on_side(CGAL::sign(height) == CGAL::NEGATIVE ? across : -across, inside, p, third_e, q, third_f);
      if (other.holds() || (other.nearly_holds() && !best.nearly_holds())) best = other;
    }
    add(FeaturePair::edge_edge, {e.first, e.second, -1}, {f.first, f.second, -1}, height * height / square, best);
  }

  Conditions on_side(const Vec& normal, Conditions minimum, const Vec& p, const std::vector<int>& third_e, const Vec& q,
                     const std::vector<int>& third_f) const {
    const Rational square = dot(normal, normal);
    for (const int c : third_e) minimum.at_most_zero(dot(normal, a_.x[c] - p), square);
    for (const int c : third_f) minimum.at_most_zero(-dot(normal, b_.x[c] - q), square);
    return minimum;
  }

  ExactMesh a_, b_;
  double reach_, far_, band_;
  std::map<PointKey, ExactPoint> found_;
};

}  // namespace

std::map<PointKey, ExactPoint> exact_points(const Mesh& a, const Mesh& b, double reach, double band) {
  return ExactOracle(a, b, reach, band).run();
}

}  // namespace tact::tests
