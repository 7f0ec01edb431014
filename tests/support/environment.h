// Settings of tests that take as long as they are told to.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace tact::tests {

inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  return value ? std::strtoull(value, nullptr, 10) : otherwise;
}

// Is this the value of TACT_FAST_PATHS?
inline bool fast_paths_are(std::string_view wanted) {
  const char* value = std::getenv("TACT_FAST_PATHS");
  return value != nullptr && wanted == value;
}

}  // namespace tact::tests
