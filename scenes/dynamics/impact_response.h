// Ends a step before anything passes through anything: by the impacts between its beginning and its end.
#pragma once

#include <tact/tact.h>

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/dynamics/body.h"

namespace tact::scenes {

class ImpactResponse {
 public:
  using Positions = std::vector<std::vector<Vec3>>;  // by body

  // What is done where some rounds of stopping have left impacts.
  enum class LastResort {
    all_stop,   // all bodies go only so far as nothing meets: nothing is torn, however far a body went
    some_stay,  // the vertices of impacts stay where they began, round by round, until nothing meets
  };

  // Bodies went from `begin`, where no two of them cross and tact saw them last, to where they are, within `seconds`.
  // They end where no two cross either, and no body itself whose self-contact is asked for; and tact has their
  // positions.
  //
  // Each impact stops what its two features move towards each other, masses shared, with friction (R. Bridson,
  // R. Fedkiw, J. Anderson, Robust treatment of collisions, contact and friction for cloth animation, 2002). As that
  // makes new impacts it is done some times. What no force moves may be stopped by the last resort, too; its script
  // sets it where it should be in the next step.
  void run(const Positions& begin, double seconds, LastResort last_resort, const std::vector<BodyId>& ids,
           std::vector<Body>& bodies, World& world);

  // Of the last run: how many impacts were stopped, the part of the way that all bodies went, and how many vertices
  // stayed where they were.
  std::int64_t impacts() const { return impacts_; }
  double part() const { return part_; }
  std::int64_t stayed() const { return stayed_; }

 private:
  const MotionReport& detect(Impacts wanted, const std::vector<BodyId>& ids, const std::vector<Body>& bodies,
                             World& world);
  void let_all_go_a_part(const Positions& begin, double part, std::vector<Body>& bodies);
  // False if all of the impacts' vertices are there already.
  bool take_back(std::span<const Impact> impacts, const Positions& begin, std::vector<Body>& bodies);
  // Two that begin within `rest_offsets`, the sum of theirs, stay as far apart as they begin.
  void stop(const Impact& impact, double rest_offsets, const Positions& begin, std::vector<Body>& bodies) const;

  std::int64_t impacts_ = 0;
  double part_ = 1.0;
  std::int64_t stayed_ = 0;
  std::vector<PositionsUpdate> updates_;
  Positions wanted_;  // positions at the end of the step, if nothing were in the way
};

}  // namespace tact::scenes
