// Bodies that have come to rest are left alone until something moves them.
#pragma once

#include <tact/report.h>

#include <array>
#include <vector>

#include "scenes/dynamics/body.h"

namespace tact::scenes {

struct SleepSettings {
  double speed = 0.02;  // metres a second, root of the mean square over a body: slower is still; 0: nobody sleeps
  double time = 0.3;    // seconds that it has to be still before it sleeps
  // A body also sleeps when three of its vertices have not left this room for a second, metres: it rocks, or trembles
  // in a heap, and gets nowhere. 0: it does not.
  double room = 0.0;
  double wake = 5.0;  // a body that touches it wakes it at so many times that speed
};

// A sleeping body has no velocity, no gravity, and an infinite mass for those that touch it. It sleeps when it has been
// still for a while and nothing that touches it moves; it wakes when a body that touches it moves faster than it could
// in its sleep. That is decided body by body: a pile does not wait for its last one. A body that a script moves goes on
// whatever is in its way: it wakes what it has contact points with, however slow it is.
class Sleep {
 public:
  // After a step of `seconds`, and its report. Body i has index i in it.
  void update(const Report& report, double seconds, const SleepSettings& settings, std::vector<Body>& bodies);

 private:
  // Where three of its vertices were, and for how long they have been near there, seconds.
  struct Anchor {
    std::array<Vec3, 3> places;
    double time = 0.0;
  };
  static void watch(const Body& body, double seconds, double room, Anchor& anchor);

  std::vector<double> still_;    // by body: for how long, seconds
  std::vector<Anchor> anchors_;  // by body
  std::vector<double> squares_;  // by body: mean square of its speed
  std::vector<char> restless_;   // by body: does something that touches it move?
};

}  // namespace tact::scenes
