// What went wrong in a scene, and what it cost. All ways of playing it are held to the same measure.
#pragma once

#include <tact/tact.h>

#include "scene.h"

namespace example {

struct Measured {
  double deepest = 0.0;        // how far a vertex was in another body, of every fourth step, metres
  std::int64_t crossings = 0;  // the most facet pairs that ever crossed
  double box_height = 0.0;     // of the rigid box's middle at the end, metres
  double cloth_height = 0.0;   // of the cloth's middle at the end, metres
  double moving = 0.0;         // kinetic energy at the end, joules
  double gained = 0.0;         // the most energy ever above that of the start, joules
  double step_ms = 0.0;        // median time of a step, milliseconds
};

// Looks at the bodies of a scene with a world of its own, which knows no margins.
class Measure {
 public:
  explicit Measure(const Scene& scene);
  // After each step, which took `milliseconds`.
  void look(const Scene& scene, double milliseconds);
  Measured result(const Scene& scene) const;

 private:
  double deepest(const Scene& scene) const;

  tact::World world_;
  std::vector<tact::BodyId> ids_;
  Measured so_far_;
  double energy_at_start_ = 0.0;
  std::vector<double> times_;
};

}  // namespace example
