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

// What is remembered of a body between steps.
struct Rest {
  double still = 0.0;               // for how long it has been still, seconds
  std::array<Vec3, 3> places = {};  // where three of its vertices were,
  double near = 0.0;                // and for how long they have been near there, seconds
};

// The mean square of a body's speed; of what a script moves, of its fastest vertex.
double mean_square_speed(const Body& body);
// Whether the contact has a point so near that what moves on one side is felt on the other; `thickness` is the sum of
// both.
bool presses(const Contact& contact, double thickness);
// Whether a dynamic body is disturbed by what has a contact with it, moves at `square` (mean_square_speed()) and is
// `dynamic` or moved by a script; if it is dynamic, only where the contact presses.
bool disturbs(double square, bool dynamic, const SleepSettings& settings);
// After a step of `seconds`: the body, if it is dynamic, moves at `square`, falls asleep, goes on or is woken.
void settle(Body& body, Rest& rest, double square, bool disturbed, double seconds, const SleepSettings& settings);

// A sleeping body has no velocity, no gravity, and an infinite mass for those that touch it. It sleeps when it has been
// still for a while and nothing that touches it moves; it wakes when a body that touches it moves faster than it could
// in its sleep. That is decided body by body: a pile does not wait for its last one. A body that a script moves goes on
// whatever is in its way: it wakes what it has contact points with, however slow it is.
class Sleep {
 public:
  // After a step of `seconds`, and its report. Body i has index i in it.
  void update(const Report& report, double seconds, const SleepSettings& settings, std::vector<Body>& bodies);

 private:
  std::vector<Rest> rests_;      // by body
  std::vector<double> squares_;  // by body: mean square of its speed
  std::vector<char> disturbed_;  // by body: does something that touches it move?
};

}  // namespace tact::scenes
