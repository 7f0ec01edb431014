// The directions in which M's height was queried, in a search for the smallest.
#pragma once

#include <limits>
#include <vector>

#include "narrowphase/hull/minkowski_difference.h"

namespace tact::narrowphase {

class QueriedDirections {
 public:
  struct Queried {
    Vec3 direction;       // unit
    double height = 0.0;  // of M along it, scaled
  };

  // Forgets all, and keeps the memory.
  void restart() {
    queried_.clear();
    least_ = std::numeric_limits<double>::infinity();
  }

  // The vertex of M that is farthest along the unit vector n; its height bounds the smallest from above.
  MinkowskiVertex query(const MinkowskiDifference& m, Vec3 n) {
    const MinkowskiVertex vertex = m.support(n);
    queried_.push_back({n, dot(n, vertex.point)});
    if (queried_.back().height < least_) least_ = queried_.back().height;
    return vertex;
  }

  // The least height found; infinite before the first query.
  double least() const { return least_; }
  int count() const { return static_cast<int>(queried_.size()); }

  // Of the directions whose heights exceed the least by no more than `tolerance`, the one nearest to `preferred`.
  Queried choose(Vec3 preferred, double tolerance) const {
    Queried chosen{{}, std::numeric_limits<double>::infinity()};
    double nearness = -std::numeric_limits<double>::infinity();
    for (const Queried& candidate : queried_) {
      const double cosine = dot(candidate.direction, preferred);
      if (candidate.height > least_ + tolerance || !(cosine > nearness)) continue;
      nearness = cosine;
      chosen = candidate;
    }
    return chosen;
  }

 private:
  std::vector<Queried> queried_;  // in the order of the queries
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace tact::narrowphase
