// One case of the benchmark `stability`: the engine's answers, with every setting that must not matter, against the
// truth.
#pragma once

#include <string>

#include "bench/stability/cases.h"

namespace tact::bench {

// Failures of a case, summed over its settings (carried and smallest directions, 1 and 2 threads), steps and pairs.
struct StabilityFailures {
  int facet_sets = 0;  // pairs whose set of facet pairs differs from CGAL's
  int hulls = 0;       // pairs whose hulls were called apart and overlap, or the reverse
  int depths = 0;      // contacts whose depth is off from w(direction) by more than 1e-12 of the pair's size
  int directions = 0;  // contacts whose direction is no local minimum of w, or is not smallest where that is asked for
  int limits = 0;      // contacts that say that a limit was reached
  int exceptions = 0;  // calls that threw and should not have, or the reverse
  int hashes = 0;      // steps whose hash differs between 1 and 2 threads
  std::string first = {};  // what the first of them was

  int sum() const { return facet_sets + hulls + depths + directions + limits + exceptions + hashes; }
};

// Adds the counts, and keeps the first description.
void add(StabilityFailures& sum, const StabilityFailures& one);

StabilityFailures check_stability(const StabilityCase& c);

}  // namespace tact::bench
