#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "narrowphase/self/cluster_neighbors.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/folds.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

struct Neighbors {
  ClusteredMesh mesh;
  Features features;
  ClusterNeighbors of;
  explicit Neighbors(const Mesh& source) : mesh(tests::clustered(source)), features(mesh), of(mesh, features) {}
};

int cluster_of(int facet) { return facet / kClusterSize; }

TEST(ClusterNeighbors, AroundAreThoseWithACommonVertex) {
  for (const auto& [name, source] : tests::folded_meshes(20, 1)) {
    const Neighbors neighbors(source);
    std::map<int, std::set<int>> users;
    for (int f = 0; f < neighbors.mesh.facet_count(); ++f) {
      for (const int v : neighbors.mesh.corners(f)) users[v].insert(cluster_of(f));
    }
    std::map<int, std::set<int>> around;
    for (const auto& [_, clusters] : users) {
      for (const int c : clusters) around[c].insert(clusters.begin(), clusters.end());
    }
    for (int c = 0; c < neighbors.mesh.cluster_count(); ++c) {
      const auto those = neighbors.of.around(c);
      EXPECT_TRUE(std::ranges::equal(those, around[c])) << name << ", cluster " << c;
    }
  }
}

// Each edge between two clusters stands in both, in opposite directions; each edge of one facet in one.
TEST(ClusterNeighbors, RimsHoldTheEdgesBetweenClustersAndTheEndsOfTheSurface) {
  for (const auto& [name, source] : tests::folded_meshes(20, 2)) {
    const Neighbors neighbors(source);
    std::map<std::pair<int, int>, int> facet_at;  // of each edge as the facet has it
    for (int f = 0; f < neighbors.mesh.facet_count(); ++f) {
      const Corners c = neighbors.mesh.corners(f);
      for (std::size_t k = 0; k < 3; ++k) facet_at[{c[k], c[(k + 1) % 3]}] = f;
    }
    std::set<std::tuple<int, int, int, int>> expected, found;  // cluster, other, from, to
    for (const auto& [edge, f] : facet_at) {
      const auto beyond = facet_at.find({edge.second, edge.first});
      const int other = beyond == facet_at.end() ? -1 : cluster_of(beyond->second);
      if (other != cluster_of(f)) expected.insert({cluster_of(f), other, edge.first, edge.second});
    }
    for (int c = 0; c < neighbors.mesh.cluster_count(); ++c) {
      EXPECT_FALSE(neighbors.of.irregular(c)) << name;
      for (const auto& rim : neighbors.of.rims(c)) {
        for (const auto& side : neighbors.of.sides(rim)) found.insert({c, rim.other, side.from, side.to});
      }
    }
    EXPECT_EQ(found, expected) << name;
  }
}

// The line around a corner holds each edge that one facet of its clusters has and none has against it, one after the
// other, each vertex once.
TEST(ClusterNeighbors, LinesAreTheBoundariesOfTheClustersAtACorner) {
  int corners = 0;
  std::vector<tests::NamedMesh> meshes = tests::folded_meshes(20, 3);
  meshes.push_back({"sheet", tests::sheet(48, 48, 1.0, 1.0)});
  meshes.push_back({"sphere", tests::icosphere(4)});
  for (const auto& [name, source] : meshes) {
    const Neighbors neighbors(source);
    for (int corner = 0; corner < neighbors.of.corner_count(); ++corner, ++corners) {
      const auto clusters = neighbors.of.clusters_at(corner);
      EXPECT_TRUE(std::ranges::is_sorted(clusters)) << name;
      EXPECT_GE(clusters.size(), 2u) << name;
      std::set<std::pair<int, int>> edges;
      std::map<int, std::set<int>> users;
      for (int f = 0; f < neighbors.mesh.facet_count(); ++f) {
        if (std::ranges::find(clusters, cluster_of(f)) == clusters.end()) continue;
        const Corners c = neighbors.mesh.corners(f);
        for (std::size_t k = 0; k < 3; ++k) {
          edges.insert({c[k], c[(k + 1) % 3]});
          users[c[k]].insert(cluster_of(f));
        }
      }
      EXPECT_TRUE(std::ranges::any_of(users, [&](const auto& one) { return one.second.size() == clusters.size(); }));
      std::erase_if(edges, [all = edges](const auto& e) { return all.contains({e.second, e.first}); });
      const auto line = neighbors.of.line_around(corner);
      std::set<std::pair<int, int>> found;
      for (std::size_t i = 0; i < line.size(); ++i) found.insert({line[i], line[(i + 1) % line.size()]});
      EXPECT_EQ(found, edges) << name << ", corner " << corner;
      EXPECT_EQ(std::set<int>(line.begin(), line.end()).size(), line.size()) << name << ", corner " << corner;
    }
  }
  EXPECT_GT(corners, 100);
}

TEST(ClusterNeighbors, MostPairsMeetAtACorner) {
  for (const Mesh& source : {tests::sheet(48, 48, 1.0, 1.0), tests::icosphere(4)}) {
    const Neighbors neighbors(source);
    int pairs = 0, at_corners = 0;
    for (int c = 0; c < neighbors.mesh.cluster_count(); ++c) {
      for (const int corner : neighbors.of.corners_of(c)) {
        const auto clusters = neighbors.of.clusters_at(corner);
        EXPECT_NE(std::ranges::find(clusters, c), clusters.end());
      }
      for (const int d : neighbors.of.around(c)) {
        const auto of_d = neighbors.of.corners_of(d);
        ++pairs;
        at_corners += std::ranges::any_of(neighbors.of.corners_of(c),
                                          [&](int corner) { return std::ranges::find(of_d, corner) != of_d.end(); });
      }
    }
    EXPECT_GT(at_corners, 0.95 * pairs);
  }
}

TEST(ClusterNeighbors, FacetsThatNoSurfaceHasAreIrregular) {
  const Mesh source = tests::sheet(20, 20, 1.0, 1.0);
  const auto irregular_with = [&](int i, int j, int k) {
    Mesh mesh = source;
    mesh.facets.conservativeResize(3, mesh.facet_count() + 1);
    mesh.facets.rightCols(1) << i, j, k;
    const Neighbors neighbors(mesh);
    const int cluster = cluster_of(neighbors.mesh.facet_of_source(source.facet_count()));
    return neighbors.of.irregular(cluster);
  };
  const auto f = [&](int corner) { return source.facets(corner, 400); };
  EXPECT_TRUE(irregular_with(f(0), f(1), f(2)));  // repeated
  EXPECT_TRUE(irregular_with(f(2), f(1), f(0)));  // and turned
  EXPECT_TRUE(irregular_with(f(0), f(0), f(1)));  // without area
  EXPECT_TRUE(irregular_with(f(0), f(1), 0));     // a third one at an edge
  Mesh turned = source;
  std::swap(turned.facets(0, 400), turned.facets(1, 400));  // two in the same direction
  const Neighbors neighbors(turned);
  EXPECT_TRUE(neighbors.of.irregular(cluster_of(neighbors.mesh.facet_of_source(400))));
}

// A fan of 3,000 facets around one vertex: its clusters would all be neighbours.
TEST(ClusterNeighbors, OfAVertexOfManyClustersAreNotListed) {
  tests::MeshBuilder builder;
  const int middle = builder.vertex({0, 0, 0});
  for (int i = 0; i <= 3000; ++i) builder.vertex({1.0 + i, 1.0, 0.001 * i * i});
  for (int i = 1; i <= 3000; ++i) builder.facet(middle, i, i + 1);
  const Neighbors neighbors(builder.mesh());
  for (int c = 0; c < neighbors.mesh.cluster_count(); ++c) {
    EXPECT_TRUE(neighbors.of.irregular(c));
    EXPECT_LE(neighbors.of.around(c).size(), 3u);
  }
}

}  // namespace
}  // namespace tact::narrowphase
