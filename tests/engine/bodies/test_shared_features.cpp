#include <gtest/gtest.h>
#include <tact/tact.h>

#include <vector>

#include "engine/base/tuning.h"
#include "engine/bodies/bodies.h"
#include "narrowphase/mesh/same_topology.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/mesh.h"

namespace tact::tests {
namespace {

class SharedFeatures : public ::testing::Test {
 protected:
  std::uint32_t add(const Mesh& mesh, Motion motion = Motion::rigid) {
    return bodies_.add(BodyDefinition{.positions = mesh.positions, .facets = mesh.facets, .motion = motion}).index;
  }
  const narrowphase::Features* features_of(std::uint32_t slot, const std::vector<std::uint32_t>& with = {}) {
    std::vector<std::uint32_t> slots = with;
    slots.push_back(slot);
    bodies_.make_features(slots, 2);
    return bodies_.featured(slot).features;
  }

  base::Tuning tuning_;
  Bodies bodies_{1, tuning_};
};

TEST_F(SharedFeatures, OfBodiesFromOneMeshAreOne) {
  const Mesh ball = icosphere(2), shorter = torus(8, 8, 1.0, 0.3);
  const std::uint32_t a = add(ball), b = add(shorter), c = add(ball), d = add(ball, Motion::deformable);
  const narrowphase::Features* const first = features_of(c, {a, b});
  EXPECT_EQ(first, features_of(a));
  EXPECT_NE(first, features_of(b));
  EXPECT_EQ(first, features_of(d));  // which comes later
}

TEST_F(SharedFeatures, OfFacetsInAnotherOrderAreOthers) {
  const Mesh ball = icosphere(1);
  Mesh turned = ball, other = ball;
  turned.facets.col(3) << ball.facets(1, 3), ball.facets(2, 3), ball.facets(0, 3);
  other.facets.col(0).swap(other.facets.col(1));
  const std::uint32_t a = add(ball), b = add(turned), c = add(other);
  const narrowphase::Features* const first = features_of(a, {b, c});
  EXPECT_NE(first, features_of(b));
  EXPECT_NE(first, features_of(c));
  EXPECT_NE(features_of(b), features_of(c));
}

// Another mesh in the slot of the first body, which is no more; the third has what it had.
TEST_F(SharedFeatures, StayWithTheOthersWhenABodyGoes) {
  const Mesh ball = icosphere(2), other = torus(8, 8, 1.0, 0.3);
  const std::uint32_t a = add(ball), b = add(ball);
  const narrowphase::Features* const first = features_of(a, {b});
  bodies_.remove(bodies_.in_slot(a).id);
  ASSERT_EQ(add(other), a);
  EXPECT_NE(features_of(a), first);
  EXPECT_EQ(features_of(b), first);
  const narrowphase::Features* const last = features_of(add(ball));
  EXPECT_NE(last, features_of(a));
  EXPECT_EQ(last->edge_count(), first->edge_count());
  EXPECT_EQ(last, features_of(add(ball)));
}

TEST(SameTopology, IsThatOfFacetsClustersAndWhatTheyAre) {
  const auto clustered = [](const Mesh& mesh, int edges) {
    return narrowphase::ClusteredMesh({mesh.positions.data(), static_cast<std::size_t>(mesh.positions.size())},
                                      {mesh.facets.data(), static_cast<std::size_t>(mesh.facets.size())},
                                      {.edges = edges});
  };
  const Mesh ball = icosphere(2), bent = mapped(ball, [](Vec3 p) { return Vec3{p.x, p.y + 9.0 * p.x * p.x, p.z}; });
  const auto mesh = clustered(ball, 0);
  EXPECT_TRUE(same_topology(mesh, clustered(scaled(ball, 2.0), 0)));
  EXPECT_EQ(topology_hash(mesh), topology_hash(clustered(scaled(ball, 2.0), 0)));
  EXPECT_FALSE(same_topology(mesh, clustered(bent, 0)));  // its clusters are others
  EXPECT_FALSE(same_topology(mesh, clustered(ball, 1)));
  EXPECT_NE(topology_hash(mesh), topology_hash(clustered(ball, 1)));
}

}  // namespace
}  // namespace tact::tests
