#include <gtest/gtest.h>

#include <algorithm>

#include "narrowphase/mesh/refit.h"
#include "narrowphase/pairs/box_reach.h"
#include "narrowphase/pairs/kept_clusters.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;
using tests::Random;

// The clusters whose boxes, grown by a reach, meet `other`, found one by one.
std::vector<std::int32_t> clusters_by_loop(const ClusterBoxes& boxes, double reach, const Box& other) {
  std::vector<std::int32_t> found;
  for (std::int32_t c = 0; c < boxes.mesh->cluster_count(); ++c) {
    if (overlaps(base::grown(boxes[c], reach), other)) found.push_back(c);
  }
  return found;
}

// In one group of clusters, in several, and in more than are looked at together; still, and on their ways.
TEST(KeptClusters, AreThoseWhoseBoxMeets) {
  Random random(31);
  KeptClusters kept;
  for (const int cells : {10, 100, 530}) {
    const Mesh sheet = tests::wrinkled_sheet(cells, 2.0, 0.3, 2);
    ClusteredMesh mesh = tests::clustered(sheet);
    refit(mesh, tests::translated(sheet, {0.1, 0.2, 0.3}).positions.data());
    const Placement begin = mesh.placements().before();
    std::size_t most = 0;
    for (int k = 0; k < 200; ++k) {
      const Vec3 corner{random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), random.uniform(-0.3, 0.3)};
      const double edge = k % 10 == 0 ? 3.0 : random.uniform(0.0, 0.5), reach = k % 3 == 0 ? 0.0 : 0.1;
      const Box box{corner, corner + Vec3{edge, edge, edge}};
      const MeshWay way{.begin = &begin, .frame = k % 4 == 1 ? Vec3{0.1, 0.2, 0.2} : Vec3{}};
      const ClusterBoxes boxes{.mesh = &mesh, .way = k % 2 == 0 ? nullptr : &way};
      keep_clusters(boxes, reach, box, kept);
      ASSERT_EQ(kept.cluster, clusters_by_loop(boxes, reach, box)) << cells << " cells, box " << k;
      Box bounds;
      for (std::size_t i = 0; i < kept.cluster.size(); ++i) {
        EXPECT_EQ(kept.boxes[i], reach == 0.0 ? boxes[kept.cluster[i]] : kept.boxes[i]);
        bounds = merged(bounds, intersection(kept.boxes[i], box));
      }
      EXPECT_EQ(kept.bounds, bounds);
      most = std::max(most, kept.cluster.size());
    }
    EXPECT_GT(3 * most, static_cast<std::size_t>(mesh.cluster_count()));
  }
}

TEST(KeptClusters, WithoutThoseThatAreTooLow) {
  KeptClusters all, high;
  const ClusteredMesh mesh = tests::clustered(tests::icosphere(5));
  const LeastHeight half{.axis = {0, 0, 1, 0, 0, 0}, .lowest = 0.5};
  keep_clusters({.mesh = &mesh}, 0.0, mesh.box(), all);
  keep_clusters({.mesh = &mesh, .least_height = &half}, 0.0, mesh.box(), high);
  std::vector<std::int32_t> expected = all.cluster;
  std::erase_if(expected, [&](std::int32_t c) { return mesh.cluster_boxes()[c].upper.z < 0.5; });
  EXPECT_EQ(high.cluster, expected);
  EXPECT_EQ(high.too_low, all.count() - high.count());
  EXPECT_GT(high.too_low, 0);
}

// A box that a reach touches but for rounding is not lost.
TEST(KeptClusters, AGrownBoxThatTouchesIsKept) {
  Random random(5);
  KeptClusters kept;
  const double corner[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int facet[] = {0, 1, 2};
  ClusteredMesh mesh(corner, facet);
  for (int i = 0; i < 10'000; ++i) {
    const double size = i % 2 == 0 ? 1.0 : 1e6, reach = random.uniform(0.0, 2.0), x = size * random.uniform(-1.0, 1.0);
    const double moved[] = {x, 0, 0, x + 1, 0, 0, x, 1, 0};
    refit(mesh, moved);
    const double left = inflated(mesh.box(), reach).lower.x, right = inflated(mesh.box(), reach).upper.x;
    for (const Box& other : {Box{{left - 1, 0, 0}, {left, 1, 1}}, Box{{right, 0, 0}, {right + 1, 1, 1}}}) {
      keep_clusters({.mesh = &mesh}, reach, other, kept);
      ASSERT_EQ(kept.count(), 1) << i;
    }
  }
}

TEST(KeptClusters, AreKeptAgainWhereTheyMeetLess) {
  KeptClusters kept;
  const ClusteredMesh mesh = tests::clustered(tests::icosphere(5));
  const Box less{{0.5, -1, -1}, {1, 1, 1}};
  keep_clusters({.mesh = &mesh}, 0.0, mesh.box(), kept);
  keep_again(less, kept);
  EXPECT_EQ(kept.cluster, clusters_by_loop({.mesh = &mesh}, 0.0, less));
  for (int i = 0; i < kept.count(); ++i) EXPECT_EQ(kept.boxes[i], mesh.cluster_boxes()[kept.cluster[i]]);
}

}  // namespace
}  // namespace tact::narrowphase
