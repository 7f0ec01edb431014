// The few loops in which the time goes, compiled once for each instruction set and chosen when the program starts. The
// loops stand in the .inl files, over the packs of packs.h; kernels.inl makes the table. Every instruction set gives
// the same bits: the same operations in the same order on every element, a fused multiply-add only for the exact error
// of a product. Plain pointers only: nothing inline may leak from files that are compiled for a newer machine.
#pragma once

#include <tact/facet_pair.h>

#include <cstdint>

namespace tact::narrowphase {

// Three arrays of coordinates.
struct PointArrays {
  const double* x;
  const double* y;
  const double* z;
};

// A direction n and a point o: the height of x is ((n.x (x - o.x) + n.y (y - o.y)) + n.z (z - o.z)).
struct HeightAxis {
  double nx, ny, nz;
  double ox, oy, oz;
};

struct IndexRange {
  std::int32_t begin, end;
};

struct HighestPoint {
  double height;
  std::int32_t index;
};

// Lower and upper bounds of boxes in separate arrays.
struct BoxPointers {
  const double* lower[3];
  const double* upper[3];
};

// One box.
struct BoxBounds {
  double lower[3];
  double upper[3];
};

// The extent of points along the diagonals of a cube's faces: y + z, z + x, x + y, y - z, z - x, x - y. See
// hull/kdop.h.
inline constexpr int kDiagonals = 6;
struct Kdop {
  double lower[kDiagonals];
  double upper[kDiagonals];
};

// A determinant of differences of coordinates up to 2^300 is rounded by at most kRelativeRounding times the sum of the
// sizes of its products, and kAbsoluteRounding. See facets.inl.
inline constexpr double kRelativeRounding = 1e-15;
inline constexpr double kAbsoluteRounding = 1e-200;
// The relative rounding in double-double. See facet_pairs.inl.
inline constexpr double kWideRelativeRounding = 0x1p-100;

// A cluster's facets and vertices. The vertices that it owns stand next to each other in `points`; the others are
// borrowed. `corner` counts the owned ones first; 64 bytes of each of its arrays may be read.
struct ClusterFacets {
  PointArrays points;  // of all vertices
  std::int32_t owned_begin;
  std::int32_t owned_count;
  const std::int32_t* borrowed;
  std::int32_t borrowed_count;
  const std::uint8_t* corner[3];
  std::int32_t facet_begin;
  std::int32_t facet_count;
};

// A box cut into cells along each axis: x is at (x - origin) scale, which does not change the order of two coordinates,
// however it is rounded.
struct Grid {
  double origin[3];
  double scale[3];
};
inline constexpr double kLastCell = 0x7fff;

// The cells that a box reaches, from the lower to the upper along each axis.
struct CellBox {
  std::int16_t lower[3];
  std::int16_t upper[3];
};

// The cells that the boxes of facets reach.
struct alignas(64) FacetCells {
  static constexpr int kRoom = 64 + 32;
  std::int16_t lower[3][kRoom];  // cut off at 0 and kLastCell
  std::int16_t upper[3][kRoom];
  int count = 0;
};

// Facets of one or more clusters in separate arrays. Each starts at a cache line, and is longer by what a SIMD loop may
// write past the end.
struct alignas(64) FacetBlock {
  static constexpr int kCapacity = 64;
  static constexpr int kRoom = kCapacity + 8;
  FacetCells cells;  // of the first facets
  double lower[3][kRoom];
  double upper[3][kRoom];
  double corner[3][3][kRoom];  // corner, axis, facet
  double normal[3][kRoom];     // (c1 - c0) × (c2 - c0), as computed
  std::int32_t facet[kRoom];   // its number in the mesh
  int count = 0;
};

// The corners of facets along three axes, rounded to floats.
struct alignas(64) FloatCorners {
  static constexpr int kRoom = FacetBlock::kCapacity + 16;
  float corner[3][3][kRoom];  // corner, axis, facet
  double extent[3];           // of the largest facet
  double error;               // of any coordinate, at most
  int count;
};

// The vertices of a cluster as floats about a point near them: those that it owns, then those that it borrows. Each
// array is a whole number of runs, filled up with the first vertex, and 64 floats of it may be read.
struct LocalVertices {
  static constexpr int kRun = 16;
  static constexpr int kMost = 192 + kRun;
  float* x;
  float* y;
  float* z;
};

struct LocalRange {
  float lower, upper;
};

// Three axes, at most 1 in length each, and a grid along them. A vertex x is at axis · x + offset.
struct LocalFrame {
  float axis[3][3];
  float offset[3];
  float margin;          // by which boxes of facets are widened before they are put into cells
  float cell_origin[3];  // cells are cut off at 0 and kLastCell
  float cell_scale[3];
  double error;  // of any coordinate, at most
};

// What facets are judged by.
struct CullPlanes {
  HeightAxis axis;
  double lowest;  // a facet whose highest corner is lower is left out
  BoxBounds box;  // so is one whose box misses this
};

// How many facets or boxes the planes leave, and how many of the others are too low.
struct Culled {
  std::int32_t left;
  std::int32_t low;
};

// Pairs of facets of two blocks. Beyond `count` there are indices that may be read, and room for what a SIMD loop may
// write past the end.
struct FacetPairList {
  static constexpr int kCapacity = 64;
  std::uint8_t a[2 * kCapacity] = {};
  std::uint8_t b[2 * kCapacity] = {};
  int count = 0;
};

// Which facets of a block share cells with some facet of another block, a bit each, and how many such pairs there are.
struct SharedCells {
  std::uint64_t facets;
  std::int64_t pairs;
};

inline constexpr int kMostSorted = 128;

// What became of a list of pairs, a bit each.
struct PairMatches {
  std::uint64_t meeting = 0;    // certainly
  std::uint64_t undecided = 0;  // for exact predicates
  std::uint64_t flat = 0;       // the facet of `a` certainly lies in the plane of the facet of `b`, if that has one
};

// Triangles, or parallelograms in the order of their outlines, whose corners move straight from time 0 to time 1;
// coordinates are at most 2 in size.
struct alignas(64) MovingPolygons {
  static constexpr int kCapacity = 64;
  static constexpr int kRoom = kCapacity + 8;
  double corner[2][4][3][kRoom];  // time, corner, axis, polygon
  int corners = 3;
  int count = 0;
};

// A cluster's vertices, owned ones first, times a power of two, and what rules each out: a bit for each side of a box.
struct alignas(64) ClusterPoints {
  static constexpr int kRoom = 192 + 64;
  double at[3][kRoom];
  std::uint8_t outside[kRoom];
  int count = 0;
};

// Between which coordinates each vertex of a cluster stays on its way, owned ones first.
struct alignas(64) VertexWays {
  static constexpr int kRoom = 192 + 64;
  double lower[3][kRoom], upper[3][kRoom];
  int count = 0;
};

// Some features of a cluster, in its own numbers of vertices: `corners` of them each. 64 bytes of each array that is
// used may be read.
struct FeatureCorners {
  const std::uint8_t* corner[3];
  int corners;
  int count;  // up to 64
};

// Features that are left, and the cells of their boxes.
struct alignas(64) FeatureBlock {
  static constexpr int kCapacity = 64;
  FacetCells cells;
  std::uint8_t feature[kCapacity];  // which of those that were given
  std::uint8_t corner[3][2 * kCapacity];
  int count = 0;
};

// Those of a block that have a bit, and the points of their cluster.
struct PlacedFeatures {
  const ClusterPoints& points;
  const FeatureBlock& block;
  std::uint64_t some;
};

// Features, and the boxes of their ways.
struct alignas(64) FeatureWays {
  static constexpr int kRoom = 192 + 64;
  double lower[3][kRoom], upper[3][kRoom];
  std::uint8_t feature[kRoom], corner[3][kRoom];
  int count = 0;
};

// Pairs of edges of two meshes, by the vertices of each: its ends, and the third vertices of two facets that have it,
// or of one twice, or an end instead.
struct alignas(64) EdgePairs {
  static constexpr int kCapacity = 64;
  static constexpr int kRoom = kCapacity + 8;
  std::int32_t vertex[2][4][kRoom];  // mesh
  int count = 0;
};

// The side that edges are on: as nearest_between_edges() and crossing_between_edges() ask.
enum class EdgeSide { before, passed };

// Facets of two meshes that meet, by pairs.
struct alignas(64) TrianglePairs {
  static constexpr int kCapacity = 64;
  static constexpr int kRoom = kCapacity + 8;
  double corner[2][3][3][kRoom];  // mesh, corner, axis
  int count = 0;
};

// A bit for each pair. Edge k leads from corner k of the first facet to the next one, edge 3 + k from corner k of the
// second facet.
struct EdgesThrough {
  std::uint64_t meeting[6];  // it certainly meets the other facet
  std::uint64_t undecided[6];
};

// Bounds what the sign of a product of lengths loses in doubles, relative to that product: see
// contact_points/nearest.cpp.
inline constexpr double kSignRounding = 256 * 0x1p-53;

// Two edges of which the squared sine is smaller are nearly parallel: doubles do not tell where their lines are
// nearest.
inline constexpr double kNearlyParallel = 1e-8;

// New positions for the clusters cluster_begin <= c < cluster_end. Those of source vertex s are source[3 s], source[3 s
// + 1], source[3 s + 2].
struct RefitInput {
  const double* source;
  std::int32_t cluster_begin, cluster_end;
  // For each cluster, and one more: the first vertex that it owns, the first that it borrows.
  const std::int32_t* ranges;
  const std::int32_t* owned;     // source vertices, copied to x, y, z in this order
  const std::int32_t* borrowed;  // source vertices that only widen the box
  std::int32_t ahead;            // how many owned vertices ahead positions are prefetched; 0: they are not
  PointArrays before;            // where the owned ones were
  double* x;
  double* y;
  double* z;
  double* boxes;  // of the clusters, see BoxPointers: one array after the other, each box_stride long
  std::int32_t box_stride;
  double* steps_squared;  // of each cluster, how far an owned vertex goes at most, squared; null: not asked for
};

// What a refit saw.
struct Refitted {
  BoxBounds box;      // of all these clusters
  bool changed;       // some owned coordinate is not what it was
  bool not_a_number;  // some owned coordinate is not a number: the boxes are of no use
};

// A pose of a rigid mesh, see mesh/pose.h, and all clusters of it: see RefitInput for what is not said here.
struct PlaceInput {
  double rotation[3][3];  // rows
  double translation[3];
  PointArrays rest;
  std::int32_t cluster_count;
  const std::int32_t* ranges;
  const std::int32_t* borrowed;  // vertices, not source vertices
  double* x;
  double* y;
  double* z;
  double* boxes;
};

// A segment, for the question when it enters boxes. Where it is parallel to an axis, or as good as, `inverse` is zero;
// then `stays` tells whether it is so exactly, or else that axis rules nothing out.
struct SegmentSlabs {
  double from[3];
  double inverse[3];  // 1 / the way along each axis
  bool stays[3];
};

// Some of many boxes, with a number each: the squared distance from a point, or when a segment enters.
struct alignas(64) RankedBoxes {
  static constexpr int kMost = 512;
  double rank[kMost + 8];
  std::int32_t index[kMost + 8];
  int count = 0;
};

// A line, for the question which facets it may meet: `axis` are those of space in an order in which the way is longest
// along the last, of which it goes slope[0] and slope[1] along the others. Seen along the line a point is off by at
// most `error`.
struct LineOfSight {
  int axis[3];
  double from[3];  // in the order of space
  double slope[2];
  double error;
};

// The corners of a cluster's facets in floats, one beside the other: (x - origin) scale, at most 1 in size; what
// follows the last facet is like its first vertex.
struct alignas(64) LinedFacets {
  static constexpr int kMost = 64;
  float corner[3][3][kMost];  // of each corner its coordinates
  double origin[3];
  double scale;
  std::int32_t count;
};

// Boxes in floats about a middle, in a unit in which no coordinate exceeds 1: lower x, y, z, upper x, y, z, an array
// each. Of what is read at once 64 bytes more can be read.
struct LinedBoxes {
  const float* bounds[6];
};

// A segment in the same unit, and the boxes that it enters, with when at the earliest. Of an axis x is passed at
// x inverse - enter_at at the earliest, and at x inverse - leave_at at the latest.
struct alignas(64) EnteringLine {
  static constexpr int kMost = 128;
  float rank[kMost + 32];
  std::int32_t index[kMost + 32];
  float inverse[3], enter_at[3], leave_at[3];
  float latest;
  int count;
  bool overflows;      // there were more
  std::int32_t taken;  // the index of what take_nearest() took
};

// Facets of a cluster, and what their squared distances from a point are at least, in a unit of the caller's.
struct alignas(64) FacetDistances {
  static constexpr int kCapacity = 64;
  double least_squared[kCapacity + 8];
  std::uint8_t facet[2 * kCapacity];  // counted from the first one
  int count;
};

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
  // The same of boxes (closed) whose squared distance from a point is at most `within_squared`, but for rounding.
  int (*select_within)(const BoxPointers& boxes, int count, const double* point, double within_squared,
                       std::int32_t* indices);
  // The same of boxes that the planes leave. A box that misses that of the planes does not count as too low.
  Culled (*cull_boxes)(const BoxPointers& boxes, int count, const CullPlanes& planes, std::int32_t* indices);

  // Appends to `block` the facets of a cluster that the planes leave; if it has no room for all, appends none. Returns
  // how many they are.
  Culled (*open_cluster)(const ClusterFacets& cluster, const CullPlanes& planes, FacetBlock* block);

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
  // Is there a facet of `block` with a bit in `candidates` that reaches into `cells` and whose plane may cut `box`?
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

  // Is every coordinate of every corner a whole number of steps? A step is a power of two; coordinates are below 2^51
  // steps.
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

  // The vertices of a cluster, times `scale`; `box` is scaled, too.
  void (*place_points)(const ClusterFacets& cluster, double scale, const BoxBounds& box, ClusterPoints* points);
  // The features that no side of the box rules out, and the cells of their boxes, widened by `widen`.
  void (*place_features)(const ClusterPoints& points, const FeatureCorners& features, const Grid& grid, double widen,
                         FeatureBlock* block);
  // For each of some vertices a bit for each of some facets that shares cells with it and may have a point nearer than
  // `reach`: anywhere, and inside. They are written for the vertices that the result has a bit for: they have one.
  std::uint64_t (*near_vertices)(const PlacedFeatures& vertices, const PlacedFeatures& facets, double reach,
                                 std::uint64_t* near, std::uint64_t* inside);
  // The same of edges and edges, without those that certainly are not nearer than `reach` where their lines are
  // nearest, or not inside both.
  std::uint64_t (*near_edges)(const PlacedFeatures& few, const PlacedFeatures& many, double reach, std::uint64_t* near);
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
  // The same for lined facets, fewer of them; the line's own error does not count. And what fills them, but for their
  // origin and scale.
  std::uint64_t (*facets_on_line)(const LinedFacets& facets, const LineOfSight& line);
  void (*line_up_facets)(const ClusterFacets& cluster, LinedFacets* lined);
  // Appends those of `count` boxes, from `first` on, that a segment enters by `latest`; their index is mark xor their
  // number.
  void (*enter_lined_boxes)(const LinedBoxes& boxes, int first, int count, std::int32_t mark, EnteringLine* line);
  // Takes out the box that is entered first, if that is not later than `latest`.
  bool (*take_nearest)(EnteringLine* line);
  // The facets of a cluster that may be as near to a point as any, or as `most`: their squared distances times the
  // square of `scale`, from below.
  void (*rank_facets)(const ClusterFacets& cluster, const double* point, double scale, double most,
                      FacetDistances* facets);
  // The facets of a block whose boxes are as near to a point as `most`, likewise; counted from the first of the block.
  void (*rank_block)(const FacetBlock& block, const double* point, double scale, double most, FacetDistances* facets);

  // Writes a bit for each side of the box that a vertex stays beyond, a byte a vertex; up to 8 bytes more are written.
  void (*flag_ways)(const VertexWays& vertices, const BoxBounds& box, std::uint8_t* outside);
  // Appends the features that no side rules out, their numbers counted from `first`. The room of VertexWays is that of
  // `outside`, too.
  void (*append_near_ways)(const VertexWays& vertices, const std::uint8_t* outside, const FeatureCorners& features,
                           int first, FeatureWays* near);
  // A bit for each polygon that certainly stays farther than `reach` from the origin, all the time.
  std::uint64_t (*apart_throughout)(const MovingPolygons& polygons, double reach);
};

// The best for this machine, or the one that the environment variable TACT_INSTRUCTION_SET names: scalar, avx2, avx512.
const Kernels& kernels();

// For tests: each instruction set, or null where the machine or the build does not have it.
const Kernels* scalar_kernels();
const Kernels* avx2_kernels();
const Kernels* avx512_kernels();

}  // namespace tact::narrowphase
