#include <gtest/gtest.h>
#include <tact/error.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

namespace tact {
namespace {

// The enumerators, read from the header in their order.
TEST(Error, EachCodeIsCalledAsInTheHeader) {
  std::ifstream header(std::filesystem::path(TACT_SOURCE_DIR) / "engine/base/include/tact/error.h");
  const std::regex enumerator(R"(^  ([a-z_]+),\s*///<.*)");
  int code = 0;
  for (std::string line; std::getline(header, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, enumerator)) continue;
    EXPECT_EQ(error_code_name(static_cast<ErrorCode>(code++)), match[1].str());
  }
  EXPECT_GT(code, 10);
  EXPECT_STREQ(error_code_name(static_cast<ErrorCode>(code)), "unknown");
}

TEST(Error, HoldsItsCodeAndMessage) {
  const Error error(ErrorCode::stale_body, "body 7 was removed");
  EXPECT_EQ(error.code(), ErrorCode::stale_body);
  EXPECT_STREQ(error.what(), "body 7 was removed");
}

}  // namespace
}  // namespace tact
