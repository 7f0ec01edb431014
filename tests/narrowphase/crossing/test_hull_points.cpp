#include <gtest/gtest.h>

#include <vector>

#include "narrowphase/crossing/hull_points.h"
#include "narrowphase/hull/support.h"
#include "tests/support/environment/allocation_hook.h"
#include "tests/support/generators/random.h"

namespace tact::narrowphase {
namespace {

std::vector<Vec3> some_points(int count, tests::Random& random) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(random.in_ball());
  if (count > 3) points[3] = points[1];
  return points;
}

TEST(HullPoints, AreFarthestWhereTheyAre) {
  tests::Random random(1);
  HullPoints hull;
  for (const int count : {1, 2, 64, 65, 7, 300, 64}) {
    const std::vector<Vec3> points = some_points(count, random);
    const ClusteredMesh& mesh = hull.mesh(points);
    mesh.validate();
    for (int k = 0; k < 20; ++k) {
      const Vec3 n = random.direction();
      int farthest = 0;
      for (int i = 1; i < count; ++i) {
        if (dot(n, points[i]) > dot(n, points[farthest])) farthest = i;
      }
      EXPECT_EQ(mesh.source_vertex(support(mesh, n, {}).vertex), farthest);
    }
  }
}

TEST(HullPoints, AllocateForTheMostAlone) {
  tests::Random random(1);
  HullPoints hull;
  const std::vector<Vec3> many = some_points(200, random), few = some_points(9, random);
  hull.mesh(many);
  hull.mesh(few);
  const long before = tests::allocation_count();
  hull.mesh(few);
  hull.mesh(many);
  EXPECT_EQ(tests::allocation_count(), before);
}

}  // namespace
}  // namespace tact::narrowphase
