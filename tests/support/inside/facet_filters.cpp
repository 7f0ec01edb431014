#include "tests/support/inside/facet_filters.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "narrowphase/triangles/confirm.h"
#include "narrowphase/triangles/lattice.h"

namespace tact::tests {
namespace {

using narrowphase::BoxBounds;
using narrowphase::CellBox;
using narrowphase::ClusterFacets;
using narrowphase::CullPlanes;
using narrowphase::FacetBlock;
using narrowphase::FacetPairList;
using narrowphase::FloatCorners;
using narrowphase::Grid;
using narrowphase::Kernels;
using narrowphase::Lattice;
using narrowphase::PairMatches;

constexpr double kFar = 0x1p301;
constexpr CullPlanes kAll{.axis = {}, .lowest = -1.0, .box = {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}}};

// One triangle of each pair as a facet with vertices of its own.
FacetBlock block_of(const Kernels& kernels, std::span<const TrianglePair> pairs, Triangle TrianglePair::*triangle,
                    const Grid& grid) {
  constexpr std::size_t kVertices = 3 * FacetBlock::kCapacity + narrowphase::kPadding;
  std::array<double, kVertices> x{}, y{}, z{};
  std::array<std::array<std::uint8_t, FacetBlock::kCapacity>, 3> corner{};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = 3 * i + k;
      const base::Vec3 p = (pairs[i].*triangle)[k];
      x[v] = p.x, y[v] = p.y, z[v] = p.z;
      corner[k][i] = static_cast<std::uint8_t>(v);
    }
  }
  const auto count = static_cast<std::int32_t>(pairs.size());
  const ClusterFacets cluster{.points = {x.data(), y.data(), z.data()},
                              .owned_begin = 0,
                              .owned_count = 3 * count,
                              .borrowed = nullptr,
                              .borrowed_count = 0,
                              .corner = {corner[0].data(), corner[1].data(), corner[2].data()},
                              .facet_begin = 0,
                              .facet_count = count};
  FacetBlock block;
  kernels.open_cluster(cluster, kAll, &block);
  kernels.find_cells(grid, &block);
  return block;
}

// The box of all triangles.
BoxBounds bounds_of(std::span<const TrianglePair> pairs) {
  base::Box box;
  for (const TrianglePair& pair : pairs) {
    for (const base::Vec3& p : pair.a) box = extended(box, p);
    for (const base::Vec3& p : pair.b) box = extended(box, p);
  }
  return narrowphase::bounds_of(box);
}

// The box of the i-th facets of two blocks.
BoxBounds bounds_of(const FacetBlock& a, const FacetBlock& b, std::size_t i) {
  return merged(box_of(a, i), box_of(b, i));
}

FloatCorners float_corners(const Kernels& kernels, const FacetBlock& block, std::uint64_t facets, const Grid& unit) {
  FloatCorners corners;
  kernels.float_corners(block, facets, unit, &corners);
  return corners;
}

// Is facet i of `many` left out when facet i of `few`, whose cells are of the same grid, is held against it?
bool leaves_out(const Kernels& kernels, const FacetBlock& few, const FacetBlock& many, std::size_t i,
                const Grid& grid) {
  const std::uint64_t bit = std::uint64_t{1} << i;
  const BoxBounds box = box_of(few, i), bounds = bounds_of(few, many, i);
  const CellBox cells = narrowphase::cells_of(grid, box);
  if (kernels.near_facets(many.cells, bit, cells) == 0) return true;
  if (!kernels.any_near(many, bit, cells, box, bounds)) return true;
  std::array<std::uint64_t, FacetBlock::kCapacity> met{};
  if (kernels.share_cells(few.cells, bit, many.cells, bit, met.data()).pairs == 0) return true;
  const Grid unit = narrowphase::grid_over(bounds, 1.0);
  double gap[3];
  for (int axis = 0; axis < 3; ++axis) gap[axis] = unit.scale[axis] / grid.scale[axis];
  kernels.leave_aside(float_corners(kernels, few, bit, unit), bit, float_corners(kernels, many, bit, unit), gap, 0.0f,
                      1, met.data());
  return met[i] == 0;
}

Filtered::Decision decision(const PairMatches& matches, std::size_t i) {
  if ((matches.undecided >> i & 1) != 0) return Filtered::Decision::undecided;
  return (matches.meeting >> i & 1) != 0 ? Filtered::Decision::meeting : Filtered::Decision::apart;
}

bool is_right(Filtered::Decision decision, bool meet) {
  return decision == Filtered::Decision::undecided || (decision == Filtered::Decision::meeting) == meet;
}

bool on_lattice(const Kernels& kernels, const Lattice& lattice, const FacetBlock& a, const FacetBlock& b) {
  return lattice.step > 0.0 && kernels.on_lattice(a, lattice.step) && kernels.on_lattice(b, lattice.step);
}

}  // namespace

bool lies_in_plane(const Triangle& a, const Triangle& b) {
  narrowphase::PredicateCounts counts;
  return narrowphase::sides_of_plane(b[0], b[1], b[2], a, counts) == std::array<int, 3>{0, 0, 0};
}

std::uint64_t all_bits(int count) { return ~std::uint64_t{0} >> (64 - count); }

BoxBounds box_of(const FacetBlock& block, std::size_t facet) {
  return {{block.lower[0][facet], block.lower[1][facet], block.lower[2][facet]},
          {block.upper[0][facet], block.upper[1][facet], block.upper[2][facet]}};
}

BoxBounds merged(BoxBounds box, const BoxBounds& other) {
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min(box.lower[axis], other.lower[axis]);
    box.upper[axis] = std::max(box.upper[axis], other.upper[axis]);
  }
  return box;
}

bool on_lattice(const Kernels& kernels, const FacetBlock& a, const FacetBlock& b, const BoxBounds& bounds) {
  return on_lattice(kernels, narrowphase::finest_lattice_in_doubles(bounds), a, b);
}

PairMatches match_pairs(const Kernels& kernels, const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs,
                        const BoxBounds& bounds) {
  if (on_lattice(kernels, a, b, bounds)) return kernels.match_exact_pairs(a, b, pairs);
  return kernels.match_pairs(a, b, pairs, all_bits(pairs.count), bounds);
}

std::optional<PairMatches> match_exact_float_pairs(const Kernels& kernels, const FacetBlock& a, const FacetBlock& b,
                                                   const FacetPairList& pairs, const BoxBounds& bounds) {
  const Lattice lattice = narrowphase::finest_lattice_in_floats(bounds);
  if (!on_lattice(kernels, lattice, a, b)) return std::nullopt;
  return kernels.match_exact_float_pairs(float_corners(kernels, a, all_bits(a.count), lattice.grid),
                                         float_corners(kernels, b, all_bits(b.count), lattice.grid), pairs);
}

PairMatches match_float_pairs(const Kernels& kernels, const FacetBlock& a, const FacetBlock& b,
                              const FacetPairList& pairs, const BoxBounds& bounds) {
  std::uint64_t of_a = 0, of_b = 0;
  for (int k = 0; k < pairs.count; ++k) {
    of_a |= std::uint64_t{1} << pairs.a[k];
    of_b |= std::uint64_t{1} << pairs.b[k];
  }
  const Grid unit = narrowphase::grid_over(bounds, 1.0);
  const FloatCorners floats_a = float_corners(kernels, a, of_a, unit), floats_b = float_corners(kernels, b, of_b, unit);
  double gap[3] = {};
  for (int k = 0; k < pairs.count; ++k) {
    const BoxBounds box_a = box_of(a, pairs.a[k]), box_b = box_of(b, pairs.b[k]);
    for (int axis = 0; axis < 3; ++axis) {
      const double apart = std::max(box_b.lower[axis] - box_a.upper[axis], box_a.lower[axis] - box_b.upper[axis]);
      gap[axis] = std::max(gap[axis], apart * unit.scale[axis]);
    }
  }
  return kernels.match_float_pairs(floats_a, floats_b, pairs, gap);
}

std::vector<Filtered> filtered(const Kernels& kernels, std::span<const TrianglePair> pairs) {
  const Grid grid = narrowphase::grid_over(bounds_of(pairs), narrowphase::kLastCell);
  const FacetBlock a = block_of(kernels, pairs, &TrianglePair::a, grid);
  const FacetBlock b = block_of(kernels, pairs, &TrianglePair::b, grid);
  FacetPairList list;
  std::uint64_t all = 0;
  BoxBounds everything = bounds_of(a, b, 0);
  std::vector<Filtered::Decision> alone, alone_in_floats;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    list.a[i] = list.b[i] = static_cast<std::uint8_t>(i);
    ++list.count;
    all |= std::uint64_t{1} << i;
    everything = merged(everything, bounds_of(a, b, i));
    FacetPairList one;
    one.count = 1;
    one.a[0] = one.b[0] = static_cast<std::uint8_t>(i);
    const BoxBounds bounds = bounds_of(a, b, i);
    alone.push_back(decision(match_pairs(kernels, a, b, one, bounds), 0));
    alone_in_floats.push_back(decision(match_float_pairs(kernels, a, b, one, bounds), 0));
  }
  const PairMatches together = match_pairs(kernels, a, b, list, everything);
  const PairMatches in_floats = match_float_pairs(kernels, a, b, list, everything);
  const PairMatches wide = kernels.match_pairs_wide(a, b, list, all);
  const std::uint64_t sharing = kernels.sharing_pairs(a, b, list, all), flat = together.flat | wide.flat;
  PairMatches in_plane = kernels.match_flat_pairs(a, b, list, flat);
  in_plane.undecided |= all & ~flat;
  std::vector<Filtered> result(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    result[i] = {.left_out = leaves_out(kernels, a, b, i, grid) || leaves_out(kernels, b, a, i, grid),
                 .in_floats = alone_in_floats[i],
                 .in_floats_together = decision(in_floats, i),
                 .simple = alone[i],
                 .together = decision(together, i),
                 .wide = decision(wide, i),
                 .in_plane = decision(in_plane, i),
                 .sharing = (sharing >> i & 1) != 0,
                 .flat = (flat >> i & 1) != 0};
  }
  return result;
}

bool is_right(const Filtered& filtered, const TrianglePair& pair, bool meet) {
  if ((filtered.left_out && meet) || (filtered.sharing && !meet)) return false;
  if (filtered.flat && !lies_in_plane(pair.a, pair.b)) return false;
  return is_right(filtered.in_floats, meet) && is_right(filtered.in_floats_together, meet) &&
         is_right(filtered.simple, meet) && is_right(filtered.together, meet) && is_right(filtered.wide, meet) &&
         is_right(filtered.in_plane, meet);
}

std::vector<const Kernels*> available_kernels() {
  std::vector<const Kernels*> all;
  for (const Kernels* one : {narrowphase::scalar_kernels(), narrowphase::simd128_kernels(), narrowphase::avx2_kernels(),
                             narrowphase::avx512_kernels()}) {
    if (one != nullptr) all.push_back(one);
  }
  return all;
}

}  // namespace tact::tests
