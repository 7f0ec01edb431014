// At `exact`, the facet pairs are those of the oracle: no more, no fewer, on every kind of body.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/generators/messy_soups.h"

namespace tact::tests {
namespace {

class FacetPairsOfKind : public ::testing::TestWithParam<BodyPairKind> {
 protected:
  static constexpr std::uint64_t kSeeds = 12;
};

std::vector<MeetingBodies> swapped(std::vector<MeetingBodies> meeting) {
  for (MeetingBodies& pair : meeting) {
    for (FacetPair& f : pair.facet_pairs) std::swap(f.a, f.b);
    std::sort(pair.facet_pairs.begin(), pair.facet_pairs.end());
  }
  return meeting;
}

TEST_P(FacetPairsOfKind, EqualOracle) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    ASSERT_TRUE(engine_agrees_with_oracle(GetParam().make(seed))) << "seed " << seed;
  }
}

// Neither the direction, nor what is asked for besides, may change a facet pair.
TEST_P(FacetPairsOfKind, EqualOracleForOtherSettings) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Mesh> bodies = GetParam().make(seed);
    const std::vector<MeetingBodies> expected = meeting_bodies_by_oracle(bodies);
    for (const Settings& settings : {Settings{.gjk_tolerance = 0.1, .iteration_limit = 1},
                                     Settings{.direction = DirectionPolicy::smallest, .outputs = {.patches = true}},
                                     Settings{.threads = 2, .outputs = {.zones = true}}}) {
      ASSERT_TRUE(same_meeting_bodies(expected, meeting_bodies_by_engine(bodies, settings))) << "seed " << seed;
    }
  }
}

TEST_P(FacetPairsOfKind, ArePartOfOracleAtPaper) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Mesh> bodies = GetParam().make(seed);
    const std::vector<FacetPair> all = facet_pairs_by_oracle(bodies[0], bodies[1]);
    const std::vector<FacetPair> found = facet_pairs_by_engine(bodies[0], bodies[1], {.accuracy = Accuracy::paper});
    ASSERT_TRUE(std::ranges::includes(all, found)) << "seed " << seed;
  }
}

TEST_P(FacetPairsOfKind, AreTurnedWhenBodiesAreSwapped) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Mesh> bodies = GetParam().make(seed);
    const std::vector<MeetingBodies> there = meeting_bodies_by_engine(bodies);
    const std::vector<MeetingBodies> back = meeting_bodies_by_engine(std::array{bodies[1], bodies[0]});
    ASSERT_TRUE(same_meeting_bodies(there, swapped(back))) << "seed " << seed;
  }
}

TEST_P(FacetPairsOfKind, StayTheSameWhenVerticesAndFacetsAreRenumbered) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Mesh> bodies = GetParam().make(seed);
    const std::vector<FacetPair> expected = facet_pairs_by_engine(bodies[0], bodies[1]);
    Random random(seed);
    std::array<std::vector<int>, 2> facets;
    std::array<Mesh, 2> renumbered;
    for (std::size_t i = 0; i < 2; ++i) {
      facets[i] = random.permutation(bodies[i].facet_count());
      renumbered[i] = permuted(bodies[i], random.permutation(bodies[i].vertex_count()), facets[i]);
    }
    std::vector<FacetPair> found = facet_pairs_by_engine(renumbered[0], renumbered[1]);
    for (FacetPair& f : found) {
      f = {facets[0][f.a], facets[1][f.b]};
    }
    std::sort(found.begin(), found.end());
    ASSERT_TRUE(same_facet_pairs(expected, found)) << "seed " << seed;
  }
}

TEST_P(FacetPairsOfKind, StayTheSameUnderScalingByPowersOfTwo) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Mesh> bodies = GetParam().make(seed);
    const std::vector<FacetPair> expected = facet_pairs_by_engine(bodies[0], bodies[1]);
    for (const int exponent : {-280, -30, 1, 70, 280}) {
      const double factor = std::ldexp(1.0, exponent);
      const std::vector<FacetPair> found = facet_pairs_by_engine(scaled(bodies[0], factor), scaled(bodies[1], factor));
      ASSERT_TRUE(same_facet_pairs(expected, found)) << "seed " << seed << ", 2^" << exponent;
    }
  }
}

TEST_P(FacetPairsOfKind, StayTheSameUnderExactTranslation) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    std::vector<Mesh> bodies = GetParam().make(seed);
    for (Mesh& body : bodies) body = snapped(std::move(body), 0x1p-20);
    const std::vector<FacetPair> expected = facet_pairs_by_engine(bodies[0], bodies[1]);
    for (const Vec3 by : {Vec3{1.0, 0.0, 0.0}, Vec3{-0x1p10, 0x1p3, 0.0}, Vec3{0x1p30, -0x1p31, 0x1p27}}) {
      const std::vector<FacetPair> found = facet_pairs_by_engine(translated(bodies[0], by), translated(bodies[1], by));
      ASSERT_TRUE(same_facet_pairs(expected, found)) << "seed " << seed << ", by " << by.x;
    }
  }
}

TEST_P(FacetPairsOfKind, EqualOracleFarFromOrigin) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    std::vector<Mesh> bodies = GetParam().make(seed);
    // 1e8 away, a metre is some 1e8 units in the last place; 1e15 away only a few, and most facets are crumpled.
    for (const double far : {1e4, 1e8, 1e15}) {
      for (Mesh& body : bodies) body = translated(std::move(body), {far, -0.7 * far, 0.3 * far});
      ASSERT_TRUE(engine_agrees_with_oracle(bodies)) << "seed " << seed << ", at " << far;
    }
  }
}

TEST_P(FacetPairsOfKind, EqualOracleWhenStretchedToSlivers) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    std::vector<Mesh> bodies = GetParam().make(seed);
    for (Mesh& body : bodies) body = stretched(std::move(body), {1e6, 1.0, 1e-6});
    ASSERT_TRUE(engine_agrees_with_oracle(bodies)) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FacetPairsOfKind,
                         ::testing::ValuesIn(body_pair_kinds().begin(), body_pair_kinds().end()),
                         [](const auto& instance) { return instance.param.name; });

// What is apart, and what lies outside the slab, must be certified: here the rounded dot products err in every few
// pairs.
TEST(FacetPairs, OfKissingBodiesEqualOracle) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const std::vector<Mesh> bodies = kissing_bodies(seed);
    const std::vector<FacetPair> expected = facet_pairs_by_oracle(bodies[0], bodies[1]);
    ASSERT_FALSE(expected.empty()) << "seed " << seed;
    for (const bool zones : {false, true}) {
      const Settings settings{.outputs = {.zones = zones}};
      ASSERT_TRUE(same_facet_pairs(expected, facet_pairs_by_engine(bodies[0], bodies[1], settings))) << "seed " << seed;
    }
    // Again, from a separating direction of the step before.
    World world;
    const std::vector<BodyId> ids =
        add_bodies(world, std::array{bodies[0], translated(bodies[1], {0.001, 0.0, 0.002})});
    world.detect();
    world.set_positions(ids[1], bodies[1].positions);
    const std::vector<MeetingBodies> found = meeting_bodies(world.detect(), ids);
    ASSERT_EQ(found.size(), 1u) << "seed " << seed;
    ASSERT_TRUE(same_facet_pairs(expected, found[0].facet_pairs)) << "seed " << seed;
  }
}

// Where squares vanish, and where products and coordinates themselves are subnormal.
TEST(FacetPairs, OfTinyKissingBodiesEqualOracle) {
  std::size_t meeting = 0;
  for (const int exponent : {-520, -600, -1000, -1040}) {
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
      std::vector<Mesh> bodies = kissing_bodies(seed);
      for (Mesh& body : bodies) body = scaled(std::move(body), std::ldexp(1.0, exponent));
      const std::vector<FacetPair> expected = facet_pairs_by_oracle(bodies[0], bodies[1]);
      meeting += expected.empty() ? 0 : 1;
      for (const bool zones : {false, true}) {
        const Settings settings{.outputs = {.zones = zones}};
        ASSERT_TRUE(same_facet_pairs(expected, facet_pairs_by_engine(bodies[0], bodies[1], settings)))
            << "seed " << seed << ", 2^" << exponent;
      }
    }
  }
  EXPECT_GT(meeting, 1500u);
}

// Soups as broken files hold them, at some 10⁴ m; here whole, then each facet a body of its own.
TEST(FacetPairs, OfMessySoupsEqualOracle) {
  std::size_t meeting = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    const std::vector<Mesh> bodies = messy_soups(seed % 10 == 0 ? 800 : 60, seed);
    const std::vector<FacetPair> expected = facet_pairs_by_oracle(bodies[0], bodies[1]);
    meeting += expected.size();
    ASSERT_TRUE(same_facet_pairs(expected, facet_pairs_by_engine(bodies[0], bodies[1]))) << "seed " << seed;
    ASSERT_TRUE(same_facet_pairs(
        expected, facet_pairs_by_engine(bodies[0], bodies[1], {.gjk_tolerance = 0.1, .iteration_limit = 1})))
        << "seed " << seed << ", limits reached";
  }
  EXPECT_GT(meeting, 20000u);
}

TEST(FacetPairs, OfFacetsOfMessySoupsEqualOracle) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    std::vector<Mesh> facets;
    for (const Mesh& soup : messy_soups(80, seed)) {
      for (int f = 0; f < soup.facet_count(); ++f) {
        MeshBuilder builder;
        builder.triangle(soup.position(soup.facets(0, f)), soup.position(soup.facets(1, f)),
                         soup.position(soup.facets(2, f)));
        facets.push_back(builder.mesh());
      }
    }
    ASSERT_TRUE(engine_agrees_with_oracle(facets)) << "seed " << seed;
  }
}

TEST(FacetPairs, OfHundredsOfBlobsEqualOracle) {
  EXPECT_TRUE(engine_agrees_with_oracle(crowd_of_blobs(400, 1)));
  EXPECT_TRUE(engine_agrees_with_oracle(crowd_of_blobs(150, 2), {.threads = 1}));
}

TEST(FacetPairs, OfMixedCrowdsEqualOracle) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    EXPECT_TRUE(engine_agrees_with_oracle(mixed_crowd(120, 1000 * seed))) << "seed " << seed;
  }
}

// Every face is shared exactly with neighbours: coplanar facets, common edges and corners only.
TEST(FacetPairs, OfBrickWallEqualOracle) { EXPECT_TRUE(engine_agrees_with_oracle(brick_wall(12, 20))); }

TEST(FacetPairs, OfNestedSpheresAreNone) {
  const std::vector<Mesh> spheres = nested_spheres(60);
  World world;
  add_bodies(world, spheres);
  const Report& report = world.detect();
  EXPECT_EQ(report.contacts().size(), 60u * 59u / 2u);
  for (const Contact& contact : report.contacts()) EXPECT_FALSE(contact.touching());
}

TEST(FacetPairs, OfLargeBodiesEqualOracle) {
  const Mesh a = blob(5, 1.0, 0.3, 1);  // 20480 facets
  const Mesh b = translated(blob(5, 1.0, 0.3, 2), {1.1, 0.3, 0.0});
  EXPECT_TRUE(engine_agrees_with_oracle(a, b));
  const Mesh cloth = translated(wrinkled_sheet(120, 3.0, 0.7, 3), {0.0, 0.0, 0.2});  // 28800 facets
  EXPECT_TRUE(engine_agrees_with_oracle(cloth, a));
}

// A pair that is shared out among threads, and one whose clusters are so many that trees find their pairs.
TEST(FacetPairs, OfVeryLargeBodiesEqualOracle) {
  const std::array soups = {soup(12000, 1.0, 1), soup(10000, 1.0, 2)};
  const std::array sheets = {wrinkled_sheet(190, 2.0, 0.02, 3), wrinkled_sheet(190, 2.0, 0.02, 4)};
  for (const int threads : {1, 2}) {
    World world({.threads = threads}), other({.threads = threads});
    const std::vector<BodyId> ids = add_bodies(world, soups), other_ids = add_bodies(other, sheets);
    const Report &report = world.detect(), &other_report = other.detect();
    EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(soups), meeting_bodies(report, ids)));
    EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(sheets), meeting_bodies(other_report, other_ids)));
    EXPECT_GT(report.stats().cluster_pairs, 4096);  // or the test would not show what it is for
    EXPECT_EQ(other_report.stats().tree_pairs, 1);
  }
}

// Boxes, caches and separating directions are carried from step to step: none may go stale.
TEST(FacetPairs, OfMovingBodiesEqualOracleInEveryStep) {
  std::vector<Mesh> bodies = crowd_of_blobs(40, 7);
  bodies.push_back(wrinkled_sheet(20, 5.0, 0.6, 7));
  Random random(7);
  std::vector<Vec3> velocities;
  for (std::size_t i = 0; i < bodies.size(); ++i) velocities.push_back(0.2 * random.in_ball());
  World world;
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  for (int step = 0; step < 15; ++step) {
    ASSERT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(bodies), meeting_bodies(world.detect(), ids)))
        << "step " << step;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (random.chance(0.3)) continue;
      bodies[i] = jittered(translated(bodies[i], velocities[i]), 0.01, random.bits());
      world.set_positions(ids[i], bodies[i].positions);
    }
  }
}

// A vertex that no facet uses does not count, wherever it is.
TEST(FacetPairs, IgnoreUnusedVertices) {
  const Mesh a = icosphere(1);
  const Mesh b = translated(a, {1.5, 0.0, 0.0});
  Mesh spoiled = b;
  spoiled.positions.conservativeResize(3, b.vertex_count() + 2);
  spoiled.positions.col(b.vertex_count()) << -1e9, 0.0, 1e9;
  spoiled.positions.col(b.vertex_count() + 1) << 0.0, 0.0, 0.0;
  EXPECT_TRUE(same_facet_pairs(facet_pairs_by_oracle(a, b), facet_pairs_by_engine(a, spoiled)));
  const Mesh apart = translated(spoiled, {3.0, 0.0, 0.0});
  World world;
  add_bodies(world, std::array{a, apart});
  EXPECT_TRUE(world.detect().candidate_pairs().empty());
}

TEST(FacetPairs, OfRepeatedFacetsAreRepeated) {
  const Mesh a = merged(std::array{icosphere(0), icosphere(0), turned_inside_out(icosphere(0))});
  const Mesh b = translated(icosphere(0), {1.0, 0.0, 0.0});
  EXPECT_EQ(facet_pairs_by_engine(a, b).size(), 3 * facet_pairs_by_engine(icosphere(0), b).size());
  EXPECT_TRUE(engine_agrees_with_oracle(a, b));
}

TEST(FacetPairs, AreNoneAtHulls) {
  EXPECT_TRUE(facet_pairs_by_engine(icosphere(1), icosphere(1), {.accuracy = Accuracy::hulls}).empty());
}

}  // namespace
}  // namespace tact::tests
