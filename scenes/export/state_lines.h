// How the steps of a scene went, as JSON lines, an object a step; docs/pages/json.md tells the form.
#pragma once

#include <ostream>

#include "scenes/dynamics/simulation.h"

namespace tact::scenes {

// Writes the line of the last step.
void write_state_line(std::ostream& out, int frame, const Simulation& simulation);

}  // namespace tact::scenes
