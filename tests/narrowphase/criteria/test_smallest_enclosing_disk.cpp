#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "narrowphase/criteria/smallest_enclosing_disk.h"

namespace tact::narrowphase {
namespace {

using PlanePoints = std::vector<Point2>;

long double distance(long double x, long double y, Point2 p) { return std::hypot(p.x - x, p.y - y); }

// The radius of the smallest disk about a pair's middle or a triple's circumcenter that holds all points, in long
// double.
long double radius_by_brute_force(const PlanePoints& points) {
  long double best = points.size() == 1 ? 0.0L : std::numeric_limits<long double>::infinity();
  const auto consider = [&](long double x, long double y) {
    long double radius = 0.0L;
    for (const Point2& p : points) radius = std::max(radius, distance(x, y, p));
    best = std::min(best, radius);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Point2& p = points[i];
      consider((static_cast<long double>(p.x) + points[j].x) / 2, (static_cast<long double>(p.y) + points[j].y) / 2);
      for (std::size_t k = 0; k < j; ++k) {
        const long double sx = static_cast<long double>(points[j].x) - p.x,
                          sy = static_cast<long double>(points[j].y) - p.y;
        const long double tx = static_cast<long double>(points[k].x) - p.x,
                          ty = static_cast<long double>(points[k].y) - p.y;
        const long double area = sx * ty - sy * tx;
        if (area == 0.0L) continue;
        const long double ss = sx * sx + sy * sy, tt = tx * tx + ty * ty;
        consider(p.x + (ss * ty - tt * sy) / (2 * area), p.y + (tt * sx - ss * tx) / (2 * area));
      }
    }
  }
  return best;
}

void expect_encloses(const Disk& disk, const PlanePoints& points) {
  for (const Point2& p : points) {
    EXPECT_LE(std::hypot(p.x - disk.center.x, p.y - disk.center.y), disk.radius);
    EXPECT_LE(distance(disk.center.x, disk.center.y, p), disk.radius);
  }
}

void expect_smallest(const PlanePoints& points, const char* what, unsigned seed) {
  SCOPED_TRACE(testing::Message() << what << ", seed " << seed << ", " << points.size() << " points");
  const Disk disk = smallest_enclosing_disk(points);
  expect_encloses(disk, points);
  EXPECT_LE(disk.radius, radius_by_brute_force(points) * (1.0L + 1e-12L));
}

PlanePoints random_points(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  PlanePoints points(count);
  for (Point2& p : points) p = {coordinate(random), coordinate(random)};
  return points;
}

}  // namespace

TEST(SmallestEnclosingDisk, NoPointsGiveNoDisk) { EXPECT_LT(smallest_enclosing_disk({}).radius, 0.0); }

TEST(SmallestEnclosingDisk, OnePointIsItsOwnDisk) {
  const PlanePoints points{{0.1, -3e200}, {0.1, -3e200}};
  for (const std::size_t count : {1u, 2u}) {
    const Disk disk = smallest_enclosing_disk(std::span(points).first(count));
    EXPECT_EQ(disk.center.x, 0.1);
    EXPECT_EQ(disk.center.y, -3e200);
    EXPECT_EQ(disk.radius, 0.0);
  }
}

TEST(SmallestEnclosingDisk, ClosedForms) {
  const auto expect = [](const PlanePoints& points, Point2 center, double radius) {
    const Disk disk = smallest_enclosing_disk(points);
    expect_encloses(disk, points);
    EXPECT_NEAR(disk.center.x, center.x, 1e-15);
    EXPECT_NEAR(disk.center.y, center.y, 1e-15);
    EXPECT_NEAR(disk.radius, radius, 1e-14);
  };
  expect({{1, 2}, {4, 6}}, {2.5, 4}, 2.5);
  expect({{0, 0}, {1, 1}, {4, 4}, {3, 3}}, {2, 2}, std::sqrt(8.0));                  // on a line
  expect({{-1, 0}, {1, 0}, {0, 0.5}}, {0, 0}, 1);                                    // obtuse
  expect({{-1, 0}, {1, 0}, {0, 1}}, {0, 0}, 1);                                      // right
  expect({{0, 1}, {-std::sqrt(0.75), -0.5}, {std::sqrt(0.75), -0.5}}, {0, 0}, 1);    // acute
  expect({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}, {2, 2}}, {1, 1}, std::sqrt(2.0));  // a square
}

TEST(SmallestEnclosingDisk, EqualsBruteForceOnRandomPoints) {
  for (unsigned seed = 0; seed < 3000; ++seed) expect_smallest(random_points(1 + seed % 12, seed), "random", seed);
}

TEST(SmallestEnclosingDisk, EqualsBruteForceOnGridsFullOfTies) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    PlanePoints points = random_points(2 + seed % 12, seed);
    for (Point2& p : points) p = {std::round(2 * p.x), std::round(2 * p.y)};
    expect_smallest(points, "grid", seed);
  }
}

TEST(SmallestEnclosingDisk, EqualsBruteForceOnOneCircleOrNearly) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    PlanePoints points = random_points(3 + seed % 10, seed);
    const double noise = seed % 4 == 0 ? 0.0 : std::pow(10.0, -4.0 * (seed % 4));
    for (Point2& p : points) {
      const double angle = std::numbers::pi * p.x;
      p = {(1 + noise * p.y) * std::cos(angle), (1 + noise * p.y) * std::sin(angle)};
    }
    expect_smallest(points, "circle", seed);
  }
}

TEST(SmallestEnclosingDisk, EqualsBruteForceOnNearlyStraightAndNearlyEqualPoints) {
  for (unsigned seed = 0; seed < 3000; ++seed) {
    PlanePoints points = random_points(2 + seed % 9, seed);
    const double thickness = std::pow(10.0, -static_cast<double>(seed % 18));
    for (std::size_t i = 0; i < points.size(); ++i) {
      Point2& p = points[i];
      p = seed % 2 == 0
              ? Point2{0.6 * p.x + thickness * p.y, 0.8 * p.x - thickness * p.y}
              : Point2{(i % 3 == 0 ? 1.0 : -0.3) + thickness * p.x, (i % 3 == 1 ? 0.7 : 0.0) + thickness * p.y};
    }
    expect_smallest(points, seed % 2 == 0 ? "straight" : "equal", seed);
  }
}

// Scaling by a power of two changes nothing but the exponent, down to where doubles lose bits.
TEST(SmallestEnclosingDisk, ScalesWithPowersOfTwo) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const PlanePoints points = random_points(8, seed);
    const Disk disk = smallest_enclosing_disk(points);
    for (const int exponent : {-900, -300, -30, 30, 299}) {
      PlanePoints scaled = points;
      for (Point2& p : scaled) p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent)};
      const Disk scaled_disk = smallest_enclosing_disk(scaled);
      EXPECT_EQ(scaled_disk.radius, std::ldexp(disk.radius, exponent)) << seed << ' ' << exponent;
      EXPECT_EQ(scaled_disk.center.x, std::ldexp(disk.center.x, exponent)) << seed << ' ' << exponent;
    }
  }
}

TEST(SmallestEnclosingDisk, SubnormalCoordinatesAreEnclosed) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const PlanePoints points{{0, 0}, {3 * tiny, 0}, {0, 5 * tiny}, {7 * tiny, 7 * tiny}};
  const Disk disk = smallest_enclosing_disk(points);
  expect_encloses(disk, points);
  EXPECT_LE(disk.radius, 7 * tiny);
}

TEST(SmallestEnclosingDisk, FarFromTheOriginLosesOnlyTheCentersRounding) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    PlanePoints points = random_points(9, seed);
    for (Point2& p : points) p = {p.x + 1e8, p.y - 3e8};
    const Disk disk = smallest_enclosing_disk(points);
    expect_encloses(disk, points);
    EXPECT_LE(disk.radius, radius_by_brute_force(points) + 6e-8) << seed;
  }
}

TEST(SmallestEnclosingDisk, DependsOnTheSetAlone) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    PlanePoints points = random_points(40, seed);
    if (seed % 2 == 0) {
      for (Point2& p : points) p = {std::round(4 * p.x), std::round(4 * p.y)};
    }
    const Disk disk = smallest_enclosing_disk(points);
    points.insert(points.end(), points.begin(), points.begin() + 20);
    std::shuffle(points.begin(), points.end(), std::mt19937(seed));
    const Disk shuffled = smallest_enclosing_disk(points);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(disk.radius), std::bit_cast<std::uint64_t>(shuffled.radius)) << seed;
    EXPECT_EQ(disk.center.x, shuffled.center.x) << seed;
    EXPECT_EQ(disk.center.y, shuffled.center.y) << seed;
  }
}

// Many points, of which a known few decide: a ring of them just inside a circle through three.
TEST(SmallestEnclosingDisk, ManyPoints) {
  PlanePoints points = random_points(100000, 7);
  for (Point2& p : points) {
    const double angle = std::numbers::pi * p.x;
    const double radius = 1.0 - 1e-9 * (1.0 + p.y);
    p = {radius * std::cos(angle), radius * std::sin(angle)};
  }
  points[500] = {0.0, 1.0};
  points[60000] = {0.6, -0.8};
  points[70000] = {-0.8, -0.6};
  const Disk disk = smallest_enclosing_disk(points);
  EXPECT_NEAR(disk.radius, 1.0, 1e-14);
  expect_encloses(disk, points);
}

}  // namespace tact::narrowphase
