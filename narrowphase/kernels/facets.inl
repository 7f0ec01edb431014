// The loops over facets.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/boxes.inl"
#include "narrowphase/kernels/bytes.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"
#include "narrowphase/kernels/points.inl"

namespace tact::narrowphase {
namespace {

// Vectors of doubles or floats, a lane each.
template <class Real>
struct VectorOf {
  PackOf<Real> x, y, z;
};
using VectorPack = VectorOf<double>;

template <class Real>
inline VectorOf<Real> sub(const VectorOf<Real>& a, const VectorOf<Real>& b) {
  return {sub(a.x, b.x), sub(a.y, b.y), sub(a.z, b.z)};
}
template <class Real>
inline PackOf<Real> dot(const VectorOf<Real>& n, const VectorOf<Real>& x) {
  return add(add(mul(n.x, x.x), mul(n.y, x.y)), mul(n.z, x.z));
}
inline VectorPack cross(const VectorPack& a, const VectorPack& b) {
  return {sub(mul(a.y, b.z), mul(a.z, b.y)), sub(mul(a.z, b.x), mul(a.x, b.z)), sub(mul(a.x, b.y), mul(a.y, b.x))};
}
inline VectorPack spread(const double* p) { return {spread(p[0]), spread(p[1]), spread(p[2])}; }

// A determinant as computed, a bound of its rounding, and the sum of the sizes of its products. If that is zero, each
// product has a factor that is zero, and was so before rounding: then the determinant is zero (see nothing_vanishes).
struct Determinant {
  Pack value, error, size;

  Mask positive() const { return less(error, value); }
  Mask negative() const { return less(value, sub(spread(0.0), error)); }
  Mask zero() const { return less_equal(size, spread(0.0)); }
};

// A 3 x 3 determinant of differences, x · n with n = e × f, rounds by at most (7 + 56 eps) eps times the same sum of
// absolute products, eps = 2^-53 (Shewchuk, "Adaptive precision floating-point arithmetic", 1997, §4.4), so by less
// than 1e-15 times it. Where products vanish below the smallest double, each of the nine loses at most 2^-1075 times a
// difference; differences of coordinates <= 2^300 make that less than the added 1e-200.
inline Pack rounding_of(Pack size) { return add(mul(size, spread(kRelativeRounding)), spread(kAbsoluteRounding)); }

inline Determinant determinant(const VectorPack& x, const VectorPack& n, const VectorPack& n_bound) {
  const Pack value = dot(n, x);
  const Pack size = add(add(mul(n_bound.x, abs(x.x)), mul(n_bound.y, abs(x.y))), mul(n_bound.z, abs(x.z)));
  return {value, rounding_of(size), size};
}

// The plane through the corners of a triangle.
struct Plane {
  VectorPack origin, normal, bound;

  Plane(const VectorPack& c0, const VectorPack& c1, const VectorPack& c2) : origin(c0) {
    const VectorPack e = sub(c1, c0), f = sub(c2, c0);
    const Pack xy = mul(e.y, f.z), xz = mul(e.z, f.y), yz = mul(e.z, f.x), yx = mul(e.x, f.z), zx = mul(e.x, f.y),
               zy = mul(e.y, f.x);
    normal = {sub(xy, xz), sub(yz, yx), sub(zx, zy)};
    bound = {add(abs(xy), abs(xz)), add(abs(yz), abs(yx)), add(abs(zx), abs(zy))};
  }

  // (point - c0) · ((c1 - c0) × (c2 - c0)).
  Determinant height(const VectorPack& point) const { return determinant(sub(point, origin), normal, bound); }
};

// The vertices of a cluster, owned ones first, and what rules each out: the lowest bit for the plane, one for each side
// of the box.
struct alignas(64) ClusterVertices {
  static constexpr int kCapacity = 192 + 8;
  double x[kCapacity], y[kCapacity], z[kCapacity];
  std::uint8_t outside[kCapacity];
};

inline void load_vertices(const ClusterFacets& in, ClusterVertices* v) {
  const double *x = in.points.x + in.owned_begin, *y = in.points.y + in.owned_begin, *z = in.points.z + in.owned_begin;
  for (int i = 0; i < in.owned_count; i += kWidth) {
    store(v->x + i, load(x + i));
    store(v->y + i, load(y + i));
    store(v->z + i, load(z + i));
  }
  for (int i = 0; i < in.borrowed_count; ++i) {
    const std::int32_t from = in.borrowed[i];
    v->x[in.owned_count + i] = in.points.x[from];
    v->y[in.owned_count + i] = in.points.y[from];
    v->z[in.owned_count + i] = in.points.z[from];
  }
}

inline void judge_vertices(const CullPlanes& planes, int count, ClusterVertices* v) {
  const BoxPack box(planes.box);
  const HeightPack height(planes.axis);
  const Pack lowest = spread(planes.lowest);
  for (int i = 0; i < count; i += kWidth) {
    const Pack x = load(v->x + i), y = load(v->y + i), z = load(v->z + i);
    const Mask out[7] = {less(height({v->x, v->y, v->z}, i), lowest),
                         less(x, box.lower[0]),
                         less(box.upper[0], x),
                         less(y, box.lower[1]),
                         less(box.upper[1], y),
                         less(z, box.lower[2]),
                         less(box.upper[2], z)};
    store_flags(v->outside + i, out);
  }
}

// A facet is left out if one and the same thing rules out all its corners.
Culled open_cluster(const ClusterFacets& in, const CullPlanes& planes, FacetBlock* block) {
  ClusterVertices v;
  load_vertices(in, &v);
  judge_vertices(planes, in.owned_count + in.borrowed_count, &v);
  const CommonFlags flags = common_flags(v.outside, in.owned_count + in.borrowed_count, in.corner, in.facet_count);
  const std::uint64_t left = flags.none;
  const int count = __builtin_popcountll(left), begin = block->count;
  const Culled opened{count, __builtin_popcountll(flags.lowest)};
  if (begin + count > FacetBlock::kCapacity) return opened;
  alignas(64) std::uint8_t corner[3][2 * FacetBlock::kCapacity], place[FacetBlock::kCapacity];
  for (int k = 0; k < 3; ++k) {
    compress(left, in.corner[k], corner[k]);
    for (int n = count; n < count + kWidth; ++n) corner[k][n] = 0;
  }
  write_places(left, place);
  for (int n = 0; n < count; ++n) block->facet[begin + n] = in.facet_begin + place[n];
  const double* const coordinate[3] = {v.x, v.y, v.z};
  for (int i = 0; i < count; i += kWidth) {
    const int to = begin + i;
    Pack p[3][3];
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 3; ++k) {
        p[k][axis] = gather(coordinate[axis], corner[k] + i);
        store(block->corner[k][axis] + to, p[k][axis]);
      }
      store(block->lower[axis] + to, min(min(p[0][axis], p[1][axis]), p[2][axis]));
      store(block->upper[axis] + to, max(max(p[0][axis], p[1][axis]), p[2][axis]));
    }
    const Plane plane({p[0][0], p[0][1], p[0][2]}, {p[1][0], p[1][1], p[1][2]}, {p[2][0], p[2][1], p[2][2]});
    const Pack normal[3] = {plane.normal.x, plane.normal.y, plane.normal.z};
    for (int axis = 0; axis < 3; ++axis) store(block->normal[axis] + to, normal[axis]);
  }
  block->count = begin + count;
  return opened;
}

// The vertices of a cluster, owned ones first, one after the other; the fourth number of each has no meaning.
struct alignas(64) PointsTogether {
  double at[4 * ClusterVertices::kCapacity];

  explicit PointsTogether(const ClusterFacets& in) {
    double* to = at;
    const auto put = [&](std::int32_t from) {
      to[0] = in.points.x[from];
      to[1] = in.points.y[from];
      to[2] = in.points.z[from];
      to += 4;
    };
    for (int i = 0; i < in.owned_count; ++i) put(in.owned_begin + i);
    for (int i = 0; i < in.borrowed_count; ++i) put(in.borrowed[i]);
  }
};

// The corners of a cluster's facets among its vertices; past the end all are the first vertex.
struct alignas(64) CornerPlaces {
  std::uint8_t corner[3][2 * FacetBlock::kCapacity];

  explicit CornerPlaces(const ClusterFacets& in) {
    for (int k = 0; k < 3; ++k) {  // 64 bytes may be read
      __builtin_memcpy(corner[k], in.corner[k], FacetBlock::kCapacity);
      __builtin_memset(corner[k] + in.facet_count, 0, kWidth);
    }
  }
};

inline Pack place_in(const Grid& grid, int axis, Pack x) {
  return mul(sub(x, spread(grid.origin[axis])), spread(grid.scale[axis]));
}

inline Pack cell(const Grid& grid, int axis, Pack x) {
  return max(min(place_in(grid, axis, x), spread(kLastCell)), spread(0.0));
}

void open_whole(const ClusterFacets& in, const Grid& grid, FacetBlock* block) {
  const PointsTogether points(in);
  const CornerPlaces places(in);
  for (int i = 0; i < in.facet_count; i += kWidth) {
    Pack p[3][3];
    for (int k = 0; k < 3; ++k) {
      gather_points(points.at, places.corner[k] + i, p[k]);
      for (int axis = 0; axis < 3; ++axis) store(block->corner[k][axis] + i, p[k][axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const Pack low = min(min(p[0][axis], p[1][axis]), p[2][axis]),
                 high = max(max(p[0][axis], p[1][axis]), p[2][axis]);
      store_cells(block->cells.lower[axis] + i, cell(grid, axis, low));
      store_cells(block->cells.upper[axis] + i, cell(grid, axis, high));
    }
  }
  block->count = block->cells.count = in.facet_count;
}

// Adds up in one order, whatever the width.
inline double sum_of_eight(const double* p) {
  return ((p[0] + p[4]) + (p[2] + p[6])) + ((p[1] + p[5]) + (p[3] + p[7]));
}

NormalSpread normal_spread(const ClusterFacets& in, double least_sine_squared) {
  const PointsTogether points(in);
  const CornerPlaces places(in);
  alignas(64) double normal[3][FacetBlock::kCapacity], square[FacetBlock::kCapacity], sums[3][8] = {};
  unsigned flat = 0;
  for (int i = 0; i < in.facet_count; i += kWidth) {
    VectorPack p[3];
    for (int k = 0; k < 3; ++k) {
      Pack xyz[3];
      gather_points(points.at, places.corner[k] + i, xyz);
      p[k] = {xyz[0], xyz[1], xyz[2]};
    }
    const VectorPack e = sub(p[1], p[0]), g = sub(p[2], p[0]);
    const VectorPack n{sub(mul(e.y, g.z), mul(e.z, g.y)), sub(mul(e.z, g.x), mul(e.x, g.z)),
                       sub(mul(e.x, g.y), mul(e.y, g.x))};
    const Pack squared = dot(n, n), least = mul(mul(spread(least_sine_squared), dot(e, e)), dot(g, g));
    flat |= ~bits(less(least, squared)) & lanes_left(in.facet_count - i);
    store(square + i, squared);
    const Pack coordinates[3] = {n.x, n.y, n.z};
    for (int axis = 0; axis < 3; ++axis) {  // past the end there is no normal: all corners are the first vertex
      store(normal[axis] + i, coordinates[axis]);
      double* const sum = sums[axis] + i % 8;
      store(sum, add(load(sum), coordinates[axis]));
    }
  }
  if (flat != 0) return {};
  const double x = sum_of_eight(sums[0]), y = sum_of_eight(sums[1]), z = sum_of_eight(sums[2]);
  const double length = __builtin_sqrt(x * x + y * y + z * z);
  if (!(length > 0.0)) return {};
  NormalSpread spread_of{{x / length, y / length, z / length}, 1.0};
  const Pack ax = spread(spread_of.axis[0]), ay = spread(spread_of.axis[1]), az = spread(spread_of.axis[2]);
  Pack least = spread(1.0);
  for (int i = 0; i < in.facet_count; i += kWidth) {
    const Pack along =
        add(add(mul(load(normal[0] + i), ax), mul(load(normal[1] + i), ay)), mul(load(normal[2] + i), az));
    const Pack cosine = div(mul(along, abs(along)), load(square + i));
    least = min(least, select(mask_of(lanes_left(in.facet_count - i)), cosine, least));
  }
  alignas(64) double lane[kWidth];
  store(lane, least);
  for (const double one : lane) spread_of.least = one < spread_of.least ? one : spread_of.least;
  return spread_of;
}

void find_cells(const Grid& grid, FacetBlock* block) {
  for (int i = block->cells.count; i < block->count; i += kWidth) {
    for (int axis = 0; axis < 3; ++axis) {
      store_cells(block->cells.lower[axis] + i, cell(grid, axis, load(block->lower[axis] + i)));
      store_cells(block->cells.upper[axis] + i, cell(grid, axis, load(block->upper[axis] + i)));
    }
  }
  block->cells.count = block->count;
}

std::uint64_t facing_away(const FacetBlock& block, const HeightAxis& axis) {
  const Pack nx = spread(axis.nx), ny = spread(axis.ny), nz = spread(axis.nz), zero = spread(0.0);
  std::uint64_t away = 0;
  for (int i = 0; i < block.count; i += kWidth) {
    const Pack x = load(block.normal[0] + i), y = load(block.normal[1] + i), z = load(block.normal[2] + i);
    const Pack along = add(add(mul(nx, x), mul(ny, y)), mul(nz, z));
    const Mask area = either(either(not_equal(x, zero), not_equal(y, zero)), not_equal(z, zero));
    away |= static_cast<std::uint64_t>(bits(both(less_equal(along, zero), area)) & lanes_left(block.count - i)) << i;
  }
  return away;
}

// Bounds the rounding of every determinant of differences of points in a box, as Determinant::error does and no less:
// each of its six products is at most that of the box's sides, which may have been rounded down.
inline Pack rounding_in(const BoxBounds& box) {
  double product = 6.0 * 1.0001;
  for (int axis = 0; axis < 3; ++axis) product *= box.upper[axis] - box.lower[axis];
  return rounding_of(spread(product));
}

// The lanes whose plane certainly leaves the whole box on one side. Where x runs over the box, the determinant is
// lowest and highest at corners of it, and as computed no higher and no lower than at any corner, since rounding keeps
// order.
inline unsigned planes_apart(const FacetBlock& block, int i, const BoxPack& box, Pack error) {
  Pack lowest[3], highest[3];
  for (int axis = 0; axis < 3; ++axis) {
    const Pack origin = load(block.corner[0][axis] + i), n = load(block.normal[axis] + i);
    const Pack to_lower = sub(box.lower[axis], origin), to_upper = sub(box.upper[axis], origin);
    const Pack p = mul(n, to_lower), q = mul(n, to_upper);
    lowest[axis] = min(p, q);
    highest[axis] = max(p, q);
  }
  const Mask above = less(error, add(add(lowest[0], lowest[1]), lowest[2]));
  const Mask below = less(add(add(highest[0], highest[1]), highest[2]), sub(spread(0.0), error));
  return bits(either(above, below));
}

bool any_near(const FacetBlock& block, std::uint64_t candidates, const CellBox& cells, const BoxBounds& box,
              const BoxBounds& bounds) {
  const BoxPack pack(box);
  const Pack error = rounding_in(bounds);
  for (std::uint64_t left = candidates & sharing_cells(cells, block.cells); left != 0;) {
    const int i = __builtin_ctzll(left) / kWidth * kWidth;
    if ((static_cast<unsigned>(left >> i) & kAllLanes & ~planes_apart(block, i, pack, error)) != 0) return true;
    left &= ~(static_cast<std::uint64_t>(kAllLanes) << i);
  }
  return false;
}

std::uint64_t near_facets(const FacetCells& facets, std::uint64_t candidates, const CellBox& cells) {
  return candidates & sharing_cells(cells, facets);
}

SharedCells share_cells(const FacetCells& few, std::uint64_t some, const FacetCells& many, std::uint64_t others,
                        std::uint64_t* met) {
  SharedCells shared{0, 0};
  for (; some != 0; some &= some - 1) {
    const int f = __builtin_ctzll(some);
    const CellBox cells{{few.lower[0][f], few.lower[1][f], few.lower[2][f]},
                        {few.upper[0][f], few.upper[1][f], few.upper[2][f]}};
    met[f] = others & sharing_cells(cells, many);
    shared.pairs += __builtin_popcountll(met[f]);
    shared.facets |= static_cast<std::uint64_t>(met[f] != 0) << f;
  }
  return shared;
}

std::uint64_t list_pairs(std::uint64_t some, std::uint64_t* met, bool few_are_b, FacetPairList* pairs) {
  std::uint8_t *const of_few = few_are_b ? pairs->b : pairs->a, *const of_many = few_are_b ? pairs->a : pairs->b;
  for (; some != 0; some &= some - 1) {
    const int f = __builtin_ctzll(some), begin = pairs->count, room = FacetPairList::kCapacity - begin;
    const int count = __builtin_popcountll(met[f]);
    const std::uint64_t listed = count <= room ? met[f] : expand((std::uint64_t{1} << room) - 1, met[f]);
    write_places(listed, of_many + begin);
    __builtin_memset(of_few + begin, f, FacetPairList::kCapacity);
    pairs->count = begin + (count <= room ? count : room);
    if (count > room) {
      met[f] &= ~listed;
      break;
    }
  }
  return some;
}

}  // namespace
}  // namespace tact::narrowphase
