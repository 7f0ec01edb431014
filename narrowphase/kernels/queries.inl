// The loops that answer queries: which boxes and facets a segment may meet, which may be nearest to a point.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/bytes.inl"
#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

inline void append_ranked(unsigned mask, int first, Pack rank, RankedBoxes* ranked) {
  ranked->count += store_some(mask, rank, first, ranked->rank + ranked->count, ranked->index + ranked->count);
}

// A quotient by way of the inverse of the way is wrong by four roundings at most: of the way, of its inverse, of the
// difference and of the product; or by the least number. Its sign is right.
void rank_by_entry(const BoxPointers& boxes, int count, const SegmentSlabs& segment, double latest,
                   RankedBoxes* ranked) {
  const Pack zero = spread(0.0), one = spread(1.0), least = spread(0x1p-1000), end = spread(latest);
  const Pack earlier = spread(1.0 - 0x1p-50), later = spread(1.0 + 0x1p-50);
  const double *near[3], *far[3];
  Pack from[3], inverse[3];
  for (int axis = 0; axis < 3; ++axis) {
    near[axis] = segment.inverse[axis] >= 0.0 ? boxes.lower[axis] : boxes.upper[axis];
    far[axis] = segment.inverse[axis] >= 0.0 ? boxes.upper[axis] : boxes.lower[axis];
    from[axis] = spread(segment.from[axis]);
    inverse[axis] = spread(segment.inverse[axis]);
  }
  ranked->count = 0;
  for (int i = 0; i < count; i += kWidth) {
    Pack first = zero, last = one;
    Mask meets = mask_of(lanes_left(count - i));
    for (int axis = 0; axis < 3; ++axis) {
      const Pack enter = load(near[axis] + i), leave = load(far[axis] + i);
      if (segment.inverse[axis] != 0.0) {
        first = max(first, mul(sub(enter, from[axis]), inverse[axis]));
        last = min(last, mul(sub(leave, from[axis]), inverse[axis]));
      } else if (segment.stays[axis]) {
        meets = both(meets, both(less_equal(enter, from[axis]), less_equal(from[axis], leave)));
      }
    }
    first = sub(mul(first, earlier), least);
    last = add(mul(last, later), least);
    meets = both(meets, both(less_equal(first, last), less_equal(first, end)));
    append_ranked(bits(meets), i, first, ranked);
  }
}

void rank_by_distance(const BoxPointers& boxes, int count, const double* point, double scale, double most,
                      RankedBoxes* ranked) {
  const Pack limit = spread(most), zero = spread(0.0), unit = spread(scale);
  ranked->count = 0;
  for (int i = 0; i < count; i += kWidth) {
    Pack sum = zero;
    for (int axis = 0; axis < 3; ++axis) {
      const Pack x = spread(point[axis]);
      const Pack away = max(max(sub(load(boxes.lower[axis] + i), x), sub(x, load(boxes.upper[axis] + i))), zero);
      const Pack scaled = mul(unit, away);
      sum = add(sum, mul(scaled, scaled));
    }
    append_ranked(bits(less_equal(sum, limit)) & lanes_left(count - i), i, sum, ranked);
  }
}

// Calls work(k, x, y, z) for packs of a cluster's vertices, owned ones first; those from k on, counted from the first.
template <class Work>
inline void for_cluster_points(const ClusterFacets& in, const Work& work) {
  const double* const from[3] = {in.points.x, in.points.y, in.points.z};
  for (int i = 0; i < in.owned_count; i += kWidth) {
    const int k = in.owned_begin + i;
    work(i, load(from[0] + k), load(from[1] + k), load(from[2] + k));
  }
  for (int i = 0; i < in.borrowed_count; i += kWidth) {
    const std::int32_t* index = in.borrowed + i;
    std::int32_t last[kWidth];
    if (in.borrowed_count - i < kWidth) {
      for (int k = 0; k < kWidth; ++k) last[k] = index[i + k < in.borrowed_count ? k : 0];
      index = last;
    }
    work(in.owned_count + i, gather(from[0], index), gather(from[1], index), gather(from[2], index));
  }
}

// A line does not meet a facet whose corners all lie on one side of it, as seen along it: in one of seven directions.
std::uint64_t sight_facets(const ClusterFacets& cluster, const LineOfSight& line) {
  alignas(64) std::uint8_t beside[192 + 64];
  const int x_axis = line.axis[0], y_axis = line.axis[1], z_axis = line.axis[2];
  const Pack from[3] = {spread(line.from[0]), spread(line.from[1]), spread(line.from[2])};
  const Pack slope_x = spread(line.slope[0]), slope_y = spread(line.slope[1]);
  const Pack high = spread(line.error), low = spread(-line.error);
  const Pack high_2 = spread(4.0 * line.error), low_2 = spread(-4.0 * line.error);
  for_cluster_points(cluster, [&](int k, Pack x, Pack y, Pack z) {
    const Pack away[3] = {sub(x, from[0]), sub(y, from[1]), sub(z, from[2])};
    const Pack u = sub(away[x_axis], mul(slope_x, away[z_axis])), v = sub(away[y_axis], mul(slope_y, away[z_axis]));
    const Pack sum = add(u, v), difference = sub(u, v);
    const Mask out[7] = {less(u, low),      less(high, u),           less(v, low), less(high, v), less(sum, low_2),
                         less(high_2, sum), less(high_2, difference)};
    store_flags(beside + k, out);
  });
  return common_flags(beside, cluster.owned_count + cluster.borrowed_count, cluster.corner, cluster.facet_count).none;
}

// The squared distance of the origin from a side, at its nearest place.
inline Pack side_distance_squared(const VectorPack& a, const VectorPack& b) {
  const VectorPack side = sub(b, a);
  const Pack zero = spread(0.0), length = dot(side, side);
  const Pack t = min(max(div(sub(zero, dot(a, side)), length), zero), spread(1.0));
  const Pack s = select(less(zero, length), t, zero);
  const VectorPack p{add(a.x, mul(s, side.x)), add(a.y, mul(s, side.y)), add(a.z, mul(s, side.z))};
  return dot(p, p);
}

// What the squared distance of the origin from a facet is at least. Corners are rounded at 2^-52 of their size, the
// largest of which is m. Where the height h of a facet is at least 2^-10 of its longest side, its normal is off by an
// angle of 2^-42 m / h. That makes the distance from its plane wrong by 2^-41 m, and moves the border between what is
// inside and what is not by 2^-50 m² / h, but not by more than the size of the facet, and so by 2^-20 m: the distance
// from a side there is wrong by 2^-40 m². Narrower facets have their sides nearly as near as any of their points: the
// squares differ by h² at most.
// Inlined, or packs go through memory: nearest points take 1.06 of their time then.
[[gnu::always_inline]] inline Pack facet_distance_squared(const VectorPack& a, const VectorPack& b,
                                                          const VectorPack& c) {
  const Pack zero = spread(0.0);
  const Pack sides = min(min(side_distance_squared(a, b), side_distance_squared(b, c)), side_distance_squared(c, a));
  const VectorPack ab = sub(b, a), ac = sub(c, a), bc = sub(c, b), normal = cross(ab, ac);
  const Pack square = dot(normal, normal), height = dot(normal, a);
  const Pack longest = max(max(dot(ab, ab), dot(ac, ac)), dot(bc, bc));
  const Mask inside = both(both(less_equal(zero, dot(cross(a, b), normal)), less_equal(zero, dot(cross(b, c), normal))),
                           less_equal(zero, dot(cross(c, a), normal)));
  const Mask wide = less(mul(spread(0x1p-20), mul(longest, longest)), square);
  const Pack of_plane = div(mul(height, height), square);
  const Pack narrow = sub(sides, select(less(zero, longest), div(square, longest), zero));
  const Pack squared = select(wide, select(inside, of_plane, sides), narrow);
  const Pack most = max(max(dot(a, a), dot(b, b)), dot(c, c));
  return sub(squared, mul(spread(0x1p-34), most));
}

// Facets whose planes certainly are farther from the origin than the square root of `limit`, which is to hold what
// facet_distance_squared() takes off. Without the third side, as no side is longer than the two others together.
inline Mask planes_beyond(const VectorPack& a, const VectorPack& b, const VectorPack& c, Pack limit) {
  const VectorPack ab = sub(b, a), ac = sub(c, a), normal = cross(ab, ac);
  const Pack square = dot(normal, normal), height = dot(normal, a), longest = max(dot(ab, ab), dot(ac, ac));
  const Mask wide = less(mul(spread(0x1p-16), mul(longest, longest)), square);
  return both(wide, less(mul(square, limit), mul(height, height)));
}

constexpr int kRankedVertices = 192 + 64;  // room for those of a cluster
constexpr int kManyRanked = FacetDistances::kCapacity / 2;

inline VectorPack corners(const double (&at)[3][kRankedVertices], const std::uint8_t* corner) {
  return {gather(at[0], corner), gather(at[1], corner), gather(at[2], corner)};
}

// From the middle of a ball all facets are nearly as near as the nearest one, and most of their planes are not. Keeps
// those of the listed facets whose planes are as near, with their distances.
void rank_many(const double (&at)[3][kRankedVertices], const std::uint8_t (&corner)[3][2 * FacetDistances::kCapacity],
               int vertex_count, Pack beyond, FacetDistances* facets) {
  Pack farthest = spread(0.0);
  for (int i = 0; i < vertex_count; i += kWidth) {
    const VectorPack p{load(at[0] + i), load(at[1] + i), load(at[2] + i)};
    farthest = max(farthest, select(mask_of(lanes_left(vertex_count - i)), dot(p, p), spread(0.0)));
  }
  const Pack limit = add(beyond, spread(0x1p-33 * largest_lane(farthest)));
  const int listed = facets->count;
  facets->count = 0;
  for (int i = 0; i < listed; i += kWidth) {
    const VectorPack a = corners(at, corner[0] + i), b = corners(at, corner[1] + i), c = corners(at, corner[2] + i);
    const unsigned near = ~bits(planes_beyond(a, b, c, limit)) & lanes_left(listed - i);
    if (near == 0) continue;
    alignas(64) double squared[kWidth];
    store(squared, facet_distance_squared(a, b, c));
    for (int lane = 0; lane < kWidth; ++lane) {
      if ((near >> lane & 1u) == 0) continue;
      facets->least_squared[facets->count] = squared[lane];
      facets->facet[facets->count++] = facets->facet[i + lane];
    }
  }
}

void rank_facets(const ClusterFacets& cluster, const double* point, double scale, double most, FacetDistances* facets) {
  alignas(64) double at[3][kRankedVertices];
  alignas(64) std::uint8_t outside[kRankedVertices];
  const Pack origin[3] = {spread(point[0]), spread(point[1]), spread(point[2])}, unit = spread(scale);
  const int count = cluster.owned_count + cluster.borrowed_count;
  for_cluster_points(cluster, [&](int k, Pack x, Pack y, Pack z) {
    store(at[0] + k, mul(unit, sub(x, origin[0])));
    store(at[1] + k, mul(unit, sub(y, origin[1])));
    store(at[2] + k, mul(unit, sub(z, origin[2])));
  });
  // Nothing is farther than the nearest corner: it lies in a box about the point, and not beyond the plane through
  // that corner.
  Pack nearest = spread(most), where = spread(-1.0);
  for (int i = 0; i < count; i += kWidth) {
    const VectorPack p{load(at[0] + i), load(at[1] + i), load(at[2] + i)};
    const Pack square = select(mask_of(lanes_left(count - i)), dot(p, p), spread(__builtin_inf()));
    where = select(less(square, nearest), spread(static_cast<double>(i)), where);
    nearest = min(square, nearest);
  }
  const double least = -largest_lane(sub(spread(0.0), nearest));
  VectorPack direction{spread(0.0), spread(0.0), spread(0.0)};
  alignas(64) double places[kWidth], squares[kWidth];
  store(places, where);
  store(squares, nearest);
  int nearest_at = -1;  // of equally near ones the first, whatever the width
  for (int lane = 0; lane < kWidth; ++lane) {
    const int i = static_cast<int>(places[lane]) + lane;
    if (squares[lane] == least && places[lane] >= 0.0 && (nearest_at < 0 || i < nearest_at)) nearest_at = i;
  }
  if (nearest_at >= 0) direction = {spread(at[0][nearest_at]), spread(at[1][nearest_at]), spread(at[2][nearest_at])};
  const double reach = __builtin_sqrt(least) * (1.0 + 0x1p-40);
  const Pack high = spread(reach), low = spread(-reach), beyond = spread(least * (1.0 + 0x1p-40));
  const Pack rounding = spread(0x1p-48 * reach);
  for (int i = 0; i < count; i += kWidth) {
    const VectorPack p{load(at[0] + i), load(at[1] + i), load(at[2] + i)};
    const Mask out[7] = {less(p.x, low),
                         less(high, p.x),
                         less(p.y, low),
                         less(high, p.y),
                         less(p.z, low),
                         less(high, p.z),
                         less(add(beyond, mul(rounding, add(add(abs(p.x), abs(p.y)), abs(p.z)))), dot(direction, p))};
    store_flags(outside + i, out);
  }
  const std::uint64_t left = common_flags(outside, count, cluster.corner, cluster.facet_count).none;
  facets->count = __builtin_popcountll(left);
  write_places(left, facets->facet);
  alignas(64) std::uint8_t corner[3][2 * FacetDistances::kCapacity];
  for (int k = 0; k < 3; ++k) {
    compress(left, cluster.corner[k], corner[k]);
    for (int n = facets->count; n < facets->count + kWidth; ++n) corner[k][n] = 0;
  }
  if (facets->count > kManyRanked) return rank_many(at, corner, count, beyond, facets);
  for (int i = 0; i < facets->count; i += kWidth)
    store(facets->least_squared + i,
          facet_distance_squared(corners(at, corner[0] + i), corners(at, corner[1] + i), corners(at, corner[2] + i)));
}

// Which facets of a block certainly do not face a direction. In the unit of `scale` corners that are counted from a
// point at most 4 away are rounded by 2^-50, sides by twice that: a normal, times the square of `scale`, and what it is
// along the direction are off by less than 2^-45 times the size of the facet's box.
struct FacingTest {
  VectorPack direction;
  Pack unit, unit_squared, least;

  FacingTest(const FacingNormals& facing, double scale)
      : direction{spread(facing.direction[0]), spread(facing.direction[1]), spread(facing.direction[2])},
        unit(spread(0x1p-44 * scale)),
        unit_squared(spread(scale * scale)),
        least(spread(facing.cosine * facing.cosine * (1.0 - 0x1p-40))) {}

  Mask turned_away(const FacetBlock& block, int i) const {
    const VectorPack normal{mul(unit_squared, load(block.normal[0] + i)), mul(unit_squared, load(block.normal[1] + i)),
                            mul(unit_squared, load(block.normal[2] + i))};
    Pack size = spread(0.0);
    for (int axis = 0; axis < 3; ++axis)
      size = add(size, sub(load(block.upper[axis] + i), load(block.lower[axis] + i)));
    const Pack most_along = add(dot(normal, direction), mul(unit, size));
    return either(less(most_along, spread(0.0)), less(mul(most_along, most_along), mul(least, dot(normal, normal))));
  }
};

void rank_block(const FacetBlock& block, const double* point, double scale, double most, const FacingNormals* facing,
                FacetDistances* facets) {
  const FacingTest test(facing != nullptr ? *facing : FacingNormals{}, scale);
  const Pack origin[3] = {spread(point[0]), spread(point[1]), spread(point[2])}, unit = spread(scale);
  const Pack limit = spread(most), zero = spread(0.0);
  std::uint64_t left = 0;
  for (int i = 0; i < block.count; i += kWidth) {
    Pack sum = zero;
    for (int axis = 0; axis < 3; ++axis) {
      const Pack below = sub(load(block.lower[axis] + i), origin[axis]);
      const Pack above = sub(origin[axis], load(block.upper[axis] + i));
      const Pack away = mul(unit, max(max(below, above), zero));
      sum = add(sum, mul(away, away));
    }
    Mask some = less_equal(sum, limit);
    if (facing != nullptr && bits(some) != 0) some = without(some, test.turned_away(block, i));
    left |= static_cast<std::uint64_t>(bits(some) & lanes_left(block.count - i)) << i;
  }
  facets->count = __builtin_popcountll(left);
  if (left == 0) return;
  write_places(left, facets->facet);
  for (int n = facets->count; n < facets->count + kWidth; ++n) facets->facet[n] = 0;
  for (int i = 0; i < facets->count; i += kWidth) {
    const auto along = [&](int k, int axis) {
      return mul(unit, sub(gather(block.corner[k][axis], facets->facet + i), origin[axis]));
    };
    const auto of = [&](int k) { return VectorPack{along(k, 0), along(k, 1), along(k, 2)}; };
    store(facets->least_squared + i, facet_distance_squared(of(0), of(1), of(2)));
  }
}

}  // namespace
}  // namespace tact::narrowphase
