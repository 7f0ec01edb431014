// Groups the facets of bodies again whose clusters have lost their shape.
#include <algorithm>
#include <optional>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/bodies/bodies.h"
#include "narrowphase/mesh/cluster_quality.h"
#include "narrowphase/mesh/refit.h"

namespace tact {

using narrowphase::ClusteredMesh, narrowphase::Refit;

// A mesh that is grouped anew where it is goes back to where the body was in the last step, and comes again. So if this
// step fails, what moves until the next one is known still.
Bodies::Begin Bodies::go_the_way(std::uint32_t slot, ClusteredMesh& anew) const {
  const Body& body = in_slot(slot);
  if (!on_its_way(slot)) return Begin::here;
  const auto refit_at = [&](const narrowphase::PointArrays& points) {
    std::vector<double> positions(3 * static_cast<std::size_t>(body.mesh.source_vertex_count()), 0.0);
    for (int v = 0; v < body.mesh.vertex_count(); ++v) {
      double* const to = &positions[3 * static_cast<std::size_t>(body.mesh.source_vertex(v))];
      to[0] = points.x[v], to[1] = points.y[v], to[2] = points.z[v];
    }
    return refit(anew, positions.data());
  };
  if (refit_at(moving(slot).begin.points) == Refit::changed) {
    refit_at(body.mesh.points());
  } else {
    narrowphase::MeshPlacements& placements = anew.placements();
    std::copy_n(placements.now_memory(), placements.size() - narrowphase::kPadding, placements.spare_memory());
  }
  return Begin::before;
}

std::vector<Bodies::Regrouped> Bodies::regroup(int threads) {
  const std::span<const std::uint32_t> decayed = groupings_.sort_decayed();
  std::vector<Regrouped> all(decayed.size());
  std::vector<std::optional<ClusteredMesh>> meshes(decayed.size());
  std::vector<Begin> begins(decayed.size(), Begin::here);
  base::parallel_for(decayed.size(), 1, threads, [&](std::size_t i) {
    const ClusteredMesh& mesh = in_slot(decayed[i]).mesh;
    if (!groupings_.has_decayed(decayed[i], cluster_quality(mesh))) return;  // it was, when it was looked at
    meshes[i] = clustered_anew(mesh);
    begins[i] = go_the_way(decayed[i], *meshes[i]);
    all[i] = {in_slot(decayed[i]).id, vertex_numbers_in(*meshes[i], mesh)};
  });
  // From here on nothing can fail.
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!meshes[i]) continue;
    Body& body = *slots_[decayed[i]].body;
    if (cluster_spread(*meshes[i]) <= tuning_->worth_regrouping * cluster_spread(body.mesh)) {
      packed_meshes_.remove(body.mesh);
      body.mesh = std::move(*meshes[i]);
      body.features.reset();
      body.neighbors.reset();
      slots_[decayed[i]].begin = begins[i];
      packed_meshes_.add(body.mesh);
    } else {
      all[i].numbers.clear();
    }
    groupings_.note_try(decayed[i], cluster_quality(body.mesh));
  }
  std::erase_if(all, [](const Regrouped& body) { return body.numbers.empty(); });
  keep_groups();
  return all;
}

}  // namespace tact
