// The loops over features that may be near each other: vertices, edges and facets.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/bytes.inl"
#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

// For each box a bit for each side of `box` that it is beyond: 2^(2 axis) below, twice that above.
inline void flag_outside(const double* const (&lower)[3], const double* const (&upper)[3], int count,
                         const BoxBounds& box, std::uint8_t* outside) {
  const BoxPack sides(box);
  Mask out[7];
  out[6] = less(spread(1.0), spread(0.0));
  for (int i = 0; i < count; i += kWidth) {
    for (int axis = 0; axis < 3; ++axis) {
      out[2 * axis] = less(load(upper[axis] + i), sides.lower[axis]);
      out[2 * axis + 1] = less(sides.upper[axis], load(lower[axis] + i));
    }
    store_flags(outside + i, out);
  }
}

void place_points(const ClusterFacets& in, double scale, const BoxBounds& box, ClusterPoints* points) {
  const double* const from[3] = {in.points.x, in.points.y, in.points.z};
  const int begin = points->count, end = begin + in.owned_count + in.borrowed_count;
  const Pack factor = spread(scale);
  for (int axis = 0; axis < 3; ++axis) {
    double* const to = points->at[axis] + begin;
    for (int i = 0; i < in.owned_count; i += kWidth) store(to + i, mul(factor, load(from[axis] + in.owned_begin + i)));
    for (int i = 0; i < in.borrowed_count; ++i) to[in.owned_count + i] = scale * from[axis][in.borrowed[i]];
  }
  for (int i = begin; i < end; ++i) {
    for (int axis = 0; axis < 3; ++axis) points->together[4 * i + axis] = points->at[axis][i];
  }
  const double* const at[3] = {points->at[0] + begin, points->at[1] + begin, points->at[2] + begin};
  flag_outside(at, at, end - begin, box, points->outside + begin);
  points->count = end;
}

// A bit for each feature that no side rules out, of one to 64.
inline std::uint64_t left_of(const FeatureCorners& in, const std::uint8_t* outside, int vertices) {
  const std::uint8_t* const corner[3] = {in.corner[0], in.corner[in.corners > 1 ? 1 : 0], in.corner[in.corners - 1]};
  return common_flags(outside, vertices, corner, in.count).none;
}

std::uint64_t features_left(const ClusterPoints& points, int first_point, const FeatureCorners& in) {
  return in.count == 0 ? 0 : left_of(in, points.outside + first_point, points.count - first_point);
}

void place_features(const ClusterPoints& points, int first_point, const FeatureCorners& in, std::uint64_t some,
                    const Grid& grid, double widen, FeatureBlock* block) {
  const int begin = block->count, end = begin + __builtin_popcountll(some);
  std::uint8_t place[FeatureBlock::kCapacity];
  write_places(some, place);
  // Whole arrays at a time: that is a few operations, whatever lies beyond the end.
  for (int n = 0; n < FeatureBlock::kCapacity; ++n) block->feature[begin + n] = in.first + place[n];
  for (int k = 0; k < in.corners; ++k) {
    std::uint8_t* const corner = block->corner[k] + begin;
    compress(some, in.corner[k], corner);
    for (int n = 0; n < FeatureBlock::kCapacity; ++n) corner[n] = static_cast<std::uint8_t>(corner[n] + first_point);
    for (int n = end; n < end + kWidth; ++n) block->corner[k][n] = 0;
  }
  const Pack more = spread(widen);
  for (int i = begin; i < end; i += kWidth) {
    Pack low[3], high[3];
    gather_points(points.together, block->corner[0] + i, low);
    for (int axis = 0; axis < 3; ++axis) high[axis] = low[axis];
    for (int k = 1; k < in.corners; ++k) {
      Pack x[3];
      gather_points(points.together, block->corner[k] + i, x);
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = min(low[axis], x[axis]);
        high[axis] = max(high[axis], x[axis]);
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      store_cells(block->cells.lower[axis] + i, cell(grid, axis, sub(low[axis], more)));
      store_cells(block->cells.upper[axis] + i, cell(grid, axis, add(high[axis], more)));
    }
  }
  block->count = block->cells.count = end;
}

struct QuadLanes {
  VectorPack point[4];
};

// Pairs of features that share cells, by their places in their blocks and by the points of their corners.
template <int kFew, int kMany>
struct ListedPairs {
  static constexpr int kEnough = 64, kRoom = kEnough + 2 * FeatureBlock::kCapacity;
  alignas(64) std::uint8_t few[kRoom], many[kRoom], corner[kFew + kMany][kRoom];
  int count = 0;

  void append(const FeatureBlock& one, int i, const FeatureBlock& others, std::uint64_t met) {
    __builtin_memset(few + count, i, FeatureBlock::kCapacity);
    write_places(met, many + count);
    for (int c = 0; c < kFew; ++c) __builtin_memset(corner[c] + count, one.corner[c][i], FeatureBlock::kCapacity);
    for (int c = 0; c < kMany; ++c) compress(met, others.corner[c], corner[kFew + c] + count);
    count += __builtin_popcountll(met);
  }
  void fill_up() {
    for (auto& one : corner) __builtin_memset(one + count, 0, kWidth);
  }
  QuadLanes lanes(const ClusterPoints& points, const ClusterPoints& others, int i) const {
    static_assert(kFew + kMany == 4);
    QuadLanes q;
    for (int k = 0; k < 4; ++k) {
      Pack xyz[3];
      gather_points((k < kFew ? points : others).together, corner[k] + i, xyz);
      q.point[k] = {xyz[0], xyz[1], xyz[2]};
    }
    return q;
  }
};

// Calls decide(pairs, i), which takes the pairs from the i-th on, as many as there are lanes and pairs, for all that
// share cells and have no bit in `left_out`. Returns a bit for each of the first ones that shares cells.
template <int kFew, int kMany, class Decide>
inline std::uint64_t for_listed_pairs(const PlacedFeatures& few, const PlacedFeatures& many,
                                      const std::uint64_t* left_out, std::uint64_t* near, const Decide& decide) {
  std::uint64_t met[FeatureBlock::kCapacity];
  ListedPairs<kFew, kMany> pairs;
  const auto decide_all = [&] {
    pairs.fill_up();
    for (int i = 0; i < pairs.count; i += kWidth) decide(pairs, i);
    pairs.count = 0;
  };
  const std::uint64_t shared = share_cells(few.block.cells, few.some, many.block.cells, many.some, met).facets;
  for (std::uint64_t left = shared; left != 0; left &= left - 1) {
    const int i = __builtin_ctzll(left);
    near[i] = 0;
    const std::uint64_t rest = left_out == nullptr ? met[i] : met[i] & ~left_out[i];
    if (rest == 0) continue;
    pairs.append(few.block, i, many.block, rest);
    if (pairs.count >= pairs.kEnough) decide_all();
  }
  decide_all();
  return shared;
}

// Those of the features that have a bit in `near`.
inline std::uint64_t with_any(std::uint64_t some, const std::uint64_t* near) {
  std::uint64_t any = 0;
  for (; some != 0; some &= some - 1) {
    const int i = __builtin_ctzll(some);
    any |= static_cast<std::uint64_t>(near[i] != 0) << i;
  }
  return any;
}

// The sides of some points, strictly; neither where rounding may tell.
struct StrictSigns {
  Mask above, below;
  explicit StrictSigns(const Determinant& d) : above(d.positive()), below(d.negative()) {}
};

inline Mask all_of(Mask a, Mask b, Mask c) { return both(both(a, b), c); }
inline Mask any_of(Mask a, Mask b, Mask c) { return either(either(a, b), c); }

// A segment meets a triangle if its ends are on two sides of the plane, and the three sides of the triangle pass it on
// one side. It does not if its ends are on one side, or if two sides of the triangle pass it on two sides: its line
// then is not in the plane, and leaves the triangle out.
EdgesThrough edges_through(const TrianglePairs& pairs) {
  EdgesThrough all{};
  for (int i = 0; i < pairs.count; i += kWidth) {
    VectorPack corner[2][3];
    for (int m = 0; m < 2; ++m) {
      for (int c = 0; c < 3; ++c) {
        const auto& from = pairs.corner[m][c];
        corner[m][c] = {load(from[0] + i), load(from[1] + i), load(from[2] + i)};
      }
    }
    const auto sign = [](const Plane& plane, const VectorPack& point) { return StrictSigns(plane.height(point)); };
    const auto sides = [&](const VectorPack(&facet)[3], const VectorPack(&points)[3]) {
      const Plane plane(facet[0], facet[1], facet[2]);
      struct Sides {
        StrictSigns of[3];
      };
      return Sides{{sign(plane, points[0]), sign(plane, points[1]), sign(plane, points[2])}};
    };
    const auto of_first = sides(corner[1], corner[0]), of_second = sides(corner[0], corner[1]);
    // How edge k of the second facet passes edge m of the first one.
    const auto passing = [&](int m) {
      const VectorPack &p = corner[0][m], &q = corner[0][(m + 1) % 3];
      const VectorPack(&t)[3] = corner[1];
      const Plane through_0(p, q, t[0]), through_1(p, q, t[1]);
      StrictSigns last = sign(through_0, t[2]);  // from the second corner to the first
      const Mask turned = last.above;
      last.above = last.below;
      last.below = turned;
      struct Passing {
        StrictSigns edge[3];
      };
      return Passing{{sign(through_0, t[1]), sign(through_1, t[2]), last}};
    };
    const auto pass_0 = passing(0), pass_1 = passing(1), pass_2 = passing(2);
    const unsigned lanes = lanes_left(pairs.count - i);
    const auto decide = [&](int edge, const StrictSigns& from, const StrictSigns& to, const StrictSigns& x,
                            const StrictSigns& y, const StrictSigns& z) {
      const Mask crosses = either(both(from.above, to.below), both(from.below, to.above));
      const Mask stays = either(both(from.above, to.above), both(from.below, to.below));
      const Mask through = either(all_of(x.above, y.above, z.above), all_of(x.below, y.below, z.below));
      const Mask past = both(any_of(x.above, y.above, z.above), any_of(x.below, y.below, z.below));
      const unsigned meets = bits(both(crosses, through)), misses = bits(either(stays, past));
      all.meeting[edge] |= static_cast<std::uint64_t>(meets & lanes) << i;
      all.undecided[edge] |= static_cast<std::uint64_t>(~(meets | misses) & lanes) << i;
    };
    decide(0, of_first.of[0], of_first.of[1], pass_0.edge[0], pass_0.edge[1], pass_0.edge[2]);
    decide(1, of_first.of[1], of_first.of[2], pass_1.edge[0], pass_1.edge[1], pass_1.edge[2]);
    decide(2, of_first.of[2], of_first.of[0], pass_2.edge[0], pass_2.edge[1], pass_2.edge[2]);
    for (int k = 0; k < 3; ++k)
      decide(3 + k, of_second.of[k], of_second.of[(k + 1) % 3], pass_0.edge[k], pass_1.edge[k], pass_2.edge[k]);
  }
  return all;
}

}  // namespace
}  // namespace tact::narrowphase
