// Pairs of edges that wait until there are enough for the kernel that leaves most of them out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

class WaitingEdges {
 public:
  /// Takes edges of `a` and `b`, by Features' numbers. Calls visit(edge_a, edge_b) for some that waited before.
  template <class Visit>
  void add(const ScaledMesh& a, int edge_a, const ScaledMesh& b, int edge_b, double reach, EdgeSide side,
           const Visit& visit) {
    const int i = pairs_.count++;
    set(a.features, edge_a, 0, i);
    set(b.features, edge_b, 1, i);
    edges_[i] = {edge_a, edge_b};
    if (pairs_.count == EdgePairs::kCapacity) visit_all(a, b, reach, side, visit);
  }

  /// Calls visit(edge_a, edge_b) for those that wait and may have a point nearer than `reach`, scaled.
  template <class Visit>
  void visit_all(const ScaledMesh& a, const ScaledMesh& b, double reach, EdgeSide side, const Visit& visit) {
    fill_up();
    const std::uint64_t beyond = kernels().edges_beyond(pairs_, a.mesh.points(), b.mesh.points(), a.scale, reach, side);
    const int count = std::exchange(pairs_.count, 0);
    for (int i = 0; i < count; ++i) {
      if ((beyond >> i & 1) == 0) visit(edges_[i].first, edges_[i].second);
    }
  }

 private:
  void set(const Features& features, int edge, int mesh, int i) {
    const EdgeVertices ends = features.edge(edge);
    const auto third = features.opposite(edge);
    auto& vertex = pairs_.vertex[mesh];
    vertex[0][i] = ends[0];
    vertex[1][i] = ends[1];
    vertex[2][i] = third.front();
    vertex[3][i] = third.back();
  }
  // Lanes beyond the last pair read the first vertex.
  void fill_up() {
    for (auto& of_mesh : pairs_.vertex) {
      for (auto& vertex : of_mesh) std::fill_n(vertex + pairs_.count, EdgePairs::kRoom - EdgePairs::kCapacity, 0);
    }
  }

  EdgePairs pairs_;
  std::pair<int, int> edges_[EdgePairs::kCapacity];
};

}  // namespace tact::narrowphase
