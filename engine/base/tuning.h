// Where one way to an answer becomes faster than another: the thresholds of the engine that tests force. None changes
// which facets meet; a direction may differ in its last bits where it starts from something else.
#pragma once

#include <cstddef>
#include <limits>

namespace tact::base {

/// A world has one, and hands it down by const reference. Programs use the defaults; tests force a way through it, see
/// WorldTuning. The benchmark that found a value stands beside it; "estimated" where it follows from what else is
/// known.
struct Tuning {
  static constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max() / 4;  ///< larger than any size

  // Measured: from which size on another way is taken, with its unit.

  /// Small bodies, from which on their memory is packed into one piece. Estimated: 64 of them no longer fit into the
  /// first levels of a cache. What packing gains: bench/results/scaling/notes.md.
  std::size_t fewest_packed = 64;
  /// Clusters, from which on those of a body are looked at, and its facets grouped again if it pays. Estimated.
  std::size_t fewest_regrouped = 4;
  /// Moves of a body after which its clusters are looked at; twice as many after each try. Estimated: a look costs
  /// about as much as a refresh, so that it is 3 % of the time at most.
  int moves_to_look = 32;
  /// How many times worse than when they were made the quality of clusters must be for a try; and the part of the
  /// spread that must be left for the new groups to be kept. Estimated.
  double decayed = 2.0;
  double worth_regrouping = 0.75;
  /// Boxes, up to which each is compared with each. tact-bench broadphase: break-even at about 20.
  std::size_t few_boxes = 16;
  /// Pairs of boxes, from which on cluster pairs are found by trees. Their work does not grow with the square of the
  /// boxes, that of the loop over runs of boxes does. tact-bench clusters: up to 268 million pairs the loop is ahead,
  /// there by 0.3 ms.
  std::size_t largest_loop = std::size_t{1} << 20;
  /// Cluster pairs, from which on planes may be tried where boxes tell little; 0: of all pairs, without a sample.
  /// Estimated: a sample of them takes as long as two or three pairs.
  std::size_t worth_planes = 64;

  // Measured: what is shared out among threads (engine/shared_work.h). Work is in microseconds, about what a pair of
  // clusters takes in stage 6; at a border between ranges a few clusters are opened twice.

  /// Work, from which on all threads share an item. Estimated: some milliseconds.
  std::size_t large_item = 4096;
  /// The same where a stage has fewer than `few_items_per_thread` items a thread. tact-bench rivals, garment 6 k on two
  /// threads: 0.74 of the time with this and the next.
  std::size_t large_of_few = 64;
  std::size_t few_items_per_thread = 4;
  /// Facets of the smaller bodies of so few pairs, from which on these are shared out one by one. Estimated.
  std::size_t worth_threads = 1024;
  /// Work of a range at least: ten times what it takes to wake a thread.
  std::size_t fewest_in_range = 32;
  /// Ranges of an item for each thread at most, so that threads end together. Shorter ones cost: the rolled sheet of 13
  /// k of tact-bench self takes 1.22 ms in ranges of 256 cluster pairs, 1.35 in ranges of 64.
  std::size_t ranges_per_thread = 4;
  /// Items that a thread takes at a time. Estimated: one takes a microsecond or more.
  std::size_t fewest_at_a_time = 4, most_at_a_time = 64;

  // Measured: facet pairs (stage 6)

  /// Pairs of clusters, from which on two bodies may be taken to lie on each other (narrowphase/triangles/confirm.cpp).
  std::size_t worth_as_surfaces = 128;
  /// Facets of two blocks, from which on those near the other block are looked for first.
  std::size_t few_in_blocks = 48;
  /// Facet pairs of two blocks, from which on their corners are made floats.
  std::size_t worth_floats = 32;
  /// Facets near one, from which on its plane tells which of them it leaves aside; deciding fewer is as cheap.
  std::size_t worth_a_plane = 6;

  // Structural: ways that may be switched off.

  /// The order of the last step is the start of the next (stage 2).
  bool carries_order = true;
  /// Pairs are separated by an axis of their 18-DOPs where one does (stage 3). tact-bench stages: 10 to 21 ns a pair,
  /// against 100 and more for the direction that separated it last.
  bool separates_by_kdop = true;
  /// A pair starts from where GJK and the search for the direction ended in the last step. Its direction is carried in
  /// any case: it is a part of the answer.
  bool carries_hulls = true;
  /// Clusters tell the vertex that is farthest in a direction; otherwise all vertices are looked at.
  bool support_by_clusters = true;
  /// Bodies that lie on each other remember how far apart their clusters were.
  bool carries_surfaces = true;
  /// A cluster is opened only where facets of the other body are near.
  bool asks_near_facets = true;
  /// Facet pairs are decided many at a time before exact predicates decide what is left.
  bool decides_many = true;
};

/// The default values.
inline constexpr Tuning kTuning{};

}  // namespace tact::base
