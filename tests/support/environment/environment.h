// Settings of tests that take as long as they are told to.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace tact::tests {

inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  return value ? std::strtoull(value, nullptr, 10) : otherwise;
}

// Calls check(seed) as often as the variable of that name says. TACT_LONG_SEED tells which, 1 if not set.
template <class Check>
void for_seeds(const char* count, std::uint64_t otherwise, const Check& check) {
  const std::uint64_t seeds = from_environment(count, otherwise), first = from_environment("TACT_LONG_SEED", 1) << 32;
  for (std::uint64_t i = 0; i < seeds; ++i) check(first + i);
}

}  // namespace tact::tests
