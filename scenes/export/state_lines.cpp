#include "scenes/export/state_lines.h"

#include <cmath>

#include "scenes/commands/json_text.h"

namespace tact::scenes {

void write_state_line(std::ostream& out, int frame, const Simulation& simulation) {
  const DynamicsState& state = simulation.state();
  const Json line = {{"frame", frame},
                     {"time", state.time},
                     {"kinetic_energy", state.kinetic_energy},
                     {"awake", state.awake},
                     {"asleep", state.asleep},
                     {"contact_points", state.contact_points},
                     {"facet_pairs", state.facet_pairs},
                     {"self_facet_pairs", state.self_facet_pairs},
                     {"squeezed", state.squeezed},
                     {"crossed", state.crossed},
                     {"smallest_gap", std::isfinite(state.smallest_gap) ? Json(state.smallest_gap) : Json()},
                     {"impacts", state.impacts},
                     {"stayed", state.stayed},
                     {"detections", state.detections},
                     {"moved_bodies", simulation.stats().moved_bodies},
                     {"ms", simulation.times().total_ms()}};
  out << json_text(line) << '\n';
}

}  // namespace tact::scenes
