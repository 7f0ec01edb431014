#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "tests/support/facet_filters.h"
#include "tests/support/generators.h"
#include "tests/support/random.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

// Points of few heights in some ranges: wherever the first of the highest stands, it is found, and whether it is alone.
TEST(Kernels, OfEquallyHighPointsTheFirstIsTheHighest) {
  tests::Random random(4);
  const std::vector<double> zero(60, 0.0);
  for (int repeat = 0; repeat < 2000; ++repeat) {
    std::vector<double> x(60, 9.0);  // outside of the ranges it is higher
    std::vector<IndexRange> ranges;
    std::vector<int> inside;
    for (int begin = random.below(4); begin < 40 && repeat % 50 != 49;) {  // none, once in a while
      const int end = std::min(begin + random.below(20), 40);
      ranges.push_back({begin, end});
      for (int i = begin; i < end; ++i) inside.push_back(i);
      begin = end + random.below(5);
    }
    for (const int i : inside) x[static_cast<std::size_t>(i)] = random.below(1 + repeat % 40) - 1.0;
    const auto height = [&](int i) { return x[static_cast<std::size_t>(i)]; };
    const auto first = std::ranges::max_element(inside, {}, height);
    const int index = first == inside.end() ? -1 : *first;
    const bool several = index >= 0 && std::ranges::count(inside, height(index), height) > 1;
    const double least = repeat % 2 == 0 ? -1.0 : -std::numeric_limits<double>::infinity();
    for (const Kernels* kernels : tests::available_kernels()) {
      const HighestPoint top = kernels->highest_point({x.data(), zero.data(), zero.data()}, ranges.data(),
                                                      static_cast<int>(ranges.size()), {1, 0, 0, 0, 0, 0}, least);
      EXPECT_EQ(top.index, index) << kernels->name;
      EXPECT_EQ(top.several, several) << kernels->name;
      EXPECT_EQ(top.height, index < 0 ? -std::numeric_limits<double>::infinity() : height(index)) << kernels->name;
    }
  }
}

TEST(Kernels, SortsPairs) {
  tests::Random random(3);
  for (int count = 0; count <= kMostSorted; ++count) {
    std::vector<FacetPair> sorted, shuffled;
    for (int i = 0; i < count; ++i) sorted.push_back({i / 5 * 70'000'000, 2'147'483'640 + i % 5});
    std::sort(sorted.begin(), sorted.end());
    shuffled = sorted;
    for (std::size_t i = shuffled.size(); i > 1; --i) {
      std::swap(shuffled[i - 1], shuffled[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      std::vector<FacetPair> pairs = shuffled;
      kernels->sort_pairs(pairs.data(), count);
      EXPECT_EQ(pairs, sorted) << kernels->name;
    }
  }
}

class RefreshCluster : public testing::Test {
 protected:
  RefreshCluster() {
    for (int v = 0; v < mesh_.vertex_count(); ++v) (v % 3 == 1 ? borrowed_ : owned_).push_back(v);
    for (std::vector<double>* axis : {&x_, &y_, &z_, &before_x_, &before_y_, &before_z_})
      axis->assign(owned_.size(), 0.0);
  }

  RefreshedCluster refresh(const Kernels& kernels, bool changed = false) {
    return kernels.refresh_cluster({.source = mesh_.positions.data(),
                                    .owned = owned_.data(),
                                    .owned_count = static_cast<std::int32_t>(owned_.size()),
                                    .borrowed = borrowed_.data(),
                                    .borrowed_count = static_cast<std::int32_t>(borrowed_.size()),
                                    .ahead = 0,
                                    .before = {before_x_.data(), before_y_.data(), before_z_.data()},
                                    .changed = changed,
                                    .x = x_.data(),
                                    .y = y_.data(),
                                    .z = z_.data()});
  }
  void keep() {
    before_x_ = x_;
    before_y_ = y_;
    before_z_ = z_;
  }

  Mesh mesh_ = tests::blob(1, 1.0, 0.3, 5);
  std::vector<std::int32_t> owned_, borrowed_;
  std::vector<double> x_, y_, z_, before_x_, before_y_, before_z_;
};

TEST_F(RefreshCluster, CopiesWidensAndNoticesChanges) {
  for (const Kernels* kernels : tests::available_kernels()) {
    before_x_.assign(owned_.size(), 0.0);
    const RefreshedCluster first = refresh(*kernels);
    EXPECT_TRUE(first.changed);
    EXPECT_FALSE(first.not_a_number);
    keep();
    EXPECT_FALSE(refresh(*kernels).changed) << kernels->name;
    EXPECT_TRUE(refresh(*kernels, true).changed) << kernels->name;
    for (std::size_t i = 0; i < owned_.size(); ++i) {
      EXPECT_EQ((Vec3{x_[i], y_[i], z_[i]}), mesh_.position(owned_[i])) << kernels->name;
      for (std::vector<double>* axis : {&before_x_, &before_y_, &before_z_}) {
        keep();
        (*axis)[i] += 1.0;
        EXPECT_TRUE(refresh(*kernels).changed) << kernels->name << " vertex " << i;
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(first.box.lower[axis], mesh_.positions.row(axis).minCoeff());
      EXPECT_EQ(first.box.upper[axis], mesh_.positions.row(axis).maxCoeff());
    }
  }
}

TEST_F(RefreshCluster, NoticesEveryOwnedCoordinateThatIsNoNumber) {
  for (const Kernels* kernels : tests::available_kernels()) {
    for (const std::int32_t v : owned_) {
      for (int axis = 0; axis < 3; ++axis) {
        const Mesh sound = mesh_;
        mesh_.positions(axis, v) = std::numeric_limits<double>::quiet_NaN();
        EXPECT_TRUE(refresh(*kernels).not_a_number) << kernels->name << " vertex " << v;
        mesh_ = sound;
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
