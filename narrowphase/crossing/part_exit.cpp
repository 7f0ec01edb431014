#include "narrowphase/crossing/part_exit.h"

#include <algorithm>
#include <utility>

#include "narrowphase/crossing/crossing.h"
#include "narrowphase/numeric/angle.h"

namespace tact::narrowphase {

namespace {

// Facets with a common edge may be as far from a vertex as each other, but for some roundings; lengths are near 1.
constexpr double kRounding = 1e-13;

bool has_place(const Corners& corners, const PlaceOnFeature& place) {
  return std::ranges::all_of(place.used(), [&](int w) { return std::ranges::find(corners, w) != corners.end(); });
}

}  // namespace

FacetsAround::FacetsAround(const ClusteredMesh& mesh) {
  begin_.assign(static_cast<std::size_t>(mesh.source_vertex_count()) + 1, 0);
  const auto for_each_corner = [&](const auto& visit) {
    for (int source = 0; source < mesh.facet_count(); ++source) {
      const Corners corners = mesh.corners(mesh.facet_of_source(source));
      for (std::size_t k = 0; k < 3; ++k) {
        const bool again = std::find(corners.begin(), corners.begin() + k, corners[k]) != corners.begin() + k;
        if (!again) visit(mesh.source_vertex(corners[k]), source);
      }
    }
  };
  for_each_corner([&](int vertex, int) { ++begin_[vertex + 1]; });
  for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
  facets_.resize(begin_.back());
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for_each_corner([&](int vertex, int source) { facets_[next[vertex]++] = source; });
}

std::span<const int> FacetsAround::operator[](int source_vertex) const {
  const auto v = static_cast<std::size_t>(source_vertex);
  return std::span(facets_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
}

Vec3 PartExitFinder::normal_at(const ScaledMesh& mesh, const NearestExit& exit) const {
  if (exit.place.vertices[2] >= 0) return mesh.unit_normal(exit.facet);
  const bool is_edge = exit.place.vertices[1] >= 0;
  Vec3 sum;
  int at_edge = 0;
  for (const int source : around_[mesh.mesh.source_vertex(exit.place.vertices[0])]) {
    const int facet = mesh.mesh.facet_of_source(source);
    const Corners c = mesh.mesh.corners(facet);
    const Vec3 normal = mesh.unit_normal(facet);
    if (is_edge) {
      if (std::ranges::find(c, exit.place.vertices[1]) == c.end()) continue;
      ++at_edge;
      sum = sum + normal;
      continue;
    }
    const auto k = static_cast<std::size_t>(std::ranges::find(c, exit.place.vertices[0]) - c.begin());
    for (const std::size_t side : {k, (k + 2) % 3}) {
      const int edge = mesh.features.facet_edge(facet, static_cast<int>(side));
      if (edge >= 0 && mesh.features.opposite(edge).size() == 1) return {};
    }
    const Vec3 p = mesh.position(c[(k + 1) % 3]) - mesh.position(c[k]),
               q = mesh.position(c[(k + 2) % 3]) - mesh.position(c[k]);
    sum = sum + angle_between(p, q) * normal;
  }
  return is_edge && at_edge == 1 ? Vec3{} : sum;
}

bool PartExitFinder::is_beside(const ClusteredMesh& mesh, int vertex, const NearestExit& exit) const {
  return std::ranges::any_of(around_[mesh.source_vertex(vertex)], [&](int source) {
    return has_place(mesh.corners(mesh.facet_of_source(source)), exit.place);
  });
}

// Of the facets at an edge or a vertex, rounding would choose: the caller's first one with an area counts.
int PartExitFinder::facet_at(const ScaledMesh& mesh, const NearestExit& exit) const {
  if (exit.place.vertices[2] >= 0) return exit.facet;
  for (const int source : around_[mesh.mesh.source_vertex(exit.place.vertices[0])]) {
    const int facet = mesh.mesh.facet_of_source(source);
    if (has_place(mesh.mesh.corners(facet), exit.place) && mesh.unit_normal(facet) != Vec3{}) return facet;
  }
  return exit.facet;
}

std::optional<NearestExit> PartExitFinder::find(const ScaledMesh& mesh, int vertex, int from) {
  return find(mesh, vertex, from, [](const NearestExit&) { return true; });
}

std::optional<NearestExit> PartExitFinder::find_behind(const ScaledMesh& mesh, int vertex, int from) {
  return find(mesh, vertex, from, [&](const NearestExit& exit) {
    return exit.distance > kTouches && dot(mesh.unit_normal(exit.facet), exit.direction) > kFaces;
  });
}

// Of those that count.
template <class Counts>
std::optional<NearestExit> PartExitFinder::find(const ScaledMesh& mesh, int vertex, int from, const Counts& counts) {
  const Vec3 v = mesh.position(vertex);
  seen_.resize(static_cast<std::size_t>(mesh.mesh.facet_count()));
  std::optional<NearestExit> best;
  double within = 0.0;
  const auto look_at = [&](int source) {
    if (std::exchange(seen_[source], 1) != 0) return;
    reached_.push_back(source);
    const int facet = mesh.mesh.facet_of_source(source);
    const Corners corners = mesh.mesh.corners(facet);
    if (std::ranges::find(corners, vertex) != corners.end()) return;
    const auto exit = exit_to_facet(mesh, facet, v);
    if (!exit) return;
    if (reached_.size() == 1) within = exit->distance * (1.0 + kRounding) + kRounding;
    if (exit->distance > within) return;
    spread_.push_back(facet);
    if (!counts(*exit)) return;
    const bool better = !best || exit->distance < best->distance ||
                        (exit->distance == best->distance && source < mesh.mesh.source_facet(best->facet));
    if (better) best = exit;
  };
  look_at(mesh.mesh.source_facet(from));
  for (; !spread_.empty();) {
    const int facet = spread_.back();
    spread_.pop_back();
    for (const int corner : mesh.mesh.corners(facet)) {
      for (const int source : around_[mesh.mesh.source_vertex(corner)]) look_at(source);
    }
  }
  for (const int source : reached_) seen_[source] = 0;
  reached_.clear();
  if (best) best->facet = facet_at(mesh, *best);
  return best;
}

}  // namespace tact::narrowphase
