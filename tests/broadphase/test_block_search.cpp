#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "broadphase/block_search.h"
#include "tests/support/generators/random.h"

namespace tact::broadphase {
namespace {

using base::Vec3;

// Those that overlap a box; each that is found is noted.
struct Overlapping {
  Box around() const { return box; }
  double rank(const Box& other) const { return base::overlaps(other, box) ? other.lower.x : kInfinity; }
  double rank_of(std::uint32_t index) const { return rank((*boxes)[index]); }
  bool wants(double) const { return true; }
  void visit(std::uint32_t index) { found.push_back(index); }

  const std::vector<Box>* boxes;
  Box box;
  std::vector<std::uint32_t> found = {};
};

// The box with the least lower bound along x.
struct Least : Overlapping {
  bool wants(double rank) const { return rank < least; }
  void visit(std::uint32_t index) {
    least = rank_of(index);
    found = {index};
  }
  double least = kInfinity;
};

std::vector<Box> random_boxes(std::size_t count, double size, const Vec3& middle, tests::Random& random) {
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    if (random.chance(0.05)) continue;  // empty
    const Vec3 p = middle + size * random.in_cube(1.0);
    box = base::extended({p, p}, p + 0.1 * size * random.in_cube(1.0));
  }
  return boxes;
}

BlockTree tree_of(const std::vector<Box>& boxes) {
  std::vector<std::uint32_t> all(boxes.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  BlockTree tree;
  tree.update(boxes, all, std::vector<std::uint8_t>(boxes.size(), 1), 1);
  return tree;
}

TEST(BlockSearch, FindsTheBoxesThatALoopFinds) {
  tests::Random random(1);
  for (const std::size_t count : {0U, 1U, 15U, 17U, 300U, 5000U}) {
    for (const double size : {0x1p-200, 1e-3, 1.0, 1e6, 0x1p200}) {
      for (const Vec3& middle : {Vec3{}, Vec3{1e6 * size, -3.0 * size, 1e9 * size}}) {
        const std::vector<Box> boxes = random_boxes(count, size, middle, random);
        const BlockTree tree = tree_of(boxes);
        for (int i = 0; i < 20; ++i) {
          Overlapping search{&boxes, random_boxes(1, size, middle, random)[0]};
          // Also a box that touches one of the others along a whole side.
          if (i % 2 == 0 && count > 0 && !boxes[count / 2].empty()) {
            search.box = boxes[count / 2];
            search.box.lower.x = search.box.upper.x;
          }
          Least least{search};
          BlockSearch(tree, search).run();
          BlockSearch(tree, least).run();
          std::vector<std::uint32_t> expected;
          for (std::uint32_t k = 0; k < count; ++k) {
            if (!boxes[k].empty() && search.rank_of(k) < kInfinity) expected.push_back(k);
          }
          std::ranges::sort(search.found);
          ASSERT_EQ(search.found, expected) << count << " boxes of size " << size;
          ASSERT_EQ(least.found.empty(), expected.empty());
          for (const std::uint32_t k : expected) ASSERT_LE(least.least, search.rank_of(k));
        }
      }
    }
  }
}

TEST(BlockSearch, FloatsAreRoundedOutward) {
  tests::Random random(2);
  for (int i = 0; i < 100'000; ++i) {
    const double origin = i % 3 == 0 ? 0.0 : std::ldexp(random.uniform(-1.0, 1.0), random.below(200) - 100);
    const double x = std::ldexp(random.uniform(-1.0, 1.0), random.below(600) - 300);
    const float bound = to_float(x, origin);
    ASSERT_LE(not_above(bound, origin), x);
    ASSERT_GE(not_below(bound, origin), x);
  }
}

}  // namespace
}  // namespace tact::broadphase
