// A cluster in floats about the middle of its box, by one set of kernels.
#pragma once

#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact::tests {

struct LocalCluster {
  LocalCluster(const narrowphase::Kernels& kernels, const narrowphase::ClusteredMesh& mesh, int cluster)
      : facets(mesh.facets_of(cluster)), count(facets.owned_count + facets.borrowed_count) {
    const base::Box box = mesh.cluster_boxes()[cluster];
    origin = 0.5 * box.lower + 0.5 * box.upper;
    floats.assign(3 * narrowphase::LocalVertices::kMost + 64, 0.0f);
    const double from[3] = {origin.x, origin.y, origin.z};
    kernels.localize(facets, from, 1.0, vertices());
  }
  narrowphase::LocalVertices vertices() {
    constexpr int kMost = narrowphase::LocalVertices::kMost;
    return {floats.data(), floats.data() + kMost, floats.data() + 2 * kMost};
  }
  float at(int axis, int vertex) const { return floats[axis * narrowphase::LocalVertices::kMost + vertex]; }

  narrowphase::ClusterFacets facets;
  int count;
  base::Vec3 origin;
  std::vector<float> floats;
};

// Calls check(mesh, cluster) for clusters of many kinds: full ones and a last one that is not, with few vertices and
// with three a facet.
template <class Check>
void for_clusters(const Check& check) {
  for (const Mesh& mesh : {wrinkled_sheet(13, 2.0, 0.3, 1), icosphere(3), soup(150, 1.0, 2), lattice_soup(100, 2, 3)}) {
    const narrowphase::ClusteredMesh clusters = clustered(mesh);
    for (int c = 0; c < clusters.cluster_count(); ++c) check(clusters, c);
  }
}

}  // namespace tact::tests
