// What World::set_facets() costs beside World::set_positions(), and the step after it beside any other: a part of
// `tact-bench refresh`.
#pragma once

#include "bench/table.h"

namespace tact::bench {

/// A sheet over a floor is cut again and again, a hundredth of its facets at a time, with the numbers that it has or
/// in a new order. In milliseconds.
Table measure_cutting(bool quick);

}  // namespace tact::bench
