// What meets between frames of the scenes, frames left out, against brute force.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "scenes/dynamics/simulation.h"
#include "scenes/library/catalog.h"
#include "tests/support/oracles/motion_by_brute_force.h"

namespace tact::scenes {
namespace {

// The positions of all bodies in each frame.
using Frames = std::vector<std::vector<Eigen::Matrix3Xd>>;

Frames play(Simulation& simulation, int frames) {
  Frames all;
  for (int frame = 0; frame < frames; ++frame) {
    simulation.step();
    auto& positions = all.emplace_back();
    for (const Body& body : simulation.bodies()) positions.emplace_back(as_matrix(body.positions));
  }
  return all;
}

using Found = std::map<tests::ImpactKey, double>;
Found impacts_of(const MotionReport& report, BodyId a, BodyId b) {
  Found found;
  for (const Impact& impact : report.impacts()) {
    if (impact.a == a && impact.b == b)
      found.emplace(tests::ImpactKey{impact.kind, impact.a_vertices, impact.b_vertices}, impact.time);
  }
  return found;
}

base::Box box_of(const tests::MovingMesh& way) {
  base::Box box;
  for (const Eigen::Matrix3Xd* positions : {&way.begin.positions, &way.end}) {
    for (const auto& p : positions->colwise()) box = extended(box, base::Vec3{p.x(), p.y(), p.z()});
  }
  return box;
}

struct Sequence {
  const char* scene;
  int size;
  int frames;
  double margin;
};

class SceneMotion : public ::testing::TestWithParam<Sequence> {};

TEST_P(SceneMotion, EqualsBruteForceHoweverManyFramesAreLeftOut) {
  Scene scene = find_scene(GetParam().scene)->make(GetParam().size);
  Simulation simulation(std::move(scene.bodies), scene.script, scene.dynamics, {.threads = 1});
  const Frames frames = play(simulation, GetParam().frames);
  const std::vector<Body>& bodies = simulation.bodies();
  for (const std::size_t leap : {2u, 4u, 8u}) {
    World world({.threads = 2});
    std::vector<BodyId> ids;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      ids.push_back(world.add_body({.positions = frames[0][i],
                                    .facets = bodies[i].facets,
                                    .surface = bodies[i].surface,
                                    .motion = bodies[i].motion,
                                    .margin = GetParam().margin}));
    world.detect();
    std::size_t impacts = 0;
    for (std::size_t frame = 0; frame + leap < frames.size(); frame += leap) {
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies[i].motion != Motion::fixed) world.set_positions(ids[i], frames[frame + leap][i]);
      }
      const MotionReport& report = world.detect_motion();
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        for (std::size_t k = i + 1; k < bodies.size(); ++k) {
          const auto way = [&](std::size_t body) {
            return tests::MovingMesh{{frames[frame][body], bodies[body].facets}, frames[frame + leap][body]};
          };
          const tests::MovingMesh a = way(i), b = way(k);
          if (a.begin.positions == a.end && b.begin.positions == b.end) continue;  // what stands meets nothing
          const double reach = 2 * GetParam().margin;
          // Far apart throughout: nothing to be asked of brute force.
          const bool pass = overlaps(base::grown(box_of(a), reach), box_of(b));
          const Found expected = pass ? tests::impacts_by_brute_force(a, b, reach) : Found{};
          impacts += expected.size();
          ASSERT_EQ(impacts_of(report, ids[i], ids[k]), expected)
              << "frame " << frame << ", leap " << leap << ", " << bodies[i].name << " and " << bodies[k].name;
        }
      }
      world.detect();
    }
    EXPECT_GT(impacts, 0u) << "leap " << leap;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneMotion,
                         ::testing::Values(Sequence{"bullets", 3, 17, 0.0}, Sequence{"cloth-over-sphere", 12, 97, 0.01},
                                           Sequence{"pile", 6, 97, 0.005}, Sequence{"liver-and-tool", 0, 33, 0.002}),
                         [](const auto& instance) {
                           std::string name = instance.param.scene;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace tact::scenes
