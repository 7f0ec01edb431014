#include "narrowphase/mesh/mesh_parts.h"

#include <algorithm>
#include <numeric>

#include "narrowphase/mesh/disjoint_sets.h"

namespace tact::narrowphase {

std::vector<int> one_of_each_part(const ClusteredMesh& mesh, std::span<const EdgeVertices> edges) {
  std::vector<int> parent(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& [v, w] : edges) join_sets(parent, v, w);
  std::vector<int> parts;
  std::vector<int> first(parent.size(), -1);  // of each set
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    parent[v] = parent[parent[v]];  // the least of the set, as that of lesser numbers is known
    int& known = first[parent[v]];
    if (known < 0 || mesh.source_vertex(v) < mesh.source_vertex(known)) known = v;
    if (parent[v] == v) parts.push_back(v);
  }
  for (int& least : parts) least = first[least];
  std::ranges::sort(parts, {}, [&](int v) { return mesh.source_vertex(v); });
  return parts;
}

std::vector<int> one_of_each_part(const ClusteredMesh& mesh) {
  std::vector<EdgeVertices> edges;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const Corners corners = mesh.corners(f);
    for (std::size_t k = 1; k < 3; ++k) edges.push_back({corners[0], corners[k]});
  }
  return one_of_each_part(mesh, edges);
}

}  // namespace tact::narrowphase
