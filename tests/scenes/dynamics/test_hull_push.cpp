#include <gtest/gtest.h>
#include <tact/tact.h>

#include "scenes/dynamics/hull_push.h"
#include "scenes/library/shapes.h"

namespace tact::scenes {
namespace {

Vec3 momentum(const Body& body) {
  Vec3 sum;
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    if (body.inverse_masses[v] > 0.0) sum = sum + (1.0 / body.inverse_masses[v]) * body.velocities[v];
  }
  return sum;
}

class HullPush : public ::testing::Test {
 protected:
  // Two boxes, one in the other by 0.2 along z.
  HullPush() {
    bodies_.push_back(make_soft("lower", box({0, 0, 0}, {1, 1, 1}, 0.5), {}));
    bodies_.push_back(make_soft("upper", box({0.1, 0.1, 0.8}, {0.9, 0.9, 2.0}, 0.5), {}));
    for (const Body& body : bodies_) {
      world_.add_body({.positions = as_matrix(body.positions), .facets = body.facets, .name = body.name});
    }
  }

  std::vector<Body> bodies_;
  World world_{{.threads = 1, .direction = DirectionPolicy::smallest}};
};

TEST_F(HullPush, GivesBothTheSameMomentumAlongTheDirection) {
  bodies_[0].hull_stiffness = 10.0;
  bodies_[1].hull_stiffness = 20.0;
  push_hulls_apart(world_.detect().contacts(), bodies_, 0.01);
  const double expected = 30.0 * 0.2 * 0.01;
  EXPECT_NEAR(momentum(bodies_[1]).z, expected, 1e-12);
  EXPECT_NEAR(momentum(bodies_[0]).z, -expected, 1e-12);
  EXPECT_NEAR(norm(momentum(bodies_[0])), expected, 1e-12);
}

TEST_F(HullPush, OnlyThePartBetweenThePlanesIsMoved) {
  bodies_[1].hull_stiffness = 20.0;
  push_hulls_apart(world_.detect().contacts(), bodies_, 0.01);
  for (std::size_t v = 0; v < bodies_[1].positions.size(); ++v) {
    EXPECT_EQ(bodies_[1].velocities[v].z > 0.0, bodies_[1].positions[v].z <= 1.0) << v;
  }
}

TEST_F(HullPush, NothingWithoutStiffnessNorForHeldVertices) {
  push_hulls_apart(world_.detect().contacts(), bodies_, 0.01);
  EXPECT_EQ(norm(momentum(bodies_[0])), 0.0);
  bodies_[0].hull_stiffness = 5.0;
  bodies_[1].inverse_masses.assign(bodies_[1].positions.size(), 0.0);
  push_hulls_apart(world_.detect().contacts(), bodies_, 0.01);
  for (const Vec3& velocity : bodies_[1].velocities) EXPECT_EQ(norm(velocity), 0.0);
}

}  // namespace
}  // namespace tact::scenes
