// Which vertices are past a surface that has no inside to tell: from the ends of edges that meet it, from vertex to
// vertex along edges that meet nothing, as long as each has an exit.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "narrowphase/crossing/crossing.h"

namespace tact::narrowphase {

/// A vertex that may be past the surface.
struct ReachedVertex {
  int source_vertex, vertex;  // by the caller's number, and by the mesh's
  int from;     // the vertex that it was reached from, by the caller's number; -1: from an edge that is cut
  int facet;    // of the surface, where it is past it, by the caller's number
  Vec3 facing;  // the side of the facet on which the vertex belongs
};

/// Buffers are reused.
class SpreadPast {
 public:
  /// Begins at those ends of edges that are, exactly, beyond a facet of `surface` that the edge meets, as seen from the
  /// side of facing(hit, end), a unit vector along which the facet's normal is more than `least`.
  template <class Facing>
  void begin(const CrossedSurface& own, const ScaledMesh& surface, double least, const Facing& facing) {
    reached_.clear();
    PredicateCounts counts;
    for (const EdgeHit& hit : own.cut.hits()) {
      const int facet = surface.mesh.facet_of_source(hit.facet);
      const Triangle t = surface.mesh.triangle(facet);
      const Vec3 normal = surface.unit_normal(facet);
      const EdgeVertices ends = own.mesh.features->edge(hit.edge);
      for (std::size_t k = 0; k < 2; ++k) {
        const Vec3 side = facing(hit, k);
        const double along = dot(normal, side);
        if (!(std::abs(along) > least)) continue;
        const int below = orient3d(t[0], t[1], t[2], own.mesh.mesh->position(ends[k]), counts);
        if (below == (along > 0.0 ? 1 : -1)) reached_.push_back({hit.vertices[k], ends[k], -1, hit.facet, side});
      }
    }
  }

  /// Gives `own` the vertices past `surface` and their exits. exit_of(reached) gives the exit of a vertex that is past
  /// it; of several the nearest counts.
  template <class ExitOf>
  void run(CrossedSurface& own, const ScaledMesh& surface, const ExitOf& exit_of) {
    while (!reached_.empty()) {
      take_reached(own, surface, exit_of);
      spread(own);
    }
  }

 private:
  // In the order of the caller's numbers, so that no answer depends on how facets are grouped.
  template <class ExitOf>
  void take_reached(CrossedSurface& own, const ScaledMesh& surface, const ExitOf& exit_of) {
    std::ranges::sort(reached_, {}, [](const ReachedVertex& one) {
      return std::tuple(one.source_vertex, one.facet, one.facing.x, one.facing.y, one.facing.z);
    });
    next_.clear();
    for (std::size_t i = 0; i < reached_.size();) {
      const ReachedVertex first = reached_[i];
      const std::size_t begin = i;
      std::optional<NearestExit> best;
      for (; i < reached_.size() && reached_[i].source_vertex == first.source_vertex; ++i) {
        if (own.exits.find(first.source_vertex) != nullptr) continue;
        const std::optional<NearestExit> exit = exit_of(reached_[i]);
        if (exit && (!best || exit->distance < best->distance)) best = exit;
      }
      if (!best) continue;
      own.exits.add(first.source_vertex, *best);
      if (!own.cut.is_past(first.source_vertex)) own.cut.add_past(first.vertex);
      for (std::size_t k = begin; k < i; ++k) {
        if (reached_[k].from >= 0) own.cut.join_patches(first.source_vertex, reached_[k].from);
      }
      next_.push_back(
          {first.source_vertex, first.vertex, first.from, surface.mesh.source_facet(best->facet), best->direction});
    }
  }

  void spread(const CrossedSurface& own) {
    reached_.clear();
    for (const ReachedVertex& one : next_) {
      for (const int to : own.mesh.features->neighbors(one.vertex)) {
        const int source = own.mesh.mesh->source_vertex(to);
        if (own.exits.find(source) == nullptr && !own.cut.is_cut_between(one.vertex, to))
          reached_.push_back({source, to, one.source_vertex, one.facet, one.facing});
      }
    }
  }

  std::vector<ReachedVertex> reached_, next_;
};

}  // namespace tact::narrowphase
