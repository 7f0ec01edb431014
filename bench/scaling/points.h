// What contact points cost, and what the same points cost with others' boxes.
#pragma once

#include <tact/report.h>

#include <string>
#include <vector>

#include "bench/options.h"
#include "bench/rivals/near_points.h"

namespace tact::bench {

int run_points(const BenchOptions& options);

// Throws std::runtime_error if a rival found other points; of bodies that cross, what has not crossed is compared.
void check_against_rival(const Report& report, const std::vector<NearPoint>& rival, const std::string& name);

}  // namespace tact::bench
