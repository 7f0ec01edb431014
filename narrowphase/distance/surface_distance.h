// How far it is from one point of a mesh to another along its edges.
#pragma once

#include <algorithm>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

/// A point of a surface, and the vertices of the feature that holds it.
struct PointOnSurface {
  std::span<const int> vertices;
  Vec3 point;
};

/// Memory of the search, used again.
struct SurfaceWays {
  std::vector<std::pair<double, int>> reached;  // length of the way, vertex
};

/// True if a path shorter than `limit` leads from one point to a vertex of its feature, along edges, and from a vertex
/// of the other's feature to the other point. position(v) is where a vertex is, in the unit of the points. After
/// Dijkstra, 1959, with a plain list, as a reach is a few edges.
template <class Position>
bool surface_distance_below(double limit, const Position& position, const Features& features,
                            const PointOnSurface& from, const PointOnSurface& to, SurfaceWays& ways) {
  auto& reached = ways.reached;
  reached.clear();
  // No way on is shorter than the straight one; the sums of lengths are rounded.
  const double farthest = (1.0 + 1e-9) * limit;
  const auto reach = [&](double length, int vertex) {
    if (!(length < limit) || length + norm(position(vertex) - to.point) > farthest) return;
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

/// Whether two places of one mesh are too near along it to have a contact: nearer than the places that are one `reach`
/// apart on a sheet folded as tightly as its thickness lets it. False for a reach of zero.
template <class Position>
bool too_near_along(const Position& position, const Features& features, double reach, const PointOnSurface& from,
                    const PointOnSurface& to, SurfaceWays& ways) {
  const double limit = 0.5 * std::numbers::pi * reach;
  return reach > 0.0 && surface_distance_below(limit, position, features, from, to, ways);
}
bool too_near_along(const ScaledMesh& mesh, double reach, const PointOnSurface& from, const PointOnSurface& to,
                    SurfaceWays& ways);

}  // namespace tact::narrowphase
