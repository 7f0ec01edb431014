#include "narrowphase/motion/parting.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "narrowphase/motion/height_signs.h"
#include "narrowphase/motion/opening_walls.h"

namespace tact::narrowphase {

namespace {

// Spans that are tried after the whole one. The last one is short enough for whatever goes by lengths of one scale.
constexpr int kHalvings[] = {4, 10, 20};
constexpr int kMostHalvings = 40;
constexpr std::size_t kMostNeighbors = 8;  // of a vertex, in pairs of which planes are looked for

}  // namespace

double PartingSearch::apart_until(const MovingMesh& a, const MovingMesh& b, FeaturePair kind, int feature_a,
                                  int feature_b, double time, PlanesAtBegin& planes) {
  const bool slides = own_in_plane_ = time > 0.0;
  if (!slides) {
    if (const double until = walls_open_until(a, b, kind, feature_a, feature_b); until > 0.0) return until;
  }
  if (planes == PlanesAtBegin::none || (slides && planes == PlanesAtBegin::none_to_slide_along)) return 0.0;
  planes_.clear();
  if (kind == FeaturePair::edge_edge) {
    take_edge(a, feature_a, a_);
    take_edge(b, feature_b, b_);
    add_planes_of_edges(slides);
  } else {
    const bool vertex_is_a = kind == FeaturePair::vertex_facet;
    const MovingMesh &of_vertex = vertex_is_a ? a : b, &of_facet = vertex_is_a ? b : a;
    const int vertex = vertex_is_a ? feature_a : feature_b;
    Star &star = vertex_is_a ? a_ : b_, &facet = vertex_is_a ? b_ : a_;
    take_vertex(of_vertex, vertex, star);
    take_facet(of_facet, vertex_is_a ? feature_b : feature_a, facet);
    add_plane(facet.vertices[0], facet.vertices[1], facet.vertices[2]);
    add_planes_of_vertex(of_vertex, vertex, star, slides);
  }
  if (planes_.empty()) {
    planes = slides ? PlanesAtBegin::none_to_slide_along : PlanesAtBegin::none;
    return 0.0;
  }
  const auto separates_for = [&](int halvings) {
    return [this, halvings](const Plane& plane) { return separates(plane, halvings); };
  };
  if (std::ranges::any_of(planes_, separates_for(0))) return 1.0;
  if (slides) return 0.0;
  // Where a coefficient keeps its sign on a span it does on each shorter one.
  std::erase_if(planes_, std::not_fn(separates_for(kMostHalvings)));
  if (planes_.empty()) return 0.0;
  for (const int halvings : kHalvings) {
    if (std::ranges::any_of(planes_, separates_for(halvings))) return std::ldexp(1.0, -halvings);
  }
  return std::ldexp(1.0, -kMostHalvings);
}

void PartingSearch::take_vertex(const MovingMesh& mesh, int vertex, Star& star) {
  star.vertices.assign(1, mesh.vertex(vertex));
  star.own = 1;
  star.is_border = false;
  std::span<const int> neighbors = mesh.features->neighbors(vertex);
  // Those of which planes are looked for come first: the caller's first, so that no grouping decides.
  if (neighbors.size() > kMostNeighbors) {
    neighbors_.assign(neighbors.begin(), neighbors.end());
    const auto of_caller = [&](int v) { return mesh.mesh->source_vertex(v); };
    std::nth_element(neighbors_.begin(), neighbors_.begin() + kMostNeighbors, neighbors_.end(),
                     [&](int x, int y) { return of_caller(x) < of_caller(y); });  // ranges:: is not in older libc++
    neighbors = neighbors_;
  }
  for (const int next : neighbors) star.vertices.push_back(mesh.vertex(next));
}

void PartingSearch::take_edge(const MovingMesh& mesh, int edge, Star& star) {
  const EdgeVertices ends = mesh.features->edge(edge);
  star.vertices.assign({mesh.vertex(ends[0]), mesh.vertex(ends[1])});
  star.own = 2;
  const std::span<const int> opposite = mesh.features->opposite(edge);
  star.is_border = opposite.size() < 2;
  for (const int third : opposite) star.vertices.push_back(mesh.vertex(third));
}

void PartingSearch::take_facet(const MovingMesh& mesh, int facet, Star& star) {
  const Corners& c = mesh.features->corners(facet);
  star.vertices.assign({mesh.vertex(c[0]), mesh.vertex(c[1]), mesh.vertex(c[2])});
  star.own = 3;
  star.is_border = false;
}

void PartingSearch::add_plane(const MovingVertex& a, const MovingVertex& b, const MovingVertex& c) {
  add({{a, b}, {a, c}, a, a});
}

// Of a facet that has it; or through it and any two of its neighbors.
void PartingSearch::add_planes_of_vertex(const MovingMesh& mesh, int vertex, const Star& star, bool only_one) {
  const Corners& c = mesh.features->corners(mesh.features->first_facet_of_vertex(vertex));
  add_plane(mesh.vertex(c[0]), mesh.vertex(c[1]), mesh.vertex(c[2]));
  if (only_one) return;
  const std::size_t count = std::min(star.vertices.size() - 1, kMostNeighbors);
  for (std::size_t i = 1; i <= count; ++i) {
    for (std::size_t k = i + 1; k <= count; ++k) add_plane(star.vertices[0], star.vertices[i], star.vertices[k]);
  }
}

// Of the facets that have one; along both; and along one and an axis.
void PartingSearch::add_planes_of_edges(bool only_facets) {
  for (const Star* star : {&a_, &b_}) {
    for (std::size_t i = 2; i < star->vertices.size(); ++i)
      add_plane(star->vertices[0], star->vertices[1], star->vertices[i]);
  }
  if (only_facets) return;
  const MovingWay e{a_.vertices[0], a_.vertices[1]}, f{b_.vertices[0], b_.vertices[1]};
  add({e, f, a_.vertices[0], b_.vertices[0]});
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along;
    along[axis] = 1.0;
    const MovingWay way{{{Vec3{}, Vec3{}}}, {{along, along}}};
    add({e, way, a_.vertices[0], a_.vertices[0]});
    add({f, way, b_.vertices[0], b_.vertices[0]});
  }
}

// Whether the places at time 0 rule out that a plane separates, as doubles tell: of most they do.
bool PartingSearch::begins_on_both_sides(const Plane& plane) const {
  const BeginNormal normal(plane.u, plane.v);
  unsigned of_b = same(plane.base_a, plane.base_b) ? 0u : normal.sign_along(plane.base_a, plane.base_b), of_a = 0;
  const auto take = [&](const Star& star, const MovingVertex& base, std::size_t begin, std::size_t end, unsigned& of) {
    bool any_in_plane = !own_in_plane_ || begin > 0;
    for (std::size_t i = begin; i < end; ++i) {
      const unsigned sign = normal.sign_along(base, star.vertices[i]);
      of |= sign;
      any_in_plane = any_in_plane || sign == 0;
    }
    return any_in_plane && (of_a & of_b) == 0 && of != (kAbove | kBelow);
  };
  return !(take(a_, plane.base_a, 0, a_.own, of_a) && take(b_, plane.base_b, 0, b_.own, of_b) &&
           take(a_, plane.base_a, a_.own, a_.vertices.size(), of_a) &&
           take(b_, plane.base_b, b_.own, b_.vertices.size(), of_b));
}

void PartingSearch::add(const Plane& plane) {
  if (!begins_on_both_sides(plane)) planes_.push_back(plane);
}

// What doubles tell of all vertices comes first: most planes separate nothing, which needs no exact sign.
bool PartingSearch::separates(const Plane& plane, int halvings) {
  const MovingNormal normal(plane.u, plane.v, halvings);
  unsigned of[2] = {0, 0};  // the signs of both stars
  const auto is_apart = [&] {
    return (of[0] & of[1]) == 0 && of[0] != (kAbove | kBelow) && of[1] != (kAbove | kBelow);
  };
  open_.clear();
  const auto take = [&](const MovingWay& way, std::size_t side, bool is_own) {
    const MovingNormal::Signs signs = normal.signs_along(way);
    of[side] |= signs.certain;
    if (signs.open != 0) open_.push_back({way, side, is_own && signs.certain == 0, signs});
    return signs.certain;
  };
  const auto is_in_plane = [&](const MovingWay& way) {
    const auto is = [&](const MovingWay& other) { return same(way.from, other.from) && same(way.to, other.to); };
    return same(way.from, way.to) || is(plane.u) || is(plane.v);
  };
  const Star* const stars[2] = {&a_, &b_};
  const MovingVertex* const bases[2] = {&plane.base_a, &plane.base_b};
  if (!same(plane.base_a, plane.base_b)) take({plane.base_a, plane.base_b}, 1, false);
  int may_be_in_plane[2] = {0, 0};  // of own ones
  bool any_in_plane[2] = {!own_in_plane_, !own_in_plane_};
  for (const bool own : {true, false}) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Star& star = *stars[side];
      for (std::size_t i = own ? 0 : star.own; i < (own ? star.own : star.vertices.size()); ++i) {
        const MovingWay way{*bases[side], star.vertices[i]};
        if (is_in_plane(way))
          any_in_plane[side] |= own;
        else if (take(way, side, own) == 0 && own)
          ++may_be_in_plane[side];
        if (!is_apart()) return false;
      }
      if (own && !any_in_plane[side] && may_be_in_plane[side] == 0) return false;
    }
  }
  for (const auto& [way, side, may_be, signs] : open_) {
    const unsigned exact = normal.exact_signs_along(way, signs.open, signs.certain);
    of[side] |= exact;
    if (!is_apart()) return false;
    if (!may_be) continue;
    if (exact == 0) any_in_plane[side] = true;
    if (--may_be_in_plane[side] == 0 && !any_in_plane[side]) return false;
  }
  // If all is in the plane, borders of two sheets may meet in it.
  return (of[0] | of[1]) != 0 || (normal.has_area() && !(a_.is_border && b_.is_border));
}

}  // namespace tact::narrowphase
