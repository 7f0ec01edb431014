// How the steps of a scene went, as JSON lines, an object a step:
//
//   {"frame":12,"time":0.1083,"kinetic_energy":1.7,"awake":98,"asleep":2,"contact_points":512,"facet_pairs":0,
//    "self_facet_pairs":0,"squeezed":0.0004,"crossed":0,"smallest_gap":0.0057,"impacts":0,"stayed":0,
//    "detections":1,"moved_bodies":98,"ms":3.1}
//
// `awake` and `asleep` count bodies that forces move. The time is in seconds, the energy in joules, `ms` the wall time
// of the step. Over all detections of the step: `facet_pairs` that cross, of two bodies; `self_facet_pairs`, of a body
// with itself; `squeezed` and `crossed`, see DynamicsState, are shares of the smaller body's size; `smallest_gap` of a
// contact point is in metres, null without points. `impacts` were stopped, and `stayed` counts vertices that were taken
// back for it, where the scene looks for impacts.
#pragma once

#include <ostream>

#include "scenes/dynamics/simulation.h"

namespace tact::scenes {

// Writes the line of the last step.
void write_state_line(std::ostream& out, int frame, const Simulation& simulation);

}  // namespace tact::scenes
