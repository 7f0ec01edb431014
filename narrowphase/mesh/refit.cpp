#include "narrowphase/mesh/refit.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "engine/base/parallel.h"
#include "narrowphase/mesh/position_problem.h"
#include "narrowphase/mesh/prefetch.h"

namespace tact::narrowphase {

namespace {

// Clusters that a thread refits at a time: at least a group, so that a mesh that is divided has groups.
constexpr int kFewestInRange = kGroupSize, kMostInRange = 256;
// How many vertices ahead positions are prefetched: fewer where a body is small, as its last so many are not.
constexpr int kFewestAhead = 64, kMostAhead = 128;

bool is_within(const Box& box, double largest) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.lower[axis] >= -largest && box.upper[axis] <= largest)) return false;
  }
  return true;
}

// Positions are gathered cluster by cluster, in an order that no hardware foresees. A small body was prefetched whole.
Refitted refit_range(const ClusteredMesh& mesh, const double* positions, int cluster_begin, int cluster_end,
                     bool prefetch, double* steps_squared) {
  const int ahead = std::clamp(mesh.vertex_count() / 8, kFewestAhead, kMostAhead);
  const PlacementArrays to = arrays_in(mesh.placements().spare_memory(), mesh.counts());
  return kernels().refit_clusters({.source = positions,
                                   .cluster_begin = cluster_begin,
                                   .cluster_end = cluster_end,
                                   .ranges = mesh.refit_indices().data(),
                                   .owned = mesh.source_vertices(),
                                   .borrowed = mesh.borrowed_source_vertices(),
                                   .ahead = prefetch && mesh.vertex_count() > ahead ? ahead : 0,
                                   .before = mesh.points(),
                                   .x = to.x,
                                   .y = to.y,
                                   .z = to.z,
                                   .boxes = to.cluster_boxes,
                                   .box_stride = mesh.cluster_count(),
                                   .steps_squared = steps_squared});
}

Refitted refit_in_ranges(const ClusteredMesh& mesh, const double* positions, int per_range, const RefitOptions& options,
                         double* steps_squared) {
  std::atomic<bool> any_changed{false}, any_not_a_number{false};
  const int ranges = (mesh.cluster_count() + per_range - 1) / per_range;
  base::parallel_for(static_cast<std::size_t>(ranges), 1, options.threads, [&](std::size_t i) {
    const int begin = static_cast<int>(i) * per_range, end = std::min(begin + per_range, mesh.cluster_count());
    const Refitted range = refit_range(mesh, positions, begin, end, options.prefetch, steps_squared);
    if (range.changed) any_changed = true;
    if (range.not_a_number) any_not_a_number = true;
  });
  return {.box = {}, .changed = any_changed, .not_a_number = any_not_a_number};
}

}  // namespace

void find_group_boxes(const ClusteredMesh& mesh, double* placement) {
  if (mesh.group_count() <= 1) return;
  const PlacementArrays to = arrays_in(placement, mesh.counts());
  const BoxView clusters(to.cluster_boxes, static_cast<std::size_t>(mesh.cluster_count()));
  for (int g = 0; g < mesh.group_count(); ++g) {
    const int begin = mesh.cluster_begin(g), count = mesh.cluster_end(g) - begin;
    set_box(to.group_boxes, static_cast<std::size_t>(mesh.group_count()), static_cast<std::size_t>(g),
            to_box(kernels().bounds(clusters.pointers(begin), count)));
  }
}

Refit refit(ClusteredMesh& mesh, const double* positions, const RefitOptions& options) {
  const int per_range = std::clamp(mesh.cluster_count() / (4 * options.threads), kFewestInRange, kMostInRange);
  const bool in_ranges = options.threads > 1 && mesh.cluster_count() > per_range;
  double* const steps = mesh.travel() == nullptr ? nullptr : mesh.travel()->steps_squared();
  const Refitted all = in_ranges ? refit_in_ranges(mesh, positions, per_range, options, steps)
                                 : refit_range(mesh, positions, 0, mesh.cluster_count(), options.prefetch, steps);
  find_group_boxes(mesh, mesh.placements().spare_memory());
  const Box box = in_ranges ? mesh.placements().spare_box() : to_box(all.box);
  const auto is_bad = [&](int source_vertex) {
    const double* position = positions + 3 * static_cast<std::ptrdiff_t>(source_vertex);
    return find_position_problem(position, 1, options.largest).kind != PositionProblem::none;
  };
  if (all.not_a_number || !is_within(box, options.largest) ||
      std::ranges::any_of(mesh.unused_source_vertices(), is_bad))
    return Refit::bad;
  if (!all.changed) return Refit::same;
  mesh.placements().exchange(box);
  mesh.count_travel();
  return Refit::changed;
}

void undo_refit(ClusteredMesh& mesh) {
  mesh.placements().exchange(mesh.placements().spare_box());
  if (mesh.travel() != nullptr) mesh.travel()->undo();
}

void prefetch_refit(const ClusteredMesh& mesh, const double* positions) {
  const MeshPlacements& placements = mesh.placements();
  prefetch_lines(positions,
                 3 * static_cast<std::size_t>(mesh.source_vertex_count()) + 1);  // masked loads touch one more
  prefetch_lines(mesh.refit_indices());
  prefetch_lines(placements.spare_memory(), placements.size());
  prefetch_line(placements.now_memory());  // if anything moves, the first x of all do
}

void prefetch_place(const ClusteredMesh& mesh) {
  const MeshPlacements& placements = mesh.placements();
  prefetch_lines(placements.spare_memory(), placements.size());
  prefetch_lines(mesh.refit_indices());
  prefetch_lines(placements.now_memory(), placements.size());
}

}  // namespace tact::narrowphase
