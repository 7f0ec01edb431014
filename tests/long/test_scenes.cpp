// The scenes at full size until they rest: nothing crosses, nothing stays squeezed, what rests costs nothing. How long
// is read from the environment.
//   TACT_LONG_SCENES_FULL  1: full sizes, half an hour; 0 if not set: small ones, for seconds
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "scenes/library/catalog.h"
#include "tests/support/environment/environment.h"

namespace tact::scenes {
namespace {

bool at_full_size() { return tests::from_environment("TACT_LONG_SCENES_FULL", 0) > 0; }

Simulation simulation_of(const std::string& name, int size) {
  Scene scene = find_scene(name)->make(size);
  return Simulation(std::move(scene.bodies), scene.script, scene.dynamics, {});
}

struct LongRun {
  const char* scene;
  int full_size, full_steps;
  int small_size, small_steps;
  bool rests;  // in the full run
};

std::ostream& operator<<(std::ostream& out, const LongRun& run) { return out << run.scene; }

class LongScene : public ::testing::TestWithParam<LongRun> {};

TEST_P(LongScene, NothingCrossesAndItComesToRest) {
  const LongRun& run = GetParam();
  const bool full = at_full_size();
  Simulation simulation = simulation_of(run.scene, full ? run.full_size : run.small_size);
  double peak = 0.0;
  for (int step = 0; step < (full ? run.full_steps : run.small_steps); ++step) {
    simulation.step();
    const DynamicsState& state = simulation.state();
    peak = std::max(peak, state.kinetic_energy);
    ASSERT_EQ(state.facet_pairs, 0) << "step " << step;
    ASSERT_EQ(state.self_facet_pairs, 0) << "step " << step;
  }
  const DynamicsState& state = simulation.state();
  std::printf("%s: kinetic energy %.3g of its peak, %lld awake, squeezed by %.3g\n", run.scene,
              state.kinetic_energy / peak, static_cast<long long>(state.awake), state.squeezed);
  if (!full) return;
  EXPECT_LE(state.crossed, 0.005);  // of the smaller body's size
  EXPECT_LE(state.squeezed, 0.02);
  if (!run.rests) return;
  EXPECT_LT(state.kinetic_energy, 1e-4 * peak);
  EXPECT_EQ(state.awake, 0);
  EXPECT_EQ(simulation.stats().moved_bodies, 0);
}

// Into five layers in the half of the time, in which the free parts of the strips are flung.
TEST(ClothFoldLong, AtTwiceTheSpeedDoesNotCrossItselfAndComesToRest) {
  const bool full = at_full_size();
  Scene scene = find_scene("cloth-fold")->make(full ? 40 : 16);
  const Script fold = scene.script;
  Simulation simulation(std::move(scene.bodies),
                        [&](double time, std::vector<Body>& bodies) { fold(2.0 * time, bodies); }, scene.dynamics, {});
  const int steps = full ? 780 : 40;
  double peak = 0.0;
  for (int step = 0; step < steps; ++step) {
    simulation.step();
    peak = std::max(peak, simulation.state().kinetic_energy);
    ASSERT_EQ(simulation.state().self_facet_pairs, 0) << "step " << step;
  }
  std::printf("cloth-fold at twice the speed: kinetic energy %.3g J at most, then %.3g J\n", peak,
              simulation.state().kinetic_energy);
  if (!full) return;
  EXPECT_LT(peak, 0.5);  // joules; 0.16 when this was written
  EXPECT_LT(simulation.state().kinetic_energy, 0.01 * peak);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, LongScene,
    ::testing::Values(LongRun{"cloth-over-sphere", 128, 2000, 12, 60, true}, LongRun{"pile", 1000, 3000, 5, 60, true},
                      LongRun{"clamp", 0, 2000, 0, 30, false}, LongRun{"liver-and-tool", 0, 2000, 0, 30, false},
                      LongRun{"wheel-on-ground", 300, 2000, 50, 30, false},
                      LongRun{"cloth-fold", 40, 2000, 16, 40, false}, LongRun{"ribbon-knot", 160, 2000, 100, 40, true}),
    [](const auto& instance) {
      std::string name = instance.param.scene;
      std::erase(name, '-');
      return name;
    });

}  // namespace
}  // namespace tact::scenes
