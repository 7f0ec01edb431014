// operator new, replaced for the whole program: it counts, and fails where it is told to. In a file of its own, for
// where it could be inlined GCC takes its free() for a mistake.
#pragma once

namespace tact::tests {

// Whether operator new is replaced: the thread sanitizer has one of its own, and then nothing is counted or fails.
bool is_hooked();

// Calls of operator new so far, by any thread.
long allocation_count();

// The allocation that comes after `number` others throws std::bad_alloc; all later ones too if `for_good`.
void fail_allocation(long number, bool for_good);

// No allocation fails any more. Has one failed since fail_allocation()?
bool stop_failing();

}  // namespace tact::tests
