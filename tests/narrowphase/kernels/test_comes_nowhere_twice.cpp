#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

struct Place {
  std::int64_t x, y;
  bool operator==(const Place&) const = default;
};

std::int64_t area(Place a, Place b, Place c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }
int sign(std::int64_t x) { return (x > 0) - (x < 0); }

bool lies_on(Place p, Place a, Place b) {
  return area(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool meet(Place a, Place b, Place c, Place d) {
  if (lies_on(c, a, b) || lies_on(d, a, b) || lies_on(a, c, d) || lies_on(b, c, d)) return true;
  return sign(area(a, b, c)) * sign(area(a, b, d)) < 0 && sign(area(c, d, a)) * sign(area(c, d, b)) < 0;
}

// Whole numbers, exactly. The edges at a vertex may have it in common, and nothing else.
bool is_simple(const std::vector<Place>& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Place a = p[i], b = p[(i + 1) % n], c = p[(i + 2) % n];
    if (a == b || lies_on(c, a, b) || lies_on(a, b, c)) return false;
    for (std::size_t k = i + 2; k < n; ++k) {
      if ((k + 1) % n != i && meet(a, b, p[k], p[(k + 1) % n])) return false;
    }
  }
  return true;
}

FlatPolygon polygon_of(const std::vector<Place>& places, double scale, double size) {
  FlatPolygon polygon;
  polygon.count = static_cast<int>(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    polygon.x[i] = scale * static_cast<double>(places[i].x);
    polygon.y[i] = scale * static_cast<double>(places[i].y);
  }
  polygon.size = scale * size;
  polygon.error = 0x1p-48 * polygon.size;
  return polygon;
}

bool comes_nowhere_twice(const std::vector<Place>& places, double scale = 1.0, double size = 4096.0) {
  FlatPolygon first = polygon_of(places, scale, size);
  const bool expected = scalar_kernels()->comes_nowhere_twice(&first);
  for (const Kernels* kernels : tests::available_kernels()) {
    FlatPolygon polygon = polygon_of(places, scale, size);
    EXPECT_EQ(kernels->comes_nowhere_twice(&polygon), expected) << kernels->name;
  }
  return expected;
}

// Whole numbers are far from what rounding may hide, so the answer is exact; few of them, so that vertices often lie on
// edges and on each other.
TEST(ComesNowhereTwice, EqualsBruteForceInWholeNumbers) {
  tests::Random random(1);
  std::array<int, 2> count{};
  for (int round = 0; round < 40000; ++round) {
    const int n = 3 + random.below(round % 4 == 0 ? 40 : 5), span = 4 + random.below(40);
    std::vector<Place> places;
    for (int i = 0; i < n; ++i) {
      const double at = 2.0 * std::numbers::pi * i / n, r = span * (round % 2 == 0 ? random.uniform(0.3, 1.0) : 1.0);
      if (round % 4 < 3 && n < 8) {
        places.push_back({random.below(span), random.below(span)});
      } else {
        places.push_back({std::llround(r * std::cos(at)), std::llround(r * std::sin(at))});
      }
    }
    const bool expected = is_simple(places);
    ++count[expected ? 1 : 0];
    ASSERT_EQ(comes_nowhere_twice(places), expected) << "round " << round;
  }
  EXPECT_GT(count[0], 5000);
  EXPECT_GT(count[1], 2000);
}

// A comb of the most vertices there may be, and what becomes of it if one of them moves through an edge far along it.
TEST(ComesNowhereTwice, HoldsForAsManyVerticesAsThereMayBe) {
  std::vector<Place> comb;
  for (int i = 0; i < FlatPolygon::kMost - 2; ++i) comb.push_back({10 * i, i % 2 == 0 ? 100 : 900});
  comb.push_back({10 * FlatPolygon::kMost, 1000});
  comb.push_back({-10, 1000});
  for (const double scale : {0x1p-190, 1.0, 0x1p180}) EXPECT_TRUE(comes_nowhere_twice(comb, scale)) << scale;
  for (std::size_t i = 0; i < 40; ++i) {
    std::vector<Place> crossed = comb;
    crossed[3 * i] = {1275, 1100};
    EXPECT_FALSE(is_simple(crossed));
    EXPECT_FALSE(comes_nowhere_twice(crossed)) << i;
  }
}

// What is nearer than errors can tell is not certain.
TEST(ComesNowhereTwice, SaysNoWhereItCannotTell) {
  const std::vector<Place> gap{{0, 0}, {1000, 0}, {1000, 1000}, {501, 1000}, {501, 1}, {500, 1000}, {0, 1000}};
  EXPECT_TRUE(comes_nowhere_twice(gap));
  EXPECT_TRUE(comes_nowhere_twice(gap, 1.0, 0x1p24));
  EXPECT_FALSE(comes_nowhere_twice(gap, 1.0, 0x1p30));
}

}  // namespace
}  // namespace tact::narrowphase
