// Workloads recorded from the scenes of the command line program, see workloads.h.
#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bench/workloads/workloads.h"
#include "scenes/dynamics/simulation.h"
#include "scenes/library/catalog.h"

namespace tact::bench {

namespace {

void append(const scenes::Body& body, WorkloadBody& to) {
  Eigen::Matrix3Xd& positions = to.frames.front();
  const Eigen::Index vertices = positions.cols(), facets = to.facets.cols();
  const auto added = static_cast<Eigen::Index>(body.positions.size());
  positions.conservativeResize(3, vertices + added);
  positions.rightCols(added) = scenes::as_matrix(body.positions);
  to.facets.conservativeResize(3, facets + body.facets.cols());
  to.facets.rightCols(body.facets.cols()) = body.facets.array() + static_cast<int>(vertices);
  to.surface = body.surface;
}

}  // namespace

Workload recorded(const std::string& scene, int size, int settled, int frames) {
  const scenes::SceneEntry* entry = scenes::find_scene(scene);
  if (entry == nullptr) throw std::logic_error("no scene is called " + scene);
  scenes::Scene made = entry->make(size);
  scenes::Simulation simulation(std::move(made.bodies), std::move(made.script), made.dynamics, {});
  Workload workload{frames, {}};
  // What stands still is one body: tact holds no two fixed bodies against each other, rivals would.
  WorkloadBody still{.facets = Eigen::Matrix3Xi(3, 0), .frames = {Eigen::Matrix3Xd(3, 0)}};
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < simulation.bodies().size(); ++i) {
    const scenes::Body& body = simulation.bodies()[i];
    if (body.motion == Motion::fixed) {
      append(body, still);
      still.margin = std::max(still.margin, body.thickness);
      continue;
    }
    moving.push_back(i);
    workload.bodies.push_back({.facets = body.facets, .surface = body.surface});
  }
  const int steps = frames / 2 + 1;  // there and back
  for (int step = 0; step < settled; ++step) simulation.step();
  // As the scene has them then: some have moved fast before, and were to see far.
  const std::vector<BodyId> ids = simulation.world().bodies();
  for (std::size_t k = 0; k < moving.size(); ++k) workload.bodies[k].margin = simulation.world().margin(ids[moving[k]]);
  for (int step = 0; step < steps; ++step) {
    simulation.step();
    for (std::size_t k = 0; k < moving.size(); ++k) {
      workload.bodies[k].frames.push_back(scenes::as_matrix(simulation.bodies()[moving[k]].positions));
    }
  }
  if (still.facets.cols() > 0) workload.bodies.push_back(std::move(still));
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
