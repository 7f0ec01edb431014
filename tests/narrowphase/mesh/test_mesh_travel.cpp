#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "narrowphase/mesh/refit.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

long double distance(const Mesh& from, const Mesh& to, int vertex) {
  long double sum = 0.0L;
  for (int axis = 0; axis < 3; ++axis) {
    const long double d = static_cast<long double>(to.positions(axis, vertex)) - from.positions(axis, vertex);
    sum += d * d;
  }
  return std::sqrt(sum);
}

// The longest step of a vertex of the cluster, borrowed ones included.
long double longest_step(const ClusteredMesh& mesh, int cluster, const Mesh& from, const Mesh& to) {
  long double longest = 0.0L;
  for (int f = mesh.facet_begin(cluster); f < mesh.facet_end(cluster); ++f) {
    for (const int v : mesh.corners(f)) longest = std::max(longest, distance(from, to, mesh.source_vertex(v)));
  }
  return longest;
}

TEST(MeshTravel, IsNoLessThanTheSumOfStepsAndHardlyMore) {
  for (const double scale : {1.0, 0x1p-250, 0x1p250}) {
    Mesh at = tests::scaled(tests::wrinkled_sheet(24, 2.0, 0.2, 1), scale);
    ClusteredMesh mesh = tests::clustered(at);
    mesh.keep_travel(true);
    std::vector<long double> sum(static_cast<std::size_t>(mesh.cluster_count()), 0.0L);
    for (std::uint64_t step = 0; step < 20; ++step) {
      const Mesh to = tests::jittered(at, scale * std::pow(10.0, -static_cast<double>(step % 5)), step);
      refit(mesh, to.positions.data());
      mesh.keep_travel(true);  // still
      for (int c = 0; c < mesh.cluster_count(); ++c) {
        long double& all = sum[c];
        all += longest_step(mesh, c, at, to);
        EXPECT_GE(mesh.travel()->of(c), all);
        // A cluster counts the steps of its neighbours' vertices, too.
        EXPECT_LE(mesh.travel()->of(c), 4.0L * all + 1e-140L);
      }
      at = to;
    }
  }
}

TEST(MeshTravel, OfRefusedStepsIsTakenBack) {
  const Mesh at = tests::icosphere(3);
  ClusteredMesh mesh = tests::clustered(at);
  mesh.keep_travel(true);
  refit(mesh, tests::jittered(at, 0.01, 1).positions.data());
  const double travel = mesh.travel()->of(3);
  refit(mesh, tests::jittered(at, 0.5, 2).positions.data());
  EXPECT_GT(mesh.travel()->of(3), travel);
  undo_refit(mesh);
  EXPECT_EQ(mesh.travel()->of(3), travel);
  Mesh bad = at;
  bad.positions(1, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refit(mesh, bad.positions.data()), Refit::bad);
  EXPECT_EQ(mesh.travel()->of(3), travel);
}

TEST(MeshTravel, EndsIfNobodyAsksForItAgain) {
  const Mesh at = tests::icosphere(2);
  ClusteredMesh mesh = tests::clustered(at);
  mesh.keep_travel(true);
  const std::uint64_t begin = mesh.travel_epoch();
  for (int step = 0; step < 3 * ClusteredMesh::kMostUnasked; ++step) {
    refit(mesh, tests::jittered(at, 0.1, static_cast<std::uint64_t>(step)).positions.data());
    EXPECT_EQ(mesh.travel() != nullptr, step < ClusteredMesh::kMostUnasked) << step;
  }
  EXPECT_NE(mesh.travel_epoch(), begin);
  mesh.keep_travel(true);
  EXPECT_NE(mesh.travel(), nullptr);
}

TEST(MeshTravel, EpochsTellMovesThatNobodySaw) {
  const Mesh at = tests::icosphere(2);
  ClusteredMesh mesh = tests::clustered(at);
  const std::uint64_t begin = mesh.travel_epoch();
  refit(mesh, at.positions.data());
  EXPECT_EQ(mesh.travel_epoch(), begin);  // nothing moved
  refit(mesh, tests::jittered(at, 0.1, 1).positions.data());
  EXPECT_NE(mesh.travel_epoch(), begin);
  mesh.keep_travel(true);
  const std::uint64_t kept = mesh.travel_epoch();
  refit(mesh, at.positions.data());
  EXPECT_EQ(mesh.travel_epoch(), kept);
  mesh.keep_travel(false);
  EXPECT_NE(mesh.travel_epoch(), kept);
}

}  // namespace
}  // namespace tact::narrowphase
