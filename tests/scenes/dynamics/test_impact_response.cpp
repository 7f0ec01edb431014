// Simulations that stop before impacts: nothing crosses, at any step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "scenes/dynamics/simulation.h"
#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"

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

// A world of its own that sees where the bodies are after each step: has anything met on the way there?
class Watch {
 public:
  explicit Watch(const std::vector<Body>& bodies) {
    for (const Body& body : bodies)
      ids_.push_back(world_.add_body({.positions = as_matrix(body.positions),
                                      .facets = body.facets,
                                      .surface = body.surface,
                                      .motion = body.motion}));
    world_.detect();
  }
  double first_time(const std::vector<Body>& bodies) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].motion != Motion::fixed) world_.set_positions(ids_[i], as_matrix(bodies[i].positions));
    }
    const double first = world_.detect_motion(Impacts::first).first_time();
    world_.detect();
    return first;
  }

 private:
  World world_;
  std::vector<BodyId> ids_;
};

// Steps of the simulation, none of which may end with a facet of one body in another, or pass through it.
void expect_no_crossing(Simulation& simulation, int steps) {
  std::int64_t stopped = 0;
  Watch watch(simulation.bodies());
  for (int step = 0; step < steps; ++step) {
    simulation.step();
    ASSERT_GT(watch.first_time(simulation.bodies()), 1.0) << "step " << step;
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
  expect_no_crossing(simulation, 400);  // it lies on the sphere by then
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

// A script moves both, so that no impulse stops them: the second one would end below the first, but for a corner that
// is beside it.
TEST(ImpactResponse, WhatMeetsStaysAndTheRestGoesOn) {
  const auto sheet = [](double height, double shift) {
    return make_rigid("sheet", moved(grid_sheet(6, 6, 1.0, 1.0), {shift, shift, height}), {}, Motion::deformable);
  };
  std::vector<Body> bodies{sheet(0.0, 0.0), sheet(0.1, 0.3)};
  World world;
  std::vector<BodyId> ids;
  ImpactResponse::Positions begin;
  for (const Body& body : bodies) {
    ids.push_back(world.add_body(
        {.positions = as_matrix(body.positions), .facets = body.facets, .surface = Surface::sheet, .margin = 0.001}));
    begin.push_back(body.positions);
  }
  world.detect();
  for (Vec3& p : bodies[1].positions) p.z = -0.1;
  ImpactResponse impacts;
  impacts.run(begin, 0.1, ImpactResponse::LastResort::some_stay, ids, bodies, world);
  const Report& report = world.detect();
  EXPECT_EQ(report.stats().facet_pairs, 0);
  EXPECT_GT(impacts.stayed(), 10);
  for (const Vec3& p : bodies[1].positions) {
    const bool over_the_first = p.x < 0.45 && p.y<0.45, beside_it = p.x> 0.75 || p.y > 0.75;
    if (over_the_first || beside_it) {
      EXPECT_EQ(p.z, beside_it ? -0.1 : 0.1);
    }
  }
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
