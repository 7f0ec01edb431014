#include <gtest/gtest.h>

#include <vector>

#include "narrowphase/mesh/rigid_box.h"
#include "tests/support/clustered.h"
#include "tests/support/random.h"

namespace tact::tests {
namespace {

using narrowphase::Pose;
using narrowphase::RigidPose;

// Of smooth, flat and torn meshes, of one cluster to several groups, near and far, tiny and huge: the box that is found
// without placing is, bit for bit, that of the placed vertices.
TEST(RigidBox, IsThatOfThePlacedVertices) {
  Random random(17);
  const std::vector<Mesh> meshes{icosphere(1),        blob(4, 1.0, 0.3, 1), gridded_box({-1, -1, -1}, {1, 1, 1}, 12),
                                 sheet(40, 40, 2, 2), soup(500, 2.0, 3),    torus(60, 30, 1.0, 0.4)};
  for (const Mesh& mesh : meshes) {
    for (const double unit : {0x1p-1000, 1.0, 0x1p280}) {
      narrowphase::ClusteredMesh clusters = clustered(scaled(mesh, unit));
      RigidPose state;
      clusters.make_rigid(&state);
      for (int i = 0; i < 30; ++i) {
        Pose pose;
        const Rotation rotation = i == 0 ? Rotation{} : random.rotation();
        for (std::size_t k = 0; k < 3; ++k) pose.rows[k] = rotation.row[k];
        pose.translation = (i % 3 == 0 ? 1e9 : i % 3 == 1 ? 1.0 : 0.0) * unit * random.in_cube(1.0);
        const base::Box found = narrowphase::box_at_pose(clusters, pose);
        state.set(pose);
        clusters.place();
        clusters.validate();
        EXPECT_EQ(found, clusters.box()) << clusters.facet_count() << " facets, unit " << unit << ", pose " << i;
      }
    }
  }
}

}  // namespace
}  // namespace tact::tests
