// Ends a step before anything passes through anything: by the impacts between its beginning and its end.
#pragma once

#include <tact/tact.h>

#include <cstdint>
#include <vector>

#include "scenes/dynamics/body.h"

namespace tact::scenes {

class ImpactResponse {
 public:
  // Bodies went from `begin`, where no two of them cross and tact saw them last, to where they are, within `seconds`.
  // They end where no two cross either, and tact has their positions.
  //
  // Each impact stops what its two features move towards each other, masses shared, with friction (R. Bridson,
  // R. Fedkiw, J. Anderson, Robust treatment of collisions, contact and friction for cloth animation, 2002). As that
  // makes new impacts it is done some times; if any are left then, all bodies go only so far as nothing meets. A body
  // that no force moves stops, too, then; its script sets it where it should be in the next step.
  void run(const std::vector<std::vector<Vec3>>& begin, double seconds, const std::vector<BodyId>& ids,
           std::vector<Body>& bodies, World& world);

  // Of the last step: how often impacts were looked for, how many were stopped, and the part of the way that was gone.
  int rounds() const { return rounds_; }
  std::int64_t impacts() const { return impacts_; }
  double part() const { return part_; }

 private:
  // Two that begin within `margins`, the sum of theirs, stay as far apart as they begin.
  void stop(const Impact& impact, double margins, const std::vector<std::vector<Vec3>>& begin,
            std::vector<Body>& bodies) const;

  int rounds_ = 0;
  std::int64_t impacts_ = 0;
  double part_ = 1.0;
  std::vector<std::vector<Vec3>> wanted_;  // positions at the end of the step, if nothing were in the way
};

}  // namespace tact::scenes
