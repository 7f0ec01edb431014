#include <gtest/gtest.h>

#include <vector>

#include "narrowphase/crossing/convex.h"
#include "narrowphase/crossing/convex_separation.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

bool is_convex_mesh(const Mesh& mesh) {
  const ClusteredMesh clustered = tests::clustered(mesh);
  const Features features(clustered);
  return is_convex({clustered, features, unit_scale_of(clustered.box())});
}

TEST(Convex, AreBoxesSpheresAndHullsHoweverTheyLie) {
  tests::Random random(1);
  for (const Mesh& mesh : {tests::cube(1.0, {}), tests::gridded_box({-1, -1, -0.01}, {1, 1, 0.01}, 4),
                           tests::icosphere(2), tests::random_hull(20, 3), tests::spike({0, 0.1, 1e6}, 1e6)})
    EXPECT_TRUE(is_convex_mesh(tests::translated(tests::rotated(mesh, random.rotation()), random.direction())));
}

TEST(Convex, AreNoDentedOpenOrSeveralBodies) {
  const Mesh two[] = {tests::cube(1.0, {}), tests::cube(1.0, {3, 0, 0})};
  for (const Mesh& mesh : {tests::blob(2, 0.6, 0.3, 1), tests::torus(16, 8, 0.5, 0.1), tests::sheet(2, 2, 1.0, 1.0),
                           tests::merged(two), tests::turned_inside_out(tests::cube(1.0, {}))})
    EXPECT_FALSE(is_convex_mesh(mesh));
}

// Two bodies, of which vertices of the first remember these normals and gaps, and others are past the second one now;
// the contact is along x.
class Remembering {
 public:
  Remembering(const Mesh& a, const Mesh& b) : a_(tests::clustered(a)), b_(tests::clustered(b)) {
    crossing_.direction = {1, 0, 0};
    crossing_.surfaces[0].begin({&a_, &of_a_}, SurfaceKind::closed, -1.0, 1.0);
    crossing_.surfaces[1].begin({&b_, &of_b_}, SurfaceKind::closed, 1.0, 1.0);
  }
  ConvexSeparation with(std::vector<CarriedNormal> of_a, const std::vector<int>& past = {7}) {
    Cut& cut = crossing_.surfaces[0].cut;
    cut.begin({&a_, &of_a_}, {}, Cut::Which::a);
    for (const int source : past) cut.add_past(of_a_.vertex_of_source(source));
    carried_ = std::move(of_a);
    crossing_.carried = {.of_a = carried_, .of_b = {}, .of_edges = {}};
    ConvexSeparation separation;
    separation.find(crossing_);
    return separation;
  }

 private:
  ClusteredMesh a_, b_;
  Features of_a_{a_}, of_b_{b_};
  std::vector<CarriedNormal> carried_;
  Crossing crossing_;
};

TEST(ConvexSeparation, IsTheMeanNormalOfNegativeGaps) {
  Remembering cubes(tests::cube(1.0, {}), tests::cube(1.0, {0.5, 0, 0}));
  ConvexSeparation separation = cubes.with({{0, {0, 1, 0}, -0.1}, {1, {0, 1, 0}, -0.2}, {2, {0, 0, -1}, 0.1}});
  EXPECT_EQ(separation.direction(), (Vec3{0, 1, 0}));
  EXPECT_FALSE(separation.leads_all());
  EXPECT_TRUE(separation.is_against({0, -1, 0}));
  EXPECT_FALSE(separation.is_against({0, 0, 1}));
  // Nothing was in the other body.
  EXPECT_FALSE(cubes.with({{0, {0, 1, 0}, 0.1}}).is_against({0, -1, 0}));
}

TEST(ConvexSeparation, LeadsAllAlongTheContactWhereNormalsLedToAndFro) {
  const std::vector<CarriedNormal> to_and_fro = {{0, {0, 1, 0}, -0.1}, {1, {0, -1, 0}, -0.1}};
  Remembering cubes(tests::cube(1.0, {}), tests::cube(1.0, {0.5, 0, 0}));
  ConvexSeparation separation = cubes.with(to_and_fro);
  EXPECT_TRUE(separation.leads_all());
  EXPECT_EQ(separation.direction(), (Vec3{1, 0, 0}));
  // One is in still, or nothing came in.
  EXPECT_FALSE(cubes.with(to_and_fro, {0, 7}).leads_all());
  EXPECT_FALSE(cubes.with(to_and_fro, {}).leads_all());
  // Both within 60 degrees of the contact.
  EXPECT_FALSE(cubes.with({{0, {0.6, 0.8, 0}, -0.1}, {1, {0.6, -0.8, 0}, -0.1}}).leads_all());
  // What is not convex may be gripped.
  Remembering torus(tests::torus(16, 8, 0.5, 0.1), tests::cube(1.0, {0.5, 0, 0}));
  separation = torus.with(to_and_fro);
  EXPECT_FALSE(separation.leads_all());
  EXPECT_FALSE(separation.is_against({-1, 0, 0}));
}

}  // namespace
}  // namespace tact::narrowphase
