// The loops in which the time goes, compiled for each instruction set and chosen when the program runs. All
// instruction sets give the same answer: they compare, subtract and convert, and round alike.
#pragma once

#include <cstddef>
#include <cstdint>

#include "broadphase/block.h"
#include "broadphase/index_pair.h"

namespace tact::broadphase {

// One side of a comparison: a block, what stands in each of its lanes (no two alike), and a bit for each active lane.
struct BlockSide {
  const Block* block;
  const std::uint32_t* names;
  std::uint32_t active;
};

struct Overlaps {
  std::size_t count;
  bool certain;  // no float of the one box was equal to one of the other's where it counts
};

struct Kernels {
  const char* name;

  // The lanes that overlap a box.
  std::uint32_t (*find_lanes)(const Block& block, const FloatBox& box);

  // For each of `count` pairs of different blocks, or of a block with itself, writes the lanes of the first that
  // overlap the bounds of the second. Known in advance, they keep the loops over lanes from waiting for comparisons.
  void (*find_rows)(const Block* blocks, const IndexPair* pairs, std::size_t count, std::uint16_t* rows);

  // Writes the names (smaller first) of each pair of overlapping boxes, one of `a` and one of `b`, of which at least
  // one is active, in any order. `rows` are those of find_rows(). A block against itself gives each pair once. `pairs`
  // must have room for kOverlapRoom; the room behind the pairs written may be overwritten.
  Overlaps (*find_overlaps)(const BlockSide& a, const BlockSide& b, std::uint32_t rows, IndexPair* pairs);

  // Sets the boxes of `lanes`, each of which has a member, and the bounds. `boxes` has six doubles a box, lower then
  // upper. A box that is empty or not within `region` is left out; returns a bit for each of these.
  std::uint32_t (*refit_lanes)(Block& block, const double* boxes, const std::uint32_t* members, std::uint32_t lanes,
                               const Frame& frame, const FloatBox& region);
};

inline constexpr std::size_t kOverlapRoom = kLanes * (kLanes + 1);

// Each instruction set; null where the machine or the build does not have it.
const Kernels* baseline_kernels();
const Kernels* avx2_kernels();
const Kernels* avx512_kernels();

// Those that TACT_INSTRUCTION_SET names, or the best for this machine; the same for the whole process.
const Kernels& kernels();

}  // namespace tact::broadphase
