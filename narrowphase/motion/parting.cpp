#include "narrowphase/motion/parting.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "narrowphase/motion/opening_walls.h"
#include "narrowphase/numeric/bounded_number.h"
#include "narrowphase/numeric/wide_vector.h"

namespace tact::narrowphase {

namespace {

// Spans that are tried after the whole one. The last one is short enough for whatever goes by lengths of one scale.
constexpr int kHalvings[] = {4, 10, 20};
constexpr int kMostHalvings = 40;
constexpr std::size_t kMostNeighbors = 8;  // of a vertex, in pairs of which planes are looked for

Vec3 which_are_zero(Vec3 a) { return {a.x != 0.0 ? 1.0 : 0.0, a.y != 0.0 ? 1.0 : 0.0, a.z != 0.0 ? 1.0 : 0.0}; }

// The k-th of the combinations of three ends of which `later` are the later ones.
constexpr int kCombinations[4][3][3] = {
    {{0, 0, 0}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{1, 1, 0}, {1, 0, 1}, {0, 1, 1}}, {{1, 1, 1}}};
constexpr int kCounts[4] = {1, 3, 3, 1};

// The difference at both ends in units, the later one times 2^halvings.
using Exact = WideVector<36>;
struct ExactEnds {
  Exact at[2];

  ExactEnds(const MovingWay& way, int unit, int halvings) {
    const auto difference = [&](int time) {
      return in_units<33>(way.to.at[time], unit) - in_units<33>(way.from.at[time], unit);
    };
    const WideVector<34> begin = difference(0), end = difference(1);
    at[0] = Exact(begin);
    at[1] = halvings == 0 ? Exact(end) : WideInteger<1>(false, (std::uint64_t{1} << halvings) - 1, 0) * begin + end;
  }
};

int lowest_bit_of(const MovingWay& way) {
  return std::min(
      {lowest_bit(way.from.at[0]), lowest_bit(way.from.at[1]), lowest_bit(way.to.at[0]), lowest_bit(way.to.at[1])});
}

int exact_sign(const MovingWay& u, const MovingWay& v, const MovingWay& w, int later, int halvings) {
  const int unit = std::min({lowest_bit_of(u), lowest_bit_of(v), lowest_bit_of(w)});
  const ExactEnds a(u, unit, halvings), b(v, unit, halvings), c(w, unit, halvings);
  const auto volume = [&](int k) {
    const auto& ends = kCombinations[later][k];
    return dot(a.at[ends[0]], cross(b.at[ends[1]], c.at[ends[2]]));
  };
  if (kCounts[later] == 1) return volume(0).sign();
  return (volume(0) + volume(1) + volume(2)).sign();
}

// The same ends as double-doubles.
using BoundedVector = NumberVector<BoundedNumber>;
struct BoundedEnds {
  BoundedVector at[2];
  bool is_exact[2];

  BoundedEnds(const MovingWay& way, int halvings) {
    const auto difference = [&](int time) {
      const auto [x, y, z] = double_double_difference(way.to.at[time], way.from.at[time]);
      return BoundedVector{BoundedNumber(x), BoundedNumber(y), BoundedNumber(z)};
    };
    at[0] = difference(0), at[1] = difference(1);
    is_exact[0] = true, is_exact[1] = halvings == 0;
    if (halvings != 0) at[1] = at[0] + BoundedNumber(DoubleDouble{std::ldexp(1.0, -halvings)}) * (at[1] - at[0]);
  }
};

// Nothing where double-doubles do not tell either: where a volume is zero for another reason than equal ways.
std::optional<int> bounded_sign(const MovingWay& u, const MovingWay& v, const MovingWay& w, int later, int halvings) {
  const BoundedEnds ends[3] = {{u, halvings}, {v, halvings}, {w, halvings}};
  BoundedNumber sum;
  for (int k = 0; k < kCounts[later]; ++k) {
    const auto& at = kCombinations[later][k];
    const auto are_one = [&](int i, int j) {
      return ends[i].is_exact[at[i]] && ends[j].is_exact[at[j]] && ends[i].at[at[i]] == ends[j].at[at[j]];
    };
    if (are_one(0, 1) || are_one(1, 2) || are_one(0, 2)) continue;
    sum = sum + dot(ends[0].at[at[0]], cross(ends[1].at[at[1]], ends[2].at[at[2]]));
  }
  BoundedNumber::unclear() = false;
  const int sign = sum.sign();
  return BoundedNumber::unclear() ? std::nullopt : std::optional(sign);
}

// Of the coefficient with so many later ends.
int sign_of_coefficient(const MovingWay& u, const MovingWay& v, const MovingWay& w, const WayEnds (&ends)[3], int later,
                        int halvings) {
  double volume = 0.0, sizes = 0.0, may_count = 0.0;
  for (int k = 0; k < kCounts[later]; ++k) {
    const auto& at = kCombinations[later][k];
    const auto [i, j, l] = std::array{at[0], at[1], at[2]};
    volume += dot(ends[0].at[i], cross(ends[1].at[j], ends[2].at[l]));
    sizes += sum_of_sizes(ends[0].size[i], ends[1].size[j], ends[2].size[l]);
    may_count +=
        sum_of_sizes(which_are_zero(ends[0].size[i]), which_are_zero(ends[1].size[j]), which_are_zero(ends[2].size[l]));
  }
  if (may_count == 0.0) return 0;
  if (sizes > kVanishingVolume && std::abs(volume) > kWayRounding * sizes) return volume > 0.0 ? 1 : -1;
  const std::optional<int> sign = bounded_sign(u, v, w, later, halvings);
  return sign ? *sign : exact_sign(u, v, w, later, halvings);
}

// Whether the area of u and v is certainly not zero at the beginning.
bool has_area(const MovingWay& u, const MovingWay& v) {
  const WayEnds a(u, 0), b(v, 0);
  const Vec3 normal = cross(a.at[0], b.at[0]), s = a.size[0], t = b.size[0];
  const Vec3 sizes{s.y * t.z + s.z * t.y, s.z * t.x + s.x * t.z, s.x * t.y + s.y * t.x};
  for (int axis = 0; axis < 3; ++axis) {
    if (sizes[axis] > kVanishingVolume && std::abs(normal[axis]) > kWayRounding * sizes[axis]) return true;
  }
  return false;
}

}  // namespace

unsigned volume_signs(const MovingWay& u, const MovingWay& v, const MovingWay& w, int halvings) {
  const WayEnds ends[3] = {{u, halvings}, {v, halvings}, {w, halvings}};
  unsigned signs = 0;
  for (const int later : {0, 3, 1, 2}) {
    const int sign = sign_of_coefficient(u, v, w, ends, later, halvings);
    signs |= sign > 0 ? kAbove : sign < 0 ? kBelow : 0u;
    if (signs == (kAbove | kBelow)) break;
  }
  return signs;
}

double PartingSearch::apart_until(const MovingMesh& a, const MovingMesh& b, FeaturePair kind, int feature_a,
                                  int feature_b, double time) {
  const bool slides = time > 0.0;
  if (!slides) {
    if (const double until = walls_open_until(a, b, kind, feature_a, feature_b); until > 0.0) return until;
  }
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
  const auto separates_for = [&](int halvings) {
    return [this, halvings, slides](const Plane& plane) { return separates(plane, halvings, slides); };
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
  for (const int next : mesh.features->neighbors(vertex)) star.vertices.push_back(mesh.vertex(next));
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
  planes_.push_back({{a, b}, {a, c}, a, a});
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
  planes_.push_back({e, f, a_.vertices[0], b_.vertices[0]});
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along;
    along[axis] = 1.0;
    const MovingWay way{{{Vec3{}, Vec3{}}}, {{along, along}}};
    planes_.push_back({e, way, a_.vertices[0], a_.vertices[0]});
    planes_.push_back({f, way, b_.vertices[0], b_.vertices[0]});
  }
}

// If all is in the plane, borders of two sheets may meet in it.
bool PartingSearch::separates(const Plane& plane, int halvings, bool own_in_plane) const {
  const auto signs_of = [&](const MovingVertex& base, const MovingVertex& vertex) {
    const auto spans = [&](const MovingWay& way) { return same(way.from, base) && same(way.to, vertex); };
    return same(vertex, base) || spans(plane.u) || spans(plane.v)
               ? 0u
               : volume_signs(plane.u, plane.v, {base, vertex}, halvings);
  };
  const bool is_one = same(plane.base_a, plane.base_b);
  unsigned of_a = 0, of_b = is_one ? 0u : volume_signs(plane.u, plane.v, {plane.base_a, plane.base_b}, halvings);
  const auto is_apart = [&] { return (of_a & of_b) == 0 && of_a != (kAbove | kBelow) && of_b != (kAbove | kBelow); };
  const auto take = [&](const Star& star, const MovingVertex& base, std::size_t begin, std::size_t end, unsigned& all) {
    bool any_in_plane = false;
    for (std::size_t i = begin; i < end; ++i) {
      const unsigned signs = signs_of(base, star.vertices[i]);
      any_in_plane = any_in_plane || signs == 0;
      all |= signs;
      if (!is_apart()) return false;
    }
    return any_in_plane || !own_in_plane || begin > 0;
  };
  const bool separates = take(a_, plane.base_a, 0, a_.own, of_a) && take(b_, plane.base_b, 0, b_.own, of_b) &&
                         take(a_, plane.base_a, a_.own, a_.vertices.size(), of_a) &&
                         take(b_, plane.base_b, b_.own, b_.vertices.size(), of_b);
  if (!separates) return false;
  return (of_a | of_b) != 0 || (has_area(plane.u, plane.v) && !(a_.is_border && b_.is_border));
}

}  // namespace tact::narrowphase
