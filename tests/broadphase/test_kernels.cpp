#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "broadphase/kernels/kernels.h"
#include "tests/support/generators/random.h"

namespace tact::broadphase {
namespace {

using tests::Random;

std::vector<const Kernels*> available_kernels() {
  std::vector<const Kernels*> found;
  for (const Kernels* kernels : {baseline_kernels(), avx2_kernels(), avx512_kernels()}) {
    if (kernels) found.push_back(kernels);
  }
  return found;
}

Box random_box(Random& random) {
  const base::Vec3 lower = random.in_cube(2.0);
  Box box{lower, lower + base::Vec3{random.uniform(), random.uniform(), random.uniform()}};
  if (random.chance(0.3)) {  // faces in common
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::round(box.lower[axis]);
      box.upper[axis] = box.lower[axis] + 1.0;
    }
  }
  return random.chance(0.1) ? Box{} : box;
}

struct Sample {
  std::vector<Box> boxes;
  std::vector<std::uint32_t> members;
  Block block;
  std::uint32_t left;
};

constexpr FloatBox kEverywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};

Sample random_sample(const Kernels& kernels, Random& random, const FloatBox& region) {
  Sample sample;
  for (std::uint32_t i = 0; i < kLanes; ++i) {
    sample.boxes.push_back(random_box(random));
    sample.members.push_back(i);
  }
  std::memset(static_cast<void*>(&sample.block), 0, sizeof sample.block);
  sample.left = kernels.refit_lanes(sample.block, &sample.boxes[0].lower.x, sample.members.data(), kAllLanes,
                                    Frame{{0.25, 0.0, 1.0 / 3.0}}, region);
  return sample;
}

TEST(BroadphaseKernels, RefreshGivesTheSameBitsOnEveryInstructionSet) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const FloatBox region{{-1.5f, -1.5f, -2.0f}, {1.5f, 2.0f, 2.0f}};
    Random random(seed);
    const Sample first = random_sample(*baseline_kernels(), random, region);
    for (const Kernels* kernels : available_kernels()) {
      Random same(seed);
      const Sample sample = random_sample(*kernels, same, region);
      EXPECT_EQ(sample.left, first.left) << kernels->name << ", seed " << seed;
      EXPECT_EQ(std::memcmp(&sample.block, &first.block, sizeof sample.block), 0) << kernels->name << ", seed " << seed;
    }
  }
}

TEST(BroadphaseKernels, RefreshLeavesOtherLanesAlone) {
  for (const Kernels* kernels : available_kernels()) {
    Random random(7);
    Sample sample = random_sample(*kernels, random, kEverywhere);
    const Block before = sample.block;
    for (Box& box : sample.boxes) box = {{9, 9, 9}, {10, 10, 10}};
    EXPECT_EQ(kernels->refit_lanes(sample.block, &sample.boxes[0].lower.x, sample.members.data(), 1u << 3 | 1u << 14,
                                   Frame{}, kEverywhere),
              0u);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const bool set = lane == 3 || lane == 14;
      EXPECT_EQ(sample.block.lower[1][lane], set ? 9.0f : before.lower[1][lane]) << kernels->name;
      EXPECT_EQ(sample.block.upper[2][lane], set ? 10.0f : before.upper[2][lane]) << kernels->name;
    }
    EXPECT_EQ(sample.block.bounds.upper[0], 10.0f);
  }
}

struct Found {
  std::vector<IndexPair> pairs;  // sorted
  bool certain;
};

Found found_pairs(const Kernels& kernels, const BlockSide& a, const BlockSide& b) {
  const Block blocks[2] = {*a.block, *b.block};
  const IndexPair both{0, 1};
  std::uint16_t rows = 0;
  kernels.find_rows(blocks, &both, 1, &rows);
  Found found;
  found.pairs.resize(kOverlapRoom);
  const Overlaps overlaps = kernels.find_overlaps(a, b, rows, found.pairs.data());
  found.pairs.resize(overlaps.count);
  std::ranges::sort(found.pairs);
  found.certain = overlaps.certain;
  return found;
}

// The pairs that the definition gives, on the floats of the blocks.
std::vector<IndexPair> expected_pairs(const BlockSide& a, const BlockSide& b) {
  std::vector<IndexPair> pairs;
  for (std::uint32_t i = 0; i < kLanes; ++i) {
    for (std::uint32_t j = a.block == b.block ? i + 1 : 0; j < kLanes; ++j) {
      bool overlap = (a.active >> i & 1u) != 0 || (b.active >> j & 1u) != 0;
      for (int axis = 0; axis < 3; ++axis) {
        overlap = overlap && a.block->lower[axis][i] <= b.block->upper[axis][j] &&
                  b.block->lower[axis][j] <= a.block->upper[axis][i];
      }
      if (overlap) pairs.push_back({std::min(a.names[i], b.names[j]), std::max(a.names[i], b.names[j])});
    }
  }
  std::ranges::sort(pairs);
  return pairs;
}

TEST(BroadphaseKernels, OverlapsAreThoseOfTheDefinition) {
  for (const Kernels* kernels : available_kernels()) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      Random random(seed);
      const Sample one = random_sample(*kernels, random, kEverywhere);
      const Sample other = random_sample(*kernels, random, kEverywhere);
      std::uint32_t names[2 * kLanes];
      for (std::uint32_t i = 0; i < 2 * kLanes; ++i) names[i] = i * 0x9e3779b1u;
      const BlockSide a{&one.block, names, static_cast<std::uint32_t>(random.bits()) & kAllLanes};
      const BlockSide b{&other.block, names + kLanes, seed % 3 == 0 ? kAllLanes : 0u};
      for (const BlockSide& second : {b, a}) {
        EXPECT_EQ(found_pairs(*kernels, a, second).pairs, expected_pairs(a, second))
            << kernels->name << ", seed " << seed;
      }
    }
  }
}

TEST(BroadphaseKernels, EqualFloatsAreDoubtful) {
  for (const Kernels* kernels : available_kernels()) {
    for (const double gap : {0.0, 1e-12, -0.5, 0.5}) {
      std::vector<Box> boxes(kLanes);
      boxes[2] = {{0, 0, 0}, {1, 1, 1}};
      boxes[9] = {{1.0 + gap, 0.25, 0.25}, {3, 0.5, 0.5}};
      Block block{};
      std::vector<std::uint32_t> members(kLanes);
      for (std::uint32_t i = 0; i < kLanes; ++i) members[i] = i;
      kernels->refit_lanes(block, &boxes[0].lower.x, members.data(), kAllLanes, Frame{}, kEverywhere);
      const BlockSide side{&block, members.data(), kAllLanes};
      const Found found = found_pairs(*kernels, side, side);
      EXPECT_EQ(found.pairs.size(), gap < 0.25 ? 1u : 0u) << gap;
      EXPECT_EQ(found.certain, gap < 0.0 || gap > 0.25) << gap;
      EXPECT_EQ((block.exact_lanes >> 9 & 1u) != 0, gap != 1e-12) << gap;
    }
  }
}

}  // namespace
}  // namespace tact::broadphase
