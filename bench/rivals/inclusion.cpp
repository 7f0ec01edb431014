#include "bench/rivals/inclusion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>

namespace tact::bench {
namespace {

using Eigen::Vector3d;

// Two or four points, at time 0 and at time 1.
struct Query {
  bool edges;
  Vector3d at[2][4];

  // A vertex and a point of a facet, or points of two edges: their difference.
  Vector3d difference(double t, double u, double v) const {
    Vector3d p[4];
    for (int k = 0; k < 4; ++k) p[k] = at[0][k] + t * (at[1][k] - at[0][k]);
    if (edges) return p[0] + u * (p[1] - p[0]) - p[2] - v * (p[3] - p[2]);
    return p[0] - p[1] - u * (p[2] - p[1]) - v * (p[3] - p[1]);
  }
};

// Is the volume of the four points of one sign throughout?
bool is_never_flat(const Query& q) {
  const auto volume = [&](int i, int j, int k) {
    return (q.at[i][1] - q.at[i][0]).dot((q.at[j][2] - q.at[j][0]).cross(q.at[k][3] - q.at[k][0]));
  };
  const double c[4] = {volume(0, 0, 0), volume(1, 0, 0) + volume(0, 1, 0) + volume(0, 0, 1),
                       volume(1, 1, 0) + volume(1, 0, 1) + volume(0, 1, 1), volume(1, 1, 1)};
  double size = 0.0;
  for (const auto& corners : q.at) {
    for (const Vector3d& p : corners) size = std::max(size, (p - q.at[0][0]).cwiseAbs().maxCoeff());
  }
  const double rounding = 1e-13 * size * size * size;
  const auto [low, high] = std::minmax_element(c, c + 4);
  return *low > rounding || *high < -rounding;
}

// The time at which the boxes of the difference first hold the origin, down to a step of 1e-6; 2 if never.
double first_time(const Query& q) {
  struct Cell {
    std::array<double, 3> low, width;
  };
  std::vector<Cell> cells{{{0, 0, 0}, {1, 1, 1}}};
  while (!cells.empty()) {
    const auto earliest =
        std::min_element(cells.begin(), cells.end(), [](const Cell& x, const Cell& y) { return x.low[0] < y.low[0]; });
    const Cell cell = *earliest;
    *earliest = cells.back();
    cells.pop_back();
    if (!q.edges && cell.low[1] + cell.low[2] > 1.0) continue;
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (int corner = 0; corner < 8; ++corner) {
      const auto at = [&](int k) {
        const auto i = static_cast<std::size_t>(k);
        return cell.low[i] + (corner >> k & 1) * cell.width[i];
      };
      const Vector3d x = q.difference(at(0), at(1), at(2));
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    if ((low.array() > 1e-14).any() || (high.array() < -1e-14).any()) continue;
    if ((high - low).maxCoeff() < 1e-6 || cell.width[0] < 1e-9) return cell.low[0];
    const auto axis =
        static_cast<std::size_t>(std::max_element(cell.width.begin(), cell.width.end()) - cell.width.begin());
    Cell half = cell;
    half.width[axis] *= 0.5;
    cells.push_back(half);
    half.low[axis] += half.width[axis];
    cells.push_back(half);
  }
  return 2.0;
}

// A vertex, an edge or a facet: its vertices, and its box on the way.
struct Feature {
  std::array<int, 3> vertices{-1, -1, -1};
  int count = 0;
  Vector3d low, high;
};

Feature feature_of(const MovingShape& shape, std::initializer_list<int> vertices) {
  Feature feature;
  feature.low.setConstant(std::numeric_limits<double>::infinity());
  feature.high = -feature.low;
  for (const int v : vertices) {
    feature.vertices[feature.count++] = v;
    feature.low = feature.low.cwiseMin(shape.begin.positions.col(v)).cwiseMin(shape.end.col(v));
    feature.high = feature.high.cwiseMax(shape.begin.positions.col(v)).cwiseMax(shape.end.col(v));
  }
  return feature;
}

struct Features {
  std::vector<Feature> vertices, edges, facets;

  explicit Features(const MovingShape& shape) {
    std::set<std::array<int, 2>> known;
    for (Eigen::Index v = 0; v < shape.end.cols(); ++v) vertices.push_back(feature_of(shape, {static_cast<int>(v)}));
    for (const auto& f : shape.begin.facets.colwise()) {
      facets.push_back(feature_of(shape, {f[0], f[1], f[2]}));
      for (int k = 0; k < 3; ++k) known.insert({std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])});
    }
    for (const auto& [v, w] : known) edges.push_back(feature_of(shape, {v, w}));
    for (auto* all : {&vertices, &edges, &facets}) {
      std::sort(all->begin(), all->end(), [](const Feature& x, const Feature& y) { return x.low[0] < y.low[0]; });
    }
  }
};

template <class Visit>
void for_each_overlap(const std::vector<Feature>& a, const std::vector<Feature>& b, const Visit& visit) {
  const auto test = [&](const Feature& one, const Feature& other) {
    if ((one.low.array() <= other.high.array()).all() && (other.low.array() <= one.high.array()).all())
      visit(one, other);
  };
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    if (a[i].low[0] <= b[k].low[0]) {
      for (std::size_t l = k; l < b.size() && b[l].low[0] <= a[i].high[0]; ++l) test(a[i], b[l]);
      ++i;
    } else {
      for (std::size_t l = i; l < a.size() && a[l].low[0] <= b[k].high[0]; ++l) test(a[l], b[k]);
      ++k;
    }
  }
}

}  // namespace

InclusionResult find_by_inclusion(const MovingShape& a, const MovingShape& b) {
  InclusionResult result;
  const Features of_a(a), of_b(b);
  const auto decide = [&](FeaturePair kind, const Feature& x, const Feature& y) {
    ++result.candidates;
    Query q{.edges = kind == FeaturePair::edge_edge, .at = {}};
    const bool swap = kind == FeaturePair::facet_vertex;  // the vertex comes first
    int k = 0;
    for (const auto& [shape, feature] :
         {std::pair(swap ? &b : &a, swap ? &y : &x), std::pair(swap ? &a : &b, swap ? &x : &y)}) {
      for (int i = 0; i < feature->count; ++i, ++k) {
        const int v = feature->vertices[i];
        q.at[0][k] = shape->begin.positions.col(v);
        q.at[1][k] = shape->end.col(v);
      }
    }
    if (is_never_flat(q)) return;
    if (const double time = first_time(q); time <= 1.0) result.impacts.push_back({kind, x.vertices, y.vertices, time});
  };
  const auto find = [&](FeaturePair kind, const std::vector<Feature>& x, const std::vector<Feature>& y) {
    for_each_overlap(x, y, [&](const Feature& one, const Feature& other) { decide(kind, one, other); });
  };
  find(FeaturePair::vertex_facet, of_a.vertices, of_b.facets);
  find(FeaturePair::facet_vertex, of_a.facets, of_b.vertices);
  find(FeaturePair::edge_edge, of_a.edges, of_b.edges);
  return result;
}

}  // namespace tact::bench
