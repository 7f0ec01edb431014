// What a body does in a substep by itself; contacts come between its beginning and its end.
#pragma once

#include <vector>

#include "scenes/dynamics/body.h"

namespace tact::scenes {

struct Substep {
  double seconds = 0.0;
  double gravity = 0.0;  // metres a second², towards -z
  int threads = 1;
};

// The body falls and goes on as it did, and its springs, volume and shape hold it together, once each. `before` gets
// the positions until then, but of a rigid body. The two have one length.
void begin_substep(Body& body, std::vector<Vec3>& before, const Substep& substep);
// No vertex that forces move goes farther than `most` metres in the substep.
void shorten_ways(Body& body, const std::vector<Vec3>& before, double most);
// Takes the way of the substep, and what contacts made of it, for the motion. Returns the longest way of a vertex,
// metres.
double end_substep(Body& body, const std::vector<Vec3>& before, const Substep& substep);

}  // namespace tact::scenes
