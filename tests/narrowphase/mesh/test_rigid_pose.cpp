#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "narrowphase/mesh/rigid_pose.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

Pose random_pose(tests::Random& random, double reach) {
  Pose pose;
  const tests::Rotation rotation = random.rotation();
  for (int axis = 0; axis < 3; ++axis) pose.rows[axis] = rotation.row[axis];
  pose.translation = random.in_cube(reach);
  return pose;
}

TEST(RigidPose, BoxesHoldEveryPlacedVertex) {
  tests::Random random(3);
  for (const double size : {1.0, 0x1p-300, 0x1p300}) {
    tests::Mesh mesh = tests::blob(2, 1.0, 0.3, 5);
    mesh.positions *= size;
    const ClusteredMesh clusters = tests::clustered(mesh);
    RigidPose rigid;
    rigid.begin(clusters.points(), clusters.vertex_count(), clusters.box());
    for (int i = 0; i < 50; ++i) {
      const Pose pose = random_pose(random, 3.0 * size);
      const Box box = rigid.box_at(pose);
      for (int v = 0; v < clusters.vertex_count(); ++v)
        ASSERT_TRUE(contains(box, placed(pose, clusters.position(v)))) << "vertex " << v << ", size " << size;
    }
  }
}

// The box of a ball does not grow when the ball turns; that of its turned box would, by up to the root of three.
TEST(RigidPose, BoxesOfRoundBodiesStaySmall) {
  const ClusteredMesh ball = tests::clustered(tests::icosphere(3));
  RigidPose rigid;
  rigid.begin(ball.points(), ball.vertex_count(), ball.box());
  tests::Random random(4);
  for (int i = 0; i < 20; ++i) {
    const Box box = rigid.box_at(random_pose(random, 1.0));
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(box.upper[axis] - box.lower[axis], 2.0 + 1e-7);
  }
}

TEST(RigidPose, WithoutVerticesHasNoBox) {
  RigidPose rigid;
  rigid.begin({}, 0, {});
  EXPECT_TRUE(rigid.box_at({}).empty());
}

TEST(RigidPose, IsPlacedOnceForEachPoseByOneOfManyThreads) {
  RigidPose rigid;
  rigid.begin({}, 0, {});
  for (int round = 0; round < 50; ++round) {
    rigid.set({});
    EXPECT_FALSE(rigid.is_placed());
    std::atomic<int> placed_times = 0;
    int written = 0;  // by the thread that places; the others read it afterwards
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        rigid.place_once([&] {
          written = 7;
          ++placed_times;
        });
        EXPECT_EQ(written, 7);
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(placed_times, 1);
    EXPECT_TRUE(rigid.is_placed());
  }
}

}  // namespace
}  // namespace tact::narrowphase
