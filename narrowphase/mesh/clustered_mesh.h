// A triangle mesh as the narrow phase sees it: facets grouped into clusters of up to 64 neighbours, vertices stored
// cluster by cluster, a box a cluster. Every spatial query starts from the boxes and opens only the clusters that
// matter.
//
// Vertices are renumbered: a vertex belongs to the first cluster that uses it (its *owner*), and the vertices of a
// cluster stand next to each other, in the caller's order. Clusters borrow the other vertices that they use from
// earlier clusters, so that refreshing in order reads each vertex of the caller once. A vertex that no facet uses is
// left out. "vertex" below means the new number, "source vertex" the caller's; likewise "facet" and "source facet".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/vec3.h"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/facet_order.h"

namespace tact::narrowphase {

using base::Box;
using base::Vec3;

inline constexpr int kGroupSize = 32;  // clusters in a group, at most: neighbours, with a box of their own

// Corners of a facet as vertices, and as points.
using Corners = std::array<int, 3>;
using Triangle = std::array<Vec3, 3>;

// The most doubles, or as many bytes, that a SIMD loop reads past the end of an array: arrays are longer by so many.
inline constexpr int kPadding = 8;

// Boxes in separate arrays, one entry a cluster (or a facet), for loops that compare many at once: lower x, y, z, upper
// x, y, z, each `stride` long, in one block of memory.
class BoxView {
 public:
  BoxView() = default;
  BoxView(const double* bounds, std::size_t stride) : bounds_(bounds), stride_(stride) {}
  const double* lower(int axis) const { return bounds_ + static_cast<std::size_t>(axis) * stride_; }
  const double* upper(int axis) const { return lower(axis + 3); }
  BoxPointers pointers(int first = 0) const {
    return {{lower(0) + first, lower(1) + first, lower(2) + first},
            {upper(0) + first, upper(1) + first, upper(2) + first}};
  }
  Box operator[](std::size_t i) const {
    return {{lower(0)[i], lower(1)[i], lower(2)[i]}, {upper(0)[i], upper(1)[i], upper(2)[i]}};
  }

 private:
  const double* bounds_ = nullptr;
  std::size_t stride_ = 0;
};

// Where a mesh is, or was: its vertices and the boxes of its clusters and of all.
struct Placement {
  PointArrays points{};
  BoxView cluster_boxes;
  Box box;
};

// Writes an entry of what a BoxView shows.
inline void set_box(double* bounds, std::size_t stride, std::size_t i, const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bounds[axis * stride + i] = box.lower[static_cast<int>(axis)];
    bounds[(axis + 3) * stride + i] = box.upper[static_cast<int>(axis)];
  }
}

// Boxes with memory of their own.
class BoxArrays {
 public:
  void resize(std::size_t count);  // what the boxes are then is left open
  void set(std::size_t i, const Box& box) { set_box(bounds_.data(), stride_, i, box); }
  BoxView view() const { return {bounds_.data(), stride_}; }
  BoxPointers pointers() const { return view().pointers(); }
  Box operator[](std::size_t i) const { return view()[i]; }
  BoxBounds bounds(std::size_t i) const {
    const BoxPointers p = pointers();
    return {{p.lower[0][i], p.lower[1][i], p.lower[2][i]}, {p.upper[0][i], p.upper[1][i], p.upper[2][i]}};
  }

 private:
  std::vector<double> bounds_;  // and kPadding more
  std::size_t stride_ = 0;
};

// The same for a few, in memory of a fixed size. What the boxes are at first is left open.
template <int kMostBoxes>
struct FixedBoxes {
  static constexpr int kMost = kMostBoxes;
  int count = 0;
  double bounds[6][kMost + kPadding];  // lower x, y, z, upper x, y, z

  void set(int i, const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
      bounds[axis][i] = box.lower[axis];
      bounds[axis + 3][i] = box.upper[axis];
    }
  }
  Box box(int i) const {
    return {{bounds[0][i], bounds[1][i], bounds[2][i]}, {bounds[3][i], bounds[4][i], bounds[5][i]}};
  }
  BoxPointers pointers() const { return {{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}}; }
};

// A box as the kernels take it.
inline BoxBounds bounds_of(const Box& box) {
  return {{box.lower.x, box.lower.y, box.lower.z}, {box.upper.x, box.upper.y, box.upper.z}};
}

// The first coordinate that cannot be taken, if any.
struct PositionProblem {
  enum Kind { none, non_finite, out_of_range } kind = none;
  int source_vertex = -1;
  int axis = -1;
};

// Looks at 3 x count coordinates, column by column: are all finite and at most `largest` in size?
PositionProblem find_position_problem(const double* positions, std::size_t count, double largest);

// Asks for memory that is used soon: a line, or all lines of an array; of long ones only the beginning, as the hardware
// then sees what is wanted. Many lines go to the second level of the cache, as the first has room for few under way.
// GCC 12 thinks a function that only prefetches has no effect, and leaves out its calls: hence the empty statements.
inline constexpr int kPrefetchedBytes = 4096;
inline void prefetch_line(const void* line) {
  __builtin_prefetch(line, 0, 3);
  asm volatile("");
}
template <class T>
void prefetch_lines(const T* begin, std::size_t count) {
  const auto address = reinterpret_cast<std::uintptr_t>(begin), line = address / 64 * 64;
  const std::size_t size = address - line + std::min<std::size_t>(count * sizeof(T), kPrefetchedBytes);
  for (std::size_t i = 0; i < size; i += 64) __builtin_prefetch(reinterpret_cast<const char*>(line + i), 0, 2);
  asm volatile("");
}

class ClusteredMesh {
 public:
  // positions: 3 x V coordinates in metres, checked by the caller; facets: 3 x F source vertices, each 0 <= i < V.
  ClusteredMesh(std::span<const double> positions, std::span<const int> facets);
  ClusteredMesh(ClusteredMesh&&) = default;
  ClusteredMesh& operator=(ClusteredMesh&&) = default;

  // Reads new positions, 3 x V, in one pass: refreshes all boxes, looks whether every coordinate is finite and at most
  // `largest` in size, and whether any of a used vertex changed. The mesh moves if any did and none is bad. Large
  // meshes are cut into ranges of clusters for up to `threads` threads. Memory is asked for in good time if
  // `asks_ahead`, which pays unless positions are in the cache. Allocates nothing.
  enum class Refresh { same, changed, bad };
  Refresh refresh(const double* positions, double largest, int threads, bool asks_ahead = true);
  // Undoes a refresh() that changed the mesh, right after it: so that of a batch of bodies all move or none.
  void take_back();
  // For positions that were checked; says whether any changed.
  bool set_positions(const double* positions, int threads);
  // Asks for the memory that refresh() reads and writes, in good time.
  void prefetch(const double* positions) const;

  int source_vertex_count() const { return source_vertex_count_; }
  int vertex_count() const { return vertex_count_; }
  int facet_count() const { return facet_count_; }
  int facet_of_source(int source_facet) const { return facet_of_source_[source_facet]; }
  int cluster_count() const { return (facet_count() + kClusterSize - 1) / kClusterSize; }
  int group_count() const { return (cluster_count() + kGroupSize - 1) / kGroupSize; }

  // How many vertices of the caller refresh() reads for clusters, those that several clusters share more than once.
  int vertex_reads() const { return vertex_count_ + borrowed_count_; }

  int source_vertex(int vertex) const { return source_vertices()[vertex]; }
  // Of all vertices; after them stand those of the borrowed vertices of all clusters.
  const int* source_vertices() const { return ranges_ + 2 * cluster_count() + 2; }
  int source_facet(int facet) const { return source_facet_[facet]; }

  // The clusters of a group are cluster_begin(g) <= c < cluster_end(g).
  int cluster_begin(int group) const { return group * kGroupSize; }
  int cluster_end(int group) const { return std::min((group + 1) * kGroupSize, cluster_count()); }

  // The facets of a cluster are facet_begin(c) <= f < facet_end(c), the vertices that it owns
  // vertex_begin(c) <= v < vertex_end(c).
  int facet_begin(int cluster) const { return cluster * kClusterSize; }
  int facet_end(int cluster) const { return std::min((cluster + 1) * kClusterSize, facet_count()); }
  int vertex_begin(int cluster) const { return ranges_[2 * cluster]; }
  int vertex_end(int cluster) const { return vertex_begin(cluster + 1); }

  Corners corners(int facet) const;
  Vec3 position(int vertex) const {
    const double* x = placed_ + vertex;
    return {x[0], x[stride_], x[2 * stride_]};
  }
  Triangle triangle(int facet) const;

  // What is behind corners() and position(), for loops over many.
  ClusterFacets facets_of(int cluster) const;
  PointArrays points() const { return {placed_, placed_ + stride_, placed_ + 2 * stride_}; }

  // The box of all facets; empty if there is none. The boxes of the clusters, borrowed vertices included, and of the
  // groups, if there are several.
  const Box& box() const { return box_; }
  BoxView cluster_boxes() const { return cluster_boxes(placed_); }
  BoxView group_boxes() const { return group_boxes(placed_); }
  // Where the mesh is; where it was before the last refresh() that changed it, valid until the next; and where it was
  // when keep_placement_before() wrote that to memory of the caller, of placement_size() doubles.
  Placement placement() const { return placement_in(placed_); }
  Placement placement_before() const { return placement_in(other_); }
  Placement placement_in(const double* memory) const;
  std::size_t placement_size() const { return memory_size().placement + kPadding; }
  void keep_placement_before(double* memory) const { std::copy_n(other_, memory_size().placement, memory); }
  // How large the clusters are: the sum of (length + width + height)² of their boxes, in square metres.
  double spread() const;
  // The same over the spread of the facets, of some hundred of them at most: about 0.6 for a smooth mesh, whatever its
  // size, and more as clusters lose the shape in which they were grouped. Zero if the facets have no size.
  double looseness() const;
  // The same mesh, its facets grouped by where they are now; and what numbers this one's vertices have in `other`,
  // which was grouped from it.
  ClusteredMesh regrouped() const;
  std::vector<int> numbers_in(const ClusteredMesh& other) const;
  // How far the vertices, of which there must be one, reach along the diagonals of a cube's faces, in one more pass.
  DiagonalBounds diagonals() const { return kernels().diagonal_bounds(points(), vertex_count_); }

  // Asks for the memory of a cluster's facets, in good time.
  void prefetch_facets(int cluster) const {
    const int first = vertex_begin(cluster), borrowed = borrowed_begin(cluster);
    const auto owned = static_cast<std::size_t>(vertex_end(cluster) - first);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      prefetch_lines(placed_ + axis * stride_ + first, owned);
      prefetch_lines(corner_[axis] + facet_begin(cluster),
                     static_cast<std::size_t>(facet_end(cluster) - facet_begin(cluster)));
    }
    prefetch_lines(borrowed_ + borrowed, static_cast<std::size_t>(borrowed_begin(cluster + 1) - borrowed));
    prefetch_lines(source_facet_ + facet_begin(cluster),
                   static_cast<std::size_t>(facet_end(cluster) - facet_begin(cluster)));
  }
  // Asks for the position of a vertex, in good time.
  void prefetch_position(int vertex) const {
    for (std::size_t axis = 0; axis < 3; ++axis) prefetch_line(placed_ + axis * stride_ + vertex);
  }
  // Asks for the positions of all vertices, or of the first thousands.
  void prefetch_points() const {
    for (std::size_t axis = 0; axis < 3; ++axis) prefetch_lines(placed_ + axis * stride_, stride_);
  }
  // Asks for the memory of the clusters' boxes, and of where their vertices begin, in good time.
  void prefetch_boxes() const {
    prefetch_lines(ranges_, 2 * static_cast<std::size_t>(cluster_count()));
    prefetch_lines(cluster_boxes().lower(0), 6 * static_cast<std::size_t>(cluster_count()));
  }

  // The memory of a mesh: two placements (see below), what refresh() reads besides, and the rest. A mesh begins with
  // memory of its own, in one block; where many small ones are refreshed, parts of a kind are better next to each
  // other, as the hardware then foresees what is read.
  struct Memory {
    double* placement[2];
    int* indices;
    std::byte* rest;
  };
  struct MemorySize {
    std::size_t placement;  // doubles, of each
    std::size_t indices;    // ints
    std::size_t rest;       // bytes; begins where an int may
  };
  MemorySize memory_size() const;
  // Moves there. The memory stays the caller's, until the mesh moves again or is no more; kPadding doubles, or as many
  // bytes, follow the last placement and the rest.
  void move_to(const Memory& memory);
  bool has_own_memory() const { return memory_ != nullptr; }

  // Throws std::logic_error that says what is broken: every source facet stands in one cluster, every used source
  // vertex has one owner, those of a cluster stand in the caller's order, boxes are the boxes of their vertices. For
  // tests.
  void validate() const;

 private:
  struct Numbering;
  Numbering number_vertices(std::span<const int> facets, std::span<const int> order) const;
  void take_memory(const Numbering& numbering, std::span<const int> order);
  void lay_out(const Memory& memory);
  // All that moves with the vertices is a placement: x of each vertex, and stride_ later y, and z; then the boxes of
  // the clusters, then those of the groups.
  BoxView cluster_boxes(const double* placement) const {
    return {placement + 3 * stride_, static_cast<std::size_t>(cluster_count())};
  }
  BoxView group_boxes(const double* placement) const {
    return {cluster_boxes(placement).lower(0) + 6 * cluster_count(), static_cast<std::size_t>(group_count())};
  }
  Box box_of(const double* placement) const;
  Refreshed refresh_range(const double* positions, int cluster_begin, int cluster_end, bool asks_ahead) const;
  void refresh_groups() const;

  // Where the borrowed vertices of a cluster begin.
  int borrowed_begin(int cluster) const { return ranges_[2 * cluster + 1]; }
  const int* borrowed_sources() const { return source_vertices() + vertex_count_; }

  // What refresh() needs comes first.
  int source_vertex_count_ = 0;
  int vertex_count_ = 0;
  int facet_count_ = 0;
  int borrowed_count_ = 0;
  int unused_count_ = 0;
  std::size_t stride_ = 0;
  double* placed_ = nullptr;  // the placement where the mesh is
  double* other_ = nullptr;   // one to refresh into, and after that where the mesh was
  Box box_;
  // vertex_begin and borrowed_begin of each cluster and one more; after them all source vertices.
  int* ranges_ = nullptr;
  int* unused_sources_ = nullptr;  // source vertices that no facet uses
  int* borrowed_ = nullptr;        // vertices that a cluster uses and does not own, cluster by cluster
  std::uint8_t* corner_[3] = {};   // of each facet: vertices that its cluster owns come first, then the borrowed
  int* source_facet_ = nullptr;    // of each facet
  int* facet_of_source_ = nullptr;
  std::unique_ptr<std::byte[]> memory_;  // unless move_to() was called
};

}  // namespace tact::narrowphase
