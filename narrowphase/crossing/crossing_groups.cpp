#include "narrowphase/crossing/crossing_groups.h"

#include <algorithm>
#include <numeric>

#include "narrowphase/mesh/disjoint_sets.h"

namespace tact::narrowphase {

int CrossingGroups::node_of(const CrossedSurface& surface, int patch) const {
  return patch < 0 || &surface == &crossing_->a() ? patch : crossing_->a().cut.patch_count() + patch;
}

void CrossingGroups::find(const Crossing& c) {
  crossing_ = &c;
  parent_.resize(static_cast<std::size_t>(c.a().cut.patch_count() + c.b().cut.patch_count()));
  std::iota(parent_.begin(), parent_.end(), 0);
  group_.assign(parent_.size(), -1);
  count_ = 0;
  const auto node_of_corner = [&](const CrossedSurface& surface, int source_facet) {
    return node_of(surface, surface.cut.patch_of(surface.source_corner(source_facet)));
  };
  for (const FacetPair& pair : c.facet_pairs)
    join_sets(parent_, node_of_corner(c.a(), pair.a), node_of_corner(c.b(), pair.b));
  for (const FacetPair& pair : c.facet_pairs) {
    int& group = group_[least_of_set(parent_, node_of_corner(c.a(), pair.a))];
    if (group < 0) group = count_++;
  }
}

int CrossingGroups::group_of_patch(const CrossedSurface& surface, int patch) const {
  const int node = node_of(surface, patch);
  return node < 0 ? -1 : group_[least_of_set(parent_, node)];
}

int CrossingGroups::group_of(const FeaturePoint& point) const {
  int group = -1;
  for (std::size_t k = 0; k < 3 && group < 0; ++k) {
    if (point.a[k] >= 0) group = group_of(crossing_->a(), point.a[k]);
    if (point.b[k] >= 0 && group < 0) group = group_of(crossing_->b(), point.b[k]);
  }
  return group;
}

void CrossingGroups::take_parts(int group, PartOfSurface& part_a, PartOfSurface& part_b) const {
  part_a.facets.clear();
  part_b.facets.clear();
  for (const FacetPair& pair : crossing_->facet_pairs) {
    if (group_of(crossing_->a(), crossing_->a().source_corner(pair.a)) != group) continue;
    part_a.facets.push_back(pair.a);
    part_b.facets.push_back(pair.b);
  }
  for (const bool of_b : {false, true}) {
    const CrossedSurface& surface = of_b ? crossing_->b() : crossing_->a();
    PartOfSurface& part = of_b ? part_b : part_a;
    std::ranges::sort(part.facets);
    part.facets.erase(std::unique(part.facets.begin(), part.facets.end()), part.facets.end());
    part.vertices.clear();
    for (const int vertex : surface.cut.past()) {
      const int source = surface.mesh.mesh->source_vertex(vertex);
      if (group_of(surface, source) == group) part.vertices.push_back(source);
    }
  }
}

}  // namespace tact::narrowphase
