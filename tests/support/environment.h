// Settings of tests that take as long as they are told to.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace tact::tests {

inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  return value ? std::strtoull(value, nullptr, 10) : otherwise;
}

}  // namespace tact::tests
