#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "narrowphase/hull/support.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

TEST(Support, IsThatOfAFullScanBitForBit) {
  tests::Random random(7);
  for (const tests::Mesh& mesh : tests::meshes_with_ties()) {
    const ClusteredMesh clusters = tests::clustered(mesh);
    for (int i = 0; i < 100; ++i) {
      // Every tenth direction is an axis or a diagonal: many vertices tie.
      const auto tie = [&] { return random.below(3) - 1.0; };
      const Vec3 n = i % 10 == 0 ? Vec3{tie(), tie(), tie()} : random.direction();
      const Vec3 origin = random.in_cube(1.0);
      const Support expected = support_by_full_scan(clusters, n, origin);
      const Support found = support(clusters, n, origin);
      EXPECT_EQ(found.vertex, expected.vertex);
      EXPECT_EQ(found.height, expected.height);
      for (int v = 0; v < clusters.vertex_count(); ++v) {
        const double height = dot(n, clusters.position(v) - origin);
        EXPECT_LE(height, expected.height);
        if (height == expected.height) {
          EXPECT_LE(clusters.source_vertex(expected.vertex), clusters.source_vertex(v));
        }
      }
    }
  }
}

// In one group of clusters, in several, and in more than are looked at together.
TEST(Support, LooksAtAllGroups) {
  tests::Random random(8);
  std::vector<std::int32_t> reaching;
  for (const int cells : {10, 100, 530}) {
    const ClusteredMesh mesh = tests::clustered(tests::wrinkled_sheet(cells, 2.0, 0.3, 3));
    for (int i = 0; i < 20; ++i) {
      const Vec3 n = random.direction(), origin = random.in_cube(1.0);
      const Support top = support_by_full_scan(mesh, n, origin);
      EXPECT_EQ(support(mesh, n, origin).vertex, top.vertex);
      EXPECT_FALSE(stays_below(mesh, n, origin, top.height));
      EXPECT_TRUE(stays_below(mesh, n, origin, std::nextafter(top.height, HUGE_VAL)));

      const double height = top.height - random.uniform(0.0, 1.0);
      select_vertices(mesh, n, origin, height, reaching);
      std::vector<std::int32_t> expected;
      for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (dot(n, mesh.position(v) - origin) >= height) expected.push_back(v);
      }
      ASSERT_EQ(reaching, expected) << cells << " cells, direction " << i;
      EXPECT_FALSE(expected.empty());
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
