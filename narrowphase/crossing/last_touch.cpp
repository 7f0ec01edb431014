#include "narrowphase/crossing/last_touch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "narrowphase/crossing/nearest_exit.h"
#include "narrowphase/numeric/frame.h"

namespace tact::narrowphase {

namespace {

// Ways and weights that differ by less are the same but for rounding. Lengths are near 1.
constexpr double kSame = 1e-12;
// Facets that stand along the direction, and edges that are parallel seen along it, have such a sine at most: their
// places would be rounding alone. Others beside them touch as late.
constexpr double kSeenSine = 1e-9;

// Across the direction.
double turn(Vec3 p, Vec3 q) { return p.x * q.y - p.y * q.x; }
double length_across(Vec3 p) { return std::sqrt(p.x * p.x + p.y * p.y); }

}  // namespace

void LastTouch::see(const SurfacePart& part, std::vector<SeenFacet>& seen) const {
  seen.clear();
  for (std::size_t i = 0; i < part.facets().size(); ++i) {
    SeenFacet one{part.facet(i), static_cast<int>(i), {}, 0.0, 0.0};
    const Triangle t = part.surface().triangle(one.facet);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 at = t[k] - origin_;
      one.corner[k] = {dot(u_, at), dot(v_, at), dot(direction_, at)};
    }
    const auto [bottom, top] = std::minmax({one.corner[0].z, one.corner[1].z, one.corner[2].z});
    one.bottom = bottom;
    one.top = top;
    seen.push_back(one);
  }
}

void LastTouch::append_points(const SurfacePart& a, const SurfacePart& b, Vec3 direction,
                              std::vector<FeaturePoint>& found) {
  const Frame frame = frame_across(direction);
  origin_ = a.surface().triangle(a.facet(0))[0];
  u_ = frame.u;
  v_ = frame.v;
  direction_ = direction;
  see(a, a_);
  see(b, b_);
  // Facets of equal height stay in the caller's order.
  std::ranges::sort(a_, {}, [](const SeenFacet& one) { return std::pair(-one.top, one.place); });
  std::ranges::sort(b_, {}, [](const SeenFacet& one) { return std::pair(one.bottom, one.place); });
  touches_.clear();
  last_way_ = -kSame;
  for (const SeenFacet& of_a : a_) {
    for (const SeenFacet& of_b : b_) {
      if (of_a.top - of_b.bottom < last_way_ - kSame) break;
      look_at(of_a, of_b);
    }
  }
  std::erase_if(touches_, [&](const Touch& one) { return one.way < last_way_ - kSame; });
  const bool any_vertex =
      std::ranges::any_of(touches_, [](const Touch& one) { return one.kind != FeaturePair::edge_edge; });
  points_.clear();
  for (const Touch& one : touches_) {
    if (!any_vertex || one.kind != FeaturePair::edge_edge) points_.push_back(point_of(one, a, b));
  }
  // Of those of the same features the first one.
  order_.resize(points_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::sort(order_, {}, [&](std::size_t i) { return std::pair(points_[i].features(), i); });
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const FeaturePoint& point = points_[order_[i]];
    if (i == 0 || points_[order_[i - 1]].features() != point.features()) found.push_back(point);
  }
}

void LastTouch::look_at(const SeenFacet& a, const SeenFacet& b) {
  for (int k = 0; k < 3; ++k) {
    look_at_vertex(a, b, k, true);
    look_at_vertex(b, a, k, false);
    for (int l = 0; l < 3; ++l) look_at_edges(a, b, k, l);
  }
}

void LastTouch::look_at_vertex(const SeenFacet& own, const SeenFacet& other, int corner, bool of_a) {
  const Vec3 at = own.corner[corner];
  std::array<Vec3, 3> t;
  for (std::size_t k = 0; k < 3; ++k) t[k] = other.corner[k] - at;
  const double area = turn(t[1] - t[0], t[2] - t[0]);
  if (!(std::abs(area) > kSeenSine * length_across(t[1] - t[0]) * length_across(t[2] - t[0]))) return;
  double weight[3], sum = 0.0, height = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    weight[k] = turn(t[(k + 1) % 3], t[(k + 2) % 3]) / area;
    if (weight[k] < -kSame) return;
    if (weight[k] < kSame) weight[k] = 0.0;
    sum += weight[k];
  }
  Touch touch{of_a ? FeaturePair::vertex_facet : FeaturePair::facet_vertex, 0, 0, corner, corner, {}, {}, 0.0};
  (of_a ? touch.facet_a : touch.facet_b) = own.facet;
  (of_a ? touch.facet_b : touch.facet_a) = other.facet;
  for (std::size_t k = 0; k < 3; ++k) {
    (of_a ? touch.weight_b : touch.weight_a)[k] = weight[k] / sum;
    height += weight[k] / sum * t[k].z;
  }
  touch.way = of_a ? -height : height;
  take(touch);
}

void LastTouch::look_at_edges(const SeenFacet& a, const SeenFacet& b, int edge_a, int edge_b) {
  const Vec3 p = a.corner[edge_a], along = a.corner[(edge_a + 1) % 3] - p;
  const Vec3 q = b.corner[edge_b], other = b.corner[(edge_b + 1) % 3] - q;
  const double across = turn(along, other);
  if (!(std::abs(across) > kSeenSine * length_across(along) * length_across(other))) return;
  const double s = turn(q - p, other) / across, t = turn(q - p, along) / across;
  if (std::min({s, 1.0 - s, t, 1.0 - t}) < kSame) return;
  take({FeaturePair::edge_edge,
        a.facet,
        b.facet,
        edge_a,
        edge_b,
        {1.0 - s, s, 0.0},
        {1.0 - t, t, 0.0},
        (p.z + s * along.z) - (q.z + t * other.z)});
}

void LastTouch::take(const Touch& touch) {
  if (touch.way < last_way_ - kSame) return;
  touches_.push_back(touch);
  last_way_ = std::max(last_way_, touch.way);
}

FeaturePoint LastTouch::point_of(const Touch& touch, const SurfacePart& a, const SurfacePart& b) const {
  const ScaledMesh &of_a = a.surface(), &of_b = b.surface();
  const double gap = touch.way > 0.0 ? -touch.way / of_a.scale : 0.0;
  if (touch.kind == FeaturePair::edge_edge) {
    const int edge_a = of_a.features.facet_edge(touch.facet_a, touch.corner_a),
              edge_b = of_b.features.facet_edge(touch.facet_b, touch.corner_b);
    Nearest nearest{.normal = direction_};
    const auto set = [](const ScaledMesh& m, int edge, int facet, int corner, const double* from, double* to) {
      const bool forward = m.features.edge(edge)[0] == m.features.corners(facet)[static_cast<std::size_t>(corner)];
      to[0] = from[forward ? 0 : 1];
      to[1] = from[forward ? 1 : 0];
    };
    set(of_a, edge_a, touch.facet_a, touch.corner_a, touch.weight_a, nearest.first);
    set(of_b, edge_b, touch.facet_b, touch.corner_b, touch.weight_b, nearest.weight);
    return point_of_edges(nearest, of_a, edge_a, of_b, edge_b, gap);
  }
  const bool vertex_of_a = touch.kind == FeaturePair::vertex_facet;
  const ScaledMesh &own = vertex_of_a ? of_a : of_b, &surface = vertex_of_a ? of_b : of_a;
  const Corners& corners = own.features.corners(vertex_of_a ? touch.facet_a : touch.facet_b);
  const int vertex = corners[static_cast<std::size_t>(vertex_of_a ? touch.corner_a : touch.corner_b)];
  const auto& weight = vertex_of_a ? touch.weight_b : touch.weight_a;
  const PlaceOnFeature place =
      place_in_facet(surface, vertex_of_a ? touch.facet_b : touch.facet_a, {weight[0], weight[1], weight[2]});
  return point_of_vertex(touch.kind, own.mesh, vertex, surface.mesh, place, vertex_of_a ? direction_ : -direction_,
                         gap);
}

}  // namespace tact::narrowphase
