#include "engine/containment.h"

#include "engine/base/parallel.h"
#include "narrowphase/queries/mesh_queries.h"

namespace tact {

void ContainmentStage::run(std::span<const MovedPair> moved, Bodies& bodies, const Settings& settings) {
  if (settings.accuracy == Accuracy::hulls) return;
  wanted_.clear();
  slots_.clear();
  for (const MovedPair& pair : moved) {
    if (!pair.record->hulls_overlap || any_meet(*pair.record)) continue;
    const std::uint32_t a = pair.record->a.index, b = pair.record->b.index;
    const auto want = [&](std::uint32_t inner, std::uint32_t outer, Containment containment) {
      if (!bodies.in_slot(outer).has_inside) return;
      if (!lies_in(bodies.in_slot(inner).mesh.box(), bodies.in_slot(outer).mesh.box())) return;
      wanted_.push_back({pair.record, inner, outer, containment});
      slots_.push_back(inner);
    };
    want(a, b, Containment::a_in_b);
    want(b, a, Containment::b_in_a);
  }
  if (wanted_.empty()) return;
  bodies.make_features(slots_, settings.threads);
  // A pair may stand here twice only if the boxes are equal, and then one after the other in one task.
  base::parallel_for(wanted_.size(), 8, settings.threads, [&](std::size_t i, int) {
    const Wanted& one = wanted_[i];
    if (i > 0 && wanted_[i - 1].record == one.record) return;
    for (std::size_t k = i; k < wanted_.size() && wanted_[k].record == one.record; ++k) {
      if (!narrowphase::lies_inside(bodies.featured(wanted_[k].inner), bodies.in_slot(wanted_[k].outer).mesh)) continue;
      one.record->contact.containment = wanted_[k].containment;
      return;
    }
  });
}

}  // namespace tact
