#include "narrowphase/mesh/cluster_quality.h"

#include <cstddef>
#include <limits>

#include "narrowphase/mesh/source_mesh.h"

namespace tact::narrowphase {

namespace {

constexpr int kMostMeasured = 128;  // facets

double spread_of(const Box& box) {
  const Vec3 size = box.upper - box.lower;
  const double extent = size.x + size.y + size.z;
  return extent * extent;
}

}  // namespace

double cluster_spread(const ClusteredMesh& mesh) {
  const BoxView boxes = mesh.cluster_boxes();
  double sum = 0.0;
  for (int c = 0; c < mesh.cluster_count(); ++c) sum += spread_of(boxes[c]);
  return sum;
}

// Facets are taken by the caller's numbers, which clusters do not change.
double cluster_quality(const ClusteredMesh& mesh) {
  const int step = (mesh.facet_count() + kMostMeasured - 1) / kMostMeasured;
  double sum = 0.0;
  int measured = 0;
  for (int source = 0; source < mesh.facet_count(); source += step, ++measured) {
    Box box;
    for (const Vec3& corner : mesh.triangle(mesh.facet_of_source(source))) box = extended(box, corner);
    sum += spread_of(box);
  }
  if (!(sum > 0.0)) return std::numeric_limits<double>::infinity();
  return sum / measured * mesh.facet_count() / cluster_spread(mesh);
}

ClusteredMesh clustered_anew(const ClusteredMesh& mesh) {
  ClusteredMesh anew(source_positions(mesh, mesh.points()), source_facets(mesh),
                     {mesh.edge_count(), mesh.point_count()});
  anew.begin_travel_after(mesh);
  return anew;
}

std::vector<int> vertex_numbers_in(const ClusteredMesh& other, const ClusteredMesh& mesh) {
  std::vector<int> of_source(static_cast<std::size_t>(mesh.source_vertex_count())), numbers;
  for (int v = 0; v < other.vertex_count(); ++v) of_source[other.source_vertex(v)] = v;
  numbers.reserve(mesh.vertex_count());
  for (int v = 0; v < mesh.vertex_count(); ++v) numbers.push_back(of_source[mesh.source_vertex(v)]);
  return numbers;
}

}  // namespace tact::narrowphase
