#include "narrowphase/expanding_polytope.h"

#include <limits>

namespace tact::narrowphase {

// Provisional: the best of 26 fixed directions, to be replaced by the expanding polytope.
SmallestSeparation smallest_separation(const MinkowskiDifference& m, Vec3 preferred) {
  SmallestSeparation best{preferred, std::numeric_limits<double>::infinity(), 0.0, false};
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3 n = normalized(Vec3{double(x), double(y), double(z)});
        const double w = dot(n, m.support(n).point);
        if (w < best.height) best = {n, w, 0.0, false};
      }
    }
  }
  return best;
}

}  // namespace tact::narrowphase
