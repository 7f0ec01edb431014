#include "engine/bodies/given_mesh.h"

#include <tact/world.h>

#include "engine/bodies/checks.h"
#include "engine/bodies/columns.h"

namespace tact {

MeshArguments arguments_of(const BodyDefinition& definition) {
  return {definition.positions, definition.facets, definition.edges, definition.points};
}

MeshArguments arguments_of(const MeshUpdate& update) {
  return {update.positions, update.facets, update.edges, update.points};
}

GivenMesh::GivenMesh(const MeshArguments& given, const std::string& name)
    : last_{static_cast<int>(given.edges.cols()), static_cast<int>(given.points.size())} {
  make_copy_room(given.positions, position_copy_);
  make_copy_room(given.facets, facet_copy_);
  positions_ = packed(given.positions, std::span(position_copy_));
  surface_ = facets_ = packed(given.facets, std::span(facet_copy_));
  check_positions(positions_.data(), vertex_count(), name);
  check_corners(surface_, given.facets, given.positions.cols(), name);
  if (last_.edges + last_.points == 0) return;
  std::vector<int> edge_copy;
  make_copy_room(given.edges, edge_copy);
  const std::span<const int> ends = packed(given.edges, std::span(edge_copy));
  check_corners(ends, given.edges, given.positions.cols(), name);
  check_points(given.points, given.positions.cols(), name);
  all_.reserve(surface_.size() + 3 * (ends.size() / 2 + given.points.size()));
  all_.assign(surface_.begin(), surface_.end());
  for (std::size_t i = 0; i < ends.size(); i += 2) all_.insert(all_.end(), {ends[i], ends[i + 1], ends[i + 1]});
  for (const int v : given.points) all_.insert(all_.end(), {v, v, v});
  facets_ = all_;
}

void check_shape(const MeshArguments& given, std::size_t bodies, const std::string& name) {
  check_array(given.positions, name);
  check_array(given.facets, name);
  check_array(given.edges, name);
  const std::ptrdiff_t all = given.facets.cols() + given.edges.cols() + std::ssize(given.points);
  check_counts(given.positions.cols(), all, bodies, name);
}

}  // namespace tact
