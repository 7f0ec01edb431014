#include "engine/pair/separate_by_kdop.h"

#include "engine/base/parallel.h"

namespace tact {

namespace {

using narrowphase::SeparatingDiagonal;

constexpr std::size_t kPairsAtATime = 2048;  // of a few nanoseconds each

// Both bodies of a pair that was apart, or is new, know their k-DOPs, whatever other pairs they have: what is found of
// a pair depends on no other. Bodies that moved and have no such pair need not know theirs when they move next.
void find_missing_kdops(const PairTable& table, Bodies& bodies, int threads) {
  for (const std::uint32_t slot : bodies.changed()) bodies.want_kdop(slot, false);
  for (const MovedPair& pair : table.moved()) {
    if (table.in_contact(pair.place)) continue;
    bodies.want_kdop(table.candidates()[pair.place].a.index, true);
    bodies.want_kdop(table.candidates()[pair.place].b.index, true);
  }
  bodies.find_kdops(threads);
}

// Whether an axis shows that the pair is farther apart than its margins. The one that did last is looked at first, then
// the others; notes which one does.
bool is_separated(const MovedPair& pair, const Bodies& bodies, PairTable& table) {
  if (table.in_contact(pair.place)) return false;
  const CandidatePair& candidate = table.candidates()[pair.place];
  const auto *a = bodies.kdops().of(candidate.a.index), *b = bodies.kdops().of(candidate.b.index);
  const bool known = a != nullptr && b != nullptr;
  const double reach = bodies.reach(candidate.a.index, candidate.b.index);
  SeparatingDiagonal& axis = table.separating_axis(pair.place);
  const SeparatingDiagonal last = axis;
  if (known && narrowphase::separates(last, *a, *b, reach)) return true;
  axis = known ? narrowphase::separating_diagonal(*a, *b, reach) : SeparatingDiagonal{0};
  if (axis != 0) return true;
  if (last != 0) {
    pair.record->history.kind = PairHistory::Kind::separated;
    pair.record->history.direction = narrowphase::direction_of(last);
  }
  return false;
}

}  // namespace

void separate_by_kdop(PairTable& table, Bodies& bodies, int threads) {
  if (!bodies.tuning().separates_by_kdop) return;
  find_missing_kdops(table, bodies, threads);
  const std::span<MovedPair> moved = table.moved();
  base::parallel_for(moved.size(), kPairsAtATime, threads,
                     [&](std::size_t i) { moved[i].separated = is_separated(moved[i], bodies, table); });
  table.drop_separated();
}

}  // namespace tact
