// Workloads recorded from the scenes of the command line program, see workloads.h.
#include <algorithm>
#include <stdexcept>

#include "bench/workloads/workloads.h"
#include "scenes/dynamics/simulation.h"
#include "scenes/library/catalog.h"

namespace tact::bench {

Workload recorded(const std::string& scene, int size, int settled, int frames) {
  const scenes::SceneEntry* entry = scenes::find_scene(scene);
  if (entry == nullptr) throw std::logic_error("no scene is called " + scene);
  scenes::Scene made = entry->make(size);
  scenes::Simulation simulation(std::move(made.bodies), std::move(made.script), made.dynamics, {});
  Workload workload{frames, {}};
  for (const scenes::Body& body : simulation.bodies())
    workload.bodies.push_back({.facets = body.facets, .surface = body.surface});
  const int steps = frames / 2 + 1;  // there and back
  for (int step = 0; step < settled; ++step) simulation.step();
  for (int step = 0; step < steps; ++step) {
    simulation.step();
    for (std::size_t i = 0; i < workload.bodies.size(); ++i) {
      if (simulation.bodies()[i].motion == Motion::fixed && step > 0) continue;
      workload.bodies[i].frames.push_back(scenes::as_matrix(simulation.bodies()[i].positions));
    }
  }
  for (WorkloadBody& body : workload.bodies) {
    if (body.fixed()) continue;
    for (int frame = steps; frame < frames; ++frame) {
      const Eigen::Matrix3Xd back = body.frames[frames - frame];
      body.frames.push_back(back);
    }
  }
  return workload;
}

}  // namespace tact::bench
