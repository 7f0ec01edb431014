// The few loops in which the time goes, compiled once for each instruction set and chosen when the program starts. The
// loops stand in the .inl files, over the packs of packs.h, what they read and write in the headers below; kernels.inl
// makes the table. Every instruction set gives the same bits: the same operations in the same order on every element, a
// fused multiply-add only for the exact error of a product. Plain pointers only: nothing inline may leak from files
// that are compiled for a newer machine.
#pragma once

#include <tact/facet_pair.h>

#include <cstdint>

#include "narrowphase/kernels/boxes.h"
#include "narrowphase/kernels/facets.h"
#include "narrowphase/kernels/features.h"
#include "narrowphase/kernels/lines.h"
#include "narrowphase/kernels/polygons.h"
#include "narrowphase/kernels/queries.h"
#include "narrowphase/kernels/refit.h"

namespace tact::narrowphase {

struct Kernels {
  const char* name;

  // Copies the owned vertices and finds the box of each cluster, owned and borrowed vertices in it.
  Refitted (*refit_clusters)(const RefitInput& input);
  // Places the vertices and finds the box of each cluster, as a refit with the same positions would; returns their box.
  BoxBounds (*place_clusters)(const PlaceInput& input);

  // The box of `count` boxes.
  BoxBounds (*bounds)(const BoxPointers& boxes, int count);

  // The k-DOP of `count` points, at least one.
  Kdop (*kdop)(PointArrays points, int count);

  // Writes the indices i < count of points whose height is >= threshold, ascending; returns how many.
  int (*select_heights)(PointArrays points, int count, const HeightAxis& axis, double threshold, std::int32_t* indices);

  // The highest of the points in ascending ranges; index -1 if there is none or it is lower than `least`. Of several
  // that are as high, the one with the least number[i], or with the least index if `number` is null.
  HighestPoint (*highest_point)(PointArrays points, const std::int32_t* number, const IndexRange* ranges,
                                int range_count, const HeightAxis& axis, double least);

  // Writes the indices i < count of boxes that overlap `box` (closed), ascending; returns how many.
  int (*select_overlapping)(const BoxPointers& boxes, int count, const BoxBounds& box, std::int32_t* indices);
  // The same of boxes that move straight from `begin` to `end`: those that overlap the box of all that one passes.
  int (*select_swept)(const BoxPointers& begin, const BoxPointers& end, int count, const BoxBounds& box,
                      std::int32_t* indices);
  // The same of boxes that the planes leave. A box that misses that of the planes does not count as too low.
  Culled (*cull_boxes)(const BoxPointers& boxes, int count, const CullPlanes& planes, std::int32_t* indices);

  // Appends to `block` the facets of a cluster that the planes leave; if it has no room for all, appends none. Returns
  // how many they are.
  Culled (*open_cluster)(const ClusterFacets& cluster, const CullPlanes& planes, FacetBlock* block);

  // Puts all facets of a cluster into `block`, which held others: their corners and the cells of their boxes. Boxes,
  // normals and numbers are left as they were, as tests of all pairs of facets do without them.
  void (*open_whole)(const ClusterFacets& cluster, const Grid& grid, FacetBlock* block);

  // Of the normals of a cluster's facets, each as long as twice its area; all is zero if their sum is, or if the sine
  // of a facet's angle at its first corner, squared, is not more than `least_sine_squared`.
  NormalSpread (*normal_spread)(const ClusterFacets& cluster, double least_sine_squared);

  // The vertices of a cluster: (x - origin) scale, rounded to floats.
  void (*localize)(const ClusterFacets& cluster, const double* origin, double scale, const LocalVertices& vertices);
  // A normal of the cluster's surface: of every fourth facet twice the area times the normal, added up.
  void (*mean_normal)(const LocalVertices& vertices, const ClusterFacets& cluster, float* normal);
  // How far `count` vertices reach along an axis.
  LocalRange (*range_along)(const LocalVertices& vertices, int count, const float* axis);
  // The corners of a cluster's facets in a frame, and the cells of their boxes, of those that reach into the cells
  // `reached`; of the others both are undefined. Returns which these are.
  std::uint64_t (*place_facets)(const LocalVertices& vertices, const ClusterFacets& cluster, const LocalFrame& frame,
                                const CellBox& reached, FloatCorners* corners, FacetCells* cells);

  // Finds the cells of the facets that have none yet.
  void (*find_cells)(const Grid& grid, FacetBlock* block);

  // A bit for each facet of `block` whose normal is not zero and has axis · normal <= 0.
  std::uint64_t (*facing_away)(const FacetBlock& block, const HeightAxis& axis);

  // The facets that have a bit in `candidates` and reach into `cells`.
  std::uint64_t (*near_facets)(const FacetCells& facets, std::uint64_t candidates, const CellBox& cells);
  // The cells that the facets with a bit in `some` reach; of no meaning if there is none.
  CellBox (*cells_of)(const FacetCells& facets, std::uint64_t some);
  // True if a facet of `block` with a bit in `candidates` reaches into `cells` and its plane may cut `box`.
  // `box` reaches `cells`; these facets and `box` lie in the box `bounds`.
  bool (*any_near)(const FacetBlock& block, std::uint64_t candidates, const CellBox& cells, const BoxBounds& box,
                   const BoxBounds& bounds);

  // For each facet f of `few` with a bit in `some`, writes to met[f] which of the facets `others` of `many` share cells
  // with it.
  SharedCells (*share_cells)(const FacetCells& few, std::uint64_t some, const FacetCells& many, std::uint64_t others,
                             std::uint64_t* met);
  // For each facet f with a bit in `some` whose met[f] holds at least `plane_from` facets: removes those from met[f]
  // that certainly lie on one side of the plane of f, farther away than `slack`. For `gap` see match_float_pairs.
  void (*leave_aside)(const FloatCorners& few, std::uint64_t some, const FloatCorners& many, const double* gap,
                      float slack, int plane_from, std::uint64_t* met);
  // For each facet f with a bit in `some`: moves the pairs of f with the facets in met[f] to the end of `pairs`, until
  // that is full. Returns which f have pairs left.
  std::uint64_t (*list_pairs)(std::uint64_t some, std::uint64_t* met, bool few_are_b, FacetPairList* pairs);

  // Sorts up to kMostSorted pairs, all different.
  void (*sort_pairs)(FacetPair* pairs, int count);

  // True if every coordinate of every corner is a whole number of steps. A step is a power of two; coordinates are
  // below 2^51 steps.
  bool (*on_lattice)(const FacetBlock& block, double step);

  // The corners of the facets that have a bit; those of the others are undefined.
  void (*float_corners)(const FacetBlock& block, std::uint64_t facets, const Grid& grid, FloatCorners* corners);

  // Decides pairs of a facet of `a` and one of `b`, in the same grid, whose boxes are at most `gap` apart along each of
  // its axes. What floats cannot tell is left undecided.
  PairMatches (*match_float_pairs)(const FloatCorners& a, const FloatCorners& b, const FacetPairList& pairs,
                                   const double* gap);

  // Decides pairs of facets on a lattice that is not too fine for doubles, or for floats: see lattice.h. Undecided are
  // only pairs with a facet that has no area.
  PairMatches (*match_exact_pairs)(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs);
  PairMatches (*match_exact_float_pairs)(const FloatCorners& a, const FloatCorners& b, const FacetPairList& pairs);

  // Decides those of the pairs that have a bit in `which`, all of them in the box `bounds`. What doubles cannot tell is
  // left undecided.
  PairMatches (*match_pairs)(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs, std::uint64_t which,
                             const BoxBounds& bounds);
  // Those of the pairs that have a bit in `which` and a corner in common.
  std::uint64_t (*sharing_pairs)(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs,
                                 std::uint64_t which);
  // Decides those of the pairs that have a bit in `which`, in double-double.
  PairMatches (*match_pairs_wide)(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs,
                                  std::uint64_t which);
  // Decides those of the pairs that have a bit in `which`, all of them of facets in one plane.
  PairMatches (*match_flat_pairs)(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs,
                                  std::uint64_t which);

  // Appends the vertices of a cluster, times `scale`; `box` is scaled, too. There is room for them.
  void (*place_points)(const ClusterFacets& cluster, double scale, const BoxBounds& box, ClusterPoints* points);
  // A bit for each feature of the cluster that was placed last, from `first_point` on, that no side of the box rules
  // out.
  std::uint64_t (*features_left)(const ClusterPoints& points, int first_point, const FeatureCorners& features);
  // Appends those of them that have a bit, and the cells of their boxes, widened by `widen`. There is room for them.
  void (*place_features)(const ClusterPoints& points, int first_point, const FeatureCorners& features,
                         std::uint64_t some, const Grid& grid, double widen, FeatureBlock* block);
  // For each of some vertices a bit for each of some facets that shares cells with it and may have a point nearer than
  // `reach`: anywhere, and inside. They are written for the vertices that the result has a bit for: they have one.
  // Unless `left_out` is null, it has a bit for each facet that a vertex is not held against.
  std::uint64_t (*near_vertices)(const PlacedFeatures& vertices, const PlacedFeatures& facets, double reach,
                                 const std::uint64_t* left_out, std::uint64_t* near, std::uint64_t* inside);
  // The same of edges and edges, without those that certainly are not nearer than `reach` where their lines are
  // nearest, or not inside both.
  std::uint64_t (*near_edges)(const PlacedFeatures& few, const PlacedFeatures& many, double reach,
                              const std::uint64_t* left_out, std::uint64_t* near);
  // A bit for each pair that certainly has no point nearer than `reach`: for the same reasons, or as a facet leads
  // nearer there. Vertices are at `a` and `b`, times `scale`.
  std::uint64_t (*edges_beyond)(const EdgePairs& pairs, const PointArrays& a, const PointArrays& b, double scale,
                                double reach, EdgeSide side);

  // Which edges of facets meet the other facets, as closed sets.
  EdgesThrough (*edges_through)(const TrianglePairs& pairs);

  // Those of up to RankedBoxes::kMost boxes that a segment enters by `latest`, and when: never later than it does.
  void (*rank_by_entry)(const BoxPointers& boxes, int count, const SegmentSlabs& segment, double latest,
                        RankedBoxes* ranked);
  // Those whose squared distance from a point, times the square of `scale`, is at most `most`, and that distance.
  void (*rank_by_distance)(const BoxPointers& boxes, int count, const double* point, double scale, double most,
                           RankedBoxes* ranked);
  // A bit for each facet of a cluster that a line may meet.
  std::uint64_t (*sight_facets)(const ClusterFacets& cluster, const LineOfSight& line);
  // Writes the leaves of a cluster, and their boxes to those of a node, from `first` on.
  void (*line_up_facets)(const ClusterFacets& cluster, const double* origin, double scale, LineLeaf* leaves, int first,
                         LineNode* node);
  // From the beginnings and the directions of segments finds the rest, with empty lists.
  LinesApart (*prepare_segments)(const LineTree& tree, LineBlock* block);
  // Appends the groups that a segment enters by its latest time.
  void (*enter_groups)(const LineTree& tree, int line, LineBlock* block);
  // Appends the leaves that it enters in those of a few nodes, from `first` on, that it enters.
  void (*enter_nodes)(const LineTree& tree, int first, int count, int line, LineBlock* block);
  // The same for all segments and all nodes, up to 64: each enters those first that it does not enter later than it
  // leaves any.
  void (*enter_all_nodes)(const LineTree& tree, LineBlock* block);
  // Now those that have a bit enter the others.
  void (*enter_later_nodes)(const LineTree& tree, std::uint32_t lines, LineBlock* block);
  // Goes on with some segments, each until there is something to do, or nothing left before its latest time.
  void (*find_facets)(const LineTree& tree, const std::uint8_t* lines, int count, LineBlock* block);
  // Decides pairs as PreparedSegment::meet(), and with the same bits.
  void (*meet_lines)(const LineBlock& block, LinePairs* pairs);
  // The facets of a cluster that may be as near to a point as any, or as `most`: their squared distances times the
  // square of `scale`, from below.
  void (*rank_facets)(const ClusterFacets& cluster, const double* point, double scale, double most,
                      FacetDistances* facets);
  // The facets of a block whose boxes are as near to a point as `most`, likewise; counted from the first of the block.
  // Without those that certainly do not face `facing`, unless that is null: whose normals are not among these, however
  // they are computed from corners that are counted from a point at most 4 away in the unit of `scale`.
  void (*rank_block)(const FacetBlock& block, const double* point, double scale, double most,
                     const FacingNormals* facing, FacetDistances* facets);

  // True if a closed polygon certainly passes no point twice. Writes to its room.
  bool (*comes_nowhere_twice)(FlatPolygon* polygon);

  // Writes a bit for each side of the box that a vertex stays beyond, a byte a vertex; up to 8 bytes more are written.
  void (*flag_ways)(const VertexWays& vertices, const BoxBounds& box, std::uint8_t* outside);
  // Appends the features that no side rules out, their numbers counted from `first`. The room of VertexWays is that of
  // `outside`, too.
  void (*append_near_ways)(const VertexWays& vertices, const std::uint8_t* outside, const FeatureCorners& features,
                           int first, FeatureWays* near);
  // A bit for each polygon that certainly stays farther from the origin than its reach, all the time.
  std::uint64_t (*apart_throughout)(const MovingPolygons& polygons, const PolygonReach& reach);

  // As near_edges(), without those that certainly are not nearer than `reach` anywhere.
  std::uint64_t (*close_edges)(const PlacedFeatures& few, const PlacedFeatures& many, double reach,
                               const std::uint64_t* left_out, std::uint64_t* near);
};

// The best for this machine, or the one that the environment variable TACT_INSTRUCTION_SET names: scalar, simd128,
// avx2, avx512.
const Kernels& kernels();

// For tests: each instruction set, or null where the machine or the build does not have it.
const Kernels* scalar_kernels();
const Kernels* simd128_kernels();
const Kernels* avx2_kernels();
const Kernels* avx512_kernels();

}  // namespace tact::narrowphase
