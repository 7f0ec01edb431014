#include "scenes/commands/run_totals.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <utility>

#include "scenes/commands/counted.h"
#include "scenes/commands/skipped_work.h"
#include "scenes/dynamics/stats_sum.h"

namespace tact::scenes {
namespace {

std::size_t facet_count(const Simulation& simulation) {
  std::size_t sum = 0;
  for (const Body& body : simulation.bodies()) sum += static_cast<std::size_t>(body.facets.cols());
  return sum;
}

double share(double part, double whole) { return whole > 0.0 ? 100.0 * part / whole : 0.0; }

}  // namespace

void RunTotals::add_step(const Simulation& simulation) {
  ++steps_;
  detections_ += simulation.state().detections;
  add_to(stats_, simulation.stats());
  const DynamicsTimes& dynamics = simulation.times();
  times_.move_ms += dynamics.move_ms;
  times_.impacts_ms += dynamics.impacts_ms;
  times_.engine_ms += dynamics.engine_ms;
  times_.contacts_ms += dynamics.contacts_ms;
  times_.sleep_ms += dynamics.sleep_ms;
  peak_energy_ = std::max(peak_energy_, simulation.state().kinetic_energy);
  stopped_ += simulation.state().impacts;
  stayed_ += simulation.state().stayed;
  shortest_ = std::min(shortest_, simulation.impacts().part());
  squeezed_ = std::max(squeezed_, simulation.state().squeezed);
  facet_pairs_ += simulation.state().facet_pairs;
  self_facet_pairs_ += simulation.state().self_facet_pairs;
}

void RunTotals::print(std::ostream& out, const Simulation& simulation, double wall_seconds,
                      const std::string& paper) const {
  const DynamicsState& state = simulation.state();
  fmt::print(out, "{} bodies, {} facets\n", simulation.bodies().size(), facet_count(simulation));
  fmt::print(out, "{} steps, {:.3f} s simulated in {:.2f} s; without pictures and files {:.1f} steps a second\n",
             steps_, state.time, wall_seconds, times_.total_ms() > 0.0 ? 1e3 * steps_ / times_.total_ms() : 0.0);
  const StepStats last = steps_ > 0 ? simulation.report()->stats() : StepStats{};
  fmt::print(out, "last step: {}, {}, {}; of the bodies that forces move {} are awake, {} sleep\n",
             counted(last.contacts, "contact"), counted(state.contact_points, "contact point"),
             counted(last.facet_pairs, "facet pair"), state.awake, state.asleep);
  fmt::print(out,
             "facet pairs that ever crossed: {}, of a body with itself {}; thicknesses squeezed by up to {:.2f} % of "
             "the smaller body's size, by "
             "{:.2f} % in the last step\n",
             facet_pairs_, self_facet_pairs_, 100.0 * squeezed_, 100.0 * state.squeezed);
  if (simulation.dynamics().continuous) {
    fmt::print(out, "impacts stopped: {}; the shortest step went {:.3g} of its way\n", stopped_, shortest_);
  } else if (simulation.dynamics().guarded) {
    fmt::print(out, "impacts stopped: {}; vertices that stayed where they were: {}\n", stopped_, stayed_);
  }
  fmt::print(out, "kinetic energy: {:.4g} J now, {:.4g} J at its peak\n", state.kinetic_energy, peak_energy_);
  print_times(out);
  print_work(out);
  if (steps_ > 0) print_skipped_work(out, stats_, steps_, simulation.world().settings());
  if (!paper.empty()) print_paper(out, paper);
}

void RunTotals::print_times(std::ostream& out) const {
  const double total = times_.total_ms();
  const auto line = [&](const char* name, double ms, const std::string& note) {
    fmt::print(out, "  {:<26} {:>9.3f} {:>6.1f} %  {}\n", name, per_step(ms), share(ms, total), note);
  };
  fmt::print(out, "\nms a step, share of the step\n");
  line("scene: motion", times_.move_ms, "");
  line("scene: contact points", times_.contacts_ms, "");
  if (times_.impacts_ms > 0.0) line("scene: impacts", times_.impacts_ms, "motion of the engine, and the response");
  line("engine", times_.engine_ms,
       fmt::format("{:.2f} detections; stages below, 3 to 6 are summed over threads",
                   per_step(static_cast<double>(detections_))));
  const std::pair<const char*, double> stages[] = {{"  1 refresh", stats_.refresh_ms},
                                                   {"  2 sweep", stats_.sweep_ms},
                                                   {"  3 hulls", stats_.hulls_ms},
                                                   {"  4 direction", stats_.direction_ms},
                                                   {"  5 cull", stats_.cull_ms},
                                                   {"  6 confirm", stats_.confirm_ms},
                                                   {"  containment", stats_.containment_ms},
                                                   {"  curves", stats_.curves_ms},
                                                   {"  points", stats_.points_ms},
                                                   {"  self: facet pairs", stats_.self_facets_ms},
                                                   {"  self: points", stats_.self_points_ms},
                                                   {"  within reach", stats_.within_reach_ms},
                                                   {"  patches", stats_.patches_ms},
                                                   {"  7 report", stats_.report_ms}};
  for (const auto& [name, ms] : stages) {
    const bool is_numbered = name[2] >= '1' && name[2] <= '7';  // the stages of every step; the others where they ran
    if (is_numbered || ms > 0.0) fmt::print(out, "  {:<26} {:>9.3f}\n", name, per_step(ms));
  }
  line("scene: sleep", times_.sleep_ms, "");
  fmt::print(out, "  {:<26} {:>9.3f}\n", "all", per_step(total));
}

void RunTotals::print_work(std::ostream& out) const {
  fmt::print(out, "\nwork of the engine, a step\n");
  for_each_count(stats_, [&](const char* name, const char* text, std::int64_t sum) {
    if (sum != 0) fmt::print(out, "  {:<26} {:>13.1f}  {}\n", name, per_step(static_cast<double>(sum)), text);
  });
}

void RunTotals::print_paper(std::ostream& out, const std::string& paper) const {
  const double facets = static_cast<double>(stats_.facets);
  const double searches =
      static_cast<double>(stats_.carried_directions + stats_.fresh_directions + stats_.smallest_directions);
  fmt::print(out,
             "\nthe paper: {}\nhere: {:.1f} steps a second, {:.2f} iterations a contact, {:.1f} % of the facets kept\n",
             paper, times_.total_ms() > 0.0 ? 1e3 * steps_ / times_.total_ms() : 0.0,
             searches > 0.0 ? static_cast<double>(stats_.direction_iterations) / searches : 0.0,
             share(static_cast<double>(stats_.kept_facets), facets));
}

}  // namespace tact::scenes
