#include "narrowphase/self/crossing_sides.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tact::narrowphase {

namespace {

Vec3 unit_or_zero(Vec3 v) {
  const double length = norm(v);
  return length > 0.0 ? (1.0 / length) * v : Vec3{};
}

bool have_common(std::span<const int> some, const std::array<int, 3>& others) {
  return std::ranges::any_of(some, [&](int v) { return std::ranges::find(others, v) != others.end(); });
}

// The normal of the facet on whose side most of the edge is: 1 for all of it, 0 where the facet meets its middle.
Vec3 longer_side(const ScaledMesh& mesh, const EdgeHit& hit, Vec3 normal) {
  const Vec3 corner = mesh.position(mesh.mesh.corners(mesh.mesh.facet_of_source(hit.facet))[0]);
  const EdgeVertices ends = mesh.features.edge(hit.edge);
  const double p = dot(normal, mesh.position(ends[0]) - corner), q = dot(normal, mesh.position(ends[1]) - corner);
  const double length = std::abs(p) + std::abs(q);
  return length > 0.0 ? (p + q) / length * normal : Vec3{};
}

}  // namespace

Vec3 unit_normal_of_source(const ScaledMesh& mesh, int source_facet) {
  return mesh.unit_normal(mesh.mesh.facet_of_source(source_facet));
}

std::array<int, 3> source_corners(const ClusteredMesh& mesh, int source_facet) {
  const Corners c = mesh.corners(mesh.facet_of_source(source_facet));
  return {mesh.source_vertex(c[0]), mesh.source_vertex(c[1]), mesh.source_vertex(c[2])};
}

void LastPoints::take(std::span<const FeaturePoint> points) {
  points_ = points;
  entries_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const bool is_a : {true, false}) {
      for (const int v : is_a ? points[i].a : points[i].b) {
        if (v >= 0) entries_.push_back({v, static_cast<int>(i), is_a});
      }
    }
  }
  std::ranges::sort(entries_, {}, [](const Entry& one) { return std::tuple(one.vertex, one.point, one.is_a); });
}

Vec3 LastPoints::side(std::span<const int> own, std::span<const int> other) const {
  Vec3 sum;
  for (std::size_t k = 0; k < own.size(); ++k) {
    auto one = std::ranges::lower_bound(entries_, own[k], {}, &Entry::vertex);
    for (; one != entries_.end() && one->vertex == own[k]; ++one) {
      const FeaturePoint& point = points_[one->point];
      const auto &mine = one->is_a ? point.a : point.b, &theirs = one->is_a ? point.b : point.a;
      if (!have_common(other, theirs) || have_common(own.first(k), mine)) continue;
      sum = one->is_a ? sum - point.normal : sum + point.normal;
    }
  }
  return sum;
}

std::size_t CrossingLines::place(int source_facet) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(facets_, source_facet) - facets_.begin());
}

CrossingLines::Found CrossingLines::root_of(std::size_t place) {
  bool other_layer = false;
  auto at = place;
  while (node_[at].parent != static_cast<int>(at)) {
    other_layer ^= node_[at].other_layer;
    at = static_cast<std::size_t>(node_[at].parent);
  }
  // The way there is made short.
  bool rest = other_layer;
  for (auto i = place; i != at;) {
    const Node was = node_[i];
    node_[i].parent = static_cast<int>(at);
    node_[i].other_layer = rest;
    rest ^= was.other_layer;
    i = static_cast<std::size_t>(was.parent);
  }
  return {static_cast<int>(at), other_layer};
}

// The root of a line is its least facet, and of the first layer.
void CrossingLines::join(const FacetPair& pair) {
  const Found a = root_of(place(pair.a)), b = root_of(place(pair.b));
  const bool differ = a.other_layer == b.other_layer;  // then the roots must
  if (a.root == b.root) {
    if (differ) node_[a.root].mixed = true;
    return;
  }
  const auto [first, second] = std::minmax(a.root, b.root);
  node_[second].parent = first;
  node_[second].other_layer = differ;
  node_[first].mixed = node_[first].mixed || node_[second].mixed;
}

void CrossingLines::find(std::span<const FacetPair> pairs) {
  facets_.clear();
  for (const FacetPair& pair : pairs) facets_.insert(facets_.end(), {pair.a, pair.b});
  std::ranges::sort(facets_);
  facets_.erase(std::unique(facets_.begin(), facets_.end()), facets_.end());
  node_.clear();
  for (std::size_t i = 0; i < facets_.size(); ++i) node_.push_back({static_cast<int>(i), false, false, -1});
  for (const FacetPair& pair : pairs) join(pair);
  count_ = 0;
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    const Found found = root_of(i);
    if (found.root == static_cast<int>(i)) node_[i].line = static_cast<int>(count_++);
    node_[i].line = node_[found.root].line;
    node_[i].mixed = node_[found.root].mixed;
    node_[i].other_layer = found.other_layer;
  }
}

double CrossingLines::layer_of(int source_facet) const {
  const Node& node = node_[place(source_facet)];
  return node.mixed ? 0.0 : node.other_layer ? -1.0 : 1.0;
}

void CrossingSides::find(const ScaledMesh& mesh, const SelfCrossingInput& input, std::span<const EdgeHit> hits) {
  last_.take(input.last);
  sides_.assign(hits.size(), {});
  if (input.surface == SurfaceKind::sheet) return find_of_sheet(mesh, input, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) sides_[i] = unit_normal_of_source(mesh, hits[i].facet);
}

// Turns what is guessed of a line around if fewer vertices then have crossed.
void CrossingSides::turn_guesses(const ScaledMesh& mesh, std::span<const EdgeHit> hits) {
  ends_.clear();
  for (const EdgeHit& hit : hits) {
    const int line = lines_.line_of(hit.facet);
    if (of_lines_[line] != Vec3{}) continue;
    const Vec3 normal = unit_normal_of_source(mesh, hit.facet);
    const Vec3 corner = mesh.position(mesh.mesh.corners(mesh.mesh.facet_of_source(hit.facet))[0]);
    const double along = lines_.layer_of(hit.facet) * dot(normal, guesses_of_lines_[line]);
    const EdgeVertices ends = mesh.features.edge(hit.edge);
    for (std::size_t k = 0; k < 2; ++k)
      ends_.emplace_back(line, along * dot(normal, mesh.position(ends[k]) - corner) < 0.0, hit.vertices[k]);
  }
  std::ranges::sort(ends_);
  ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
  more_crossed_.assign(lines_.count(), 0);
  for (const auto& [line, has_crossed, vertex] : ends_) more_crossed_[line] += has_crossed ? 1 : -1;
  for (std::size_t line = 0; line < lines_.count(); ++line) {
    if (more_crossed_[line] > 0) guesses_of_lines_[line] = -guesses_of_lines_[line];
  }
}

void CrossingSides::find_of_sheet(const ScaledMesh& mesh, const SelfCrossingInput& input,
                                  std::span<const EdgeHit> hits) {
  lines_.find(input.facet_pairs);
  guesses_.assign(hits.size(), {});
  of_lines_.assign(lines_.count(), {});
  guesses_of_lines_.assign(lines_.count(), {});
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const EdgeHit& hit = hits[i];
    sides_[i] = last_.side(hit.vertices, source_corners(mesh.mesh, hit.facet));
    guesses_[i] = longer_side(mesh, hit, unit_normal_of_source(mesh, hit.facet));
    const int line = lines_.line_of(hit.facet);
    const double layer = lines_.layer_of(hit.facet);
    of_lines_[line] = of_lines_[line] + layer * sides_[i];
    guesses_of_lines_[line] = guesses_of_lines_[line] + layer * guesses_[i];
  }
  turn_guesses(mesh, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const int line = lines_.line_of(hits[i].facet);
    const double layer = lines_.layer_of(hits[i].facet);
    const Vec3 known = layer * of_lines_[line];
    if (sides_[i] == Vec3{})
      sides_[i] = known != Vec3{} ? known : layer != 0.0 ? layer * guesses_of_lines_[line] : guesses_[i];
    sides_[i] = unit_or_zero(sides_[i]);
  }
}

}  // namespace tact::narrowphase
