#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/box_arrays.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

// Clusters that own and borrow a few vertices or many: the shortest, which no loop of four fits, and none among them.
class RefitClusters : public testing::Test {
 protected:
  RefitClusters() {
    std::vector<std::int32_t> vertices;
    for (int v = 0; v < mesh_.vertex_count(); ++v) vertices.push_back(v * 5 % mesh_.vertex_count());
    auto next = vertices.begin();
    const auto take = [&](std::size_t count, std::vector<std::int32_t>& to) {
      for (; count > 0 && next != vertices.end(); --count) to.push_back(*next++);
    };
    for (const auto& [owned, borrowed] : {std::pair{1, 0}, {3, 1}, {4, 0}, {5, 2}, {0, 3}, {7, 1}, {60, 0}}) {
      begin_cluster();
      take(static_cast<std::size_t>(owned), owned_);
      take(static_cast<std::size_t>(borrowed), borrowed_);
    }
    begin_cluster();
    for (std::vector<double>* axis : {&x_, &y_, &z_, &before_x_, &before_y_, &before_z_})
      axis->assign(owned_.size(), 0.0);
  }

  std::size_t cluster_count() const { return ranges_.size() / 2 - 1; }

  Refitted refit(const Kernels& kernels, std::int32_t ahead = 0) {
    bounds_.assign(6 * cluster_count(), 0.0);
    return kernels.refit_clusters({.source = mesh_.positions.data(),
                                   .cluster_begin = 0,
                                   .cluster_end = static_cast<std::int32_t>(cluster_count()),
                                   .ranges = ranges_.data(),
                                   .owned = owned_.data(),
                                   .borrowed = borrowed_.data(),
                                   .ahead = ahead,
                                   .before = {before_x_.data(), before_y_.data(), before_z_.data()},
                                   .x = x_.data(),
                                   .y = y_.data(),
                                   .z = z_.data(),
                                   .boxes = bounds_.data(),
                                   .box_stride = static_cast<std::int32_t>(cluster_count()),
                                   .steps_squared = steps_.empty() ? nullptr : steps_.data()});
  }
  Box box(std::size_t cluster) const { return BoxView(bounds_.data(), cluster_count())[cluster]; }
  Box expected_box(std::size_t cluster) const {
    Box box;
    const auto widen = [&](const std::vector<std::int32_t>& vertices, std::size_t which) {
      for (std::int32_t i = ranges_[2 * cluster + which]; i < ranges_[2 * cluster + 2 + which]; ++i)
        box = base::extended(box, mesh_.position(vertices[i]));
    };
    widen(owned_, 0);
    widen(borrowed_, 1);
    return box;
  }
  void keep() {
    before_x_ = x_;
    before_y_ = y_;
    before_z_ = z_;
  }

  Mesh mesh_ = tests::blob(1, 1.0, 0.3, 5);
  std::vector<std::int32_t> ranges_, owned_, borrowed_;
  std::vector<double> x_, y_, z_, before_x_, before_y_, before_z_;
  std::vector<double> steps_;  // empty: nobody asks

 private:
  void begin_cluster() {
    ranges_.insert(ranges_.end(),
                   {static_cast<std::int32_t>(owned_.size()), static_cast<std::int32_t>(borrowed_.size())});
  }
  std::vector<double> bounds_;
};

TEST_F(RefitClusters, CopiesAndFindsBoxes) {
  for (const Kernels* kernels : tests::available_kernels()) {
    for (const std::int32_t ahead : {0, 3, 8}) {
      for (std::vector<double>* axis : {&x_, &y_, &z_}) axis->assign(owned_.size(), -77.0);
      const Refitted seen = refit(*kernels, ahead);
      EXPECT_FALSE(seen.not_a_number);
      for (std::size_t i = 0; i < owned_.size(); ++i)
        EXPECT_EQ((Vec3{x_[i], y_[i], z_[i]}), mesh_.position(owned_[i])) << kernels->name;
      Box all;
      for (std::size_t c = 0; c < cluster_count(); ++c) {
        EXPECT_EQ(box(c), expected_box(c)) << kernels->name << " cluster " << c;
        all = base::merged(all, expected_box(c));
      }
      EXPECT_EQ((Box{{seen.box.lower[0], seen.box.lower[1], seen.box.lower[2]},
                     {seen.box.upper[0], seen.box.upper[1], seen.box.upper[2]}}),
                all);
    }
  }
}

TEST_F(RefitClusters, NoticesEveryOwnedCoordinateThatChanged) {
  for (const Kernels* kernels : tests::available_kernels()) {
    EXPECT_TRUE(refit(*kernels).changed);
    keep();
    EXPECT_FALSE(refit(*kernels).changed) << kernels->name;
    for (std::size_t i = 0; i < owned_.size(); ++i) {
      for (std::vector<double>* axis : {&before_x_, &before_y_, &before_z_}) {
        keep();
        (*axis)[i] += 1.0;
        EXPECT_TRUE(refit(*kernels).changed) << kernels->name << " vertex " << i;
      }
    }
    for (std::vector<double>* axis : {&before_x_, &before_y_, &before_z_}) axis->assign(owned_.size(), 0.0);
  }
}

TEST_F(RefitClusters, NoticesEveryOwnedCoordinateThatIsNoNumber) {
  for (const Kernels* kernels : tests::available_kernels()) {
    for (const std::int32_t v : owned_) {
      for (int axis = 0; axis < 3; ++axis) {
        const Mesh sound = mesh_;
        mesh_.positions(axis, v) = std::numeric_limits<double>::quiet_NaN();
        EXPECT_TRUE(refit(*kernels).not_a_number) << kernels->name << " vertex " << v;
        mesh_ = sound;
      }
    }
  }
}

TEST_F(RefitClusters, TellsHowFarOwnedVerticesGo) {
  refit(*scalar_kernels());
  keep();
  mesh_ = tests::jittered(mesh_, 0.1, 1);
  for (const Kernels* kernels : tests::available_kernels()) {
    steps_.assign(cluster_count(), -1.0);
    refit(*kernels);
    for (std::size_t c = 0; c < cluster_count(); ++c) {
      double longest = 0.0;
      for (auto i = static_cast<std::size_t>(ranges_[2 * c]); i < static_cast<std::size_t>(ranges_[2 * c + 2]); ++i) {
        const Vec3 step = mesh_.position(owned_[i]) - Vec3{before_x_[i], before_y_[i], before_z_[i]};
        longest = std::max(longest, norm_squared(step));
      }
      EXPECT_EQ(steps_[c], longest) << kernels->name << " cluster " << c;
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
