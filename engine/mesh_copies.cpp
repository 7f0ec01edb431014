#include "engine/mesh_copies.h"

namespace tact {

namespace {

const int* at_row(const std::vector<int>& all, int row, std::size_t width) {
  const std::size_t begin = width * static_cast<std::size_t>(row);
  if (row < 0 || begin >= all.size())
    throw Error(ErrorCode::wrong_order, "the answer is of facets that have changed since");
  return &all[begin];
}

}  // namespace

MeshCopy::MeshCopy(const World& world, BodyId body) : coordinates_(3 * world.vertex_count(body)) {
  world.copy_positions(body, coordinates_);
}

void MeshCopy::copy_features(const World& world, BodyId body) {
  if (has_features_) return;
  facets_.resize(3 * world.facet_count(body));
  ends_.resize(2 * world.edge_count(body));
  points_.resize(world.point_count(body));
  world.copy_facets(body, facets_);
  world.copy_edges(body, ends_);
  world.copy_points(body, points_);
  has_features_ = true;
}

base::Vec3 MeshCopy::vertex(int v) const {
  const std::size_t at = 3 * static_cast<std::size_t>(v);
  if (v < 0 || at >= coordinates_.size())
    throw Error(ErrorCode::wrong_order, "the report is of facets that have changed since");
  return {coordinates_[at], coordinates_[at + 1], coordinates_[at + 2]};
}

base::Vec3 MeshCopy::place(const std::array<int, 3>& vertices, const std::array<double, 3>& weights) const {
  base::Vec3 sum{};
  for (std::size_t k = 0; k < 3 && vertices[k] >= 0; ++k) sum = sum + weights[k] * vertex(vertices[k]);
  return sum;
}

std::array<int, 3> MeshCopy::corners(int facet) const {
  const int facets = facet_count(), edges = static_cast<int>(ends_.size() / 2);
  if (facet < facets) {
    const int* const corner = at_row(facets_, facet, 3);
    return {corner[0], corner[1], corner[2]};
  }
  if (facet < facets + edges) {
    const int* const end = at_row(ends_, facet - facets, 2);
    return {end[0], end[1], -1};
  }
  return {*at_row(points_, facet - facets - edges, 1), -1, -1};
}

std::array<base::Vec3, 3> MeshCopy::facet(int f) const {
  const int* const corner = at_row(facets_, f, 3);
  return {vertex(corner[0]), vertex(corner[1]), vertex(corner[2])};
}

MeshCopy& MeshCopies::copy_of(BodyId body) {
  const auto found = copies_.find(body);
  return found != copies_.end() ? found->second : copies_.emplace(body, MeshCopy(world_, body)).first->second;
}

const MeshCopy& MeshCopies::mesh(BodyId body) {
  MeshCopy& copy = copy_of(body);
  copy.copy_features(world_, body);
  return copy;
}

}  // namespace tact
