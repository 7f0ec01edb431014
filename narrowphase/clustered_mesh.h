// A triangle mesh as the narrow phase sees it: facets grouped into clusters of up to 64 neighbours, vertices stored
// cluster by cluster, a box a cluster. Every spatial query starts from the boxes and opens only the clusters that
// matter.
//
// Vertices are renumbered: a vertex belongs to the first cluster that uses it (its *owner*), and the vertices of a
// cluster stand next to each other. Clusters borrow the other vertices that they use from earlier clusters, so that
// refreshing in order reads each vertex of the caller once. A vertex that no facet uses is left out. "vertex" below
// means the new number, "source vertex" the caller's; likewise "facet" and "source facet".
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/vec3.h"
#include "narrowphase/kernels/kernels.h"

namespace tact::narrowphase {

using base::Box;
using base::Vec3;

inline constexpr int kClusterSize = 64;  // facets in a cluster, at most
inline constexpr int kGroupSize = 32;    // clusters in a group, at most: neighbours, with a box of their own

// Corners of a facet as vertices, and as points.
using Corners = std::array<int, 3>;
using Triangle = std::array<Vec3, 3>;

// The most elements that a SIMD loop reads past the end of an array: arrays are longer by so many.
inline constexpr int kPadding = 8;

// Boxes in separate arrays, one entry a cluster (or a facet), for loops that compare many at once. The arrays stand in
// one block of memory, so that the boxes of a small body are next to each other.
class BoxArrays {
 public:
  void resize(std::size_t count);  // empty boxes
  void prefetch() const;
  void set(std::size_t i, const Box& box);
  const double* lower(int axis) const { return bounds_.data() + static_cast<std::size_t>(axis) * stride_; }
  const double* upper(int axis) const { return lower(axis + 3); }
  BoxPointers pointers(int first = 0) const;
  Box operator[](std::size_t i) const {
    return {{lower(0)[i], lower(1)[i], lower(2)[i]}, {upper(0)[i], upper(1)[i], upper(2)[i]}};
  }

 private:
  std::vector<double> bounds_;  // lower x, y, z, upper x, y, z, and kPadding more
  std::size_t stride_ = 0;
};

// The first coordinate that cannot be taken, if any.
struct PositionProblem {
  enum Kind { none, non_finite, out_of_range } kind = none;
  int source_vertex = -1;
  int axis = -1;
};

// Looks at 3 x count coordinates, column by column: are all finite and at most `largest` in size?
PositionProblem find_position_problem(const double* positions, std::size_t count, double largest);

// Asks for memory that is used soon: of long arrays only the beginning, as the hardware then sees what is wanted.
inline constexpr int kPrefetchedBytes = 4096;
template <class T>
void prefetch_lines(const T* begin, std::size_t count) {
  const auto* bytes = reinterpret_cast<const char*>(begin);
  const std::size_t size = std::min<std::size_t>(count * sizeof(T), kPrefetchedBytes);
  for (std::size_t i = 0; i < size; i += 64) __builtin_prefetch(bytes + i);
}

class ClusteredMesh {
 public:
  // positions: 3 x V coordinates in metres, checked by the caller; facets: 3 x F source vertices, each 0 <= i < V.
  ClusteredMesh(std::span<const double> positions, std::span<const int> facets);

  // Reads the new positions, 3 x V, and refreshes all boxes, in one pass; says whether any coordinate of a used vertex
  // changed. Large meshes are cut into ranges of clusters for up to `threads` threads. Allocates nothing, so that of a
  // batch of bodies none can fail when others have moved.
  bool set_positions(const double* positions, int threads);
  // Asks for the memory that set_positions writes, in good time.
  void prefetch() const;

  int source_vertex_count() const { return source_vertex_count_; }
  int vertex_count() const { return vertex_count_; }
  int facet_count() const { return facet_count_; }
  int facet_of_source(int source_facet) const { return facet_of_source_[static_cast<std::size_t>(source_facet)]; }
  int cluster_count() const { return (facet_count() + kClusterSize - 1) / kClusterSize; }
  int group_count() const { return (cluster_count() + kGroupSize - 1) / kGroupSize; }

  // How many vertices of the caller set_positions reads, those that several clusters share more than once.
  int vertex_reads() const { return vertex_count() + static_cast<int>(borrowed_.size()); }

  int source_vertex(int vertex) const { return source_vertices()[vertex]; }
  int source_facet(int facet) const { return source_facet_[static_cast<std::size_t>(facet)]; }

  // The clusters of a group are cluster_begin(g) <= c < cluster_end(g).
  int cluster_begin(int group) const { return group * kGroupSize; }
  int cluster_end(int group) const { return std::min((group + 1) * kGroupSize, cluster_count()); }

  // The facets of a cluster are facet_begin(c) <= f < facet_end(c), the vertices that it owns
  // vertex_begin(c) <= v < vertex_end(c).
  int facet_begin(int cluster) const { return cluster * kClusterSize; }
  int facet_end(int cluster) const { return std::min((cluster + 1) * kClusterSize, facet_count()); }
  int vertex_begin(int cluster) const { return indices_[2 * static_cast<std::size_t>(cluster)]; }
  int vertex_end(int cluster) const { return vertex_begin(cluster + 1); }

  Corners corners(int facet) const;
  Vec3 position(int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    const double* x = coordinates_.data() + v;
    return {x[0], x[stride_], x[2 * stride_]};
  }
  Triangle triangle(int facet) const;

  // What is behind corners() and position(), for loops over many.
  ClusterFacets facets_of(int cluster) const;
  PointArrays points() const {
    return {coordinates_.data(), coordinates_.data() + stride_, coordinates_.data() + 2 * stride_};
  }

  // The box of all facets; empty if there is none. The boxes of the clusters, borrowed vertices included, and of the
  // groups, if there are several.
  const Box& box() const { return box_; }
  const BoxArrays& cluster_boxes() const { return cluster_boxes_; }
  const BoxArrays& group_boxes() const { return group_boxes_; }

  // Throws std::logic_error that says what is broken: every source facet stands in one cluster, every used source
  // vertex has one owner, boxes are the boxes of their vertices. For tests.
  void validate() const;

 private:
  void group_facets(std::span<const double> positions, std::span<const int> facets);
  void number_vertices(std::span<const int> facets);
  // Says what changed and gives the box of the clusters.
  struct Refreshed {
    bool changed = false;
    Box box;
  };
  Refreshed refresh_range(const double* positions, int cluster_begin, int cluster_end);

  // Where the borrowed vertices of a cluster begin.
  int borrowed_begin(int cluster) const { return indices_[2 * static_cast<std::size_t>(cluster) + 1]; }
  // Of all vertices, and of the borrowed ones of all clusters.
  const int* source_vertices() const { return indices_.data() + 2 * cluster_count() + 2; }
  const int* borrowed_sources() const { return source_vertices() + vertex_count_; }

  // What set_positions needs comes first, in few blocks of memory: small bodies are scattered.
  int source_vertex_count_ = 0;
  int vertex_count_ = 0;
  int facet_count_ = 0;
  std::vector<int> indices_;         // vertex_begin and borrowed_begin of each cluster and one more; source vertices
  std::vector<double> coordinates_;  // x of each vertex, and stride_ later y, and z
  std::size_t stride_ = 0;
  BoxArrays cluster_boxes_;
  Box box_;
  BoxArrays group_boxes_;
  std::vector<int> source_facet_;  // of each facet
  std::vector<int> facet_of_source_;
  std::vector<std::uint8_t> corner_[3];  // of each facet: vertices that its cluster owns come first, then the borrowed
  std::vector<int> borrowed_;            // vertices that a cluster uses and does not own, cluster by cluster
};

}  // namespace tact::narrowphase
