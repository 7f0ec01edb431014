#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "narrowphase/triangles/triangle_triangle.h"
#include "tests/support/generators/random.h"
#include "tests/support/generators/triangle_pairs.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/oracles/triangle_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::all_orders;
using tests::available_kernels;
using tests::cgal_meet;
using tests::Filtered;
using tests::filtered;
using tests::hard_triangle_pair;
using tests::is_right;
using tests::TrianglePair;

constexpr std::uint64_t kPairSeed = 8051977;

bool meet(const Triangle& a, const Triangle& b) {
  PredicateCounts counts;
  return triangle_triangle_meet(a, b, counts);
}

constexpr int kAll = 72;

// How many of the 72 orders of corners and of arguments say that the triangles meet. The loops that the engine puts
// before the predicates must say the same, or nothing.
int orders_that_meet(const Triangle& a, const Triangle& b) {
  const auto orders = all_orders({a, b});
  int count = 0;
  for (const TrianglePair& pair : orders) count += meet(pair.a, pair.b);
  for (const Kernels* kernels : available_kernels()) {
    for (const auto half : {std::span(orders).first<kAll / 2>(), std::span(orders).last<kAll / 2>()}) {
      const std::vector<Filtered> found = filtered(*kernels, half);
      for (std::size_t i = 0; i < half.size(); ++i) {
        EXPECT_TRUE(is_right(found[i], half[i], count > 0)) << kernels->name << ' ' << to_string(half[i]);
      }
    }
  }
  return count;
}

constexpr Triangle kUnit{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};

struct KnownAnswer {
  Triangle a;
  Triangle b;
  bool meet;
};

void expect_known_answers(const std::vector<KnownAnswer>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(orders_that_meet(rows[i].a, rows[i].b), rows[i].meet ? kAll : 0) << "row " << i;
    EXPECT_EQ(cgal_meet(rows[i].a, rows[i].b), rows[i].meet) << "row " << i;
  }
}

// Embree, kernels/bvh/bvh_collider.cpp, collision_regression_test; its numbers are floats.
TEST(TriangleTriangle, EmbreeRegressionPairs) {
  constexpr double t = 0.1f;
  constexpr double z = -2.49875e-06f;
  expect_known_answers({
      {{Vec3{-0.008815f, 0.041848f, z}, Vec3{-0.008276f, 0.053318f, z}, Vec3{0.003023f, 0.048969f, z}},
       {Vec3{0.00245f, 0.037612f, z}, Vec3{0.01434f, 0.042634f, z}, Vec3{0.013499f, 0.031309f, z}},
       false},
      {kUnit, kUnit, true},
      {kUnit, {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0, 1, 1}}, false},
      {kUnit, {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}, true},
      {kUnit, {Vec3{0, 0, 0}, Vec3{1, 0, 1}, Vec3{0, 1, 1}}, true},
      {kUnit, {Vec3{t, t, 0}, Vec3{1, 0, 1}, Vec3{0, 1, 1}}, true},
      {kUnit, {Vec3{t, t, -t}, Vec3{1, 0, 1}, Vec3{0, 1, 1}}, true},
      {kUnit, kUnit, true},
      {kUnit, {Vec3{0, 0, 0}, Vec3{0.5, 0, 0}, Vec3{0, 0.5, 0}}, true},
      {kUnit, {Vec3{t, t, 0}, Vec3{0.5, 0, 0}, Vec3{0, 0.5, 0}}, true},
      {kUnit, {Vec3{t, t, 0}, Vec3{0.5, t, 0}, Vec3{t, 0.5, 0}}, true},
      {kUnit, {Vec3{t, -t, 0}, Vec3{0.5, t, 0}, Vec3{t, 0.5, 0}}, true},
      {kUnit, {Vec3{-t, t, 0}, Vec3{0.5, t, 0}, Vec3{t, 0.5, 0}}, true},
      {kUnit, {Vec3{-1, 1, 0}, Vec3{-1 + t, 1, 0}, Vec3{-1, 1 + t, 0}}, false},
      {kUnit, {Vec3{2, 0.5, 0}, Vec3{2 + t, 0.5, 0}, Vec3{2, 0.5 + t, 0}}, false},
      {kUnit, {Vec3{0.5, -2, 0}, Vec3{0.5 + t, -2, 0}, Vec3{0.5, -2 + t, 0}}, false},
  });
}

// libigl, tests/include/igl/tri_tri_intersect.cpp: they meet along (0, 0, 0)–(0.5, 0.5, 0).
TEST(TriangleTriangle, LibiglObliquePairs) {
  for (int shift = -1000; shift <= 1000; shift += 100) {
    const double s = shift;
    EXPECT_EQ(orders_that_meet(kUnit, {Vec3{s, 0, 1}, Vec3{1, 1, 0}, Vec3{-s, 0, -1}}), kAll) << "shift " << shift;
  }
}

// libigl, tests/include/igl/predicates/triangle_triangle_intersect.cpp (libigl#2381, #2382): apart, and found to meet
// by the test of Guigue and Devillers in plain doubles.
TEST(TriangleTriangle, LibiglFalsePositives) {
  expect_known_answers({
      {{Vec3{0.39234799146652199, 0.38443601131439198, 0.44744500517845198},
        Vec3{0.39079749584197976, 0.38503675907850249, 0.45253425091505073},
        Vec3{0.38700349628925301, 0.38789276033639897, 0.45634675025939975}},
       {Vec3{0.38924700021743752, 0.385637506842613, 0.45762349665164948},
        Vec3{0.39279749989509577, 0.37299175560474374, 0.45553924888372399},
        Vec3{0.38769650459289529, 0.38623825460672351, 0.46271274238824822}},
       false},
      {{Vec3{0.30947001278400399, 0.80785250663757346, 0.47595100104808802},
        Vec3{0.31897351145744302, 0.79302775859832797, 0.48327925056219101},
        Vec3{0.32418551295995701, 0.79794725775718722, 0.48203899711370451}},
       {Vec3{0.299046009778976, 0.79801350831985496, 0.47843150794506101},
        Vec3{0.31376150995492902, 0.78810825943946872, 0.4845195040106775},
        Vec3{0.30425801128148999, 0.80293300747871421, 0.47719125449657451}},
       false},
  });
}

// libigl, tests/include/igl/triangle_triangle_intersect.cpp: two triangles with the edge (0, 0, 0)–(0, 1, 0) in common,
// spread flat or folded onto each other. libigl asks whether they meet outside that edge; as closed sets they always
// do.
TEST(TriangleTriangle, LibiglSharedEdgeFolded) {
  for (const double x : {-1.0, 2.0, 2.0 + 1e-15, 2.0 - 1e-15}) {
    EXPECT_EQ(orders_that_meet(kUnit, {Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{x, 0, 0}}), kAll) << "x " << x;
  }
}

TEST(TriangleTriangle, FailuresReportedOfOtherLibraries) {
  expect_known_answers({
      // axom#152: 6 of 36 orders of corners found no intersection.
      {{Vec3{76.648, 54.6752, 15.0012}, Vec3{76.648, 54.6752, 14.5542}, Vec3{76.582, 54.6752, 14.7879}},
       {Vec3{76.6252, 54.6752, 14.892}, Vec3{76.582, 54.6752, 14.7879}, Vec3{76.5617, 54.6752, 14.7929}},
       true},
      // benardp/contours#1: apart, found to meet.
      {{Vec3{12.3015, -0.253368, 5.49101}, Vec3{18.6765, -2.55337, 4.91756}, Vec3{12.3015, -2.55337, 4.91756}},
       {Vec3{-11.9885, -0.253368, 5.49101}, Vec3{1.61448, -0.253368, 5.49101}, Vec3{1.61448, -2.55337, 4.91756}},
       false},
      // geogram#10: apart, ended in an assertion.
      {{Vec3{1898.68, 775, 1158.48}, Vec3{2000, 775, 1166.7}, Vec3{1898.68, 675, 1148.6}},
       {Vec3{1966.41, 675, 1163.79}, Vec3{1971.63, 675, 1166.95}, Vec3{1967.56, 684.554, 1166.67}},
       false},
      // parry#76: a point and a triangle without area, 0.17147861 apart, found to meet. The numbers are floats.
      {{Vec3{2.27699995f, -7.9000001f, 16.3180008f}, Vec3{-0.569999993f, -8.10000038f, 16.6070004f},
        Vec3{-0.569999993f, -8.10000038f, 16.6070004f}},
       {Vec3{1.10000002f, -7.9000001f, 16.5879993f}, Vec3{1.10000002f, -7.9000001f, 16.5879993f},
        Vec3{1.10000002f, -7.9000001f, 16.5879993f}},
       false},
      // parry#75: a point 0.156 from a triangle, found to be in it.
      {{Vec3{21.94f, 3.7f, 0.0f}, Vec3{22.255f, 3.7f, -0.315f}, Vec3{22.255f, 3.5f, -0.315f}},
       {Vec3{22.01f, 3.7f, -0.291f}, Vec3{22.01f, 3.7f, -0.291f}, Vec3{22.01f, 3.7f, -0.291f}},
       false},
  });
}

TEST(TriangleTriangle, CornerOnFaceMeetsAndOneUlpAboveDoesNot) {
  const Vec3 left{0, 0, 1}, right{1, 1, 1};
  const double up = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{0.25, 0.25, 0}, left, right}), kAll);
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{0.25, 0.25, up}, left, right}), 0);
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{0.25, 0.25, -up}, left, right}), kAll);
}

TEST(TriangleTriangle, CornerOnEdgeMeetsAndOneUlpBeyondDoesNot) {
  const Vec3 left{1, 1, 1}, right{1, 1, -1};
  const double beyond = std::nextafter(0.5, 1.0);
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{0.5, 0.5, 0}, left, right}), kAll);
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{0.5, beyond, 0}, left, right}), 0);
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{0, 0, 0}, Vec3{0, 0, 1}, Vec3{-1, -1, 0}}), kAll);
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{-1e-300, 0, 0}, Vec3{0, 0, 1}, Vec3{-1, -1, 0}}), 0);
}

TEST(TriangleTriangle, CoplanarContainmentMeets) {
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{0.125, 0.125, 0}, Vec3{0.25, 0.125, 0}, Vec3{0.125, 0.25, 0}}), kAll);
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{-9, -9, 0}, Vec3{9, -9, 0}, Vec3{0, 9, 0}}), kAll);
}

// A star of David: no corner of one is in the other.
TEST(TriangleTriangle, CoplanarCrossingWithoutCornersInsideMeets) {
  EXPECT_EQ(
      orders_that_meet({Vec3{0, 0, 3}, Vec3{6, 0, 3}, Vec3{3, 6, 3}}, {Vec3{0, 4, 3}, Vec3{6, 4, 3}, Vec3{3, -2, 3}}),
      kAll);
}

TEST(TriangleTriangle, CoplanarSharedEdgeMeetsAndOneUlpApartDoesNot) {
  const double apart = -std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}}), kAll);
  EXPECT_EQ(orders_that_meet(kUnit, {Vec3{apart, 0, 0}, Vec3{apart, 1, 0}, Vec3{-1, 0, 0}}), 0);
}

TEST(TriangleTriangle, TriangleWithoutAreaIsASegmentOrAPoint) {
  const Vec3 above{0.25, 0.25, 1}, on{0.25, 0.25, 0}, below{0.25, 0.25, -1}, out{2, 2, 0};
  EXPECT_EQ(orders_that_meet(kUnit, {above, below, on}), kAll);  // collinear, through the face
  EXPECT_EQ(orders_that_meet(kUnit, {above, above, below}), kAll);
  EXPECT_EQ(orders_that_meet(kUnit, {above, on, on}), kAll);  // ends on the face
  EXPECT_EQ(orders_that_meet(kUnit, {on, on, on}), kAll);     // a point of the face
  EXPECT_EQ(orders_that_meet(kUnit, {on, out, out}), kAll);   // in its plane, out of it
  EXPECT_EQ(orders_that_meet(kUnit, {out, out, out}), 0);
  EXPECT_EQ(orders_that_meet(kUnit, {above, above, above}), 0);
  EXPECT_EQ(orders_that_meet({above, below, below}, {on, out, out}), kAll);  // two segments with a point in common
  EXPECT_EQ(orders_that_meet({above, below, below}, {on, on, on}), kAll);
  EXPECT_EQ(orders_that_meet({above, on, on}, {below, below, on}), kAll);  // end to end on one line
  EXPECT_EQ(orders_that_meet({above, above, above}, {on, on, below}), 0);  // apart on one line
  EXPECT_EQ(orders_that_meet({on, on, on}, {on, on, on}), kAll);
  EXPECT_EQ(orders_that_meet({on, on, on}, {out, out, out}), 0);
}

TEST(TriangleTriangle, FarPairsNeverNeedTheExactPath) {
  std::mt19937_64 random(kPairSeed);
  std::uniform_real_distribution<double> coordinate(0.0, 1.0);
  PredicateCounts counts;
  for (int i = 0; i < 10000; ++i) {
    Triangle a;
    for (Vec3& p : a) p = Vec3{40, 50, 60} + Vec3{coordinate(random), coordinate(random), coordinate(random)};
    EXPECT_FALSE(triangle_triangle_meet(kUnit, a, counts));
  }
  EXPECT_EQ(counts.exact, 0);
}

TEST(TriangleTriangle, HardPairsMeetWhereCgalSaysSo) {
  for (std::uint64_t i = 0; i < 300000; ++i) {
    const TrianglePair pair = hard_triangle_pair(kPairSeed, i);
    ASSERT_EQ(meet(pair.a, pair.b), cgal_meet(pair.a, pair.b))
        << "seed " << kPairSeed << " pair " << i << ' ' << to_string(pair);
  }
}

TEST(TriangleTriangle, OrderOfCornersAndArgumentsChangesNothing) {
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const TrianglePair pair = hard_triangle_pair(kPairSeed + 1, i);
    ASSERT_EQ(orders_that_meet(pair.a, pair.b), meet(pair.a, pair.b) ? kAll : 0)
        << "seed " << kPairSeed + 1 << " pair " << i << ' ' << to_string(pair);
  }
}

TEST(TriangleTriangle, RoundingModeChangesNothing) {
  const int saved = std::fegetround();
  for (std::uint64_t i = 0; i < 50000; ++i) {
    const TrianglePair pair = hard_triangle_pair(kPairSeed + 2, i);
    const bool expected = meet(pair.a, pair.b);
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      std::fesetround(mode);
      const bool met = meet(pair.a, pair.b);
      std::fesetround(saved);
      ASSERT_EQ(met, expected) << "mode " << mode << " seed " << kPairSeed + 2 << " pair " << i << ' '
                               << to_string(pair);
    }
  }
}

// The first two corners as a segment, the first as a point; the oracle takes them as triangles without area.
TEST(SegmentTriangle, HardPairsMeetWhereCgalSaysSo) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const TrianglePair pair = hard_triangle_pair(kPairSeed + 3, i);
    const Segment segment{pair.a[0], pair.a[1]};
    PredicateCounts counts;
    ASSERT_EQ(segment_triangle_meet(segment, pair.b, counts), cgal_meet({segment[0], segment[1], segment[1]}, pair.b))
        << "seed " << kPairSeed + 3 << " pair " << i << ' ' << to_string(pair);
  }
}

TEST(SegmentSegment, HardPairsMeetWhereCgalSaysSo) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const TrianglePair pair = hard_triangle_pair(kPairSeed + 5, i);
    const Segment a{pair.a[0], pair.a[1]}, b{pair.b[0], pair.b[1]};
    PredicateCounts counts;
    const bool expected = cgal_meet({a[0], a[1], a[1]}, {b[0], b[1], b[1]});
    ASSERT_EQ(segment_segment_meet(a, b, counts), expected)
        << "seed " << kPairSeed + 5 << " pair " << i << ' ' << to_string(pair);
    ASSERT_EQ(segment_segment_meet({b[1], b[0]}, a, counts), expected) << "seed " << kPairSeed + 5 << " pair " << i;
  }
}

// All orders in which `common` corners stand first in both.
bool meet_beyond(const Triangle& a, const Triangle& b, int common) {
  PredicateCounts counts;
  const bool expected = triangles_meet_beyond(a, b, common, counts);
  const auto in_another_order = [common](const Triangle& t, bool turns) -> Triangle {
    if (!turns) return t;
    return common == 1 ? Triangle{t[0], t[2], t[1]} : Triangle{t[1], t[0], t[2]};
  };
  for (int order = 0; order < 8; ++order) {
    // The common corners stay in one order, the others need not.
    Triangle p = in_another_order(a, (order & 1) != 0), q = in_another_order(b, (order & (common == 1 ? 2 : 1)) != 0);
    if ((order & 4) != 0) std::swap(p, q);
    EXPECT_EQ(triangles_meet_beyond(p, q, common, counts), expected) << to_string(TrianglePair{a, b});
  }
  return expected;
}

// In front of a facet with the corners (0, 0, 0), (1, 0, 0) and (0, 1, 0).
TEST(TrianglesBeyond, KnownAnswers) {
  struct Row {
    int common;
    Triangle b;
    bool meet;
  };
  const Vec3 o{0, 0, 0}, x{1, 0, 0};
  const std::vector<Row> rows{
      {1, {o, Vec3{0.25, 0.25, -1}, Vec3{0.25, 0.25, 1}}, true},  // runs through its inside
      {1, {o, Vec3{0.25, 0.25, 0}, Vec3{0.25, 0.25, 1}}, true},   // ends in it
      {1, {o, Vec3{2, 2, 0}, Vec3{2, 2, 1}}, true},               // stands on it
      {1, {o, Vec3{-1, -1, -1}, Vec3{-1, -1, 1}}, false},         // on the other side of the corner
      {1, {o, Vec3{-1, 0, 0}, Vec3{0, -1, 0}}, false},            // in its plane, beside it
      {1, {o, Vec3{2, 0, 0}, Vec3{1, -1, 0}}, true},              // an edge along its edge
      {1, {o, Vec3{0.5, 0, 0}, Vec3{1, -1, 0}}, true},            // a vertex inside its edge
      {1, {o, Vec3{0.5, 0, 0}, Vec3{1, -1, 1}}, true},            // the same from above
      {1, {o, Vec3{1, 1, 0}, Vec3{-1, 1, 0}}, true},              // overlaps in its plane
      {1, {o, Vec3{3, 1, 0}, Vec3{1, 3, 0}}, true},               // lies over all of it at the corner
      {1, {o, Vec3{1, 0, 1}, Vec3{0, 1, 1}}, false},              // above it
      {1, {o, Vec3{0.5, 0.5, 0}, Vec3{1, 1, 0}}, true},           // without area, along it
      {1, {o, Vec3{-1, -1, 0}, Vec3{0.5, 0.5, 0}}, true},         // without area, across the corner
      {1, {o, Vec3{-1, -1, 0}, Vec3{-2, -2, 0}}, false},          // without area, away from it
      {1, {o, o, Vec3{0.5, 0.5, 0}}, true},                       // a corner in the place of the common one
      {1, {o, o, o}, false},                                      // a point
      {2, {o, x, Vec3{0.25, 0.5, 0}}, true},                      // folded flat
      {2, {o, x, Vec3{5, 7, 0}}, true},                           // larger
      {2, {o, x, Vec3{0.25, -0.5, 0}}, false},                    // beside it
      {2, {o, x, Vec3{0.25, 0.5, 0x1p-1074}}, false},             // folded, and a little open
      {2, {o, x, Vec3{0.5, 0, 0}}, false},                        // without area, on the edge
      {2, {o, x, Vec3{2, 0, 0}}, false},                          // without area, beyond its end
      {3, {o, x, Vec3{0, 1, 0}}, true},                           // listed twice
  };
  const Triangle a{o, x, Vec3{0, 1, 0}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(meet_beyond(a, rows[i].b, rows[i].common), rows[i].meet) << "row " << i;
    EXPECT_EQ(tests::rational_meet_beyond(a, rows[i].b, rows[i].common), rows[i].meet) << "row " << i;
  }
  // Without area both: along a line only what goes on beyond the common edge.
  const Vec3 y{2, 0, 0}, z{3, 0, 0}, back{-1, 0, 0};
  EXPECT_TRUE(meet_beyond({o, x, y}, {o, x, z}, 2));
  EXPECT_FALSE(meet_beyond({o, x, y}, {o, x, back}, 2));
  EXPECT_FALSE(meet_beyond({o, x, y}, {o, x, x}, 2));
  EXPECT_FALSE(meet_beyond({o, x, y}, {o, x, y}, 3));
  EXPECT_TRUE(meet_beyond({o, o, x}, {o, o, y}, 2));
  EXPECT_FALSE(meet_beyond({o, o, x}, {o, o, Vec3{0, 1, 0}}, 2));
}

// On a grid of few places, so that what is in line, in one plane or in one place is common.
TEST(TrianglesBeyond, RandomPairsMeetWhereCgalConstructsMore) {
  tests::Random random(17);
  int meeting[4] = {};
  for (int i = 0; i < 12000; ++i) {
    const int grid = 2 + random.below(3), common = 1 + random.below(2);
    const bool is_flat = random.chance(0.3);
    const double unit = random.chance(0.5) ? 1.0 : random.uniform();  // rounded
    const auto corner = [&] {
      const auto coordinate = [&] { return unit * random.below(grid) + (unit == 1.0 ? 0.0 : 1.0 / 3.0); };
      return Vec3{coordinate(), coordinate(), is_flat ? 0.0 : coordinate()};
    };
    const Triangle a{corner(), corner(), corner()};
    const Triangle b{a[0], common == 2 ? a[1] : corner(), corner()};
    const bool expected = tests::rational_meet_beyond(a, b, common);
    meeting[common] += expected ? 1 : 0;
    ASSERT_EQ(meet_beyond(a, b, common), expected) << "pair " << i << ' ' << to_string(TrianglePair{a, b});
  }
  EXPECT_GT(meeting[1], 500);
  EXPECT_GT(meeting[2], 300);
}

}  // namespace
}  // namespace tact::narrowphase
