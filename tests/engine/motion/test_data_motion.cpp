// What meets between frames of real sequences, frames left out, against brute force.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include "tests/support/data/data_sets.h"
#include "tests/support/oracles/motion_by_brute_force.h"

namespace tact::tests {
namespace {

std::map<ImpactKey, double> all_impacts(const MotionReport& report) {
  std::map<ImpactKey, double> found;
  for (const Impact& impact : report.impacts()) {
    EXPECT_TRUE(found.emplace(ImpactKey{impact.kind, impact.a_vertices, impact.b_vertices}, impact.time).second);
  }
  return found;
}

// That cloth was simulated without crossing the sphere: with a margin there are impacts.
constexpr double kClothMargin = 0.02;

TEST(DataMotion, OfAClothThatFallsOnASphereEqualsBruteForce) {
  TACT_SKIP_WITHOUT_DATA();
  const Mesh sphere = read_data("cloth_sphere.obj");
  const Sequence cloth = read_data_sequence("seq_cloth_on_sphere");
  const MovingMesh still{sphere, sphere.positions};
  for (const std::size_t leap : {2u, 4u, 8u}) {
    tact::World world({.threads = 2});
    const BodyId id = world.add_body(
        {.positions = cloth.frames[0], .facets = cloth.facets, .surface = Surface::sheet, .margin = kClothMargin});
    world.add_body({.positions = sphere.positions, .facets = sphere.facets, .margin = kClothMargin});
    std::size_t impacts = 0;
    for (std::size_t frame = 12; frame + leap < cloth.frames.size(); frame += 12) {
      world.set_positions(id, cloth.frames[frame]);
      world.detect();
      world.set_positions(id, cloth.frames[frame + leap]);
      const MovingMesh moving{{cloth.frames[frame], cloth.facets}, cloth.frames[frame + leap]};
      const auto expected = impacts_by_brute_force(moving, still, 2 * kClothMargin);
      impacts += expected.size();
      ASSERT_EQ(all_impacts(world.detect_motion()), expected) << "frame " << frame << ", leap " << leap;
    }
    EXPECT_GT(impacts, 0u) << leap;
  }
}

TEST(DataMotion, OfTwoToysThatChangePosesEqualsBruteForce) {
  TACT_SKIP_WITHOUT_DATA();
  const Sequence toy = read_data_sequence("seq_toy_poses");
  const Eigen::Vector3d size = toy.frames[0].rowwise().maxCoeff() - toy.frames[0].rowwise().minCoeff();
  for (const std::size_t leap : {4u}) {
    const auto beside = [&](std::size_t frame) {
      return Eigen::Matrix3Xd(toy.frames[frame].colwise() + Eigen::Vector3d(0.55 * size.x(), 0.0, 0.05 * size.z()));
    };
    tact::World world({.threads = 2});
    const BodyId a = world.add_body({.positions = toy.frames[0], .facets = toy.facets});
    const BodyId b = world.add_body({.positions = beside(1), .facets = toy.facets});
    world.detect();
    world.set_positions(a, toy.frames[leap]);
    world.set_positions(b, beside(0));
    const auto expected = impacts_by_brute_force({{toy.frames[0], toy.facets}, toy.frames[leap]},
                                                 {{beside(1), toy.facets}, beside(0)}, 0.0);
    EXPECT_GT(expected.size(), 10u);
    ASSERT_EQ(all_impacts(world.detect_motion()), expected) << "leap " << leap;
  }
}

}  // namespace
}  // namespace tact::tests
