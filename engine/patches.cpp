#include "engine/patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/eigen_vectors.h"
#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/unit_scale.h"

namespace tact {

namespace {

using base::Box;
using base::Vec3;
using narrowphase::Triangle;

// Points of a patch that span less than this part of its size span nothing more.
constexpr double kSpansNothing = 1e-9;
// Points that span a patch are kept while they span this part of what the best would, and are this part of its size at
// most less deep: a body that trembles changes both by far less, and one that rolls or slides by more.
constexpr double kNearlyAll = 0.875, kNearlyDeepest = 0x1p-10;
// Normals that are no more than 5 degrees apart point the same way; and so many ways are told apart.
constexpr double kSameWay = 0.9962;
constexpr std::size_t kMostWays = 16;

Triangle triangle_of(const Body& body, int source_facet) {
  return body.mesh.triangle(body.mesh.facet_of_source(source_facet));
}

Box box_of(const Triangle& t) { return extended(extended(Box{t[0], t[0]}, t[1]), t[2]); }

// The body of a pair with a plane, and its facet.
const Body& beside_plane(const PatchInput& input) { return input.a.plane != nullptr ? input.b : input.a; }
int beside_plane(const PatchInput& input, const FacetPair& pair) { return input.a.plane != nullptr ? pair.b : pair.a; }
bool is_with_plane(const PatchInput& input) { return input.a.plane != nullptr || input.b.plane != nullptr; }

Box common_box(const PatchInput& input, const FacetPair& pair) {
  if (is_with_plane(input)) return box_of(triangle_of(beside_plane(input), beside_plane(input, pair)));
  return intersection(box_of(triangle_of(input.a, pair.a)), box_of(triangle_of(input.b, pair.b)));
}

Vec3 center_of(const Box& box) { return 0.5 * box.lower + 0.5 * box.upper; }

double longest(const Box& box) {
  const Vec3 size = box.upper - box.lower;
  return std::max({size.x, size.y, size.z});
}

// `scale` is a unit of length in which the area neither vanishes nor overflows.
Vec3 area_normal(const Body& body, int facet, Vec3 side, double scale) {
  const Triangle t = triangle_of(body, facet);
  const Vec3 n = cross(scale * (t[1] - t[0]), scale * (t[2] - t[0]));
  return !body.has_inside && dot(n, side) < 0.0 ? -n : n;
}

// Above the origin, along n.
double highest(const Triangle& t, Vec3 n, Vec3 origin) {
  return std::max({dot(n, t[0] - origin), dot(n, t[1] - origin), dot(n, t[2] - origin)});
}

Vec3 place(const Body& body, const std::array<int, 3>& vertices, const std::array<double, 3>& weights) {
  Vec3 p;
  for (std::size_t k = 0; k < 3; ++k) {
    if (vertices[k] >= 0) p = p + weights[k] * body.mesh.position(body.features->vertex_of_source(vertices[k]));
  }
  return p;
}

Vec3 place(const PatchInput& input, const ContactPoint& point) {
  const Vec3 half_way = 0.5 * point.gap * from_eigen(point.normal);
  if (input.b.plane != nullptr) return place(input.a, point.a_vertices, point.a_weights) + half_way;
  if (input.a.plane != nullptr) return place(input.b, point.b_vertices, point.b_weights) - half_way;
  return 0.5 * place(input.a, point.a_vertices, point.a_weights) +
         0.5 * place(input.b, point.b_vertices, point.b_weights);
}

// Of a patch without points, with a plane: how far its facets reach below.
void shape_by_plane(const PatchInput& input, Patch& patch) {
  const narrowphase::HalfSpace& plane = *(input.a.plane != nullptr ? input.a : input.b).plane;
  Vec3 center;
  double lowest = 0.0;
  for (const int i : patch.facet_pairs) {
    const Triangle t = triangle_of(beside_plane(input), beside_plane(input, input.facet_pairs[i]));
    center = center + center_of(box_of(t));
    for (const Vec3& p : t) lowest = std::min(lowest, narrowphase::height_over(plane, p));
  }
  patch.point = to_eigen((1.0 / static_cast<double>(patch.facet_pairs.size())) * center);
  patch.direction = to_eigen(input.direction);
  patch.depth = 0.0 - lowest;
}

// Of a patch without points: the mean normal of its facets, and how far they reach beyond each other along it.
void shape_by_facets(const PatchInput& input, Patch& patch) {
  Vec3 normal, center;
  double largest = 0.0;
  const auto pair = [&](int i) { return input.facet_pairs[i]; };
  for (const int i : patch.facet_pairs)
    largest = std::max(
        {largest, longest(box_of(triangle_of(input.a, pair(i).a))), longest(box_of(triangle_of(input.b, pair(i).b)))});
  const double scale = narrowphase::unit_scale(largest);
  for (const int i : patch.facet_pairs) {
    normal = normal + (area_normal(input.a, pair(i).a, input.direction, scale) -
                       area_normal(input.b, pair(i).b, -input.direction, scale));
    center = center + center_of(common_box(input, pair(i)));
  }
  const Vec3 point = (1.0 / static_cast<double>(patch.facet_pairs.size())) * center;
  const Vec3 n = normal != Vec3{} ? narrowphase::unit_vector(normal) : input.direction;
  double depth = -std::numeric_limits<double>::infinity();
  for (const int i : patch.facet_pairs) {
    const double reach =
        highest(triangle_of(input.a, pair(i).a), n, point) + highest(triangle_of(input.b, pair(i).b), -n, point);
    depth = std::max(depth, reach);
  }
  patch.point = to_eigen(point);
  patch.direction = to_eigen(n);
  patch.depth = std::max(0.0, depth);
}

// Calls visit(vertex) for the vertices of a point, as in PatchVertex. A body with itself has one kind of vertices.
template <class Visit>
void for_each_vertex(const ContactPoint& point, int b_side, const Visit& visit) {
  for (const int v : point.a_vertices) {
    if (v >= 0) visit(2 * std::int64_t{v});
  }
  for (const int v : point.b_vertices) {
    if (v >= 0) visit(2 * std::int64_t{v} + b_side);
  }
}

// The same of the corners of two facets.
template <class Visit>
void for_each_vertex(const FacetPair& pair, const Body& a, const Body& b, int b_side, const Visit& visit) {
  const auto visit_corners = [&](const Body& body, int facet, int side) {
    if (body.plane != nullptr) return;
    for (const int v : body.mesh.corners(body.mesh.facet_of_source(facet)))
      visit(2 * std::int64_t{body.mesh.source_vertex(v)} + side);
  };
  visit_corners(a, pair.a, 0);
  visit_corners(b, pair.b, b_side);
}

// Two unit vectors across n, which is one.
std::pair<Vec3, Vec3> across(Vec3 n) {
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const Vec3 axis = x <= y && x <= z ? Vec3{1.0, 0.0, 0.0} : y <= z ? Vec3{0.0, 1.0, 0.0} : Vec3{0.0, 0.0, 1.0};
  const Vec3 u = normalized(cross(n, axis));
  return {u, cross(n, u)};
}

}  // namespace

int PatchFinder::root(int i) {
  for (auto at = static_cast<std::size_t>(i); parent_[at] != i; at = static_cast<std::size_t>(i))
    i = parent_[at] = parent_[parent_[at]];
  return i;
}

// The root of a set is its lowest member.
void PatchFinder::join(int i, int k) {
  const auto [first, second] = std::minmax({root(i), root(k)});
  parent_[second] = first;
}

// Those with a plane are joined by their facets' corners instead: they all share its surface.
void PatchFinder::join_facet_pairs(std::span<const FacetPair> pairs) {
  by_b_.resize(pairs.size());
  std::iota(by_b_.begin(), by_b_.end(), 0);
  const auto b_of = [&](int i) { return pairs[i].b; };
  std::sort(by_b_.begin(), by_b_.end(), [&](int i, int j) { return b_of(i) != b_of(j) ? b_of(i) < b_of(j) : i < j; });
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    if (pairs[i - 1].a == pairs[i].a) join(static_cast<int>(i) - 1, static_cast<int>(i));
    if (b_of(by_b_[i - 1]) == b_of(by_b_[i])) join(by_b_[i - 1], by_b_[i]);
  }
}

void PatchFinder::join_facets_by_corners(std::span<const FacetPair> pairs, const Body& a, const Body& b) {
  corners_.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for_each_vertex(pairs[i], a, b, 1, [&](std::int64_t vertex) { corners_.push_back({vertex, static_cast<int>(i)}); });
  std::ranges::sort(corners_);
  for (std::size_t i = 1; i < corners_.size(); ++i) {
    if (corners_[i - 1].vertex == corners_[i].vertex) join(corners_[i - 1].patch, corners_[i].patch);
  }
}

// The points at each vertex are held against one for each way that normals point there. Of a body with itself a normal
// may point either way.
void PatchFinder::join_points(std::span<const ContactPoint> points, int first_point, const Body* a, const Body* b) {
  const int most_vertices = std::max(a->mesh.source_vertex_count(), b->mesh.source_vertex_count());
  if (first_at_vertex_.size() < 2 * static_cast<std::size_t>(most_vertices))
    first_at_vertex_.resize(2 * static_cast<std::size_t>(most_vertices), -1);
  at_vertex_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for_each_vertex(points[i], a == b ? 0 : 1, [&](std::int64_t vertex) {
      join_at_vertex(points, first_point, static_cast<int>(i), static_cast<std::size_t>(vertex), a != b);
    });
  }
}

void PatchFinder::join_at_vertex(std::span<const ContactPoint> points, int first_point, int point, std::size_t vertex,
                                 bool by_normal) {
  bool alone = true;
  int last = -1;
  for (int k = first_at_vertex_[vertex]; k >= 0; k = at_vertex_[k].next) {
    last = k;
    const int one = at_vertex_[k].point;
    if (by_normal && !(points[one].normal.dot(points[point].normal) >= 0.0)) continue;
    join(first_point + one, first_point + point);
    alone = false;
  }
  if (!alone) return;
  (last < 0 ? first_at_vertex_[vertex] : at_vertex_[last].next) = static_cast<int>(at_vertex_.size());
  at_vertex_.push_back({point, -1});
}

// Points of a body with a plane, each of a vertex.
void PatchFinder::join_along_edges(std::span<const ContactPoint> points, int first_point, const Body& body, int side) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int source = side == 0 ? points[i].a_vertices[0] : points[i].b_vertices[0];
    for (const int next : body.features->neighbors(body.features->vertex_of_source(source))) {
      const int at = first_at_vertex_[2 * static_cast<std::size_t>(body.mesh.source_vertex(next)) +
                                      static_cast<std::size_t>(side)];
      if (at >= 0) join(first_point + at_vertex_[at].point, first_point + static_cast<int>(i));
    }
  }
}

// A facet pair joins the first point at each of its corners.
void PatchFinder::join_points_and_facets(std::span<const FacetPair> pairs, const Body* a, const Body* b) {
  const int first_point = static_cast<int>(pairs.size());
  for (int i = 0; i < first_point; ++i) {
    for_each_vertex(pairs[i], *a, *b, a == b ? 0 : 1, [&](std::int64_t vertex) {
      const int first = first_at_vertex_[static_cast<std::size_t>(vertex)];
      if (first >= 0) join(i, first_point + at_vertex_[first].point);
    });
  }
}

int PatchFinder::number(std::span<const FacetPair> facet_pairs, std::span<ContactPoint> points, const Body* a,
                        const Body* b) {
  parent_.resize(facet_pairs.size() + points.size());
  std::iota(parent_.begin(), parent_.end(), 0);
  if (a->plane == nullptr && b->plane == nullptr) {
    join_facet_pairs(facet_pairs);
  } else {
    join_facets_by_corners(facet_pairs, *a, *b);
  }
  join_points(points, static_cast<int>(facet_pairs.size()), a, b);
  if (a->plane != nullptr || b->plane != nullptr)
    join_along_edges(points, static_cast<int>(facet_pairs.size()), a->plane != nullptr ? *b : *a,
                     a->plane != nullptr ? 1 : 0);
  join_points_and_facets(facet_pairs, a, b);
  for (const ContactPoint& point : points)
    for_each_vertex(point, a == b ? 0 : 1, [&](std::int64_t v) { first_at_vertex_[static_cast<std::size_t>(v)] = -1; });
  number_.resize(parent_.size());
  int count = 0;
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    const auto own = static_cast<std::size_t>(root(static_cast<int>(i)));
    number_[i] = own == i ? count++ : number_[own];
    if (i >= facet_pairs.size()) points[i - facet_pairs.size()].patch = number_[i];
  }
  return count;
}

// Members of a patch stand together, ascending.
void PatchFinder::list_members(const PatchInput& input, int count, PatchSet& set) {
  const std::size_t pairs = input.facet_pairs.size();
  const auto list = [&](std::size_t first, std::size_t last, std::vector<int>& members,
                        std::span<const int> Patch::*shown) {
    begin_.assign(static_cast<std::size_t>(count) + 1, 0);
    for (std::size_t i = first; i < last; ++i) ++begin_[static_cast<std::size_t>(number_[i]) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    members.resize(last - first);
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
      set.patches[k].*shown = std::span(members).subspan(begin_[k], begin_[k + 1] - begin_[k]);
    for (std::size_t i = first; i < last; ++i) members[begin_[number_[i]]++] = static_cast<int>(i - first);
  };
  list(0, pairs, set.facet_pairs, &Patch::facet_pairs);
  list(pairs, number_.size(), set.points, &Patch::points);
  set.vertices.clear();
  const int b_side = &input.a == &input.b ? 0 : 1;
  for (std::size_t i = 0; i < number_.size(); ++i) {
    const auto add = [&](std::int64_t vertex) { set.vertices.push_back({vertex, number_[i]}); };
    if (i < pairs) {
      for_each_vertex(input.facet_pairs[i], input.a, input.b, b_side, add);
    } else {
      for_each_vertex(input.points[i - pairs], b_side, add);
    }
  }
  std::ranges::sort(set.vertices);
  set.vertices.erase(std::unique(set.vertices.begin(), set.vertices.end()), set.vertices.end());
}

void PatchFinder::find(const PatchInput& input, PatchSet& set) {
  const int count = number(input.facet_pairs, input.points, &input.a, &input.b);
  set.patches.assign(count, Patch{});
  set.spanning.assign(count, Spanning{});
  list_members(input, count, set);
  list_last_spanning(input.last);
  for (Patch& patch : set.patches) {
    places_.clear();
    if (patch.points.empty()) {
      is_with_plane(input) ? shape_by_plane(input, patch) : shape_by_facets(input, patch);
      for (const int i : patch.facet_pairs) places_.push_back(center_of(common_box(input, input.facet_pairs[i])));
    } else {
      shape_by_points(input, patch);
    }
    Box all;
    for (const Vec3& p : places_) all = extended(all, p);
    const double scale = narrowphase::unit_scale(longest(all));
    const auto [u, v] = across(from_eigen(patch.direction));
    const Vec3 center = from_eigen(patch.point);
    flat_.clear();
    for (const Vec3& p : places_) flat_.push_back({scale * dot(u, p - center), scale * dot(v, p - center)});
    if (!patch.points.empty()) span(input, patch, set.spanning[&patch - set.patches.data()], scale);
    patch.area = area_of_hull(scale);
  }
}

// A point weighs as much as it is nearer than the margins: one that comes or goes weighs nothing.
void PatchFinder::shape_by_points(const PatchInput& input, Patch& patch) {
  const auto point = [&](int i) -> const ContactPoint& { return input.points[i]; };
  double least = std::numeric_limits<double>::infinity();
  for (const int i : patch.points) least = std::min(least, point(i).gap);
  const double most = input.reach - least;
  Vec3 normal, center;
  double sum = 0.0;
  for (const int i : patch.points) {
    const double weight = most > 0.0 ? std::max(0.0, (input.reach - point(i).gap) / most) : 1.0;
    const Vec3 at = place(input, point(i));
    places_.push_back(at);
    const double side = &input.a == &input.b && dot(normal, from_eigen(point(i).normal)) < 0.0 ? -1.0 : 1.0;
    normal = normal + (side * weight) * from_eigen(point(i).normal);
    center = center + weight * (at - places_[0]);
    sum += weight;
  }
  const double length = norm(normal);
  patch.direction = length > 0.0 ? to_eigen((1.0 / length) * normal) : to_eigen(input.direction);
  patch.point = to_eigen(places_[0] + (1.0 / sum) * center);
  patch.depth = -least;
}

// A vertex that is no minimum of both surfaces counts if its normal is nearly one of theirs: the corners of a box that
// is tilted do, vertices of a floor ahead of it, whose normals lean against it, do not. Where there are no minima, or
// their normals point in many ways, all count.
void PatchFinder::list_counting(const PatchInput& input, const Patch& patch) {
  const auto point = [&](std::size_t i) -> const ContactPoint& { return input.points[patch.points[i]]; };
  const bool of_itself = &input.a == &input.b;
  const auto along_a_minimum = [&](std::size_t i) {
    return std::ranges::any_of(minimum_normals_, [&](const Vec3& normal) {
      const double along = dot(normal, from_eigen(point(i).normal));
      return (of_itself ? std::abs(along) : along) >= kSameWay;
    });
  };
  minimum_normals_.clear();
  for (std::size_t i = 0; i < patch.points.size() && minimum_normals_.size() <= kMostWays; ++i) {
    if (point(i).minimum && !along_a_minimum(i)) minimum_normals_.push_back(from_eigen(point(i).normal));
  }
  const bool all = minimum_normals_.empty() || minimum_normals_.size() > kMostWays;
  counting_.clear();
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    if (all || point(i).minimum || along_a_minimum(i)) counting_.push_back(i);
  }
}

// The deepest, the one farthest from it, the one farthest from the line of both, the one that adds most to the three.
PatchFinder::Spanned PatchFinder::find_spanning(const PatchInput& input, const Patch& patch, double scale) const {
  const auto farthest = [&](const auto& distance) {
    std::size_t best = counting_[0];
    double most = -1.0;
    for (const std::size_t i : counting_) {
      const double one = distance(flat_[i]);
      if (one > most) best = i, most = one;
    }
    return std::pair(best, most);
  };
  Spanned chosen;
  chosen.count = 1;
  // Of those that are the deepest but for rounding, the one farthest out.
  double least = std::numeric_limits<double>::infinity(), farthest_out = -1.0;
  for (const std::size_t i : counting_) least = std::min(least, input.points[patch.points[i]].gap);
  for (const std::size_t i : counting_) {
    const double above = input.points[patch.points[i]].gap - least;
    const double out = narrowphase::length_of({flat_[i].x, flat_[i].y, 0.0});
    if (scale * above <= kSpansNothing && out > farthest_out) chosen.place[0] = i, farthest_out = out;
  }
  const PlanePoint p = flat_[chosen.place[0]];
  const auto [second, length] = farthest([&](PlanePoint r) {
    return narrowphase::length_of({r.x - p.x, r.y - p.y, 0.0});
  });
  if (!(length > kSpansNothing)) return chosen;
  chosen.place[chosen.count++] = second;
  const PlanePoint q = flat_[second];
  const auto [third, area] = farthest([&](PlanePoint r) { return std::abs(turn(p, q, r)); });
  if (!(area > kSpansNothing)) return chosen;
  chosen.place[chosen.count++] = third;
  const PlanePoint r = flat_[third];
  const auto [fourth, added] = farthest([&](PlanePoint s) { return area_beside(p, q, r, s); });
  if (added > kSpansNothing) chosen.place[chosen.count++] = fourth;
  return chosen;
}

// Twice the area of three or four points, or the length of two.
double PatchFinder::area_spanned(const Spanned& spanned) const {
  const auto at = [&](std::size_t k) { return flat_[spanned.place[k]]; };
  if (spanned.count < 2) return 0.0;
  if (spanned.count == 2) return narrowphase::length_of({at(1).x - at(0).x, at(1).y - at(0).y, 0.0});
  const double three = std::abs(turn(at(0), at(1), at(2)));
  return spanned.count == 3 ? three : three + std::max(0.0, area_beside(at(0), at(1), at(2), at(3)));
}

void PatchFinder::list_last_spanning(const PatchSet* last) {
  last_spanning_.clear();
  if (last == nullptr) return;
  last_spanned_.assign(last->spanning.size(), {});
  for (std::size_t k = 0; k < last->spanning.size(); ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (last->spanning[k].ids[i] != 0) last_spanning_.push_back({last->spanning[k].ids[i], k, i});
    }
  }
  std::ranges::sort(last_spanning_, {}, [](const LastSpanning& one) { return std::pair(one.id, one.patch); });
}

// The points of the last step that are all in this patch, of the patch that was first; none if it has no such.
PatchFinder::Spanned PatchFinder::find_last_spanning(const PatchInput& input, const Patch& patch,
                                                     const PatchSet& last) {
  met_.clear();
  for (const std::size_t i : counting_) {
    const std::uint64_t id = input.points[patch.points[i]].id;
    auto one = std::ranges::lower_bound(last_spanning_, id, {}, &LastSpanning::id);
    for (; one != last_spanning_.end() && one->id == id; ++one) {
      Spanned& spanned = last_spanned_[one->patch];
      if (spanned.count == 0) met_.push_back(one->patch);
      spanned.place[one->place] = i;
      ++spanned.count;
    }
  }
  std::ranges::sort(met_);
  Spanned found;
  for (const std::size_t k : met_) {
    const auto& ids = last.spanning[k].ids;
    const auto count = static_cast<std::size_t>(std::ranges::count_if(ids, [](std::uint64_t id) { return id != 0; }));
    const Spanned spanned = std::exchange(last_spanned_[k], {});
    if (found.count == 0 && spanned.count == count) found = spanned;
  }
  return found;
}

// Those of the last step are kept while as many would span the patch, they span nearly as much as the best of this step
// and one of them is nearly as deep as the deepest.
void PatchFinder::span(const PatchInput& input, Patch& patch, Spanning& spanning, double scale) {
  list_counting(input, patch);
  Spanned chosen = find_spanning(input, patch, scale);
  if (!last_spanning_.empty()) {
    const Spanned kept = find_last_spanning(input, patch, *input.last);
    const auto least_gap = [&](const Spanned& spanned) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < spanned.count; ++k)
        least = std::min(least, input.points[patch.points[spanned.place[k]]].gap);
      return least;
    };
    if (kept.count == chosen.count && area_spanned(kept) >= kNearlyAll * area_spanned(chosen) &&
        scale * (least_gap(kept) - least_gap(chosen)) <= kNearlyDeepest)
      chosen = kept;
  }
  for (std::size_t k = 0; k < chosen.count; ++k) {
    patch.spanning[k] = patch.points[chosen.place[k]];
    spanning.ids[k] = input.points[patch.spanning[k]].id;
  }
}

// That of the convex hull of flat_ (Andrew's monotone chain, 1979).
double PatchFinder::area_of_hull(double scale) {
  std::ranges::sort(flat_);
  hull_.clear();
  for (int half = 0; half < 2; ++half) {
    const std::size_t first = hull_.size();
    for (const PlanePoint& p : flat_) {
      while (hull_.size() >= first + 2 && turn(hull_[hull_.size() - 2], hull_.back(), p) <= 0.0) hull_.pop_back();
      hull_.push_back(p);
    }
    hull_.pop_back();
    std::ranges::reverse(flat_);
  }
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < hull_.size(); ++i) twice += turn(hull_[0], hull_[i], hull_[i + 1]);
  return 0.5 * std::max(0.0, twice) / scale / scale;
}

}  // namespace tact
