#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

#include "narrowphase/motion/height_signs.h"

namespace tact::narrowphase {
namespace {

using Whole = std::array<std::int64_t, 3>;

// A way of whole coordinates at time 0 and at the end of a span.
struct WholeWay {
  Whole at[2];
};

std::int64_t volume(const Whole& u, const Whole& v, const Whole& w) {
  return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
}

// Of the Bernstein coefficients, three times the middle ones.
unsigned signs_of(const WholeWay& u, const WholeWay& v, const WholeWay& w) {
  const auto at = [&](int i, int j, int k) { return volume(u.at[i], v.at[j], w.at[k]); };
  unsigned signs = 0;
  for (const std::int64_t c :
       {at(0, 0, 0), at(1, 0, 0) + at(0, 1, 0) + at(0, 0, 1), at(1, 1, 0) + at(1, 0, 1) + at(0, 1, 1), at(1, 1, 1)})
    signs |= c > 0 ? kAbove : c < 0 ? kBelow : 0u;
  return signs;
}

Vec3 vector(const Whole& p, double unit) {
  return unit * Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

// Its vertices are so far away that the difference keeps no bit below the unit. The end of the span is a part of the
// way: the whole way ends at begin + 2^halvings (end - begin).
MovingWay moving(const WholeWay& way, int halvings, double unit, const Vec3& from) {
  const Vec3 begin = vector(way.at[0], unit), end = vector(way.at[1], unit);
  const Vec3 last = begin + std::ldexp(1.0, halvings) * (end - begin);
  return {{{from, from}}, {{from + begin, from + last}}};
}

TEST(HeightSigns, AreThoseOfWholeNumbers) {
  std::mt19937_64 random(7);
  const auto draw = [&](std::int64_t most) {
    const auto one = [&] { return std::uniform_int_distribution<std::int64_t>(-most, most)(random); };
    return Whole{one(), one(), one()};
  };
  int open = 0, flat = 0;
  for (int k = 0; k < 20000; ++k) {
    const std::int64_t most = k % 3 == 0 ? 2 : k % 3 == 1 ? 60 : 40000;
    WholeWay u{{draw(most), draw(most)}}, v{{draw(most), draw(most)}}, w{{draw(most), draw(most)}};
    if (k % 5 == 0) {  // in the plane at the beginning, or all the time
      for (std::size_t axis = 0; axis < 3; ++axis) {
        w.at[0][axis] = 2 * u.at[0][axis] - v.at[0][axis];
        if (k % 2 == 0) w.at[1][axis] = 2 * u.at[1][axis] - v.at[1][axis];
      }
    }
    const int halvings = k % 4 == 0 ? 10 : 0;
    const double unit = 0x1p-52;
    const Vec3 from{1.0, -1.0, 0.5};
    const MovingWay a = moving(u, halvings, unit, from), b = moving(v, halvings, unit, from),
                    c = moving(w, halvings, unit, from);
    const unsigned right = signs_of(u, v, w);
    const MovingNormal normal(a, b, halvings);
    const MovingNormal::Signs signs = normal.signs_along(c);
    EXPECT_EQ(signs.certain & ~right, 0u) << "case " << k;
    EXPECT_EQ(normal.exact_signs_along(c, signs.open, signs.certain), right) << "case " << k;
    const std::int64_t first = volume(u.at[0], v.at[0], w.at[0]);
    const unsigned at_begin = BeginNormal(a, b).sign_along(c.from, c.to);
    EXPECT_EQ(at_begin & ~(first > 0 ? kAbove : first < 0 ? kBelow : 0u), 0u) << "case " << k;
    open += signs.open != 0;
    flat += right == 0;
  }
  EXPECT_GT(open, 1000);
  EXPECT_GT(flat, 100);
}

// Volumes that doubles do not tell: of products that vanish, and of three neighbouring numbers of Fibonacci, one.
TEST(HeightSigns, ThatDoublesDoNotTellAreExact) {
  const auto way = [](Vec3 to) { return MovingWay{{{Vec3{}, Vec3{}}}, {{to, to}}}; };
  const double small = 0x1p-380;
  for (const auto& [u, v, up] : {std::array{Vec3{small, 0.0, 0.0}, Vec3{0.0, small, 0.0}, Vec3{0.0, 0.0, small}},
                                 {Vec3{63245986.0, 39088169.0, 0.0}, {39088169.0, 24157817.0, 0.0}, {0.0, 0.0, 1.0}}}) {
    const MovingWay a = way(u), b = way(v);
    const MovingNormal normal(a, b, 0);
    for (const auto& [w, right] : {std::pair{way(up), kAbove}, {way(-up), kBelow}}) {
      EXPECT_EQ(normal.signs_along(w).certain, 0u);
      EXPECT_EQ(normal.exact_signs_along(w, normal.signs_along(w).open, 0u), right);
      EXPECT_EQ(BeginNormal(a, b).sign_along(w.from, w.to), 0u);
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
