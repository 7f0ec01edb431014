// The headers for C, one after the other: what tact_c.h includes.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace tact::tests {

inline std::string header_of_c() {
  std::string text;
  for (const char* part : {"world", "report", "motion", "solver", "queries", "debug_draw"}) {
    const std::string name = "bindings/c/include/tact/tact_c_" + std::string(part) + ".h";
    std::ifstream file(std::filesystem::path(TACT_SOURCE_DIR) / name);
    EXPECT_TRUE(file) << name;
    text.append(std::istreambuf_iterator<char>(file), {});
  }
  return text;
}

}  // namespace tact::tests
