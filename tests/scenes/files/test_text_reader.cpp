#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "scenes/files/text_reader.h"

namespace tact::scenes {
namespace {

TEST(ParseNumber, IsTheNearestDouble) {
  EXPECT_EQ(parse_number("0.1"), 0.1);
  EXPECT_EQ(parse_number("+1.5e3"), 1500.0);
  EXPECT_EQ(parse_number("-.5"), -0.5);
  EXPECT_EQ(parse_number("7."), 7.0);
  EXPECT_EQ(parse_number("1e-310"), 1e-310);
  EXPECT_EQ(parse_number("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_number("1.7976931348623157e308"), std::numeric_limits<double>::max());
  // Halfway between 1 and the next double, and just above: to even, then up.
  EXPECT_EQ(parse_number("1.00000000000000011102230246251565404236316680908203125"), 1.0);
  EXPECT_EQ(parse_number("1.00000000000000011102230246251565404236316680908203126"), std::nextafter(1.0, 2.0));
}

TEST(ParseNumber, RoundTripsEveryBit) {
  std::mt19937_64 random(20);
  for (int i = 0; i < 200000; ++i) {
    const std::uint64_t bits = random();
    const double value = std::bit_cast<double>(bits);
    if (!std::isfinite(value)) continue;
    const auto read = parse_number(fmt::format("{:.17g}", value));
    ASSERT_TRUE(read) << "bits " << bits;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(*read), bits) << "seed 20, case " << i;
  }
}

TEST(ParseNumber, TooSmallIsZeroAndTooLargeIsNone) {
  for (const char* text : {"1e-400", "2e-324", "1e-99999999999999999999", "0.001e-330"}) {
    const auto value = parse_number(text);
    ASSERT_TRUE(value) << text;
    EXPECT_EQ(*value, 0.0) << text;
    EXPECT_FALSE(std::signbit(*value)) << text;
  }
  EXPECT_TRUE(std::signbit(parse_number("-1e-400").value()));
  EXPECT_EQ(parse_number("0." + std::string(400, '0') + "1"), 0.0);
  for (const char* text : {"1e309", "-1e400", "1e99999999999999999999", "3E9223372036854775807", "1000e306"})
    EXPECT_FALSE(parse_number(text)) << text;
  EXPECT_FALSE(parse_number("1" + std::string(400, '0')));
}

TEST(ParseNumber, TakesExponentsOfFortran) {
  EXPECT_EQ(parse_number("0.5D+00"), 0.5);
  EXPECT_EQ(parse_number("-1.25d-2"), -0.0125);
  EXPECT_EQ(parse_number("+3D2"), 300.0);
  EXPECT_EQ(parse_number("1D-400"), 0.0);
  for (const char* text : {"D2", "1D", "1D2D3", "1D1.5", "1e2D3", "0xD", "1 D2", "nanD2", "1D400"})
    EXPECT_FALSE(parse_number(text)) << text;
}

TEST(ParseNumber, IsOneNumberFromEndToEnd) {
  for (const char* text :
       {"", "+", "-", ".", "e5", "1e", "1.2.3", "1,5", "0x10", "+-1", "++1", "--1", " 1", "1 ", "1f", "12abc"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(ParseInteger, TakesWholeIntegersOnly) {
  EXPECT_EQ(parse_integer("-12"), -12);
  EXPECT_EQ(parse_integer("+12"), 12);
  for (const char* text : {"", "+", "1.0", "1e3", "+-1", "99999999999999999999", "7a"})
    EXPECT_FALSE(parse_integer(text)) << text;
}

TEST(TextReader, CountsLinesOfEveryKind) {
  TextReader text("a\nb\r\nc\rd\n\n  e", "m", {});
  std::string seen;
  while (text.seek_token()) seen += fmt::format("{}{} ", *text.token(), text.place());
  EXPECT_EQ(seen, "a1 b2 c3 d4 e6 ");
}

TEST(TextReader, SkipsCommentsAndJoinsLines) {
  TextReader text("\xef\xbb\xbfone # two \\\nthree\\\r\nfour \\\nfive#six\n#seven", "m",
                  {.comment = '#', .backslash_joins_lines = true});
  std::string seen;
  while (text.seek_token()) {
    while (const auto token = text.token()) seen += fmt::format("{}{} ", *token, text.place());
    seen += "| ";
  }
  EXPECT_EQ(seen, "one1 | three2 four3 five4 | ");
}

// 1.#INF is what some programs write: no number with a comment behind it.
TEST(TextReader, ACommentMayTouchWhatIsBeforeIt) {
  TextReader text("1# one\n2.5#\n1.#INF 3 \\\n4", "m", {.comment = '#', .backslash_joins_lines = true});
  std::string seen;
  while (text.seek_token()) {
    while (const auto token = text.token()) seen += fmt::format("{} ", *token);
    seen += "| ";
  }
  EXPECT_EQ(seen, "1 | 2.5 | 1.#INF 3 4 | ");
}

// A path of Windows at the end of a line that is skipped.
TEST(TextReader, SkippedLinesAreNotJoined) {
  TextReader text("mtllib C:\\models\\\nnext", "m", {.comment = '#', .backslash_joins_lines = true});
  EXPECT_EQ(text.token(), "mtllib");
  text.skip_line();
  ASSERT_TRUE(text.seek_token());
  EXPECT_EQ(text.token(), "next");
}

TEST(TextReader, SaysWhatItExpectedAndFound) {
  TextReader text("1 x\x01y", "m", {});
  EXPECT_EQ(text.number("a number"), 1.0);
  try {
    text.number("a number for y");
    FAIL() << "took x for a number";
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "m:1: expected a number for y, found 'x\\x01y'");
  }
}

}  // namespace
}  // namespace tact::scenes
