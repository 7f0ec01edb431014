// Walks down a tree of blocks to the boxes that a query wants, the most promising first.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "broadphase/block_tree.h"
#include "broadphase/kernels/kernels.h"

namespace tact::broadphase {

// The number of which `bound` is the float is not below, or not above, what these return. A float is off by 2^-24 of
// itself or by 2^-150, and the difference that it was made of by 2^-53 of itself; all this is taken twice or more.
inline constexpr double kFloatSlack = 0x1p-22, kOriginSlack = 0x1p-51, kLeastSlack = 0x1p-148;

inline double not_above(float bound, double origin) {
  const double x = bound;
  if (x <= -kLargestFloat) return -std::numeric_limits<double>::infinity();
  return origin + x * (x > 0.0 ? 1.0 - kFloatSlack : 1.0 + kFloatSlack) -
         (kOriginSlack * std::abs(origin) + kLeastSlack);
}

inline double not_below(float bound, double origin) { return -not_above(-bound, -origin); }

// A box around that of a lane: around all boxes below it, or the one that it holds.
inline Box box_around(const Block& block, std::uint32_t lane, const Frame& frame) {
  const double* const origin = frame.origin;
  return {{not_above(block.lower[0][lane], origin[0]), not_above(block.lower[1][lane], origin[1]),
           not_above(block.lower[2][lane], origin[2])},
          {not_below(block.upper[0][lane], origin[0]), not_below(block.upper[1][lane], origin[1]),
           not_below(block.upper[2][lane], origin[2])}};
}

// Calls visit(index) for the boxes of a tree that a query wants, those of lower rank first within a block. The query
// has
//   around()       a box: what does not overlap it is not wanted,
//   rank(box)      a number, infinite if the box is not wanted; that of a box is at least that of any box around it,
//   rank_of(index) the same for a box of the tree, which may be left out by making it infinite,
//   wants(rank)    and visit(index), which may narrow what wants() takes.
template <class Query>
class BlockSearch {
 public:
  BlockSearch(const BlockTree& tree, Query& query) : tree_(tree), query_(query) {
    const Box around = query.around();
    for (int axis = 0; axis < 3; ++axis) {
      around_.lower[axis] = to_float(around.lower[axis], tree.frame().origin[axis]);
      around_.upper[axis] = to_float(around.upper[axis], tree.frame().origin[axis]);
    }
  }

  void run() {
    const std::size_t top = tree_.level_count() - 1;
    if (tree_.block_count(top) > 0) open(top, 0);
  }

 private:
  struct Lane {
    double rank;
    std::uint32_t below;  // a box, or a block of the level below
  };

  void open(std::size_t level, std::size_t index) {
    const Block& block = tree_.blocks(level)[index];
    std::array<Lane, kLanes> lanes;
    std::size_t count = 0;
    for (std::uint32_t left = kernels().find_lanes(block, around_); left != 0; left &= left - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
      const std::uint32_t below =
          level == 0 ? tree_.members(index)[lane] : static_cast<std::uint32_t>(index) * kLanes + lane;
      if (level == 0 ? below == BlockTree::kNone : below >= tree_.block_count(level - 1)) continue;
      const double rank = level == 0 ? query_.rank_of(below) : query_.rank(box_around(block, lane, tree_.frame()));
      if (is_wanted(rank)) lanes[count++] = {rank, below};
    }
    std::sort(lanes.begin(), lanes.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Lane& a, const Lane& b) { return a.rank < b.rank; });
    for (std::size_t i = 0; i < count && is_wanted(lanes[i].rank); ++i) {
      if (level == 0) {
        query_.visit(lanes[i].below);
      } else {
        open(level - 1, lanes[i].below);
      }
    }
  }

  bool is_wanted(double rank) const { return rank < std::numeric_limits<double>::infinity() && query_.wants(rank); }

  const BlockTree& tree_;
  Query& query_;
  FloatBox around_;
};

}  // namespace tact::broadphase
