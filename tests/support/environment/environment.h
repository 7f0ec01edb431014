// Settings of tests that take as long as they are told to.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
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

// The same for as many seconds as TACT_LONG_SECONDS says, if it is set, until a check fails. Prints the seed and how
// many there were.
template <class Check>
void for_seeds_or_seconds(const char* count, std::uint64_t otherwise, const Check& check) {
  using Clock = std::chrono::steady_clock;
  const std::uint64_t seconds = from_environment("TACT_LONG_SECONDS", 0), seed = from_environment("TACT_LONG_SEED", 1);
  const std::uint64_t most = seconds > 0 ? ~std::uint64_t{0} : from_environment(count, otherwise);
  const auto end = Clock::now() + std::chrono::seconds(seconds);
  std::printf("TACT_LONG_SEED=%llu\n", static_cast<unsigned long long>(seed));
  std::uint64_t i = 0;
  for (; i < most && (seconds == 0 || Clock::now() < end); ++i) {
    if (!check(seed << 32 | i)) return;
  }
  std::printf("%llu lives\n", static_cast<unsigned long long>(i));
}

}  // namespace tact::tests
