// Blocks of the facets of two bodies, and what the kernels make of all their pairs.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/triangles/block_pair.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/mesh.h"

namespace tact::tests {

// Space, and a cube in which all bodies here lie.
inline constexpr double kEverywhere = 0x1p1000;
inline constexpr narrowphase::BoxBounds kSpace{{-kEverywhere, -kEverywhere, -kEverywhere},
                                               {kEverywhere, kEverywhere, kEverywhere}};
inline constexpr narrowphase::BoxBounds kEverything{{-9, -9, -9}, {9, 9, 9}};
// Leave out nothing of the cube; of space.
inline constexpr narrowphase::CullPlanes kAll{{0, 0, 1, 0, 0, 0}, -9, kEverything};
inline constexpr narrowphase::CullPlanes kAnywhere{{0, 0, 1, 0, 0, 0}, -kEverywhere, kSpace};
inline const narrowphase::Grid kGrid = narrowphase::grid_over(kEverything, narrowphase::kLastCell);

narrowphase::FacetBlock block_of(const narrowphase::Kernels& kernels, const narrowphase::ClusteredMesh& mesh,
                                 int cluster, const narrowphase::CullPlanes& planes = kAll,
                                 const narrowphase::Grid& grid = kGrid);

// Seeded pairs of bodies: lattices where everything is coplanar or touches, soups, smooth ones, and lattices that were
// turned, so that rounding alone keeps corners from planes.
std::pair<Mesh, Mesh> bodies(int seed);

base::Box facet_box(const narrowphase::ClusteredMesh& mesh, int facet);

// The box of the facets of some pairs.
narrowphase::BoxBounds bounds_of(const narrowphase::FacetPairList& pairs, const narrowphase::FacetBlock& a,
                                 const narrowphase::FacetBlock& b);

// A facet with each of `count`.
narrowphase::FacetPairList all_with(int facet, int count);

// Of each facet of a block, a bit for each facet of another.
using Met = std::array<std::uint64_t, narrowphase::FacetBlock::kCapacity>;

// The corners of all facets, which lie in kEverything.
narrowphase::FloatCorners floats_of(const narrowphase::Kernels& kernels, const narrowphase::FacetBlock& block);

// The pairs that leave_aside() leaves of those that share cells of kGrid: planes are asked from `plane_from` facets on.
inline constexpr int kAlways = 0, kNever = 65;
std::vector<FacetPair> paired(const narrowphase::Kernels& kernels, const narrowphase::FacetBlock& a,
                              const narrowphase::FacetBlock& b, bool few_are_b, int plane_from,
                              std::int64_t& box_pairs);

// What becomes of all pairs of a facet of the first cluster of `a` and one of `b`.
struct Decisions {
  std::vector<FacetPair> meeting, undecided, flat;
};
enum class Digits { few, simple, wide };  // floats, doubles, twice their digits
Decisions decide_all(const narrowphase::Kernels& kernels, const narrowphase::ClusteredMesh& a,
                     const narrowphase::ClusteredMesh& b, Digits digits = Digits::simple,
                     const narrowphase::CullPlanes& planes = kAll);

// The pairs that do meet.
std::vector<FacetPair> meeting_in_truth(const narrowphase::ClusteredMesh& a, const narrowphase::ClusteredMesh& b);

// All that is decided is right.
void expect_right(const narrowphase::Kernels& kernels, const narrowphase::ClusteredMesh& a,
                  const narrowphase::ClusteredMesh& b, Digits digits, const narrowphase::CullPlanes& planes = kAll);

}  // namespace tact::tests
