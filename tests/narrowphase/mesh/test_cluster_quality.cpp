#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <vector>

#include "narrowphase/mesh/cluster_quality.h"
#include "narrowphase/mesh/refit.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

TEST(ClusterQuality, OfASmoothMeshIsThatOfNewClustersWhateverItsSize) {
  for (const int cells : {20, 60, 120}) {
    const double quality = cluster_quality(tests::clustered(tests::sheet(cells, cells, 1.0, 1.0)));
    EXPECT_GT(quality, 1.2) << cells;
    EXPECT_LT(quality, 2.2) << cells;
  }
}

// Small pieces in a row, which change places: the facets of a cluster lie all over the row, until it is clustered from
// where they are now.
TEST(ClusterQuality, DecaysWhereTheFacetsOfAClusterPartAndIsRestoredByNewClusters) {
  const auto row_of_pieces = [](const std::vector<int>& places) {
    std::vector<tests::Mesh> pieces;
    for (const int place : places)
      pieces.push_back(tests::translated(tests::sheet(1, 1, 0.1, 0.1), {0.2 * place, 0.0, 0.0}));
    return tests::merged(pieces);
  };
  constexpr int kPieces = 640;
  std::vector<int> in_order(kPieces);
  std::iota(in_order.begin(), in_order.end(), 0);
  const tests::Mesh before = row_of_pieces(in_order), after = row_of_pieces(tests::Random(8).permutation(kPieces));
  ClusteredMesh clusters = tests::clustered(before);
  const double fresh = cluster_quality(clusters), spread = cluster_spread(clusters);
  refit(clusters, after.positions.data());
  EXPECT_LT(cluster_quality(clusters), 0.1 * fresh);
  EXPECT_GT(cluster_spread(clusters), 10.0 * spread);
  EXPECT_NEAR(cluster_quality(clustered_anew(clusters)), fresh, 0.1 * fresh);
}

TEST(ClusterQuality, IsInfiniteWhereFacetsHaveNoSize) {
  tests::Mesh mesh = tests::sheet(4, 4, 1.0, 1.0);
  mesh.positions.setZero();
  EXPECT_EQ(cluster_quality(tests::clustered(mesh)), std::numeric_limits<double>::infinity());
}

TEST(ClusteredAnew, KeepsFacetsPositionsAndTheCallersNumbers) {
  const tests::Mesh mesh = tests::blob(3, 1.0, 0.3, 6);
  ClusteredMesh clusters = tests::clustered(mesh);
  const tests::Mesh moved = tests::scrambled(mesh, 7);
  refit(clusters, moved.positions.data());
  const ClusteredMesh anew = clustered_anew(clusters);
  anew.validate();
  ASSERT_EQ(anew.facet_count(), mesh.facet_count());
  for (int f = 0; f < mesh.facet_count(); ++f)
    EXPECT_EQ(anew.triangle(anew.facet_of_source(f)), clusters.triangle(clusters.facet_of_source(f)));
  const std::vector<int> numbers = vertex_numbers_in(anew, clusters);
  ASSERT_EQ(static_cast<int>(numbers.size()), clusters.vertex_count());
  for (int v = 0; v < clusters.vertex_count(); ++v) {
    EXPECT_EQ(anew.source_vertex(numbers[v]), clusters.source_vertex(v));
    EXPECT_EQ(anew.position(numbers[v]), clusters.position(v));
  }
}

}  // namespace
}  // namespace tact::narrowphase
