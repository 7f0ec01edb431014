// Pairs of triangles through the loops that the engine puts before its exact predicates: boxes, planes, and the
// decision of many pairs at once.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/triangle_pairs.h"

namespace tact::tests {

// What became of a pair.
struct Filtered {
  enum class Decision { apart, meeting, undecided };
  bool left_out = false;  // by a box or a plane: the pair is never asked about
  Decision in_floats = Decision::undecided, in_floats_together = Decision::undecided;
  Decision simple = Decision::undecided;    // by itself, within its own box
  Decision together = Decision::undecided;  // beside the others, within the box of all
  Decision wide = Decision::undecided;      // in double-double
  Decision in_plane = Decision::undecided;  // within the plane that both lie in, if they do
  bool sharing = false;                     // the triangles have a corner in common
  bool flat = false;                        // the first lies in the plane of the second

  // Is the pair one for the exact predicates?
  bool undecided() const {
    return !left_out && !sharing && simple == Decision::undecided && wide == Decision::undecided &&
           in_plane == Decision::undecided;
  }
};

// Every pair by itself, its triangles as facets of two blocks. At most narrowphase::FacetBlock::kCapacity pairs.
std::vector<Filtered> filtered(const narrowphase::Kernels& kernels, std::span<const TrianglePair> pairs);

// Is all of it right, where the triangles meet, or do not?
bool is_right(const Filtered& filtered, const TrianglePair& pair, bool meet);

// All of the pairs, which lie in the box `bounds`: in doubles, whether or not anything is rounded there, and in floats;
// in floats if nothing is rounded.
narrowphase::PairMatches match_pairs(const narrowphase::Kernels& kernels, const narrowphase::FacetBlock& a,
                                     const narrowphase::FacetBlock& b, const narrowphase::FacetPairList& pairs,
                                     const narrowphase::BoxBounds& bounds);
narrowphase::PairMatches match_float_pairs(const narrowphase::Kernels& kernels, const narrowphase::FacetBlock& a,
                                           const narrowphase::FacetBlock& b, const narrowphase::FacetPairList& pairs,
                                           const narrowphase::BoxBounds& bounds);
std::optional<narrowphase::PairMatches> match_exact_float_pairs(const narrowphase::Kernels& kernels,
                                                                const narrowphase::FacetBlock& a,
                                                                const narrowphase::FacetBlock& b,
                                                                const narrowphase::FacetPairList& pairs,
                                                                const narrowphase::BoxBounds& bounds);
// Is nothing rounded in doubles?
bool on_lattice(const narrowphase::Kernels& kernels, const narrowphase::FacetBlock& a, const narrowphase::FacetBlock& b,
                const narrowphase::BoxBounds& bounds);

// Does the first lie in the plane of the second?
bool lies_in_plane(const narrowphase::Triangle& a, const narrowphase::Triangle& b);

// The lowest 1 to 64 bits.
std::uint64_t all_bits(int count);

// The box of a facet of a block, and the box of two.
narrowphase::BoxBounds box_of(const narrowphase::FacetBlock& block, std::size_t facet);
narrowphase::BoxBounds merged(narrowphase::BoxBounds box, const narrowphase::BoxBounds& other);

// The instruction sets that this machine and build have.
std::vector<const narrowphase::Kernels*> available_kernels();

}  // namespace tact::tests
