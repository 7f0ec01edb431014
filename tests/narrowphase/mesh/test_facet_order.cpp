#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "narrowphase/mesh/cluster_quality.h"
#include "narrowphase/mesh/facet_order.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

TEST(FacetOrder, NamesEveryFacetOnce) {
  Mesh in_one_place = tests::sheet(70, 70, 1.0, 1.0);
  in_one_place.positions.setZero();
  Mesh with_degenerate_facets = tests::blob(4, 1.0, 0.3, 1);
  for (int f = 0; f < with_degenerate_facets.facet_count(); f += 3)
    with_degenerate_facets.facets(1, f) = with_degenerate_facets.facets(0, f);
  Mesh empty = tests::box({0, 0, 0}, {1, 1, 1});
  empty.facets.resize(3, 0);
  for (const Mesh& mesh : {in_one_place, with_degenerate_facets, empty, tests::sheet(1, 1, 1.0, 1.0),
                           tests::lattice_soup(3000, 3, 2), tests::soup(5000, 0.1, 3), tests::needles(700, 1e9, 4)}) {
    std::vector<int> order = tests::facet_order_of(mesh);
    std::ranges::sort(order);
    std::vector<int> all(static_cast<std::size_t>(mesh.facet_count()));
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(order, all);
  }
}

double reads_per_vertex(const Mesh& mesh) {
  const ClusteredMesh clusters = tests::clustered(mesh);
  return static_cast<double>(clusters.vertex_reads()) / clusters.vertex_count();
}

TEST(FacetOrder, VerticesAreReadAtMostOneAndAHalfTimes) {
  EXPECT_LE(reads_per_vertex(tests::icosphere(5)), 1.5);
  EXPECT_LE(reads_per_vertex(tests::blob(4, 1.0, 0.3, 1)), 1.5);
  EXPECT_LE(reads_per_vertex(tests::organ(1)), 1.5);
  EXPECT_LE(reads_per_vertex(tests::torus(128, 32, 1.0, 0.3)), 1.5);
  for (const int cells : {37, 80, 275}) {
    EXPECT_LE(reads_per_vertex(tests::sheet(cells, cells, 1.0, 1.0)), 1.5) << cells;
    EXPECT_LE(reads_per_vertex(tests::wrinkled_sheet(cells, 1.0, 0.1, 2)), 1.5) << cells;
    EXPECT_LE(reads_per_vertex(tests::sheet(cells, 60, 10.0, 1.0)), 1.5) << cells << ", facets longer than wide";
    EXPECT_LE(reads_per_vertex(tests::sheet(cells, 60, 0.1, 1.0)), 1.5) << cells << ", facets wider than long";
  }
}

// Between components no vertex is shared: cuts there must not make clusters long.
TEST(FacetOrder, ClustersOfManyComponentsAreCompact) {
  std::vector<Mesh> strands, layers;
  for (int i = 0; i < 64; ++i)
    strands.push_back(tests::translated(tests::sheet(32, 1, 1.0, 0.03), {0.0, 0.06 * i, 0.0}));
  for (int i = 0; i < 20; ++i)
    layers.push_back(tests::translated(tests::sheet(10, 10, 1.0, 1.0), {0.0, 0.0, 0.02 * i}));
  for (const std::vector<Mesh>& parts : {strands, layers}) {
    const ClusteredMesh clusters = tests::clustered(tests::merged(parts));
    EXPECT_GE(cluster_quality(clusters), 1.0 / 1.2);
  }
}

}  // namespace
}  // namespace tact::narrowphase
