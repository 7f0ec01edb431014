#include "narrowphase/distance/surface_distance.h"

#include <algorithm>
#include <numbers>

namespace tact::narrowphase {

bool surface_distance_below(double limit, const ClusteredMesh& mesh, const Features& features, double scale,
                            const PointOnSurface& from, const PointOnSurface& to, SurfaceWays& ways) {
  auto& reached = ways.reached;
  reached.clear();
  const auto position = [&](int v) { return scale * mesh.position(v); };
  const auto reach = [&](double length, int vertex) {
    if (!(length < limit)) return;
    const auto known = std::ranges::find(reached, vertex, &std::pair<double, int>::second);
    if (known == reached.end()) {
      reached.emplace_back(length, vertex);
    } else if (length < known->first) {
      known->first = length;
    }
  };
  for (const int v : from.vertices) reach(norm(position(v) - from.point), v);
  for (std::size_t done = 0; done < reached.size(); ++done) {
    const auto rest = reached.begin() + static_cast<std::ptrdiff_t>(done);
    std::iter_swap(rest, std::min_element(rest, reached.end()));
    const auto [length, vertex] = reached[done];
    if (std::ranges::find(to.vertices, vertex) != to.vertices.end() &&
        length + norm(position(vertex) - to.point) < limit)
      return true;
    for (const int next : features.neighbors(vertex)) reach(length + norm(position(next) - position(vertex)), next);
  }
  return false;
}

bool too_near_along(const ScaledMesh& mesh, double reach, const PointOnSurface& from, const PointOnSurface& to,
                    SurfaceWays& ways) {
  const double limit = 0.5 * std::numbers::pi * reach;
  return reach > 0.0 && surface_distance_below(limit, mesh.mesh, mesh.features, mesh.scale, from, to, ways);
}

}  // namespace tact::narrowphase
