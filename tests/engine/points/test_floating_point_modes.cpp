// A caller's floating-point mode changes no answer: neither how SSE and x87 round, nor how many digits x87 keeps.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

Eigen::Vector3d vector_in_cube(Random& random) {
  const base::Vec3 v = random.in_cube(1.0);
  return {v.x, v.y, v.z};
}

// Sets a mode for as long as it lives.
class CallersMode {
 public:
  CallersMode(int rounding, unsigned x87_precision) {
    std::fegetenv(&saved_);
#if defined(__x86_64__) && defined(__GNUC__)
    std::uint16_t control = 0;
    __asm__ volatile("fnstcw %0" : "=m"(control));
    control = static_cast<std::uint16_t>((control & ~0x300u) | x87_precision << 8);
    __asm__ volatile("fldcw %0" : : "m"(control));
#else
    (void)x87_precision;
#endif
    std::fesetround(rounding);
  }
  ~CallersMode() { std::fesetenv(&saved_); }
  CallersMode(const CallersMode&) = delete;
  CallersMode& operator=(const CallersMode&) = delete;

 private:
  std::fenv_t saved_;
};

// Two facets above each other with edges that are turned by 1e-5 to 1e-9.
struct NearlyParallelEdges {
  Eigen::Matrix3Xd a{3, 3}, b{3, 3};
  explicit NearlyParallelEdges(Random& random) {
    const double turn = std::pow(10.0, random.uniform(-9.0, -5.0));
    const Eigen::Vector3d along = vector_in_cube(random).normalized(),
                          up = along.cross(vector_in_cube(random)).normalized(), aside = along.cross(up);
    a << -along, along * random.uniform(0.9, 1.1), -0.5 * up - 0.1 * aside;
    b << -1.05 * along + 0.05 * up - turn * aside, along + 0.05 * up + turn * random.uniform(0.7, 1.3) * aside,
        0.6 * up + 0.2 * aside;
  }
};

std::uint64_t hash_in(const CallersMode&, World& world) { return world.detect().hash(); }

TEST(FloatingPointModes, OfTheCallerChangeNoPointsOfNearlyParallelEdges) {
  Random random(1);
  const Eigen::Matrix3Xi facet = Eigen::Vector3i(0, 1, 2);
  int edge_points = 0;
  for (int i = 0; i < 200; ++i) {
    const NearlyParallelEdges edges(random);
    std::vector<std::uint64_t> hashes;
    for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      for (const unsigned x87_precision : {3u, 2u, 0u}) {  // of 64, 53 and 24 digits
        World world({.threads = 1, .outputs = {.points = true}});
        for (const Eigen::Matrix3Xd* positions : {&edges.a, &edges.b})
          world.add_body({.positions = *positions, .facets = facet, .surface = Surface::sheet, .margin = 0.1});
        hashes.push_back(hash_in(CallersMode(rounding, x87_precision), world));
        if (hashes.size() > 1) continue;
        for (const Contact& contact : world.detect().contacts()) {
          for (const ContactPoint& point : contact.points()) edge_points += point.kind == FeaturePair::edge_edge;
        }
      }
    }
    for (const std::uint64_t hash : hashes) ASSERT_EQ(hash, hashes.front()) << "pair " << i;
  }
  EXPECT_GT(edge_points, 50);
}

// The box of a body that touches another one's only as rounding has it.
TEST(FloatingPointModes, OfTheCallerChangeNoMargin) {
  const Eigen::Matrix3Xi facet = Eigen::Vector3i(0, 1, 2);
  Eigen::Matrix3Xd x(3, 3);
  x << 0, 0, 0, 0, 1, 0, 0, 0, 1;
  x.row(0).array() += 1.0 / 3.0;
  for (int k = 1; k < 200; ++k) {
    std::vector<Bounds> bounds;
    for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      World world({.threads = 1});
      const BodyId body = world.add_body({.positions = x, .facets = facet, .surface = Surface::sheet});
      {
        const CallersMode mode(rounding, 3);
        world.set_margin(body, 0.1 + k * 1e-3);
      }
      bounds.push_back(world.bounds(body));
    }
    for (const Bounds& one : bounds) {
      EXPECT_EQ(one.lower, bounds.front().lower) << k;
      EXPECT_EQ(one.upper, bounds.front().upper) << k;
    }
  }
}

}  // namespace
}  // namespace tact::tests
