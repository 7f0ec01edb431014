#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/hull/minkowski_difference.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

long double height(Vec3 n, Vec3 p) {
  return static_cast<long double>(n.x) * p.x + static_cast<long double>(n.y) * p.y +
         static_cast<long double>(n.z) * p.z;
}

// The height of M along n in metres, from all vertices of both.
long double height_by_brute_force(const ClusteredMesh& a, const ClusteredMesh& b, Vec3 n) {
  long double above = -std::numeric_limits<long double>::infinity(), below = -above;
  for (int v = 0; v < a.vertex_count(); ++v) above = std::max(above, height(n, a.position(v)));
  for (int v = 0; v < b.vertex_count(); ++v) below = std::min(below, height(n, b.position(v)));
  return above - below;
}

TEST(MinkowskiDifference, HeightsAreThoseOfAllVerticesButForTheBound) {
  tests::Random random(11);
  for (const double size : {1.0, 0x1p-200, 0x1p200}) {
    tests::Mesh first = tests::blob(2, 1.0, 0.3, 1), second = tests::blob(3, 0.7, 0.2, 2);
    first.positions *= size;
    second.positions *= size;
    const ClusteredMesh a = tests::clustered(first),
                        b = tests::clustered(tests::translated(second, {1.5 * size, 0.0, 100.0 * size}));
    for (const bool by_clusters : {true, false}) {
      base::Tuning tuning = base::kTuning;
      tuning.support_by_clusters = by_clusters;
      const MinkowskiDifference m(a, b, tuning);
      for (int i = 0; i < 50; ++i) {
        const Vec3 n = random.direction();
        const MinkowskiVertex vertex = m.support(n);
        EXPECT_EQ(vertex.point, m.vertex(vertex.a, vertex.b).point);
        const double error =
            std::fabs(static_cast<double>(height(n, vertex.point) - m.scale() * height_by_brute_force(a, b, n)));
        EXPECT_LE(error, m.height_error()) << "size " << size;
        EXPECT_LE(norm(vertex.point), 2.0 * m.size() * (1.0 + 1e-12));
        EXPECT_EQ(m.support(n, vertex).point, vertex.point) << "a vertex to begin with changes nothing";
      }
    }
  }
}

TEST(MinkowskiDifference, APlaneSeparatesWhereBothBodiesKeepToTheirSide) {
  const ClusteredMesh a = tests::clustered_box({0, 0, 0}, {1, 1, 1}), b = tests::clustered_box({2, 0, 0}, {3, 1, 1});
  const MinkowskiDifference m(a, b);
  const MinkowskiVertex near = m.support({1, 0, 0});
  EXPECT_TRUE(m.separated_by_plane({1, 0, 0}, near.a, near.b));
  EXPECT_FALSE(m.separated_by_plane({0, 1, 0}, near.a, near.b)) << "both are as high along y";
  const ClusteredMesh overlapping = tests::clustered_box({0.5, 0, 0}, {3, 1, 1});
  const MinkowskiDifference overlap(a, overlapping);
  for (const Vec3 n : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}}) {
    const MinkowskiVertex farthest = overlap.support(n);
    EXPECT_FALSE(overlap.separated_by_plane(n, farthest.a, farthest.b));
  }
}

TEST(MinkowskiDifference, HasASizeOfAboutOneWhateverTheUnit) {
  for (const double size : {0x1p-300, 1.0, 0x1p300}) {
    tests::Mesh mesh = tests::blob(2, 1.0, 0.3, 1);
    mesh.positions *= size;
    const ClusteredMesh a = tests::clustered(mesh);
    const MinkowskiDifference m(a, a);
    EXPECT_GE(m.size(), 0.25);
    EXPECT_LE(m.size(), 8.0);
    EXPECT_EQ(std::exp2(std::round(std::log2(m.scale()))), m.scale()) << "a power of two";
  }
}

}  // namespace
}  // namespace tact::narrowphase
