#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <vector>

#include "narrowphase/mesh/features.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using narrowphase::ClusteredMesh, narrowphase::Features, narrowphase::EdgeVertices, narrowphase::Corners;

ClusteredMesh clustered_mesh_of(const Mesh& mesh) {
  return {std::span(mesh.positions.data(), static_cast<std::size_t>(mesh.positions.size())),
          std::span(mesh.facets.data(), static_cast<std::size_t>(mesh.facets.size()))};
}

// Facet by facet, each edge where it comes first.
struct ExpectedEdges {
  std::vector<EdgeVertices> edges;
  std::vector<std::vector<int>> opposite;
  std::vector<int> of_side, balance;

  explicit ExpectedEdges(const ClusteredMesh& mesh) {
    std::map<EdgeVertices, int> numbers;
    for (int f = 0; f < mesh.facet_count(); ++f) {
      const Corners c = mesh.corners(f);
      for (std::size_t k = 0; k < 3; ++k) {
        const int from = c[k], to = c[(k + 1) % 3];
        if (from == to) {
          of_side.push_back(-1);
          continue;
        }
        const bool ascends = mesh.source_vertex(from) < mesh.source_vertex(to);
        const EdgeVertices ends = ascends ? EdgeVertices{from, to} : EdgeVertices{to, from};
        const auto [at, is_new] = numbers.try_emplace(ends, static_cast<int>(edges.size()));
        if (is_new) edges.push_back(ends), opposite.emplace_back(), balance.push_back(0);
        const auto edge = static_cast<std::size_t>(at->second);
        of_side.push_back(at->second);
        opposite[edge].push_back(c[(k + 2) % 3]);
        balance[edge] += ascends ? 1 : -1;
      }
    }
  }
};

// The first vertex of each part by the caller's numbers, found by walking.
std::vector<int> first_of_parts(const Features& features, int source_vertices) {
  std::vector<int> firsts;
  std::set<int> seen;
  for (int source = 0; source < source_vertices; ++source) {
    const int v = features.vertex_of_source(source);
    if (v < 0 || !seen.insert(v).second) continue;
    firsts.push_back(v);
    for (std::vector<int> next{v}; !next.empty();) {
      const int from = next.back();
      next.pop_back();
      for (const int to : features.neighbors(from)) {
        if (seen.insert(to).second) next.push_back(to);
      }
    }
  }
  return firsts;
}

void expect_edges(const Mesh& of) {
  const ClusteredMesh mesh = clustered_mesh_of(of);
  const Features features(mesh);
  const ExpectedEdges expected(mesh);
  ASSERT_EQ(features.edge_count(), static_cast<int>(expected.edges.size()));
  for (int e = 0; e < features.edge_count(); ++e) {
    EXPECT_EQ(features.edge(e), expected.edges[static_cast<std::size_t>(e)]);
    EXPECT_TRUE(std::ranges::equal(features.opposite(e), expected.opposite[static_cast<std::size_t>(e)]));
  }
  for (int f = 0; f < mesh.facet_count(); ++f) {
    EXPECT_EQ(features.corners(f), mesh.corners(f));
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(features.facet_edge(f, k), expected.of_side[static_cast<std::size_t>(3 * f + k)]);
  }
  std::vector<int> first_facet(static_cast<std::size_t>(features.edge_count()), -1);
  for (int f = mesh.facet_count() - 1; f >= 0; --f) {
    for (int k = 0; k < 3; ++k) {
      if (const int e = features.facet_edge(f, k); e >= 0) first_facet[static_cast<std::size_t>(e)] = f;
    }
  }
  for (int c = 0; c < mesh.cluster_count(); ++c) {
    for (int e = features.edge_begin(c); e < features.edge_end(c); ++e)
      EXPECT_EQ(first_facet[static_cast<std::size_t>(e)] / narrowphase::kClusterSize, c);
  }
  EXPECT_EQ(features.is_closed(), std::ranges::all_of(expected.balance, [](int balance) { return balance == 0; }));
  EXPECT_TRUE(std::ranges::equal(features.one_of_each_part(), first_of_parts(features, mesh.source_vertex_count())));
}

TEST(Features, HaveTheEdgesOfAllKindsOfMeshes) {
  expect_edges(icosphere(2));
  expect_edges(sheet(9, 7, 1.0, 1.0));
  expect_edges(merged(std::vector{torus(12, 8, 1.0, 0.3), translated(cube(1.0, {}), {3, 0, 0}), soup(30, 1.0, 4)}));
}

// Facets on any vertices: repeated, turned, without area, of one vertex.
TEST(Features, HaveTheEdgesOfFacetsOnAnyVertices) {
  Random random(8);
  for (const int vertices : {1, 2, 5, 12, 60}) {
    Mesh mesh = soup((vertices + 2) / 3, 1.0, random.bits());
    mesh.facets.resize(3, 150);
    for (int& v : mesh.facets.reshaped()) v = random.below(vertices);
    expect_edges(mesh);
  }
}

// By the caller's numbers: one vertex tells where a part is, though facet pairs are left out (Accuracy::paper), and one
// facet of a vertex along what it slides.
TEST(Features, NameTheSameHoweverFacetsAreGrouped) {
  const Mesh of = merged(std::vector{torus(12, 8, 1.0, 0.3), translated(cube(1.0, {}), {3, 0, 0}), soup(30, 1.0, 4)});
  std::vector<int> backwards(static_cast<std::size_t>(of.facets.cols()));
  std::iota(backwards.rbegin(), backwards.rend(), 0);
  const std::span<const double> positions(of.positions.data(), static_cast<std::size_t>(of.positions.size()));
  const std::span<const int> facets(of.facets.data(), static_cast<std::size_t>(of.facets.size()));
  const auto names = [](const ClusteredMesh& mesh) {
    const Features features(mesh);
    std::array<std::vector<int>, 2> named;
    for (const int v : features.one_of_each_part()) named[0].push_back(mesh.source_vertex(v));
    for (int source = 0; source < mesh.source_vertex_count(); ++source) {
      const int v = features.vertex_of_source(source);
      named[1].push_back(v < 0 ? -1 : mesh.source_facet(features.first_facet_of_vertex(v)));
    }
    return named;
  };
  const auto [parts, firsts] = names(clustered_mesh_of(of));
  EXPECT_EQ(parts.size(), 32u);
  const auto [parts_again, firsts_again] = names(ClusteredMesh(positions, facets, backwards));
  EXPECT_EQ(parts_again, parts);
  EXPECT_EQ(firsts_again, firsts);
}

// Two tips that all facets share.
TEST(Features, OfManyFacetsAtOneVertexTakeTimeInProportion) {
  constexpr int kAround = 60000;
  Mesh mesh;
  mesh.positions = Eigen::Matrix3Xd::Zero(3, kAround + 2);
  mesh.facets.resize(3, 2 * kAround);
  for (int i = 0; i < kAround; ++i) {
    mesh.facets.col(2 * i) << kAround, i, (i + 1) % kAround;
    mesh.facets.col(2 * i + 1) << (i + 1) % kAround, i, kAround + 1;
  }
  EXPECT_EQ(Features(clustered_mesh_of(mesh)).edge_count(), 3 * kAround);
}

}  // namespace
}  // namespace tact::tests
