#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "narrowphase/distance/edge_edge.h"

namespace tact::narrowphase {
namespace {

// e lies along x; f is above the place s of e, at its own place t, and turned by as much as `turn` of its length.
struct TurnedEdges {
  EdgeEnds e, f;
  TurnedEdges(double s, double t, double turn, double length)
      : e{{-s, 0.0, 0.0}, {1.0 - s, 0.0, 0.0}},
        f{{-t * length, -t * length * turn, 0.0625}, {(1.0 - t) * length, (1.0 - t) * length * turn, 0.0625}} {}
};

// All coordinates are round, so the places are known exactly, to turns that long doubles do not see.
TEST(EdgeEdge, PlacesOfNearlyParallelEdgesAreRightToTheLastDigits) {
  for (int k = 10; k <= 44; ++k) {
    for (const double length : {1.0, 0x1p-20}) {
      if (length < 1.0 && k > 32) continue;  // there double-doubles do not tell either
      const TurnedEdges at(0.375, 0.625, std::ldexp(1.0, -k), length);
      const auto nearest = nearest_between_edges(at.e, {}, at.f, {}, 0.1);
      ASSERT_TRUE(nearest) << "turn 2^-" << k << ", length " << length;
      EXPECT_NEAR(nearest->first[1], 0.375, 0x1p-51) << "turn 2^-" << k << ", length " << length;
      EXPECT_NEAR(nearest->weight[1], 0.625, k < 14 ? 0x1p-30 : 0x1p-51) << "turn 2^-" << k << ", length " << length;
      EXPECT_NEAR(nearest->distance, 0.0625, 0x1p-56);
      EXPECT_NEAR(nearest->normal.z, 1.0, 0x1p-52);
    }
  }
}

TEST(EdgeEdge, ThereIsNoPlaceAtTheEndsNorBeyondNorBetweenParallels) {
  for (const double turn : {0.5, 0x1p-10, 0x1p-20, 0x1p-40, 0.0}) {
    for (const double place : {-0.5, 0.0, 1.0, 1.5}) {
      const TurnedEdges on_e(place, 0.5, turn, 1.0), on_f(0.5, place, turn, 1.0);
      EXPECT_FALSE(nearest_between_edges(on_e.e, {}, on_e.f, {}, 0.1)) << turn << " at " << place;
      EXPECT_FALSE(nearest_between_edges(on_f.e, {}, on_f.f, {}, 0.1)) << turn << " at " << place;
    }
    const TurnedEdges inside(0.5, 0.5, turn, 1.0);
    EXPECT_EQ(nearest_between_edges(inside.e, {}, inside.f, {}, 0.1).has_value(), turn > 0.0) << turn;
  }
}

// Edges may be far shorter than all else: products of their lengths vanish in doubles.
TEST(EdgeEdge, AreFoundHoweverShort) {
  for (const double length : {1e-30, 1e-60}) {
    const EdgeEnds e{{-length, 0.0, 0.0}, {length, 0.0, 0.0}}, f{{0.0, -length, 0.5}, {0.0, length, 0.5}};
    const auto nearest = nearest_between_edges(e, {}, f, {}, 1.0);
    ASSERT_TRUE(nearest) << length;
    EXPECT_EQ(nearest->distance, 0.5);
    EXPECT_EQ(nearest->first[1], 0.5);
    EXPECT_EQ(nearest->weight[1], 0.5);
  }
}

// Diagonals of two horizontal grids, far from the origin, where rounding turns them by 5e-14. The places are what
// rational numbers say.
TEST(EdgeEdge, NearlyParallelEdgesAreAsFarApartAsTheirPlaces) {
  const double low = 1334.171691325397, high = 1334.2431812004027;
  const EdgeEnds e{{574.41966697802673, 57.150535679720278, low}, {575.08633364469335, 57.817202346386949, low}},
      f{{574.8196669780267, 57.55053567972027, high}, {575.21966697802668, 57.95053567972031, high}};
  const std::vector<double> x{575.0, 574.0}, y{57.0, 58.0}, z_low{low, low}, z_high{high, high};
  const std::vector<int> both{0, 1};
  const auto nearest = nearest_between_edges(e, {{x.data(), y.data(), z_low.data()}, both},  //
                                             f, {{x.data(), y.data(), z_high.data()}, both}, 0.1);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->first[1], 7.0 / 9.0, 1e-6);
  EXPECT_NEAR(nearest->weight[1], 8.0 / 27.0, 1e-6);
  EXPECT_NEAR(nearest->distance, high - low, 1e-13);
  EXPECT_GT(nearest->normal.z, 1.0 - 1e-15);
  const Vec3 way =
      (nearest->weight[0] * f.p + nearest->weight[1] * f.q) - (nearest->first[0] * e.p + nearest->first[1] * e.q);
  EXPECT_NEAR(norm(way), high - low, 1e-12);
}

}  // namespace
}  // namespace tact::narrowphase
