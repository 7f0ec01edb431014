// The loops over segments of one batch: which boxes of a mesh each enters, which is next, which facets it may
// meet. Lines do not wait for each other: what one of them needs last is computed while the next begins.
#pragma once

#include <cstdint>

#include "narrowphase/distance/rounding.h"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"
#include "narrowphase/kernels/surfaces.inl"
#include "narrowphase/kernels/wide_packs.inl"

namespace tact::narrowphase {
namespace {

inline float least_lane(FloatPack a) { return -largest_lane(sub(spread(0.0f), a)); }

void line_up_facets(const ClusterFacets& cluster, const double* origin, double scale, LineLeaf* leaves, int first,
                    LineNode* node) {
  constexpr int kRoom = LocalVertices::kMost + 64, kFacets = LineLeaf::kFacets;
  alignas(64) float at[3][kRoom];
  localize(cluster, origin, scale, {at[0], at[1], at[2]});
  const int vertices = cluster.owned_count + cluster.borrowed_count;
  alignas(64) std::uint8_t place[3][64];
  for (int k = 0; k < 3; ++k) {
    __builtin_memset(place[k], cluster.corner[k][cluster.facet_count - 1], sizeof place[k]);
    __builtin_memcpy(place[k], cluster.corner[k], static_cast<std::size_t>(cluster.facet_count));
  }
  std::int32_t vertex[LocalVertices::kMost];
  for (int i = 0; i < cluster.owned_count; ++i) vertex[i] = cluster.owned_begin + i;
  for (int i = 0; i < cluster.borrowed_count; ++i) vertex[cluster.owned_count + i] = cluster.borrowed[i];
  for (int begin = 0, to = first; begin < cluster.facet_count; begin += kFacets, ++to) {
    LineLeaf& leaf = leaves[begin / kFacets];
    const FloatPack most = spread(2.0f), least = spread(-2.0f);
    FloatPack lower[3] = {most, most, most}, upper[3] = {least, least, least};
    for (int i = 0; i < kFacets; i += kFloatWidth) {
      for (int k = 0; k < 3; ++k) {
        const AnyFloatPicks picks(place[k] + begin + i);
        for (int axis = 0; axis < 3; ++axis) {
          const FloatPack x = picks.pick(at[axis], vertices);
          store_floats(leaf.corner[k][axis] + i, x);
          lower[axis] = min(lower[axis], x);
          upper[axis] = max(upper[axis], x);
        }
      }
    }
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < kFacets; ++i) leaf.vertex[k][i] = vertex[place[k][begin + i]];
    }
    for (int axis = 0; axis < 3; ++axis) {
      node->bounds[axis][to] = least_lane(lower[axis]);
      node->bounds[axis + 3][to] = largest_lane(upper[axis]);
    }
  }
}

// Of each lane one of three, by the number of an axis.
inline Pack of_axis(Pack axis, const Pack (&x)[3]) {
  return select(less(axis, spread(0.5)), x[0], select(less(axis, spread(1.5)), x[1], x[2]));
}

// As PreparedSegment does: see there.
inline void find_slopes(int i, LineBlock* block) {
  const Pack zero = spread(0.0), one = spread(1.0), largest = spread(__DBL_MAX__);
  const Pack way[3] = {load(block->direction[0] + i), load(block->direction[1] + i), load(block->direction[2] + i)};
  for (int axis = 0; axis < 3; ++axis) {
    const Pack inverse = div(one, way[axis]);
    store(block->inverse[axis] + i, select(less_equal(abs(inverse), largest), inverse, zero));
  }
  const Pack x = abs(way[0]), y = abs(way[1]), z = abs(way[2]);
  const Pack longest =
      select(both(less_equal(y, x), less_equal(z, x)), zero, select(less_equal(z, y), one, spread(2.0)));
  const Pack u[3] = {way[1], way[2], way[0]}, v[3] = {way[2], way[0], way[1]};
  const Pack along = of_axis(longest, way);
  store(block->longest + i, longest);
  store(block->way + i, along);
  store(block->slope[0] + i, div(of_axis(longest, u), along));
  store(block->slope[1] + i, div(of_axis(longest, v), along));
}

// A segment from farther away, in half sizes of the mesh, is for doubles alone: floats know too little of it.
constexpr double kFarthestLine = 1024.0;

// Seen along the line, with e = 2^-24: coordinates of facets are rounded by e, slopes by e, where the line is by c e,
// of which c is the size, what a fused operation gives by 2 e, and the last difference by (2 + c) e: a corner is off by
// d = (6 + 2 c) e, and by what doubles lost from the beginning of the line on. Twice an area between the line and a
// side is wrong by d times four coordinates, of at most m, by 2 d², and by two roundings of at most 3 e m², where m is
// less than 2 + c + d. If the areas have both signs for certain, the line passes outside.
inline void look_along(const Pack (&away)[3], Pack farthest, int i, LineBlock* block, LinesApart* apart) {
  const Pack longest = load(block->longest + i), zero = spread(0.0);
  const Pack u[3] = {away[1], away[2], away[0]}, v[3] = {away[2], away[0], away[1]};
  const Pack lost = mul(spread(0x1p-48), farthest);
  Pack size = zero;
  for (int k = 0; k < 2; ++k) {
    const Pack slope = load(block->slope[k] + i);
    const Pack shift = sub(of_axis(longest, k == 0 ? u : v), mul(slope, of_axis(longest, away)));
    store(block->tilt[k] + i, sub(zero, slope));
    store(block->shift[k] + i, shift);
    size = max(size, abs(shift));
  }
  apart->past |= bits(less(add(spread(3.0), lost), size)) << i;
  const Pack off = add(mul(spread(0x1p-24), add(spread(6.0), mul(spread(2.0), size))), lost);
  const Pack of_size = mul(spread(0x1.8p-23), add(add(spread(2.0), size), off));
  store(block->error + i, mul(spread(1.001), add(mul(spread(4.0), off), of_size)));
  store(block->least_error + i, mul(spread(2.002), mul(off, off)));
}

// Times are wrong by what four roundings of 2^-24 take from a coordinate, of the line or of a box, over the way:
// sixteen are allowed for. Where the line goes along an axis no way, it goes one that is less than that.
LinesApart prepare_segments(const LineTree& tree, LineBlock* block) {
  LinesApart apart{0, 0};
  const Pack zero = spread(0.0), scale = spread(tree.scale), unit = spread(1.0 / tree.scale);
  const Pack steepest = spread(0x1p60), least = spread(0x1p-100);
  for (int i = 0; i < LineBlock::kLines; i += kWidth) {
    find_slopes(i, block);
    Pack away[3], farthest = zero;
    for (int axis = 0; axis < 3; ++axis) {
      away[axis] = mul(sub(spread(tree.origin[axis]), load(block->from[axis] + i)), scale);
      farthest = max(farthest, abs(away[axis]));
      const Pack inverse = load(block->inverse[axis] + i),
                 clamped = min(max(mul(inverse, unit), sub(zero, steepest)), steepest);
      const Pack rate = select(not_equal(inverse, zero), clamped, steepest);
      const Pack slack = add(mul(mul(spread(0x1p-20), add(abs(away[axis]), spread(2.0))), abs(rate)), least);
      const Pack at = sub(zero, mul(away[axis], rate));
      store(block->rate[axis] + i, rate);
      store(block->enter_at[axis] + i, add(at, slack));
      store(block->leave_at[axis] + i, sub(at, slack));
    }
    const Mask near = both(less_equal(farthest, spread(kFarthestLine)), not_equal(load(block->way + i), zero));
    apart.alone |= (~bits(near) & kAllLanes) << i;
    look_along(away, farthest, i, block, &apart);
  }
  for (int line = 0; line < LineBlock::kLines; ++line) {
    block->entries[line] = 0;
    block->later_from[line] = __builtin_inff();
    store_floats(block->key[line], spread(__builtin_inff()));
  }
  block->overflowing = 0;
  apart.past &= ~apart.alone;
  return apart;
}

// The sides of boxes that a line enters by and leaves by, and when.
struct LineSlabs {
  int near[3], far[3];
  FloatPack rate[3], enter_at[3], leave_at[3], begin, end;

  LineSlabs(const LineBlock& of, int line) : begin(spread(0x1p-101f)), end(spread(of.latest[line])) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool forward = of.rate[axis][line] >= 0.0f;
      near[axis] = forward ? axis : axis + 3;
      far[axis] = forward ? axis + 3 : axis;
      rate[axis] = spread(of.rate[axis][line]);
      enter_at[axis] = spread(of.enter_at[axis][line]);
      leave_at[axis] = spread(of.leave_at[axis][line]);
    }
  }
  // A bit for each box that is entered, and when.
  template <class Bound>
  unsigned entered(const Bound& bound, FloatPack& enter) const {
    FloatPack leave = end;
    enter = begin;
    for (int axis = 0; axis < 3; ++axis) {
      enter = max(enter, fused(load(bound(near[axis])), rate[axis], enter_at[axis]));
      leave = min(leave, fused(load(bound(far[axis])), rate[axis], leave_at[axis]));
    }
    return bits(less_equal(enter, leave));
  }
};

// Appends boxes with a number each, as far as there is room.
class EntryList {
 public:
  EntryList(LineBlock* block, int line) : block_(block), line_(line), count_(block->entries[line]) {}
  // Writes how many there are. Not a destructor: kernels have none, so that none needs what unwinds.
  void finish() {
    block_->entries[line_] = count_;
    store_floats(block_->key[line_] + count_, spread(__builtin_inff()));
  }

  bool has_room() const {
    if (count_ <= LineBlock::kEntries - kFloatWidth) return true;
    block_->overflowing |= 1u << line_;
    return false;
  }
  void append(unsigned lanes, FloatPack enter, int first, int mark) {
    count_ += store_keys(lanes, enter, LineBlock::kEntries - 1, first, mark, count_, block_->key[line_] + count_,
                         block_->entry[line_] + count_);
  }

 private:
  LineBlock* block_;
  int line_, count_;
};

void enter_groups(const LineTree& tree, int line, LineBlock* block) {
  const LineSlabs slabs(*block, line);
  EntryList list(block, line);
  for (int i = 0; i < tree.group_count && list.has_room(); i += kFloatWidth) {
    FloatPack enter;
    const unsigned entered = slabs.entered([&](int side) { return tree.groups.bounds[side] + i; }, enter);
    list.append(entered & lanes_left<kFloatWidth>(tree.group_count - i), enter, i, -1);
  }
  list.finish();
}

inline void enter_leaves(const LineTree& tree, int node, const LineSlabs& slabs, EntryList& list) {
  for (int i = 0; i < LineNode::kLeaves && list.has_room(); i += kFloatWidth) {
    FloatPack enter;
    const unsigned entered = slabs.entered([&](int side) { return tree.node[node].bounds[side] + i; }, enter);
    list.append(entered, enter, node * LineNode::kLeaves + i, 0);
  }
}

void enter_nodes(const LineTree& tree, int first, int count, int line, LineBlock* block) {
  const LineSlabs slabs(*block, line);
  EntryList list(block, line);
  for (int i = 0; i < count; i += kFloatWidth) {
    FloatPack enter;
    unsigned nodes = slabs.entered([&](int side) { return tree.nodes.bounds[side] + first + i; }, enter) &
                     lanes_left<kFloatWidth>(count - i);
    for (; nodes != 0; nodes &= nodes - 1) enter_leaves(tree, first + i + __builtin_ctz(nodes), slabs, list);
  }
  list.finish();
}

// The leaves of nodes that a segment enters, a bit for each node.
inline void enter_leaves_of(const LineTree& tree, std::uint64_t nodes, int line, LineBlock* block) {
  const LineSlabs slabs(*block, line);
  EntryList list(block, line);
  for (; nodes != 0; nodes &= nodes - 1) enter_leaves(tree, __builtin_ctzll(nodes), slabs, list);
  list.finish();
}

// Adds for each lane a part of its bits, which is a number of up to 24 bits, as a float.
inline void add_bits(FloatPack part, int first, std::uint64_t* bits) {
  alignas(64) float number[kFloatWidth];
  store_floats(number, part);
  for (int lane = 0; lane < kFloatWidth; ++lane)
    bits[lane] |= static_cast<std::uint64_t>(static_cast<std::int32_t>(number[lane])) << first;
}

// Here a lane is a segment. A segment that meets the nodes that it enters first enters no others: of 38 nodes a ray
// enters seven, three of them first.
void enter_all_nodes(const LineTree& tree, LineBlock* block) {
  alignas(64) float entry[64][kFloatWidth];
  const FloatPack never = spread(__builtin_inff());
  std::uint64_t all[LineBlock::kLines] = {}, first[LineBlock::kLines] = {};
  for (int i = 0; i < LineBlock::kLines; i += kFloatWidth) {
    FloatPack rate[3], enter_at[3], leave_at[3], later_from = never;
    for (int axis = 0; axis < 3; ++axis) {
      rate[axis] = load(block->rate[axis] + i);
      enter_at[axis] = load(block->enter_at[axis] + i);
      leave_at[axis] = load(block->leave_at[axis] + i);
    }
    const FloatPack zero = spread(0.0f), begin = spread(0x1p-101f), end = load(block->latest + i);
    const FloatMask forward[3] = {less_equal(zero, rate[0]), less_equal(zero, rate[1]), less_equal(zero, rate[2])};
    FloatPack first_left = end;
    for (int node = 0; node < tree.node_count; ++node) {
      FloatPack enter = begin, leave = end;
      for (int axis = 0; axis < 3; ++axis) {
        const FloatPack lower = spread(tree.nodes.bounds[axis][node]),
                        upper = spread(tree.nodes.bounds[axis + 3][node]);
        enter = max(enter, fused(select(forward[axis], lower, upper), rate[axis], enter_at[axis]));
        leave = min(leave, fused(select(forward[axis], upper, lower), rate[axis], leave_at[axis]));
      }
      const FloatMask inside = less_equal(enter, leave);
      first_left = select(inside, min(first_left, leave), first_left);
      store_floats(entry[node], select(inside, enter, never));
    }
    constexpr int kPart = 24;
    for (int begin_part = 0; begin_part < tree.node_count; begin_part += kPart) {
      FloatPack bit = spread(1.0f), all_bits = zero, first_bits = zero;
      for (int node = begin_part; node < tree.node_count && node < begin_part + kPart; ++node) {
        const FloatPack enter = load(entry[node]);
        const FloatMask is_first = less_equal(enter, first_left);
        all_bits = select(less(enter, never), add(all_bits, bit), all_bits);
        first_bits = select(is_first, add(first_bits, bit), first_bits);
        later_from = min(later_from, select(is_first, never, enter));
        bit = add(bit, bit);
      }
      add_bits(all_bits, begin_part, all + i);
      add_bits(first_bits, begin_part, first + i);
    }
    store_floats(block->later_from + i, later_from);
  }
  for (int line = 0; line < LineBlock::kLines; ++line) {
    block->later[line] = all[line] & ~first[line];
    if (first[line] != 0) enter_leaves_of(tree, first[line], line, block);
  }
}

void enter_later_nodes(const LineTree& tree, std::uint32_t lines, LineBlock* block) {
  for (; lines != 0; lines &= lines - 1) {
    const int line = __builtin_ctz(lines);
    enter_leaves_of(tree, block->later[line], line, block);
    block->later_from[line] = __builtin_inff();
  }
}

inline std::uint32_t facets_on_line(const LineLeaf& leaf, const LineBlock& block, int line) {
  const FloatPack tilt_u = spread(block.tilt[0][line]), tilt_v = spread(block.tilt[1][line]);
  const FloatPack shift_u = spread(block.shift[0][line]), shift_v = spread(block.shift[1][line]);
  const FloatPack error = spread(block.error[line]), least_error = spread(block.least_error[line]);
  const auto z_axis = static_cast<int>(block.longest[line]);
  const int u_axis = z_axis == 2 ? 0 : z_axis + 1, v_axis = z_axis == 0 ? 2 : z_axis - 1;
  std::uint32_t out = 0;
  for (int i = 0; i < LineLeaf::kFacets; i += kFloatWidth) {
    FloatPack u[3], v[3];
    for (int k = 0; k < 3; ++k) {
      const FloatPack z = load(leaf.corner[k][z_axis] + i);
      u[k] = add(fused_sum(tilt_u, z, load(leaf.corner[k][u_axis] + i)), shift_u);
      v[k] = add(fused_sum(tilt_v, z, load(leaf.corner[k][v_axis] + i)), shift_v);
    }
    const auto widest_of = [](const FloatPack(&x)[3]) { return max(max(abs(x[0]), abs(x[1])), abs(x[2])); };
    const FloatPack high = fused_sum(max(widest_of(u), widest_of(v)), error, least_error);
    const auto area = [&](int p, int q) { return fused(u[p], v[q], mul(u[q], v[p])); };
    const FloatPack a = area(1, 2), b = area(2, 0), c = area(0, 1);
    const FloatMask outside = both(less(min(min(a, b), c), sub(spread(0.0f), high)), less(high, max(max(a, b), c)));
    out |= static_cast<std::uint32_t>(bits(outside)) << i;
  }
  return ~out & 0xffffu;
}

// The next entry of a segment, which is taken from its list, or what there is instead. Whether there is one is not to
// be guessed: the list is written in any case. Up to one pack of keys is read and written as one.
inline std::int32_t take_next(int line, LineBlock* block) {
  float* const keys = block->key[line];
  const int count = block->entries[line];
  const float latest = block->latest[line], later_from = block->later_from[line];
  const FloatPack few = load(keys);
  FloatPack least = few;
  for (int k = kFloatWidth; k < count; k += kFloatWidth) least = min(least, load(keys + k));
  const float key = least_lane(least);
  std::int32_t place;
  __builtin_memcpy(&place, &key, sizeof key);
  place &= LineBlock::kEntries - 1;
  const float limit = latest < later_from ? latest : later_from;
  const float until = key < limit ? key : limit;
  store_floats(keys, select(less_equal(few, spread(until)), spread(__builtin_inff()), few));
  const std::int32_t is_next = -static_cast<std::int32_t>(key <= limit);
  if (count > kFloatWidth && is_next != 0) keys[place] = __builtin_inff();
  const std::int32_t otherwise = LineBlock::kNothing + static_cast<std::int32_t>(latest >= later_from);
  static_assert(LineBlock::kLaterNodes == LineBlock::kNothing + 1);
  return (block->entry[line][place] & is_next) | (otherwise & ~is_next);
}

// In rounds: all segments take what they enter next, then those leaves are tested, and those without a facet go on.
// Branches on it would be mispredicted: lists are written without one.
void find_facets(const LineTree& tree, const std::uint8_t* lines, int count, LineBlock* block) {
  std::uint8_t asking[LineBlock::kLines];
  for (int i = 0; i < count; ++i) asking[i] = lines[i];
  while (count > 0) {
    int leaves = 0;
    for (int i = 0; i < count; ++i) {
      const std::uint8_t line = asking[i];
      const std::int32_t taken = take_next(line, block);
      block->taken[line] = taken;
      const auto* const leaf = reinterpret_cast<const char*>(tree.leaf + (taken >= 0 ? taken : 0));
      for (unsigned at = 0; at < sizeof(LineLeaf::corner); at += 64) __builtin_prefetch(leaf + at, 0, 3);
      asking[leaves] = line;
      leaves += static_cast<int>(taken >= 0);
    }
    count = 0;
    for (int i = 0; i < leaves; ++i) {
      const std::uint8_t line = asking[i];
      const std::int32_t taken = block->taken[line];
      const int rest = tree.facet_count - taken * LineLeaf::kFacets;
      const std::uint32_t present = rest < LineLeaf::kFacets ? (1u << rest) - 1u : 0xffffu;
      const std::uint32_t facets = facets_on_line(tree.leaf[taken], *block, line) & present;
      block->facets[line] = facets;
      asking[count] = line;
      count += static_cast<int>(facets == 0);
    }
  }
}

// The time at which a line crosses the plane of a triangle: FineCrossing of distance/segment_facet.cpp for some of
// them. `certain` where it is certain how it is rounded. Corners and lines are in one order of axes.
inline Pack crossing_times(const VectorPack (&corner)[3], const VectorPack& begin, const WideVector& way,
                           Mask& certain) {
  const WideVector p = difference(corner[1], corner[0]), q = difference(corner[2], corner[0]),
                   from = difference(corner[0], begin), normal = cross(p, q);
  const Pack sides = mul(largest_of(p), largest_of(q)), size = mul(sides, largest_of(from)),
             size_of_way = mul(sides, largest_of(way));
  const WidePack height = dot(normal, from), slope = dot(normal, way), time = div(height, slope);
  const Pack part = add(div(size, abs(height.high)), div(size_of_way, abs(slope.high)));
  const Pack error = mul(abs(time.high), add(mul(spread(0x1p-96), part), spread(0x1p-98)));
  const auto is_high = [&](Pack rest) { return less_equal(abs(sub(add(time.high, rest), time.high)), spread(0.0)); };
  certain = both(less(spread(kVanishing), min(sides, min(size, size_of_way))),
                 both(is_high(add(time.low, error)), is_high(sub(time.low, error))));
  return time.high;
}

// PreparedSegment::meet(), operation by operation: the errors are explained there.
void meet_lines(const LineBlock& block, LinePairs* pairs) {
  const Pack zero = spread(0.0), one = spread(1.0);
  pairs->meets = pairs->uncertain = 0;
  for (int i = 0; i < pairs->count; i += kWidth) {
    Pack u[3], v[3], z[3], largest = zero, widest = zero;
    VectorPack corner[3];
    const std::int32_t* const line = pairs->line + i;
    const Pack slope_u = gather(block.slope[0], line), slope_v = gather(block.slope[1], line);
    const Pack way = gather(block.way, line), longest = gather(block.longest, line);
    const auto in_order = [&](const double(&of)[3][LineBlock::kLines], Pack(&to)[3]) {
      const Pack x[3] = {gather(of[0], line), gather(of[1], line), gather(of[2], line)};
      const Pack u_of[3] = {x[1], x[2], x[0]}, v_of[3] = {x[2], x[0], x[1]};
      to[0] = of_axis(longest, u_of), to[1] = of_axis(longest, v_of), to[2] = of_axis(longest, x);
    };
    Pack from[3], ways[3], tails[3];
    in_order(block.from, from);
    in_order(block.direction, ways);
    in_order(block.direction_tail, tails);
    for (int k = 0; k < 3; ++k) {
      corner[k] = {load(pairs->corner[k][0] + i), load(pairs->corner[k][1] + i), load(pairs->corner[k][2] + i)};
      const Pack x = sub(corner[k].x, from[0]), y = sub(corner[k].y, from[1]);
      z[k] = sub(corner[k].z, from[2]);
      u[k] = sub(x, mul(slope_u, z[k]));
      v[k] = sub(y, mul(slope_v, z[k]));
      largest = max(largest, max(max(abs(x), abs(y)), abs(z[k])));
      widest = max(widest, max(abs(u[k]), abs(v[k])));
    }
    const Pack error = add(mul(spread(0x1.1p-50), largest), spread(0x1p-1000));
    const Pack bound = add(mul(mul(spread(5.0), error), add(widest, error)), spread(0x1p-900));
    const auto area_of = [&](int p, int q) { return sub(mul(u[p], v[q]), mul(u[q], v[p])); };
    const Pack area[3] = {area_of(1, 2), area_of(2, 0), area_of(0, 1)};
    const Pack least = min(min(area[0], area[1]), area[2]), most = max(max(area[0], area[1]), area[2]);
    const Pack sum = add(add(add(zero, area[0]), area[1]), area[2]), whole = abs(sum), off = mul(spread(3.0), bound);
    const Pack below = sub(zero, bound), size = max(largest, abs(way));
    const Pack extent = add(widest, sub(max(max(z[0], z[1]), z[2]), min(min(z[0], z[1]), z[2])));
    const unsigned beside = bits(both(less(least, below), less(bound, most)));
    const unsigned clear =
        bits(both(less(mul(spread(16.0), off), whole),
                  less_equal(mul(mul(spread(3.0), extent), off), mul(mul(spread(0x1p-41), size), whole))));

    const Mask negative = less(sum, zero);
    Pack weight[3], part = zero, along = zero;
    for (int k = 0; k < 3; ++k) {
      weight[k] = max(zero, select(negative, sub(zero, area[k]), area[k]));
      part = add(part, weight[k]);
    }
    for (int k = 0; k < 3; ++k) {
      weight[k] = div(weight[k], part);
      along = add(along, mul(weight[k], z[k]));
    }
    const Pack time = div(along, way);
    const Pack late = div(mul(add(div(mul(spread(4.0), off), whole), spread(0x1p-48)), largest), abs(way));
    const Mask outside = either(less(time, sub(zero, late)), less(add(one, late), time));
    const Mask inside = both(less(late, time), less(time, sub(one, late)));
    const unsigned within = bits(either(less(bound, least), less(most, below)));

    Mask certain;
    store(pairs->time + i, crossing_times(corner, {from[0], from[1], from[2]},
                                          {{ways[0], tails[0]}, {ways[1], tails[1]}, {ways[2], tails[2]}}, certain));
    for (int k = 0; k < 3; ++k) store(pairs->weight[k] + i, weight[k]);
    const unsigned missed = beside | (clear & within & bits(outside)),
                   met = clear & within & bits(both(inside, certain));
    const unsigned lanes = lanes_left(pairs->count - i);
    pairs->meets |= (met & ~missed & lanes) << i;
    pairs->uncertain |= (~met & ~missed & lanes) << i;
  }
}

}  // namespace
}  // namespace tact::narrowphase
