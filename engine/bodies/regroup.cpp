// Groups the facets of bodies again whose clusters have lost their shape.
#include <optional>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/bodies/bodies.h"
#include "narrowphase/mesh/cluster_quality.h"

namespace tact {

std::vector<Bodies::Regrouped> Bodies::regroup(int threads) {
  const std::span<const std::uint32_t> decayed = groupings_.sort_decayed();
  std::vector<Regrouped> all(decayed.size());
  std::vector<std::optional<narrowphase::ClusteredMesh>> meshes(decayed.size());
  base::parallel_for(decayed.size(), 1, threads, [&](std::size_t i) {
    const narrowphase::ClusteredMesh& mesh = in_slot(decayed[i]).mesh;
    if (!groupings_.has_decayed(decayed[i], cluster_quality(mesh))) return;  // it was, when it was looked at
    meshes[i] = clustered_anew(mesh);
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
      slots_[decayed[i]].begin = Begin::here;
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
