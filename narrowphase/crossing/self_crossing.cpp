#include "narrowphase/crossing/self_crossing.h"

#include <algorithm>

#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

const Crossing& SelfCrossing::find(const SelfCrossingInput& input) {
  CrossedSurface& own = crossing_.surfaces[0];
  own.begin(input.mesh, input.surface, -1.0, unit_scale_of(input.mesh.mesh->box()));
  crossing_.of_itself = true;
  crossing_.reach = own.scale * input.reach;
  if (exits_ == nullptr) exits_ = std::make_unique<PartExitFinder>(*input.mesh.mesh);
  take_pairs(input);
  own.cut.begin(own.mesh, pairs_, Cut::Which::both);
  edge_hits_.run(own.mesh, own.mesh, pairs_, own.cut.edge_hits(), own.cut.edge_hits());
  if (!winds_) winds_ = own.surface == SurfaceKind::closed && is_closed(own.mesh);
  if (*winds_) append_hits_beside(pairs_);
  own.cut.order_hits();
  crossing_.within = longest_exit();
  const ScaledMesh mesh = own.scaled();
  crossing_.sides.find(mesh, own.surface, pairs_, input.last, own.cut.hits());
  too_far_.clear();
  spread_.begin(own, mesh, kFaces, [&](const EdgeHit& hit, std::size_t) { return crossing_.side_of(hit); });
  if (*winds_) {
    find_inside();
    spread_.run(own, mesh, [&](const ReachedVertex& one) { return exit_from_inside(one); });
  } else {
    spread_.run(own, mesh, [&](const ReachedVertex& one) { return exit_of(one); });
  }
  crossing_.limit_reached = any_too_far();
  return crossing_;
}

// A vertex that was reached in another way may have an exit all the same.
bool SelfCrossing::any_too_far() const {
  return std::ranges::any_of(too_far_, [&](int vertex) { return crossing_.a().exits.find(vertex) == nullptr; });
}

void SelfCrossing::take_pairs(const SelfCrossingInput& input) {
  pairs_.clear();
  const auto corners = [&](int source_facet) {
    return input.mesh.features->corners(input.mesh.mesh->facet_of_source(source_facet));
  };
  for (const FacetPair& pair : input.facet_pairs) {
    const Corners a = corners(pair.a), b = corners(pair.b);
    if (std::ranges::find_first_of(a, b) == a.end()) pairs_.push_back(pair);
  }
}

// Facets with one common vertex are none of the pairs. Those beside facets that meet may meet, too: then the surface is
// folded over the vertex, which has no inner side.
void SelfCrossing::append_hits_beside(std::span<const FacetPair> pairs) {
  CrossedSurface& own = crossing_.surfaces[0];
  const ScaledMesh mesh = own.scaled();
  std::vector<EdgeHit>& hits = own.cut.edge_hits();
  folded_.clear();
  const auto look_at = [&](int source_facet) {
    const int facet = mesh.mesh.facet_of_source(source_facet);
    for (const int corner : mesh.features.corners(facet)) {
      for (const int source : exits_->around()[mesh.mesh.source_vertex(corner)]) {
        const int other = mesh.mesh.facet_of_source(source);
        append_hit_across(facet, corner, other);
        append_hit_across(other, corner, facet);
      }
    }
  };
  for (const FacetPair& pair : pairs) {
    look_at(pair.a);
    look_at(pair.b);
  }
  for (const int vertex : folded_) own.cut.leave_out(vertex);
  std::ranges::sort(hits);
  hits.erase(std::unique(hits.begin(), hits.end()), hits.end());
}

// Of the edge of a facet across from a corner with another facet that has the corner.
void SelfCrossing::append_hit_across(int facet, int corner, int other) {
  const ScaledMesh mesh = crossing_.a().scaled();
  const Corners &own = mesh.features.corners(facet), &others = mesh.features.corners(other);
  const auto k = static_cast<int>(std::ranges::find(own, corner) - own.begin());
  const int edge = mesh.features.facet_edge(facet, (k + 1) % 3);
  if (edge < 0) return;
  const EdgeVertices ends = mesh.features.edge(edge);
  if (std::ranges::any_of(ends, [&](int v) { return std::ranges::find(others, v) != others.end(); })) return;
  if (!segment_triangle_meet({mesh.mesh.position(ends[0]), mesh.mesh.position(ends[1])}, mesh.mesh.triangle(other),
                             counts_))
    return;
  folded_.push_back(corner);
  crossing_.surfaces[0].cut.edge_hits().push_back(
      {crossing_.a().source_ends(edge), mesh.mesh.source_facet(other), edge});
}

void SelfCrossing::find_inside() {
  CrossedSurface& own = crossing_.surfaces[0];
  const ScaledMesh mesh = own.scaled();
  own.cut.find_past([&](int vertex) {
    NearestExit at;
    at.place.vertices[0] = vertex;
    return winding_.is_inside(mesh, vertex, exits_->normal_at(mesh, at));
  });
}

std::optional<NearestExit> SelfCrossing::exit_from_inside(const ReachedVertex& reached) {
  if (!crossing_.a().cut.is_past(reached.source_vertex)) return {};
  const ScaledMesh mesh = crossing_.a().scaled();
  const int from = mesh.mesh.facet_of_source(reached.facet);
  auto exit = exits_->find(mesh, reached.vertex, from);
  if (exit && exit->distance <= kTouches) exit = exits_->find_behind(mesh, reached.vertex, from);
  if (!exit || exits_->is_beside(mesh.mesh, reached.vertex, *exit)) return {};
  if (!(dot(exits_->normal_at(mesh, *exit), exit->direction) > 0.0)) return {};
  return exit;
}

double SelfCrossing::longest_exit() const {
  const CrossedSurface& own = crossing_.a();
  if (own.surface == SurfaceKind::closed) return kAnywhere;
  const ScaledMesh mesh = own.scaled();
  double longest = 0.0;
  for (const EdgeHit& hit : own.cut.hits()) {
    const EdgeEnds ends = mesh.ends(hit.edge);
    longest = std::max(longest, norm(ends.q - ends.p));
  }
  return longest;
}

std::optional<NearestExit> SelfCrossing::exit_of(const ReachedVertex& reached) {
  const ScaledMesh mesh = crossing_.a().scaled();
  const auto exit = exits_->find(mesh, reached.vertex, mesh.mesh.facet_of_source(reached.facet));
  if (!exit || exit->distance <= kTouches) return {};
  if (exits_->is_beside(mesh.mesh, reached.vertex, *exit)) return {};
  const double height = -dot(exits_->normal_at(mesh, *exit), exit->direction);
  const double along = dot(mesh.unit_normal(exit->facet), reached.facing);
  if (!(along > 0.0 ? height < 0.0 : along < 0.0 && height > 0.0)) return {};
  const auto corners = source_corners(mesh.mesh, mesh.mesh.source_facet(exit->facet));
  const double known = dot(crossing_.sides.last_points().side({&reached.source_vertex, 1}, corners), exit->direction);
  if (known < 0.0) return {};
  const Vec3 v = mesh.position(reached.vertex), place = v + exit->distance * exit->direction;
  if (too_near_along(mesh, crossing_.reach, {{&reached.vertex, 1}, v}, {exit->place.used(), place}, ways_)) return {};
  if (known == 0.0 && exit->distance > crossing_.within) {
    too_far_.push_back(reached.source_vertex);
    return {};
  }
  return exit;
}

}  // namespace tact::narrowphase
