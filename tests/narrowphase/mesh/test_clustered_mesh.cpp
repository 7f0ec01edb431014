#include <gtest/gtest.h>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/mesh/refit.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::clustered;
using tests::Mesh;

TEST(ClusteredMesh, IsValidForAnyMesh) {
  for (const Mesh& mesh : tests::meshes_with_ties()) {
    const ClusteredMesh clusters = clustered(mesh);
    EXPECT_NO_THROW(clusters.validate());
    EXPECT_EQ(clusters.facet_count(), mesh.facet_count());
    for (int f = 0; f < mesh.facet_count(); ++f) {
      const Triangle triangle = clusters.triangle(clusters.facet_of_source(f));
      for (int k = 0; k < 3; ++k) EXPECT_EQ(triangle[k], mesh.position(mesh.facets(k, f)));
    }
  }
}

TEST(ClusteredMesh, ABodyWithoutFacetsHasAnEmptyBox) {
  const Mesh mesh = tests::box({0, 0, 0}, {1, 1, 1});
  const ClusteredMesh clusters({mesh.positions.data(), static_cast<std::size_t>(mesh.positions.size())}, {});
  EXPECT_TRUE(clusters.box().empty());
  EXPECT_EQ(clusters.cluster_count(), 0);
}

TEST(ClusteredMesh, AnUnusedVertexDoesNotCount) {
  Mesh mesh = tests::box({0, 0, 0}, {1, 1, 1});
  mesh.positions.conservativeResize(3, 9);
  mesh.positions.col(8) << 100, 100, 100;
  ClusteredMesh clusters = clustered(mesh);
  EXPECT_EQ(clusters.box(), (Box{{0, 0, 0}, {1, 1, 1}}));
  mesh.positions(0, 8) = 200;
  EXPECT_EQ(refit(clusters, mesh.positions.data()), Refit::same);
}

TEST(ClusteredMesh, MovesAndSaysSo) {
  for (const Mesh& mesh : tests::meshes_with_ties()) {
    ClusteredMesh clusters = clustered(mesh);
    EXPECT_EQ(refit(clusters, mesh.positions.data()), Refit::same);
    Mesh moved = tests::crumpled(mesh, 11);
    EXPECT_EQ(refit(clusters, moved.positions.data()), Refit::changed);
    clusters.validate();
    EXPECT_EQ(clusters.position(0), moved.position(clusters.source_vertex(0)));
  }
}

TEST(ClusteredMesh, RefusesBadPositionsAndStaysAsItWas) {
  constexpr double kLargest = 8.0;
  Mesh sound = tests::icosphere(2);
  sound.positions.conservativeResize(3, sound.positions.cols() + 1);
  sound.positions.rightCols(1).setConstant(1.0);  // no facet uses it
  Mesh moved = sound;
  moved.positions.array() += 0.5;
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(), 8.5, -8.5}) {
    for (Eigen::Index at = 0; at < moved.positions.size(); ++at) {
      ClusteredMesh clusters = clustered(sound);
      const Vec3 before = clusters.position(7);
      const base::Box box = clusters.box();
      Mesh bad = moved;
      bad.positions.data()[at] = value;
      EXPECT_EQ(refit(clusters, bad.positions.data(), {.largest = kLargest}), Refit::bad) << value << " at " << at;
      clusters.validate();
      EXPECT_EQ(clusters.position(7), before);
      EXPECT_EQ(clusters.box(), box);
    }
  }
  ClusteredMesh clusters = clustered(sound);
  EXPECT_EQ(refit(clusters, sound.positions.data(), {.largest = kLargest}), Refit::same);
  EXPECT_EQ(refit(clusters, moved.positions.data(), {.largest = kLargest}), Refit::changed);
  clusters.validate();
  EXPECT_EQ(clusters.position(7), moved.position(clusters.source_vertex(7)));
}

TEST(ClusteredMesh, IsTakenBackToWhereItWas) {
  for (const Mesh& mesh : tests::meshes_with_ties()) {
    ClusteredMesh clusters = clustered(mesh);
    const base::Box box = clusters.box();
    EXPECT_EQ(refit(clusters, tests::crumpled(mesh, 11).positions.data()), Refit::changed);
    undo_refit(clusters);
    clusters.validate();
    EXPECT_EQ(clusters.box(), box);
    EXPECT_EQ(refit(clusters, mesh.positions.data()), Refit::same);
  }
}

TEST(ClusteredMesh, BodyOfOnePointAtTheOriginHasABox) {
  Mesh mesh = tests::box({0, 0, 0}, {1, 1, 1});
  mesh.positions.setZero();
  const ClusteredMesh clusters = clustered(mesh);
  clusters.validate();
  EXPECT_EQ(clusters.box(), (Box{{0, 0, 0}, {0, 0, 0}}));
}

TEST(ClusteredMesh, RefusesBadPositionsOnSeveralThreads) {
  const Mesh mesh = tests::wrinkled_sheet(160, 2.0, 0.2, 2);  // several ranges of clusters
  for (const int vertex : {0, mesh.vertex_count() / 2, mesh.vertex_count() - 1}) {
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), 9.0}) {
      ClusteredMesh clusters = clustered(mesh);
      Mesh bad = mesh;
      bad.positions(1, vertex) = value;
      EXPECT_EQ(refit(clusters, bad.positions.data(), {.largest = 8.0, .threads = 2}), Refit::bad)
          << value << " at " << vertex;
    }
  }
}

TEST(ClusteredMesh, ThreadsDoNotChangeBoxes) {
  const Mesh mesh = tests::wrinkled_sheet(160, 2.0, 0.2, 2);  // several ranges of clusters
  const Mesh moved = tests::jittered(mesh, 0.01, 3);
  ClusteredMesh one = clustered(mesh), two = clustered(mesh);
  EXPECT_EQ(refit(one, moved.positions.data()), Refit::changed);
  EXPECT_EQ(refit(two, moved.positions.data(), {.threads = 2}), Refit::changed);
  two.validate();
  for (int c = 0; c < one.cluster_count(); ++c) {
    EXPECT_EQ(one.cluster_boxes()[c], two.cluster_boxes()[c]);
  }
}

}  // namespace
}  // namespace tact::narrowphase
