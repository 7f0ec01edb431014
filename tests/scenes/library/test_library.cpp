// Every scene, run for a while on a small size: what its motion must not do, and what its contacts must be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/box.h"
#include "scenes/commands/lost_pairs.h"
#include "scenes/dynamics/shape.h"
#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"
#include "tests/support/oracles/facet_pair_oracle.h"

namespace tact::scenes {
namespace {

Simulation simulation_of(const std::string& name, int size, const Settings& settings = {}) {
  Scene scene = find_scene(name)->make(size);
  return Simulation(std::move(scene.bodies), scene.script, scene.dynamics, settings);
}

base::Box box_of(const std::vector<Vec3>& positions) {
  base::Box box;
  for (const Vec3& p : positions) box = base::extended(box, p);
  return box;
}

bool inside(const base::Box& box, const base::Box& outer) {
  return box.lower.x >= outer.lower.x && box.lower.y >= outer.lower.y && box.lower.z >= outer.lower.z &&
         box.upper.x <= outer.upper.x && box.upper.y <= outer.upper.y && box.upper.z <= outer.upper.z;
}

Vec3 center(const Body& body) {
  const base::Box box = box_of(body.positions);
  return 0.5 * (box.lower + box.upper);
}

struct Case {
  const char* scene;
  int size;
  int steps;
  base::Box bounds;  // that no body that moves by forces may leave
};

std::ostream& operator<<(std::ostream& out, const Case& test) { return out << test.scene << ' ' << test.size; }

class Library : public ::testing::TestWithParam<Case> {};

// Nothing crosses, at any detection; surfaces keep most of their thickness.
TEST_P(Library, BodiesStayWholeInTheSceneAndOutOfEachOther) {
  const Case& test = GetParam();
  Simulation simulation = simulation_of(test.scene, test.size, {.threads = 1});
  std::int64_t points = 0;
  for (int step = 0; step < test.steps; ++step) {
    simulation.step();
    points += simulation.state().contact_points;
    ASSERT_EQ(simulation.state().facet_pairs, 0) << "step " << step;
    ASSERT_EQ(simulation.state().self_facet_pairs, 0) << "step " << step;
    ASSERT_LE(simulation.state().crossed, 0.0) << "step " << step;
    ASSERT_TRUE(std::isfinite(simulation.state().kinetic_energy)) << "step " << step;
    for (const Body& body : simulation.bodies()) {
      if (!body.dynamic) continue;
      const base::Box box = box_of(body.positions);
      ASSERT_TRUE(inside(box, test.bounds)) << body.name << ", step " << step;
      ASSERT_LT(norm(box.upper - box.lower), 1.5 * body.size) << body.name << ", step " << step;
    }
  }
  EXPECT_GT(points, 0);
}

TEST_P(Library, SameAnswerForOneAndTwoThreads) {
  const Case& test = GetParam();
  Simulation one = simulation_of(test.scene, test.size, {.threads = 1});
  Simulation two = simulation_of(test.scene, test.size, {.threads = 2});
  for (int step = 0; step < test.steps; ++step) {
    one.step();
    two.step();
    ASSERT_EQ(one.report()->hash(), two.report()->hash()) << "step " << step;
  }
  for (std::size_t i = 0; i < one.bodies().size(); ++i) {
    EXPECT_EQ(as_matrix(one.bodies()[i].positions), as_matrix(two.bodies()[i].positions)) << one.bodies()[i].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Library,
                         ::testing::Values(Case{"cloth-over-sphere", 16, 90, {{-1.3, -1.3, 0.0}, {1.3, 1.3, 1.5}}},
                                           Case{"sphere-into-cloth", 20, 200, {{-0.9, -0.9, 0.0}, {0.9, 0.9, 1.5}}},
                                           Case{"pile", 20, 110, {{-0.78, -0.78, -0.05}, {0.78, 0.78, 1.5}}},
                                           Case{"pile", 7, 110, {{-0.6, -0.6, -0.05}, {0.6, 0.6, 1.2}}},
                                           Case{"clamp", 0, 160, {{-0.3, -0.3, -0.05}, {0.3, 0.3, 0.9}}},
                                           Case{"liver-and-tool", 0, 310, {{-0.2, -0.2, -0.02}, {0.2, 0.2, 0.2}}},
                                           Case{"sphere-in-cloth", 24, 60, {{-0.7, -0.7, 0.0}, {0.7, 0.7, 2.0}}},
                                           Case{"wheel-on-ground", 80, 160, {{-3.0, -0.8, -0.3}, {3.0, 0.8, 1.5}}},
                                           Case{"cloth-fold", 16, 120, {{-0.9, -0.9, 0.0}, {0.9, 0.9, 0.9}}},
                                           Case{"net", 5, 50, {{-0.4, -0.4, 0.0}, {0.4, 0.4, 0.6}}},
                                           Case{"ribbon-knot", 100, 400, {{-1.2, -0.6, 0.3}, {1.2, 0.4, 1.7}}}));

// After three seconds all that fell lies in the net, above the floor.
TEST(Net, IsAtRestAfterThreeSeconds) {
  Simulation simulation = simulation_of("net", 5, {.threads = 1});
  double peak = 0.0;
  while (simulation.state().time < 3.0) {
    simulation.step();
    peak = std::max(peak, simulation.state().kinetic_energy);
    ASSERT_EQ(simulation.state().facet_pairs, 0) << simulation.state().time;
  }
  EXPECT_LT(simulation.state().kinetic_energy, 1e-4 * peak);
  for (const Body& body : simulation.bodies()) {
    if (body.plane) continue;
    EXPECT_TRUE(inside(box_of(body.positions), {{-0.35, -0.35, 0.0}, {0.35, 0.35, 0.4}})) << body.name;
  }
}

// Bodies never cross, the membrane falls in two, and the thread is through.
TEST(Surgery, CutsTearsAndPullsAThreadThrough) {
  constexpr int kSize = 11;
  Simulation simulation = simulation_of("surgery", kSize, {.threads = 1});
  const Body &membrane = simulation.bodies()[0], &thread = simulation.bodies()[4];
  while (simulation.state().time < 2.4) {
    simulation.step();
    ASSERT_EQ(simulation.state().facet_pairs, 0) << simulation.state().time;
  }
  EXPECT_EQ(membrane.positions.size(), static_cast<std::size_t>(kSize * kSize + kSize));
  EXPECT_EQ(simulation.world().vertex_count(simulation.world().bodies()[0]), membrane.positions.size());
  EXPECT_LT(thread.positions.front().z, 0.3);
  EXPECT_NE(simulation.report()->find_contact(simulation.world().bodies()[0], simulation.world().bodies()[1]), nullptr);
}

TEST(Catalog, EverySceneIsMadeAtItsSizes) {
  for (const SceneEntry& entry : scene_catalog()) {
    const Scene scene = entry.make(entry.smallest_size);
    ASSERT_EQ(scene.bodies.size(), scene.looks.size()) << entry.name;
    EXPECT_EQ(find_scene(entry.name), &entry);
    EXPECT_LE(entry.smallest_size, entry.default_size) << entry.name;
    EXPECT_LE(entry.default_size, entry.largest_size) << entry.name;
    for (const Body& body : scene.bodies) {
      if (body.surface == Surface::sheet || body.plane) continue;
      EXPECT_GT(enclosed_volume(body.positions, body.facets), 0.0) << body.name;
    }
  }
  EXPECT_EQ(find_scene("no-such-scene"), nullptr);
}

// A fine cloth stretches where a spring is asked once in a coarse substep.
TEST(Catalog, AFineClothTakesMoreSubsteps) {
  for (const char* name : {"cloth-over-sphere", "sphere-into-cloth"}) {
    EXPECT_EQ(find_scene(name)->make(64).dynamics.substeps, 8) << name;
    EXPECT_EQ(find_scene(name)->make(256).dynamics.substeps, 16) << name;
  }
}

double height_of_the_middle(const Body& cloth) { return cloth.positions[cloth.positions.size() / 2].z; }

// It lies on top of the ball, apart by both thicknesses, long after it fell.
TEST(ClothOverSphere, StaysOnTheBallAndComesToRest) {
  Simulation simulation = simulation_of("cloth-over-sphere", 17, {.threads = 1});
  double peak = 0.0;
  for (int step = 0; step < 900 && (step < 100 || simulation.state().awake > 0); ++step) {
    simulation.step();
    peak = std::max(peak, simulation.state().kinetic_energy);
    ASSERT_EQ(simulation.state().facet_pairs, 0) << "step " << step;
  }
  EXPECT_LT(simulation.state().kinetic_energy, 1e-4 * peak);
  const double top = box_of(simulation.bodies()[0].positions).upper.z;
  EXPECT_NEAR(height_of_the_middle(simulation.bodies()[1]), top + 0.008, 0.012);
  EXPECT_LT(simulation.state().squeezed, 0.001);
}

// However many there are, and however they are turned.
TEST(Pile, NoBodyBeginsInAnother) {
  const Simulation fallen = simulation_of("pile", 400, {.threads = 1});
  World world({.threads = 1});
  for (const Body& body : fallen.bodies())
    world.add_body({.positions = as_matrix(body.positions),
                    .facets = body.facets,
                    .motion = body.motion,
                    .margin = body.thickness});
  const Report& report = world.detect();
  EXPECT_EQ(report.stats().facet_pairs, 0);
  for (const Contact& contact : report.contacts())
    EXPECT_EQ(contact.containment, Containment::none) << contact.a.index << ", " << contact.b.index;
}

// After the first fold a fifth of it lies on the next fifth.
TEST(ClothFold, LaysAStripOnTheNext) {
  Simulation simulation = simulation_of("cloth-fold", 16, {.threads = 1});
  for (int step = 0; step < 360; ++step) {
    simulation.step();
    ASSERT_EQ(simulation.state().self_facet_pairs, 0) << "step " << step;
  }
  const base::Box box = box_of(simulation.bodies()[0].positions);
  EXPECT_LT(box.upper.x - box.lower.x, 1.4);
  EXPECT_GT(box.upper.x - box.lower.x, 1.2);
  EXPECT_LT(box.upper.z, 0.1);
  EXPECT_GT(simulation.state().contact_points, 100);
}

// What contact points did not keep apart is stopped by its impacts.
TEST(ClothOverSphere, IsGuardedFromItself) {
  Simulation simulation = simulation_of("cloth-over-sphere", 28, {.threads = 1});
  std::int64_t impacts = 0;
  for (int step = 0; step < 90; ++step) {
    simulation.step();
    impacts += simulation.state().impacts;
    ASSERT_EQ(simulation.state().self_facet_pairs, 0) << "step " << step;
  }
  EXPECT_GT(impacts, 0);
}

TEST(Pile, ComesToRestAndThenCostsNothing) {
  Simulation simulation = simulation_of("pile", 9, {.threads = 1});
  double peak = 0.0;
  for (int step = 0; step < 2400 && (step < 100 || simulation.state().awake > 0); ++step) {
    simulation.step();
    peak = std::max(peak, simulation.state().kinetic_energy);
    ASSERT_EQ(simulation.state().facet_pairs, 0) << "step " << step;
  }
  EXPECT_GT(peak, 1.0);
  EXPECT_EQ(simulation.state().awake, 0);
  EXPECT_LT(simulation.state().squeezed, 0.005);
  simulation.step();
  EXPECT_EQ(simulation.stats().moved_bodies, 0);
  EXPECT_EQ(simulation.state().kinetic_energy, 0.0);
}

TEST(Pile, AThirdIsRigid) {
  Simulation simulation = simulation_of("pile", 9, {.threads = 1});
  std::vector<std::vector<Vec3>> begin;
  for (const Body& body : simulation.bodies()) begin.push_back(body.positions);
  for (int step = 0; step < 150; ++step) simulation.step();
  int rigid = 0;
  for (std::size_t i = 0; i < begin.size(); ++i) {
    const Body& body = simulation.bodies()[i];
    if (!body.rigid) continue;
    ++rigid;
    EXPECT_GT(norm(body.positions[0] - begin[i][0]), 0.02) << body.name;
    for (std::size_t v = 1; v < begin[i].size(); ++v)
      ASSERT_NEAR(norm(body.positions[v] - body.positions[v / 2]), norm(begin[i][v] - begin[i][v / 2]), 1e-12);
  }
  EXPECT_EQ(rigid, 3);
}

// The organ of the paper has 500 facets and is concave.
TEST(LiverAndTool, TheOrganIsThePapers) {
  const Scene scene = find_scene("liver-and-tool")->make(0);
  EXPECT_EQ(scene.bodies[0].facets.cols(), 500);
}

// Slower than what wakes a sleeping body, as the tool does not give way.
TEST(LiverAndTool, ASlowToolWakesTheOrgan) {
  Scene scene = find_scene("liver-and-tool")->make(0);
  const Script script = [slow = scene.script](double time, std::vector<Body>& bodies) { slow(0.2 * time, bodies); };
  Simulation simulation(std::move(scene.bodies), script, scene.dynamics, {.threads = 1});
  bool slept = false;
  for (int step = 0; step < 300; ++step) {
    simulation.step();
    slept = slept || simulation.state().asleep > 0;
    ASSERT_EQ(simulation.state().facet_pairs, 0) << "step " << step;
  }
  EXPECT_TRUE(slept);
  EXPECT_EQ(simulation.state().asleep, 0);
}

// Of the bodies as the two worlds of LostPairs see them, thick enough to cross.
TEST(Clamp, ExactFindsWhatTheOracleFindsAndPaperLosesPairs) {
  Simulation simulation = simulation_of("clamp", 0);
  LostPairs lost(simulation, 1);
  const auto seen = [&](BodyId body) -> tests::Mesh {
    return {as_matrix(lost.seen(body.index)), simulation.bodies()[body.index].facets};
  };
  for (int step = 0; step < 100; ++step) {
    simulation.step();
    lost.add_step(simulation);
    if (step % 20 != 19) continue;
    for (const Contact& contact : lost.exact().contacts()) {
      const auto pairs = contact.facet_pairs();
      EXPECT_EQ(std::vector<FacetPair>(pairs.begin(), pairs.end()),
                tests::facet_pairs_by_oracle(seen(contact.a), seen(contact.b)))
          << "step " << step;
    }
  }
  EXPECT_GT(lost.all(), 1000);
  EXPECT_GT(lost.lost(), lost.all() / 10);
  EXPECT_LT(lost.lost(), lost.all());
}

TEST(Clamp, LiftsTheBall) {
  Simulation simulation = simulation_of("clamp", 0);
  const double before = center(simulation.bodies()[1]).z;
  for (int step = 0; step < 240; ++step) simulation.step();
  EXPECT_GT(center(simulation.bodies()[1]).z, before + 0.25);
}

// The sphere sinks until all of it is in the cloth; the direction that is carried still points down then, though the
// smallest separation does not; and the sphere leaves through the mouth of the bag.
TEST(SphereInCloth, TheDirectionTellsTheWayItCame) {
  Simulation simulation = simulation_of("sphere-in-cloth", 24);
  World smallest({.threads = 1, .accuracy = Accuracy::hulls, .direction = DirectionPolicy::smallest});
  std::vector<BodyId> ids;
  for (std::size_t i = 0; i < 2; ++i) {
    const Body& body = simulation.bodies()[i];
    ids.push_back(smallest.add_body(
        {.positions = as_matrix(simulation.bodies()[i].positions), .facets = body.facets, .surface = body.surface}));
  }
  const double rim = box_of(simulation.bodies()[1].positions).upper.z;
  bool wholly_inside = false, through_the_cloth = false;
  for (int step = 0; step < 280; ++step) {
    simulation.step();
    const auto contacts = simulation.report()->contacts();
    if (contacts.empty()) continue;
    ASSERT_LT(contacts[0].direction.z(), -0.7) << "step " << step;
    if (box_of(simulation.bodies()[0].positions).upper.z > rim - 0.05) continue;
    wholly_inside = true;
    for (std::size_t i = 0; i < 2; ++i) smallest.set_positions(ids[i], as_matrix(simulation.bodies()[i].positions));
    const auto by_hulls = smallest.detect().contacts();
    ASSERT_EQ(by_hulls.size(), 1u) << "step " << step;
    const Contact& shortest = by_hulls[0];
    EXPECT_LE(shortest.depth, contacts[0].depth + 1e-9) << "step " << step;
    through_the_cloth = through_the_cloth || shortest.direction.z() > -0.5;
  }
  EXPECT_TRUE(wholly_inside);
  EXPECT_TRUE(through_the_cloth);
  EXPECT_GT(box_of(simulation.bodies()[0].positions).lower.z, rim - 0.02);
}

}  // namespace
}  // namespace tact::scenes
