#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "narrowphase/mesh/facet_order.h"
#include "narrowphase/mesh/vertex_numbering.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

VertexNumbering numbering_of(const tests::Mesh& mesh, const std::vector<int>& order) {
  return number_vertices({mesh.facets.data(), static_cast<std::size_t>(mesh.facets.size())}, order,
                         mesh.vertex_count());
}

// The source vertices that facets name, found again from what clusters own and borrow.
TEST(VertexNumbering, NamesTheCornersOfEveryFacet) {
  for (const tests::Mesh& mesh : {tests::blob(3, 1.0, 0.3, 1), tests::lattice_soup(500, 2, 3), tests::soup(200, 1.0, 4),
                                  tests::sheet(1, 1, 1.0, 1.0)}) {
    const std::vector<int> order = tests::facet_order_of(mesh);
    const VertexNumbering made = numbering_of(mesh, order);
    for (std::size_t f = 0; f < order.size(); ++f) {
      const std::size_t cluster = f / kClusterSize;
      const int owned_begin = made.ranges[2 * cluster], owned = made.ranges[2 * cluster + 2] - owned_begin;
      for (int k = 0; k < 3; ++k) {
        const int local = made.corner[k][f];
        const int source = local < owned ? made.source_vertices[owned_begin + local]
                                         : made.borrowed_sources[made.ranges[2 * cluster + 1] + local - owned];
        ASSERT_EQ(source, mesh.facets(k, order[f])) << "corner " << k << " of facet " << f;
      }
    }
  }
}

TEST(VertexNumbering, GivesEachVertexToTheFirstClusterThatUsesIt) {
  const tests::Mesh mesh = tests::blob(3, 1.0, 0.3, 1);
  const std::vector<int> order = tests::facet_order_of(mesh);
  const VertexNumbering made = numbering_of(mesh, order);
  std::set<int> seen;
  for (std::size_t cluster = 0; 2 * cluster + 2 < made.ranges.size(); ++cluster) {
    std::set<int> used;
    for (std::size_t f = cluster * kClusterSize; f < std::min(order.size(), (cluster + 1) * kClusterSize); ++f)
      for (int k = 0; k < 3; ++k) used.insert(mesh.facets(k, order[f]));
    std::vector<int> owned, borrowed;
    for (const int source : used) (seen.insert(source).second ? owned : borrowed).push_back(source);
    const auto begin = made.source_vertices.begin(), begin_borrowed = made.borrowed_sources.begin();
    const int* const range = &made.ranges[2 * cluster];
    EXPECT_EQ(std::vector<int>(begin + range[0], begin + range[2]), owned) << "cluster " << cluster;
    EXPECT_EQ(std::vector<int>(begin_borrowed + range[1], begin_borrowed + range[3]), borrowed)
        << "cluster " << cluster;
  }
  for (std::size_t i = 0; i < made.borrowed.size(); ++i)
    EXPECT_EQ(made.source_vertices[made.borrowed[i]], made.borrowed_sources[i]);
}

TEST(VertexNumbering, ListsVerticesThatNoFacetUses) {
  tests::Mesh mesh = tests::box({0, 0, 0}, {1, 1, 1});
  mesh.facets.resize(3, 1);
  mesh.facets << 6, 1, 4;
  const VertexNumbering made = numbering_of(mesh, {0});
  EXPECT_EQ(made.source_vertices, (std::vector<int>{1, 4, 6}));
  EXPECT_EQ(made.unused_sources, (std::vector<int>{0, 2, 3, 5, 7}));
  EXPECT_TRUE(made.borrowed.empty());
}

}  // namespace
}  // namespace tact::narrowphase
