#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "engine/base/fused.h"

namespace tact::base {
namespace {

// MinGW's own rounds twice: there this is the only right one.
#if !defined(__MINGW32__)
// A number of any size and sign, or one whose exponent is near 0.
double any_double(std::mt19937_64& random) { return std::bit_cast<double>(random()); }
double near_one(std::mt19937_64& random, int spread) {
  const auto exponent = static_cast<std::uint64_t>(1023 + static_cast<int>(random() % (2 * spread + 1)) - spread);
  return std::bit_cast<double>((random() & 0x800fffffffffffff) | exponent << 52);
}

// NaN is as good as any other.
template <class Bits, class Real>
bool same(Real a, Real b) {
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b) || (a != a && b != b);
}

TEST(Fused, ByIntegersIsThatOfTheLibrary) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 300000; ++i) {
    const bool any = i % 4 == 0;
    const double a = any ? any_double(random) : near_one(random, 3), b = any ? any_double(random) : near_one(random, 3);
    const double c = any          ? any_double(random)
                     : i % 4 == 1 ? near_one(random, 120)
                     : i % 4 == 2 ? -(a * b)
                                  : -std::nextafter(a * b, 0.0);
    // And where the result vanishes: 2^-500 each.
    for (const double scale : {1.0, 0x1p-500, 0x1p-530}) {
      const double x = a * scale, y = b * scale, z = i % 4 == 2 ? -(x * y) : c * scale * scale;
      ASSERT_TRUE(same<std::uint64_t>(fused_by_integers(x, y, z), std::fma(x, y, z)))
          << std::hexfloat << x << " " << y << " " << z;
    }
  }
}

TEST(Fused, ByDoublesIsThatOfTheLibrary) {
  std::mt19937_64 random(2);
  const auto any_float = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random())); };
  for (int i = 0; i < 300000; ++i) {
    const float a = any_float(), b = any_float(),
                c = i % 3 == 0 ? any_float() : -std::nextafter(a * b, i % 3 == 1 ? 0.0f : a * b);
    ASSERT_TRUE(same<std::uint32_t>(fused_by_doubles(a, b, c), std::fma(a, b, c)))
        << std::hexfloat << a << " " << b << " " << c;
  }
}
#endif

TEST(Fused, RoundsOnce) {
  // The product is 1 + 2^-29 + 2^-60, which no double holds.
  const double a = 1.0 + 0x1p-30;
  EXPECT_EQ(fused(a, a, -(1.0 + 0x1p-29)), 0x1p-60);
  // Half a unit in the last place and a little more, or less, far below: what rounds first to 64 digits rounds wrongly.
  EXPECT_EQ(fused(1.0 + 0x1p-52, 1.0 - 0x1p-53, 0x1p-54), fused_by_integers(1.0 + 0x1p-52, 1.0 - 0x1p-53, 0x1p-54));
  EXPECT_EQ(fused(0x1p-60, 0x1p-60, 1.0 + 0x1p-52) - 1.0, 0x1p-52);
  EXPECT_EQ(fused_by_integers(0x1p-53, 1.0 + 0x1p-52, 1.0), 1.0 + 0x1p-52);
  EXPECT_EQ(fused_by_integers(0x1p-53, 1.0, 1.0), 1.0);
}

}  // namespace
}  // namespace tact::base
