// All loops of kernels.h for one instruction set, and the table of them: included by one source file an instruction
// set.
#pragma once

#include "narrowphase/distance/edge_edge.inl"
#include "narrowphase/distance/vertex_facet.inl"
#include "narrowphase/kernels/boxes.inl"
#include "narrowphase/kernels/bytes.inl"
#include "narrowphase/kernels/clear_pairs.inl"
#include "narrowphase/kernels/exact_pairs.inl"
#include "narrowphase/kernels/facet_pairs.inl"
#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/features.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lines.inl"
#include "narrowphase/kernels/motion.inl"
#include "narrowphase/kernels/place.inl"
#include "narrowphase/kernels/points.inl"
#include "narrowphase/kernels/polygons.inl"
#include "narrowphase/kernels/queries.inl"
#include "narrowphase/kernels/refit.inl"
#include "narrowphase/kernels/sort.inl"
#include "narrowphase/kernels/surfaces.inl"
#include "narrowphase/kernels/ways.inl"

namespace tact::narrowphase {
namespace {

constexpr Kernels all_kernels(const char* name) {
  return {.name = name,
          .refit_clusters = refit_clusters,
          .place_clusters = place_clusters,
          .bounds = bounds,
          .kdop = kdop,
          .select_heights = select_heights,
          .highest_point = highest_point,
          .select_overlapping = select_overlapping,
          .select_swept = select_swept,
          .cull_boxes = cull_boxes,
          .open_cluster = open_cluster,
          .open_whole = open_whole,
          .normal_spread = normal_spread,
          .localize = localize,
          .mean_normal = mean_normal,
          .range_along = range_along,
          .place_facets = place_facets,
          .find_cells = find_cells,
          .facing_away = facing_away,
          .near_facets = near_facets,
          .cells_of = cells_of,
          .any_near = any_near,
          .share_cells = share_cells,
          .leave_aside = leave_aside,
          .list_pairs = list_pairs,
          .sort_pairs = sort_pairs,
          .on_lattice = on_lattice,
          .float_corners = float_corners,
          .match_float_pairs = match_float_pairs,
          .match_exact_pairs = match_exact_pairs,
          .match_exact_float_pairs = match_exact_float_pairs,
          .match_pairs = match_pairs,
          .sharing_pairs = sharing_pairs,
          .match_pairs_wide = match_pairs_wide,
          .match_flat_pairs = match_flat_pairs,
          .place_points = place_points,
          .features_left = features_left,
          .place_features = place_features,
          .near_vertices = near_vertices,
          .near_edges = near_edges,
          .edges_beyond = edges_beyond,
          .edges_through = edges_through,
          .rank_by_entry = rank_by_entry,
          .rank_by_distance = rank_by_distance,
          .sight_facets = sight_facets,
          .line_up_facets = line_up_facets,
          .prepare_segments = prepare_segments,
          .enter_groups = enter_groups,
          .enter_nodes = enter_nodes,
          .enter_all_nodes = enter_all_nodes,
          .enter_later_nodes = enter_later_nodes,
          .find_facets = find_facets,
          .meet_lines = meet_lines,
          .rank_facets = rank_facets,
          .rank_block = rank_block,
          .comes_nowhere_twice = comes_nowhere_twice,
          .flag_ways = flag_ways,
          .append_near_ways = append_near_ways,
          .apart_throughout = apart_throughout,
          .close_edges = close_edges};
}

}  // namespace
}  // namespace tact::narrowphase
