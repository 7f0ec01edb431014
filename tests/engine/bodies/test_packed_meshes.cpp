#include <gtest/gtest.h>

#include <memory>

#include "engine/bodies/packed_meshes.h"
#include "narrowphase/mesh/refit.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact {
namespace {

using narrowphase::ClusteredMesh;
using narrowphase::Refit;

// Meshes of several sizes, one of them large, as a world would keep them.
class Packing : public testing::Test {
 protected:
  void add(int count) {
    for (int i = 0; i < count; ++i) {
      const auto seed = static_cast<unsigned>(meshes_.size());
      sources_.push_back(seed % 7 == 3   ? tests::blob(3, 1.0, 0.3, seed)
                         : seed % 2 == 0 ? tests::blob(2, 1.0, 0.3, seed)
                                         : tests::box({0, 0, 0}, {1, 2, 3}));
      meshes_.push_back(std::make_unique<ClusteredMesh>(tests::clustered(sources_.back())));
      packed_.add(*meshes_.back());
    }
  }
  void remove_last(int count) {
    for (int i = 0; i < count; ++i) {
      packed_.remove(*meshes_.back());
      meshes_.pop_back();
      sources_.pop_back();
    }
  }
  void pack() {
    std::vector<ClusteredMesh*> all;
    for (const auto& mesh : meshes_) all.push_back(mesh.get());
    packed_.pack(all, 2);
  }
  void expect_whole() {
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      ClusteredMesh& mesh = *meshes_[i];
      ASSERT_NO_THROW(mesh.validate()) << i;
      EXPECT_EQ(mesh.has_own_memory(), mesh.facet_count() > 1024) << i;
      EXPECT_EQ(refit(mesh, sources_[i].positions.data()), Refit::same) << i;
      for (int f = 0; f < mesh.facet_count(); f += 11) {
        const narrowphase::Triangle triangle = mesh.triangle(mesh.facet_of_source(f));
        for (int k = 0; k < 3; ++k) EXPECT_EQ(triangle[k], sources_[i].position(sources_[i].facets(k, f))) << i;
      }
    }
  }

  PackedMeshes packed_;
  std::vector<tests::Mesh> sources_;
  std::vector<std::unique_ptr<ClusteredMesh>> meshes_;
};

TEST_F(Packing, MeshesStayWhatTheyAre) {
  add(100);
  for (int round = 0; round < 3; ++round) {
    pack();
    expect_whole();
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      const tests::Mesh before = sources_[i];
      sources_[i] = tests::crumpled(before, static_cast<unsigned>(100 * round) + static_cast<unsigned>(i));
      EXPECT_EQ(refit(*meshes_[i], sources_[i].positions.data()), Refit::changed);
      if (i % 3 != 0) continue;
      undo_refit(*meshes_[i]);
      sources_[i] = before;
    }
    expect_whole();
    remove_last(10);
    add(20);
  }
}

TEST_F(Packing, IsDueWhereManyAreOutOfPlace) {
  add(60);
  EXPECT_FALSE(packed_.is_due(base::kTuning));  // few
  add(60);
  EXPECT_TRUE(packed_.is_due(base::kTuning));
  pack();
  EXPECT_FALSE(packed_.is_due(base::kTuning));
  add(50);
  EXPECT_FALSE(packed_.is_due(base::kTuning));
  add(20);
  EXPECT_TRUE(packed_.is_due(base::kTuning));
  pack();
  remove_last(40);
  EXPECT_FALSE(packed_.is_due(base::kTuning));
  remove_last(40);
  EXPECT_TRUE(packed_.is_due(base::kTuning));
  pack();
  add(200);
  pack();
  remove_last(static_cast<int>(meshes_.size()) - 10);
  EXPECT_TRUE(packed_.is_due(base::kTuning));  // few, but in a large piece of memory
  packed_.put_off();
  EXPECT_FALSE(packed_.is_due(base::kTuning));
  remove_last(1);
  EXPECT_TRUE(packed_.is_due(base::kTuning));
  remove_last(9);
  EXPECT_FALSE(packed_.is_due(base::kTuning));  // none, and no memory
  add(10);
  EXPECT_FALSE(packed_.is_due(base::kTuning));
}

TEST_F(Packing, LeavesOutAMeshOfManyVerticesThatItDoesNotUse) {
  sources_.push_back(tests::box({0, 0, 0}, {1, 2, 3}));
  sources_.back().positions.conservativeResize(3, 5000);
  sources_.back().positions.rightCols(4992).setZero();
  meshes_.push_back(std::make_unique<ClusteredMesh>(tests::clustered(sources_.back())));
  packed_.add(*meshes_.back());
  pack();
  EXPECT_TRUE(meshes_.back()->has_own_memory());
}

}  // namespace
}  // namespace tact
