#include <algorithm>
#include <array>
#include <vector>

#include "handles.h"

namespace tact::c {
namespace {

class Faults {
 public:
  void add(tact_surface_fault_kind kind, int first, int second = -1) { faults_.push_back({kind, first, second}); }
  void add_pairs(tact_surface_fault_kind kind, const std::vector<std::array<int, 2>>& pairs) {
    for (const auto& [first, second] : pairs) add(kind, first, second);
  }
  void add_all(tact_surface_fault_kind kind, const std::vector<int>& numbers) {
    for (const int number : numbers) add(kind, number);
  }
  const std::vector<tact_surface_fault>& all() const { return faults_; }

 private:
  std::vector<tact_surface_fault> faults_;
};

Faults faults_of(const SurfaceCheck& check) {
  Faults faults;
  faults.add_pairs(TACT_FAULT_BORDER_EDGE, check.border_edges);
  faults.add_pairs(TACT_FAULT_BRANCHING_EDGE, check.branching_edges);
  faults.add_all(TACT_FAULT_TURNED_FACET, check.turned_facets);
  for (const SurfaceComponent& one : check.components) {
    if (one.inside_out) faults.add(TACT_FAULT_INSIDE_OUT_COMPONENT, one.facet);
  }
  for (const FacetPair& pair : check.crossings) faults.add(TACT_FAULT_CROSSING, pair.a, pair.b);
  faults.add_pairs(TACT_FAULT_REPEATED_FACET, check.repeated_facets);
  faults.add_pairs(TACT_FAULT_REPEATED_VERTEX, check.repeated_vertices);
  faults.add_all(TACT_FAULT_SLIVER, check.slivers);
  faults.add_all(TACT_FAULT_UNUSED_VERTEX, check.unused_vertices);
  return faults;
}

}  // namespace
}  // namespace tact::c

using tact::c::check_not_null, tact::c::faults_of, tact::c::id_of, tact::c::reading, tact::c::WorldEntry;

extern "C" {

tact_error tact_world_check_surface(tact_world world, tact_body body, double sliver, bool* solid,
                                    tact_surface_fault* faults, size_t capacity, size_t* count) {
  return reading(world, [&](const WorldEntry& entry) {
    check_not_null(count);
    if (capacity > 0) check_not_null(faults);
    const tact::SurfaceCheck check = entry.world.check_surface(id_of(body), sliver);
    const auto found = faults_of(check);
    std::copy_n(found.all().begin(), std::min(found.all().size(), capacity), faults);
    if (solid != nullptr) *solid = check.is_solid();
    *count = found.all().size();
  });
}

}  // extern "C"
