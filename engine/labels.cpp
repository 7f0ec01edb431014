#include "engine/labels.h"

#include <algorithm>

#include "engine/bodies/checks.h"

namespace tact {

namespace {

using narrowphase::ClusteredMesh;

bool has_all(const ClusteredMesh& mesh, int facet, const std::array<int, 3>& vertices) {
  const narrowphase::Corners corners = mesh.corners(facet);
  return std::ranges::all_of(vertices, [&](int v) {
    return v < 0 || std::ranges::any_of(corners, [&](int corner) { return mesh.source_vertex(corner) == v; });
  });
}

// The first facet of the surface that has all the vertices, by the caller's number; -1: there is none. What holds
// points has features, which know the facets at a vertex.
int first_facet(const Body& body, const std::array<int, 3>& vertices) {
  const ClusteredMesh& mesh = body.mesh;
  int first = -1;
  const auto look_at = [&](int facet) {
    const int source = mesh.source_facet(facet);
    if (mesh.is_of_surface(source) && (first < 0 || source < first) && has_all(mesh, facet, vertices)) first = source;
  };
  if (body.features == nullptr) {
    for (int facet = 0; facet < mesh.facet_count(); ++facet) look_at(facet);
  } else if (const int vertex = body.features->vertex_of_source(vertices[0]); vertex >= 0) {
    for (const int facet : body.features->facets_at(vertex)) look_at(facet);
  }
  return first;
}

}  // namespace

FeatureLabels labels_of(const Body& body, const std::array<int, 3>& vertices) {
  for (const int v : vertices) {
    if (v < -1 || v >= body.mesh.source_vertex_count())
      throw Error(ErrorCode::invalid_argument, quoted(body.name) + ": labels of vertex " + std::to_string(v) +
                                                   ", but there are " +
                                                   std::to_string(body.mesh.source_vertex_count()) + " vertices");
  }
  FeatureLabels labels;
  if (body.arrays == nullptr) return labels;
  const FeatureSettings given = body.arrays->view();
  for (std::size_t k = 0; k < 3 && !given.vertex_labels.empty(); ++k) {
    if (vertices[k] >= 0) labels.vertices[k] = given.vertex_labels[static_cast<std::size_t>(vertices[k])];
  }
  if (given.facet_labels.empty() || vertices[0] < 0) return labels;
  if (const int facet = first_facet(body, vertices); facet >= 0)
    labels.facet = given.facet_labels[static_cast<std::size_t>(facet)];
  return labels;
}

}  // namespace tact
