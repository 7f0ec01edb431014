#include "narrowphase/mesh/clustered_mesh.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "narrowphase/mesh/facet_order.h"
#include "narrowphase/mesh/refit.h"
#include "narrowphase/mesh/vertex_numbering.h"

namespace tact::narrowphase {

namespace {

[[noreturn]] void broken(const std::string& what) { throw std::logic_error("ClusteredMesh: " + what); }

void write(const VertexNumbering& numbering, std::span<const int> order, const MeshArrays& arrays) {
  std::ranges::copy(numbering.ranges, arrays.ranges);
  std::ranges::copy(numbering.source_vertices, arrays.source_vertices);
  std::ranges::copy(numbering.borrowed_sources, arrays.borrowed_sources);
  std::ranges::copy(numbering.unused_sources, arrays.unused_sources);
  std::ranges::copy(numbering.borrowed, arrays.borrowed);
  std::ranges::copy(order, arrays.source_facet);
  for (int f = 0; f < static_cast<int>(order.size()); ++f) arrays.facet_of_source[arrays.source_facet[f]] = f;
  std::uint8_t* corner = arrays.corner;
  for (const auto& corners : numbering.corner) corner = std::ranges::copy(corners, corner).out;
}

}  // namespace

struct ClusteredMesh::Made {
  MeshCounts counts;
  OwnMemory memory;
};

ClusteredMesh::Made ClusteredMesh::make(std::span<const double> positions, std::span<const int> facets,
                                        std::span<const int> order) {
  const int source_vertices = static_cast<int>(positions.size() / 3);
  const VertexNumbering numbering = number_vertices(facets, order, source_vertices);
  const MeshCounts counts{.source_vertices = source_vertices,
                          .vertices = static_cast<int>(numbering.source_vertices.size()),
                          .facets = static_cast<int>(order.size()),
                          .borrowed = static_cast<int>(numbering.borrowed.size()),
                          .unused = static_cast<int>(numbering.unused_sources.size())};
  OwnMemory memory = own_memory(counts);
  write(numbering, order, arrays_in(memory.parts, counts));
  return {counts, std::move(memory)};
}

ClusteredMesh::ClusteredMesh(std::span<const double> positions, std::span<const int> facets, WithoutArea last)
    : ClusteredMesh(positions, facets, facet_order(positions, facets, static_cast<int>(positions.size() / 3)), last) {}

ClusteredMesh::ClusteredMesh(std::span<const double> positions, std::span<const int> facets, std::span<const int> order,
                             WithoutArea last)
    : ClusteredMesh(make(positions, facets, order)) {
  last_ = last;
  // The memory is zero: if all positions are, nothing changed, and the placement that was written is not yet in use.
  if (refit(*this, positions.data()) == Refit::same) placements_.exchange(placements_.spare_box());
}

ClusteredMesh::ClusteredMesh(Made made)
    : MeshTopology(made.memory.parts, made.counts),
      placements_(made.memory.parts.placement, made.counts),
      own_memory_(std::move(made.memory.block)) {}

void ClusteredMesh::move_to(const MeshMemory& memory) {
  MeshTopology::move_to(memory);
  placements_.move_to(memory.placement);
  own_memory_.reset();
}

Triangle ClusteredMesh::triangle(int facet) const {
  const Corners c = corners(facet);
  return {position(c[0]), position(c[1]), position(c[2])};
}

void ClusteredMesh::make_rigid(RigidPose* pose) {
  keep_travel(false);
  std::copy_n(placements_.now_memory(), placements_.size() - kPadding, placements_.spare_memory());
  rigid_ = pose;
  rigid_->begin(points(), vertex_count(), box());
}

void ClusteredMesh::place() {
  if (rigid_ == nullptr) return;
  rigid_->place_once([&] {
    placements_.set_box(place_at(rigid_->pose(), placements_.now_memory()));
    ++travel_epoch_;
  });
}

Box ClusteredMesh::place_at(const Pose& pose, double* placement) const {
  const PlacementArrays to = arrays_in(placement, counts());
  PlaceInput input{.rotation = {},
                   .translation = {pose.translation.x, pose.translation.y, pose.translation.z},
                   .rest = placements_.before().points,
                   .cluster_count = cluster_count(),
                   .ranges = refit_indices().data(),
                   .borrowed = borrowed_vertices(),
                   .x = to.x,
                   .y = to.y,
                   .z = to.z,
                   .boxes = to.cluster_boxes};
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) input.rotation[axis][k] = pose.rows[axis][k];
  }
  const Box box = to_box(kernels().place_clusters(input));
  find_group_boxes(*this, placement);
  return box;
}

Vec3 ClusteredMesh::position_by_pose(int vertex) const {
  if (rigid_ == nullptr) return position(vertex);
  const PointArrays rest = placements_.before().points;
  return placed(rigid_->pose(), Vec3{rest.x[vertex], rest.y[vertex], rest.z[vertex]});
}

void ClusteredMesh::keep_travel(bool keep) {
  if (rigid_ != nullptr) keep = false;  // the travel of its clusters is not kept
  unasked_refits_ = 0;
  if (keep == keeps_travel_) return;
  if (travel_ == nullptr) travel_ = std::make_unique<MeshTravel>(*this);
  keeps_travel_ = keep;
  ++travel_epoch_;
}

void ClusteredMesh::count_travel() {
  if (!keeps_travel_) {
    ++travel_epoch_;
    return;
  }
  travel_->add_steps();
  if (++unasked_refits_ > kMostUnasked) keep_travel(false);
}

void ClusteredMesh::validate() const {
  validate_numbers();
  validate_boxes();
}

void ClusteredMesh::validate_numbers() const {
  std::vector<char> seen(static_cast<std::size_t>(facet_count()), 0);
  for (int facet = 0; facet < facet_count(); ++facet) {
    const int f = source_facet(facet);
    if (f < 0 || f >= facet_count() || seen[f]++) broken("source facet " + std::to_string(f));
    if (facet_of_source(f) != facet) broken("the place of source facet " + std::to_string(f));
  }
  std::vector<char> owned(static_cast<std::size_t>(source_vertex_count()), 0);
  for (int v = 0; v < vertex_count(); ++v) {
    if (owned[source_vertex(v)]++) broken("source vertex " + std::to_string(source_vertex(v)) + " has two owners");
  }
  for (int c = 0; c < cluster_count(); ++c) {
    if (!std::is_sorted(source_vertices() + vertex_begin(c), source_vertices() + vertex_end(c)))
      broken("the order of the vertices of cluster " + std::to_string(c));
    for (int f = facet_begin(c); f < facet_end(c); ++f) {
      for (const int v : corners(f)) {
        if (v >= vertex_end(c)) broken("cluster " + std::to_string(c) + " uses a vertex of a later one");
      }
    }
  }
}

void ClusteredMesh::validate_boxes() const {
  Box whole;
  for (int c = 0; c < cluster_count(); ++c) {
    Box box;
    for (int f = facet_begin(c); f < facet_end(c); ++f) {
      for (const int v : corners(f)) box = extended(box, position(v));
    }
    if (!(box == cluster_boxes()[c])) broken("box of cluster " + std::to_string(c));
    whole = merged(whole, box);
  }
  if (!(whole == box())) broken("box of the mesh");
  for (int g = 0; g < group_count() && group_count() > 1; ++g) {
    Box box;
    for (int c = cluster_begin(g); c < cluster_end(g); ++c) box = merged(box, cluster_boxes()[c]);
    if (!(box == group_boxes()[g])) broken("box of group " + std::to_string(g));
  }
}

}  // namespace tact::narrowphase
