#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/facet_filters.h"
#include "tests/support/generators.h"
#include "tests/support/random.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

// Points of few heights in some ranges, with numbers or without: wherever the first of the highest stands, it is found,
// if it is as high as was asked for.
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
    const double leasts[] = {-1.0, -std::numeric_limits<double>::infinity(), random.below(1 + repeat % 40) - 1.5};
    const double least = leasts[repeat % 3];
    const bool numbered = random.chance(0.5);
    const std::vector<int> number = random.permutation(60);
    const auto rank = [&](int i) { return std::pair(-height(i), numbered ? number[static_cast<std::size_t>(i)] : i); };
    const auto first = std::ranges::min_element(inside, {}, rank);
    const int index = first == inside.end() || height(*first) < least ? -1 : *first;
    for (const Kernels* kernels : tests::available_kernels()) {
      const HighestPoint top =
          kernels->highest_point({x.data(), zero.data(), zero.data()}, numbered ? number.data() : nullptr,
                                 ranges.data(), static_cast<int>(ranges.size()), {1, 0, 0, 0, 0, 0}, least);
      EXPECT_EQ(top.index, index) << kernels->name;
      EXPECT_EQ(top.height, index < 0 ? -std::numeric_limits<double>::infinity() : height(index)) << kernels->name;
    }
  }
}

// Boxes with corners on a grid, some of them exactly at the planes: which are left, and which of the others were too
// low.
TEST(Kernels, BoxesAreCulledByTheirFarCornersAndByABox) {
  tests::Random random(6);
  for (int repeat = 0; repeat < 3000; ++repeat) {
    const int count = random.below(kPadding * 4);
    BoxArrays boxes;
    boxes.resize(static_cast<std::size_t>(count));
    const auto corner = [&] { return Vec3{random.below(9) - 4.0, random.below(9) - 4.0, random.below(9) - 4.0}; };
    const auto box = [&](Vec3 p, Vec3 q) { return base::extended(Box{p, p}, q); };
    for (int i = 0; i < count; ++i) boxes.set(static_cast<std::size_t>(i), box(corner(), corner()));
    const Vec3 n = corner(), o = corner();
    const Box other = box(corner(), corner());
    const CullPlanes planes{{n.x, n.y, n.z, o.x, o.y, o.z}, random.below(60) - 10.0, narrowphase::bounds_of(other)};
    std::vector<std::int32_t> expected;
    int low = 0;
    for (int i = 0; i < count; ++i) {
      const Box one = boxes[static_cast<std::size_t>(i)];
      if (!overlaps(one, other)) continue;
      double highest = -std::numeric_limits<double>::infinity();
      for (const double x : {one.lower.x, one.upper.x}) {
        for (const double y : {one.lower.y, one.upper.y}) {
          for (const double z : {one.lower.z, one.upper.z}) highest = std::max(highest, dot(n, Vec3{x, y, z} - o));
        }
      }
      if (highest >= planes.lowest) expected.push_back(i);
      if (highest < planes.lowest) ++low;
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      std::vector<std::int32_t> left(static_cast<std::size_t>(count));
      const Culled culled = kernels->cull_boxes(boxes.pointers(), count, planes, left.data());
      left.resize(static_cast<std::size_t>(culled.left));
      EXPECT_EQ(left, expected) << kernels->name;
      EXPECT_EQ(culled.low, low) << kernels->name;
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

  Refitted refresh(const Kernels& kernels, std::int32_t ahead = 0) {
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
                                     .box_stride = static_cast<std::int32_t>(cluster_count())});
  }
  Box box(std::size_t cluster) const { return BoxView(bounds_.data(), cluster_count())[cluster]; }
  Box expected_box(std::size_t cluster) const {
    Box box;
    const auto widen = [&](const std::vector<std::int32_t>& vertices, std::size_t which) {
      for (std::int32_t i = ranges_[2 * cluster + which]; i < ranges_[2 * cluster + 2 + which]; ++i)
        box = base::extended(box, mesh_.position(vertices[static_cast<std::size_t>(i)]));
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
      const Refitted seen = refresh(*kernels, ahead);
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
    EXPECT_TRUE(refresh(*kernels).changed);
    keep();
    EXPECT_FALSE(refresh(*kernels).changed) << kernels->name;
    for (std::size_t i = 0; i < owned_.size(); ++i) {
      for (std::vector<double>* axis : {&before_x_, &before_y_, &before_z_}) {
        keep();
        (*axis)[i] += 1.0;
        EXPECT_TRUE(refresh(*kernels).changed) << kernels->name << " vertex " << i;
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
        EXPECT_TRUE(refresh(*kernels).not_a_number) << kernels->name << " vertex " << v;
        mesh_ = sound;
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
