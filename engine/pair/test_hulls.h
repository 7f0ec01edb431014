// Stage 3: do the hulls of a pair overlap?
#pragma once

#include "engine/pair/pair_work.h"

namespace tact {

struct HullTest {
  bool overlap = false;            ///< or touch, exactly
  bool limit_reached = false;      ///< GJK stopped at its limit
  bool took_gjk = false;           ///< what the last step knew did not settle it
  bool surface_is_placed = false;  ///< PairWork::smallest holds the record's surface, where the bodies are now
};

/// What showed the hulls to overlap in the last step is asked first; or the direction that separated them, with a plane
/// and then one support query a body; then GJK, from where it ended in the last step, and integers where it cannot
/// tell. If they are apart, a direction that separates them is left in the record's history, and the record is near if
/// they are nearer than the margins.
HullTest test_hulls(const PairTask& pair);

}  // namespace tact
