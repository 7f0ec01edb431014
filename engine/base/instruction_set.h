// Which kernels run: loops are compiled for several instruction sets, and one set is chosen when the program runs.
#pragma once

#include <cstdlib>
#include <cstring>
#include <initializer_list>

namespace tact::base {

// Of kernels that this machine can run, plainest first and null where it cannot: those whose name the environment
// variable TACT_INSTRUCTION_SET gives, or the last. No answer depends on it.
template <class Kernels>
const Kernels& wanted_kernels(std::initializer_list<const Kernels*> all) {
  const char* wanted = std::getenv("TACT_INSTRUCTION_SET");
  const Kernels* best = nullptr;
  for (const Kernels* one : all) {
    if (one == nullptr) continue;
    best = one;
    if (wanted != nullptr && std::strcmp(wanted, one->name) == 0) return *one;
  }
  return *best;
}

}  // namespace tact::base
