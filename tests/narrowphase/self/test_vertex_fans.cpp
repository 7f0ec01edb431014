// Facets around vertices that are said to lie open have no more in common than what they share: by CGAL.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "narrowphase/self/vertex_fans.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/folds.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/oracles/facet_pair_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;
using tests::MeshBuilder;

struct OpenCounts {
  int vertices = 0, open = 0;
  std::size_t pairs = 0;  // of facets with a common vertex that meet beyond it
};

// No two facets at a vertex that is said to lie open meet.
OpenCounts expect_no_pair_denied(const Mesh& mesh, const std::string& what) {
  const ClusteredMesh clusters = tests::clustered(mesh);
  const VertexFans fans(clusters);
  std::set<int> open;  // by the caller's numbers
  std::vector<Vec3> sides;
  for (int v = 0; v < clusters.vertex_count(); ++v) {
    if (fans.lie_open(clusters, v, sides)) open.insert(clusters.source_vertex(v));
  }
  OpenCounts counts{clusters.vertex_count(), static_cast<int>(open.size())};
  for (const FacetPair& pair : tests::self_facet_pairs_by_oracle(mesh)) {
    const auto f = mesh.facets.col(pair.a), g = mesh.facets.col(pair.b);
    bool share = false;
    for (const int v : f) {
      if (std::ranges::find(g, v) == g.end()) continue;
      share = true;
      EXPECT_FALSE(open.contains(v)) << what << ", vertex " << v << ", facets " << pair.a << ' ' << pair.b;
    }
    counts.pairs += share ? 1 : 0;
  }
  return counts;
}

// Facets around one vertex that turn by some angle together, at heights that differ.
Mesh fan(int facets, double turn, double height, double noise, bool closed, tests::Random& random) {
  MeshBuilder builder;
  const int middle = builder.vertex({0, 0, 0});
  const int ends = closed ? facets : facets + 1;
  for (int i = 0; i < ends; ++i) {
    const double angle = turn * i / facets + noise * random.uniform(-1.0, 1.0) / facets, r = random.uniform(0.3, 2.0);
    builder.vertex({r * std::cos(angle), r * std::sin(angle), height * random.uniform(-1.0, 1.0)});
  }
  for (int i = 0; i < facets; ++i) {
    const int p = 1 + i, q = 1 + (i + 1) % ends;
    random.chance(0.5) ? builder.facet(middle, p, q) : builder.facet(q, p, middle);  // their sides do not matter
  }
  return builder.mesh();
}

TEST(VertexFans, DenyNoPairOfFans) {
  tests::Random random(3);
  std::size_t pairs = 0;
  int open = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool closed = random.chance(0.6);
    const int turns = 1 + random.below(2), facets = 3 + random.below(9);
    const double turn = 2.0 * std::numbers::pi * (closed ? turns : random.uniform(0.2, 1.6));
    const Mesh mesh = tests::rotated(fan(facets, turn, random.below(3) * 0.4, random.below(3) * 1.5, closed, random),
                                     random.rotation());
    const OpenCounts counts = expect_no_pair_denied(mesh, "fan " + std::to_string(i));
    pairs += counts.pairs;
    open += counts.open;
  }
  EXPECT_GT(pairs, 1000u);
  EXPECT_GT(open, 10000);
}

// A whole turn exactly, and next to it: the last edge lies on the first one.
TEST(VertexFans, DenyNoPairOfAWholeTurn) {
  for (const double more : {-1e-3, -1e-9, -1e-15, 0.0, 1e-15, 1e-9}) {
    for (const double up : {0.0, 0.5}) {
      MeshBuilder builder;
      const int middle = builder.vertex({0, 0, 0});
      const std::array<Vec3, 5> ends{Vec3{1, 0, up}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0},
                                     Vec3{2, more, 2 * up}};
      for (const Vec3 end : ends) builder.vertex(end);
      for (int i = 1; i < 5; ++i) builder.facet(middle, i, i + 1);
      expect_no_pair_denied(builder.mesh(), "turn and " + std::to_string(more));
    }
  }
}

TEST(VertexFans, DenyNoPairOfFoldedAndBrokenMeshes) {
  std::size_t pairs = 0;
  for (const auto& [name, mesh] : tests::folded_meshes(12, 1)) {
    pairs += expect_no_pair_denied(mesh, name).pairs;
    pairs += expect_no_pair_denied(tests::broken(mesh, 1), "broken " + name).pairs;
  }
  for (std::uint64_t seed = 1; seed < 4; ++seed)
    pairs += expect_no_pair_denied(tests::lattice_soup(200, 3, seed), "soup").pairs;
  pairs += expect_no_pair_denied(tests::jittered(tests::icosphere(2), 0.2, 3), "noise").pairs;
  EXPECT_GT(pairs, 500u);
}

TEST(VertexFans, AllOfASmoothMeshLieOpen) {
  for (const Mesh& mesh :
       {tests::sheet(12, 12, 1.0, 1.0), tests::icosphere(3), tests::gridded_box({0, 0, 0}, {1, 1, 1}, 6),
        tests::torus(16, 8, 1.0, 0.3), tests::wrinkled_sheet(24, 1.0, 0.1, 1)}) {
    for (const double scale : {1.0, 0x1p-120, 0x1p120}) {
      const OpenCounts counts = expect_no_pair_denied(tests::scaled(mesh, scale), "smooth");
      EXPECT_EQ(counts.open, counts.vertices);
    }
  }
}

// Where an edge has three facets, facets meet in a vertex alone, name one twice or are listed twice.
TEST(VertexFans, WhatIsNoRowHasNone) {
  MeshBuilder builder;
  for (int i = 0; i < 6; ++i) builder.vertex({std::cos(1.1 * i), std::sin(1.1 * i), 0.1 * i});
  builder.facet(0, 1, 2);
  const auto row_at_0 = [&] {
    const ClusteredMesh mesh = tests::clustered(builder.mesh());
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.source_vertex(v) == 0) return VertexFans(mesh).around(v).size();
    }
    return std::size_t{99};
  };
  EXPECT_EQ(row_at_0(), 2u);
  builder.facet(0, 2, 3);
  EXPECT_EQ(row_at_0(), 3u);
  const MeshBuilder two = builder;
  builder.facet(3, 0, 1);
  EXPECT_EQ(row_at_0(), 4u);  // closed
  for (const std::array<int, 3> more : {std::array{0, 2, 4}, {0, 4, 5}, {0, 0, 4}, {0, 4, 4}, {2, 1, 0}}) {
    builder = two;
    builder.facet(more[0], more[1], more[2]);
    EXPECT_EQ(row_at_0(), 0u);
  }
}

}  // namespace
}  // namespace tact::narrowphase
