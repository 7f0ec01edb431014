// A triangle mesh as the narrow phase sees it: clusters of up to 64 neighbouring facets with a box each, in groups of
// up to 32 clusters with a box each. Every spatial query starts from the boxes and opens only the clusters that matter.
//
// Its parts, a file each: MeshTopology is what does not move, MeshPlacements where it is and was, MeshMemory how both
// lie in memory. refit.h moves a mesh, cluster_quality.h says how well its clusters fit, prefetch.h prefetches its
// parts.
//
// A rigid mesh moves by a pose instead: rigid_pose.h. Until it is placed its vertices and boxes are not to be read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "narrowphase/mesh/mesh_memory.h"
#include "narrowphase/mesh/mesh_placements.h"
#include "narrowphase/mesh/mesh_topology.h"
#include "narrowphase/mesh/mesh_travel.h"
#include "narrowphase/mesh/rigid_pose.h"

namespace tact::narrowphase {

/// The three corners of a facet as points, in metres.
using Triangle = std::array<Vec3, 3>;

/// Edges and points of the caller are facets without area here: of vertices i, j, j and i, i, i. They are the last of
/// the source facets, edges first; those before them are the surface.
struct WithoutArea {
  int edges = 0, points = 0;
};

class ClusteredMesh : public MeshTopology {
 public:
  /// positions: 3 x V coordinates in metres, checked by the caller; facets: 3 x F source vertices, each 0 <= i < V.
  ClusteredMesh(std::span<const double> positions, std::span<const int> facets, WithoutArea last = {});
  /// Clusters take the facets in this order, each of them once: that of another mesh, see facet_order().
  ClusteredMesh(std::span<const double> positions, std::span<const int> facets, std::span<const int> order,
                WithoutArea last = {});

  int edge_count() const { return last_.edges; }
  int point_count() const { return last_.points; }
  int surface_facet_count() const { return facet_count() - last_.edges - last_.points; }
  bool has_surface_alone() const { return (last_.edges | last_.points) == 0; }
  bool is_of_surface(int source_facet) const { return source_facet < surface_facet_count(); }

  Vec3 position(int vertex) const { return placements_.position(vertex); }
  PointArrays points() const { return placements_.points(); }
  Triangle triangle(int facet) const;
  using MeshTopology::facets_of;
  ClusterFacets facets_of(int cluster) const { return facets_of(cluster, points()); }

  /// See MeshPlacements.
  const Box& box() const { return placements_.box(); }
  BoxView cluster_boxes() const { return placements_.cluster_boxes(); }
  BoxView group_boxes() const { return placements_.group_boxes(); }
  const MeshPlacements& placements() const { return placements_; }
  MeshPlacements& placements() { return placements_; }

  /// From now on the mesh is rigid: where it is now is its rest shape, and it stands there. It is refitted no more. Its
  /// pose is the caller's, and stays as long as the mesh is used: who sets it needs nothing of the mesh.
  void make_rigid(RigidPose* pose);
  bool is_rigid() const { return rigid_ != nullptr; }
  bool is_placed() const { return rigid_ == nullptr || rigid_->is_placed(); }
  /// Places it where its pose says, once, whichever threads call this.
  void place();
  /// A box of all its vertices: their box, if it is placed.
  Box rough_box() const { return is_placed() ? box() : rigid_->box_at(rigid_->pose()); }
  /// Writes where it is at some pose to a placement, of placements().size() doubles. Returns the box of all facets.
  Box place_at(const Pose& pose, double* placement) const;
  /// Where a vertex is, also if the mesh is not placed.
  Vec3 position_by_pose(int vertex) const;

  /// Moves to memory of the caller, of memory_size(counts()). It stays the caller's, until the mesh moves again or is
  /// no more; kPadding doubles, or as many bytes, follow the last placement and the rest.
  void move_to(const MeshMemory& memory);
  bool has_own_memory() const { return own_memory_ != nullptr; }

  /// How far the vertices have gone, if that is kept: from keep_travel(true) on, until keep_travel(false) or until it
  /// was not asked for again in kMostUnasked refits.
  const MeshTravel* travel() const { return keeps_travel_ ? travel_.get() : nullptr; }
  MeshTravel* travel() { return keeps_travel_ ? travel_.get() : nullptr; }
  void keep_travel(bool keep);
  static constexpr int kMostUnasked = 4;
  /// Another number as soon as the mesh has moved and travel() does not tell how far.
  std::uint64_t travel_epoch() const { return travel_epoch_; }
  /// This one, with other clusters, stands for `earlier` from now on.
  void begin_travel_after(const ClusteredMesh& earlier) { travel_epoch_ = earlier.travel_epoch_ + 1; }
  /// After a refit that changed the mesh.
  void count_travel();

  /// Throws std::logic_error that says what is broken: every source facet stands in one cluster, every used source
  /// vertex has one owner, those of a cluster stand in the caller's order, boxes are the boxes of their vertices. For
  /// tests.
  void validate() const;

 private:
  struct Made;
  explicit ClusteredMesh(Made made);
  static Made make(std::span<const double> positions, std::span<const int> facets, std::span<const int> order);
  void validate_numbers() const;
  void validate_boxes() const;

  MeshPlacements placements_;
  std::unique_ptr<std::byte[]> own_memory_;  // unless move_to() was called
  std::unique_ptr<MeshTravel> travel_;
  RigidPose* rigid_ = nullptr;
  bool keeps_travel_ = false;  // else travel_ is memory alone
  int unasked_refits_ = 0;     // since keep_travel(true)
  std::uint64_t travel_epoch_ = 0;
  WithoutArea last_;
};

}  // namespace tact::narrowphase
