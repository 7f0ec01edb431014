// What a run adds up to, and how it is told.
#pragma once

#include <ostream>
#include <string>

#include "scenes/dynamics/simulation.h"

namespace tact::scenes {

// Sums over the steps of a run.
class RunTotals {
 public:
  void add_step(const Simulation& simulation);
  // Prints the table that ends a run: `wall_seconds` is what all of it took, pictures and files included; `paper` is
  // what the paper says of such a scene, or empty.
  void print(std::ostream& out, const Simulation& simulation, double wall_seconds, const std::string& paper) const;

  int steps() const { return steps_; }

 private:
  void print_times(std::ostream& out) const;
  void print_work(std::ostream& out) const;
  void print_paper(std::ostream& out, const std::string& paper) const;
  double per_step(double sum) const { return steps_ > 0 ? sum / steps_ : 0.0; }

  int steps_ = 0;
  StepStats stats_;      // summed
  DynamicsTimes times_;  // summed
  double peak_energy_ = 0.0;
  std::int64_t stopped_ = 0;  // impacts
  std::int64_t stayed_ = 0;   // vertices, see ImpactResponse
  double shortest_ = 1.0;     // part of its way that a step went
  double squeezed_ = 0.0;     // share of the smaller body's size
  std::int64_t facet_pairs_ = 0, self_facet_pairs_ = 0;
  std::int64_t detections_ = 0;
};

}  // namespace tact::scenes
