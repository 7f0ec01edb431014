// The paper's own response to contact: a spring along the contact direction.
#pragma once

#include <tact/report.h>

#include <span>
#include <vector>

#include "scenes/dynamics/body.h"

namespace tact::scenes {

// Pushes the bodies of each contact apart along its direction for `seconds`, with a force of its depth times the sum of
// both hull stiffnesses: changes velocities. Of each body the force moves the part between the contact planes, all of
// it alike; a part without a vertex that forces can move stays. Body i has index i in the contacts. Source: the paper,
// §5 (penalty forces from the interpenetration along the contact direction).
void push_hulls_apart(std::span<const Contact> contacts, std::vector<Body>& bodies, double seconds);

}  // namespace tact::scenes
