#include "engine/plane_turn.h"

#include "narrowphase/numeric/predicates.h"

namespace tact {

int plane_turn(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
  narrowphase::PredicateCounts counts;
  return narrowphase::orient2d({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]}, counts);
}

}  // namespace tact
