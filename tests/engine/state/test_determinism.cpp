// The same bits for any number of threads, in every run, in every build.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/hashes/hash_scenes.h"
#include "tests/support/hashes/work_hash.h"

namespace tact::tests {
namespace {

class HashOfScene : public ::testing::TestWithParam<HashScene> {};

TEST_P(HashOfScene, IsTheSameForAnyNumberOfThreads) {
  const SceneHashes expected = GetParam().play(1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(GetParam().play(threads), expected) << threads << " threads";
}

TEST_P(HashOfScene, IsTheSameInEveryRun) {
  const SceneHashes expected = GetParam().play(0);
  for (int run = 0; run < 3; ++run) EXPECT_EQ(GetParam().play(0), expected);
}

// The constant holds for Debug and Release, GCC and clang, with and without SIMD kernels.
TEST_P(HashOfScene, IsTheOneThatIsExpected) { EXPECT_EQ(GetParam().play(2).answers, GetParam().expected); }

INSTANTIATE_TEST_SUITE_P(Scenes, HashOfScene, ::testing::ValuesIn(hash_scenes().begin(), hash_scenes().end()),
                         [](const auto& instance) { return instance.param.name; });

// A pair's answer does not depend on which other pairs there are, nor on which was asked first.
TEST(Determinism, PairsAnswerAsIfTheyWereAlone) {
  const std::vector<Mesh> bodies = crowd_of_blobs(20, 5);
  World world;
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  for (const Contact& contact : world.detect().contacts()) {
    World alone;
    add_bodies(alone, std::array{bodies[contact.a.index], bodies[contact.b.index]});
    const auto contacts = alone.detect().contacts();
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].direction, contact.direction);
    EXPECT_EQ(contacts[0].depth, contact.depth);
    EXPECT_EQ(contacts[0].plane_a, contact.plane_a);
    EXPECT_EQ(contacts[0].kept_facets_a, contact.kept_facets_a);
    EXPECT_TRUE(same_facet_pairs(contacts[0].facet_pairs(), contact.facet_pairs()));
  }
}

// Nor on the order of vertices and facets, and so on how facets were grouped into clusters: there are several.
TEST(Determinism, ContactsDoNotDependOnTheNumberingOfVerticesAndFacets) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::array bodies = {blob(2, 1.0, 0.2, seed), translated(blob(2, 0.8, 0.2, seed + 50), {1.2, 0.3, 0.1})};
    for (const Mesh& body : bodies) ASSERT_GT(body.facet_count(), 4 * 64);
    Random random(seed);
    std::array<Mesh, 2> renumbered;
    std::array<std::vector<int>, 2> facets;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::vector<int> vertices = random.permutation(bodies[i].vertex_count());
      facets[i] = random.permutation(bodies[i].facet_count());
      renumbered[i] = permuted(bodies[i], vertices, facets[i]);
    }
    World one, other;
    add_bodies(one, bodies);
    add_bodies(other, renumbered);
    const auto expected = one.detect().contacts(), found = other.detect().contacts();
    ASSERT_EQ(expected.size(), found.size());
    if (expected.empty()) continue;
    EXPECT_LT((expected[0].direction - found[0].direction).norm(), 1e-13) << "seed " << seed;
    EXPECT_NEAR(expected[0].depth, found[0].depth, 1e-14) << "seed " << seed;
    std::vector<FacetPair> pairs;
    for (const FacetPair& pair : found[0].facet_pairs()) {
      pairs.push_back({facets[0][pair.a], facets[1][pair.b]});
    }
    std::ranges::sort(pairs);
    EXPECT_TRUE(same_facet_pairs(expected[0].facet_pairs(), pairs)) << "seed " << seed;
  }
}

// So many threads that a cluster of one body, the floor's only one, is opened by more of them than a byte counts.
TEST(Determinism, AFloorUnderManyClustersCountsOnceForManyThreads) {
  const Mesh cloth = sheet(110, 110, 4.0, 4.0), floor = sheet(1, 1, 5.0, 5.0);
  ASSERT_GT(cloth.facet_count(), 300 * 64);
  const auto contact_for = [&](int threads) {
    World world({.threads = threads});
    add_bodies(world, std::array{cloth, floor});
    const auto contacts = world.detect().contacts();
    EXPECT_EQ(contacts.size(), 1u);
    return contacts.empty() ? Contact{} : contacts[0];
  };
  const Contact one = contact_for(1), many = contact_for(100);
  EXPECT_EQ(one.kept_facets_b, 2);
  EXPECT_EQ(many.kept_facets_b, 2);
  EXPECT_EQ(one.kept_facets_a, many.kept_facets_a);
}

TEST(Determinism, HashTellsAnswersApart) {
  const Mesh a = icosphere(1);
  std::vector<std::uint64_t> hashes;
  for (const double x : {0.5, 0.75, 1.0, 5.0}) {
    World world;
    add_bodies(world, std::array{a, translated(a, {x, 0.0, 0.0})});
    hashes.push_back(world.detect().hash());
  }
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end());
}

// What a step did to find an answer is not in its hash: a direction carried for a step takes fewer iterations and comes
// to the same direction.
TEST(Determinism, HashIsOfAnswersAlone) {
  const std::array bodies = {cube(1.0, {0, 0, 0}), cube(1.0, {0.9, 0.1, 0.05})};
  World fresh, zones({.outputs = {.zones = true}}), carried;
  add_bodies(fresh, bodies);
  add_bodies(zones, bodies);
  const std::vector<BodyId> ids = add_bodies(carried, bodies);
  carried.detect();
  carried.set_positions(ids[1], cube(1.0, {0.9, 0.1, 0.04}).positions);
  carried.detect();
  carried.set_positions(ids[1], bodies[1].positions);
  const Report &report = fresh.detect(), &later = carried.detect();
  ASSERT_NE(report.contacts()[0].source, later.contacts()[0].source);
  EXPECT_NE(work_hash(report), work_hash(later));
  EXPECT_EQ(report.hash(), later.hash());
  EXPECT_NE(report.hash(), zones.detect().hash());  // zones are answers
}

// Before the first step, and in a step in which nothing moved.
TEST(Determinism, HashStaysWhileNothingMoves) {
  World world;
  add_bodies(world, crowd_of_blobs(10, 1));
  const std::uint64_t expected = world.detect().hash();
  EXPECT_EQ(world.detect().hash(), expected);
  EXPECT_EQ(world.detect().hash(), expected);
}

}  // namespace
}  // namespace tact::tests
