#include "narrowphase/crossing/crossing_sides.h"

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
  const auto [p, q] = heights_of_ends(mesh, hit, normal);
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

std::array<double, 2> heights_of_ends(const ScaledMesh& mesh, const EdgeHit& hit, Vec3 normal) {
  const Vec3 corner = mesh.position(mesh.features.corners(mesh.mesh.facet_of_source(hit.facet))[0]);
  const EdgeVertices ends = mesh.features.edge(hit.edge);
  return {dot(normal, mesh.position(ends[0]) - corner), dot(normal, mesh.position(ends[1]) - corner)};
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

const CrossingLines::Node& CrossingLines::node(int source_facet) const {
  return *std::ranges::lower_bound(nodes_, source_facet, {}, &Node::facet);
}

// From the least facet of each line, which is of the first layer.
void CrossingLines::find(std::span<const FacetPair> pairs) {
  links_.clear();
  nodes_.clear();
  is_mixed_.clear();
  for (const FacetPair& pair : pairs) links_.insert(links_.end(), {{pair.a, pair.b}, {pair.b, pair.a}});
  std::ranges::sort(links_);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (i == 0 || links_[i].first != links_[i - 1].first) nodes_.push_back({links_[i].first, static_cast<int>(i)});
  }
  const auto reach = [&](std::size_t at, int line, double layer) {
    nodes_[at].line = line;
    nodes_[at].layer = layer;
    next_.push_back(static_cast<int>(at));
  };
  for (std::size_t first = 0; first < nodes_.size(); ++first) {
    if (nodes_[first].line >= 0) continue;
    const auto line = static_cast<int>(is_mixed_.size());
    is_mixed_.push_back(0);
    for (reach(first, line, 1.0); !next_.empty();) {
      const Node from = nodes_[next_.back()];
      next_.pop_back();
      for (auto i = static_cast<std::size_t>(from.first_link); i < links_.size(); ++i) {
        if (links_[i].first != from.facet) break;
        const auto to = static_cast<std::size_t>(&node(links_[i].second) - nodes_.data());
        if (nodes_[to].line < 0) reach(to, line, -from.layer);
        if (nodes_[to].layer == from.layer) is_mixed_[line] = 1;
      }
    }
  }
}

double CrossingLines::layer_of(int source_facet) const {
  const Node& one = node(source_facet);
  return is_mixed_[one.line] != 0 ? 0.0 : one.layer;
}

void CrossingSides::find(const ScaledMesh& mesh, SurfaceKind surface, std::span<const FacetPair> pairs,
                         std::span<const FeaturePoint> last, std::span<const EdgeHit> hits) {
  last_.take(last);
  sides_.assign(hits.size(), {});
  if (surface == SurfaceKind::sheet) return find_of_sheet(mesh, pairs, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) sides_[i] = unit_normal_of_source(mesh, hits[i].facet);
}

// Turns what is guessed of a line around if fewer vertices are past it then.
void CrossingSides::turn_guesses(const ScaledMesh& mesh, std::span<const EdgeHit> hits) {
  ends_.clear();
  for (const EdgeHit& hit : hits) {
    const int line = lines_.line_of(hit.facet);
    if (of_lines_[line] != Vec3{}) continue;
    const Vec3 normal = unit_normal_of_source(mesh, hit.facet);
    const double along = lines_.layer_of(hit.facet) * dot(normal, guesses_of_lines_[line]);
    const auto heights = heights_of_ends(mesh, hit, normal);
    for (std::size_t k = 0; k < 2; ++k) ends_.emplace_back(line, along * heights[k] < 0.0, hit.vertices[k]);
  }
  std::ranges::sort(ends_);
  ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
  more_past_.assign(lines_.count(), 0);
  for (const auto& [line, is_past, vertex] : ends_) more_past_[line] += is_past ? 1 : -1;
  for (std::size_t line = 0; line < lines_.count(); ++line) {
    if (more_past_[line] > 0) guesses_of_lines_[line] = -guesses_of_lines_[line];
  }
}

void CrossingSides::find_of_sheet(const ScaledMesh& mesh, std::span<const FacetPair> pairs,
                                  std::span<const EdgeHit> hits) {
  lines_.find(pairs);
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
