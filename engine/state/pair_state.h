// What one pair of bodies keeps from step to step, or one body that is held against itself, as bytes: the list of
// fields.h. It holds vertices by the numbers of the meshes, so the meshes are to be those of before.
#pragma once

#include <cstdlib>

#include "engine/pair/pair_record.h"
#include "engine/self_record.h"
#include "engine/state/archives.h"

namespace tact {

void write_pair(const PairRecord& record, StateWriter& writer);
/// Of a new record. Errors: bad_state.
void read_pair(StateReader& reader, const Body& a, const Body& b, PairRecord& record);
/// The second part of read_pair(): what is read names what there is. Errors: bad_state.
void check_pair(const StateReader& reader, const Body& a, const Body& b, PairRecord& record);

/// The diagonal that separated a pair's boxes, or 0: see SeparatingDiagonal. Errors: bad_state.
inline void check_axis(const StateReader& reader, int axis) {
  constexpr int kMostDiagonals = 6;
  reader.check(std::abs(axis) <= kMostDiagonals, "a diagonal is not there");
}

void write_self(const SelfRecord& record, StateWriter& writer);
/// Of a new record. Errors: bad_state.
void read_self(StateReader& reader, const Body& body, SelfRecord& record);

/// What the next step tells of a pair with a body that is gone: that it does not touch any more, and which patches
/// ended.
void write_gone(bool touching, const PatchSet* patches, StateWriter& writer);
void read_gone(StateReader& reader, bool& touching, PatchSet& patches);

}  // namespace tact
