// Simulations that stop before impacts: nothing crosses, at any step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "scenes/dynamics/simulation.h"
#include "scenes/library/catalog.h"

namespace tact::scenes {
namespace {

Scene continuous_scene(const std::string& name, int size) {
  Scene scene = find_scene(name)->make(size);
  scene.dynamics.continuous = true;
  scene.dynamics.time_step = 1.0 / 60.0;
  scene.dynamics.substeps = 1;
  return scene;
}

double lowest(const Body& body) { return std::ranges::min_element(body.positions, {}, &Vec3::z)->z; }

// Steps of the simulation, none of which may end with a facet of one body in another.
void expect_no_crossing(Simulation& simulation, int steps) {
  std::int64_t stopped = 0;
  for (int step = 0; step < steps; ++step) {
    simulation.step();
    ASSERT_EQ(simulation.report()->stats().facet_pairs, 0) << "step " << step;
    ASSERT_TRUE(std::isfinite(simulation.state().kinetic_energy)) << "step " << step;
    stopped += simulation.impacts().impacts();
  }
  EXPECT_GT(stopped, 100);
}

TEST(ImpactResponse, BulletsPassThroughWithoutItAndAreStoppedWithIt) {
  for (const bool continuous : {false, true}) {
    Scene scene = find_scene("bullets")->make(3);
    scene.dynamics.continuous = continuous;
    Simulation simulation(std::move(scene.bodies), scene.script, scene.dynamics, {.threads = 1});
    for (int step = 0; step < 12; ++step) simulation.step();
    for (std::size_t i = 3; i < simulation.bodies().size(); ++i) {
      const double z = lowest(simulation.bodies()[i]);
      if (continuous) {
        EXPECT_GT(z, lowest(simulation.bodies()[0])) << simulation.bodies()[i].name;  // it lies on the upper sheet
      } else {
        EXPECT_LT(z, -2.0) << simulation.bodies()[i].name;
      }
    }
  }
}

TEST(ImpactResponse, NothingCrossesAmongBullets) {
  Scene scene = continuous_scene("bullets", 4);
  Simulation simulation(std::move(scene.bodies), scene.script, scene.dynamics, {.threads = 2});
  expect_no_crossing(simulation, 1000);
}

TEST(ImpactResponse, NothingCrossesWhereAClothFallsOnASphere) {
  Scene scene = continuous_scene("cloth-over-sphere", 24);
  Simulation simulation(std::move(scene.bodies), scene.script, scene.dynamics, {.threads = 2});
  expect_no_crossing(simulation, 1000);
}

TEST(ImpactResponse, NothingCrossesInAPileDroppedFromTenMetres) {
  Scene scene = continuous_scene("pile", 8);
  // One above the other: in the scene some begin in each other.
  double above = 10.0;
  for (Body& body : scene.bodies) {
    if (!body.dynamic) continue;
    for (Vec3& p : body.positions) p.z += above;
    above += 0.5;
  }
  Simulation simulation(std::move(scene.bodies), scene.script, scene.dynamics, {.threads = 2});
  expect_no_crossing(simulation, 1000);
}

TEST(ImpactResponse, SameAnswerForOneAndTwoThreads) {
  const auto simulate = [](int threads) {
    Scene scene = continuous_scene("bullets", 3);
    Simulation simulation(std::move(scene.bodies), scene.script, scene.dynamics, {.threads = threads});
    for (int step = 0; step < 60; ++step) simulation.step();
    return simulation.report()->hash();
  };
  EXPECT_EQ(simulate(1), simulate(2));
}

}  // namespace
}  // namespace tact::scenes
