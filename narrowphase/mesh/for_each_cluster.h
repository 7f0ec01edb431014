// From the boxes of groups to those of clusters: the clusters that a question wants to open.
#pragma once

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// Calls visit(cluster) for those whose box, and that of whose group, wants(box).
template <class Wants, class Visit>
void for_each_cluster(const ClusteredMesh& mesh, const Wants& wants, const Visit& visit) {
  if (mesh.facet_count() == 0 || !wants(mesh.box())) return;
  const BoxView groups = mesh.group_boxes(), clusters = mesh.cluster_boxes();
  for (int g = 0; g < mesh.group_count(); ++g) {
    if (mesh.group_count() > 1 && !wants(groups[g])) continue;
    for (int c = mesh.cluster_begin(g); c < mesh.cluster_end(g); ++c) {
      if (wants(clusters[c])) visit(c);
    }
  }
}

}  // namespace tact::narrowphase
