// Damping of what a body does within itself, while it flies and turns as before.
#pragma once

#include "scenes/dynamics/body.h"

namespace tact::scenes {

// Over `seconds`, takes the body's inner damping off all velocities against those of a rigid body with the same
// momentum and angular momentum. Source: M. Müller et al., Position Based Dynamics, VRIPhys 2006, §3.5.
void damp_inner_motion(Body& body, double seconds);

}  // namespace tact::scenes
