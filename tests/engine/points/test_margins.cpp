// Margins, contact points and contact of a body with itself, through the world.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

BodyDefinition definition(const Mesh& mesh, double margin) {
  return {.positions = mesh.positions, .facets = mesh.facets, .margin = margin};
}

TEST(Margins, HullsNearerThanTheirSumAreInContact) {
  World world;
  const Mesh left = cube(1.0, {0, 0, 0});
  world.add_body(definition(left, 0.1));
  const BodyId b = world.add_body(definition(cube(1.0, {1.25, 0, 0}), 0.2));
  const Report& report = world.detect();
  ASSERT_EQ(report.contacts().size(), 1u);
  const Contact& contact = report.contacts()[0];
  EXPECT_NEAR(contact.depth, -0.25, 1e-15);
  EXPECT_NEAR(contact.direction.x(), 1.0, 1e-12);
  EXPECT_NEAR(contact.plane_a, 0.5, 1e-12);
  EXPECT_NEAR(contact.plane_b, 0.75, 1e-12);
  EXPECT_FALSE(contact.touching());
  ASSERT_EQ(report.candidate_pairs().size(), 1u);
  EXPECT_FALSE(report.candidate_pairs()[0].hulls_overlap);
  world.set_positions(b, cube(1.0, {1.31, 0, 0}).positions);
  EXPECT_TRUE(world.detect().contacts().empty());
  world.set_margin(b, 0.25);
  EXPECT_EQ(world.detect().contacts().size(), 1u);
  EXPECT_EQ(world.margin(b), 0.25);
}

// An axis of the k-DOPs separates the bodies, but is asked only of pairs that are not in contact.
TEST(Margins, AContactOfNearBodiesEndsWithTheirMargins) {
  World world;
  const Mesh ball = icosphere(2);
  const BodyId a = world.add_body(definition(ball, 0.2));
  const BodyId b = world.add_body(definition(translated(ball, {-1.6, -1.6, 0.0}), 0.2));
  ASSERT_EQ(world.detect().contacts().size(), 1u);
  world.set_margin(a, 0.0);
  world.set_margin(b, 0.0);
  const Report& report = world.detect();
  EXPECT_EQ(report.candidate_pairs().size(), 1u);
  EXPECT_EQ(report.contacts().size(), 0u);
  EXPECT_EQ(report.stats().contacts, 0);
}

// From apart through near to deep and back: no step in which the contact is lost.
TEST(Margins, AContactGoesThroughNearOnItsWay) {
  World world({.outputs = {.points = true}});
  world.add_body(definition(blob(2, 1.0, 0.2, 1), 0.05));
  const Mesh other = blob(2, 1.0, 0.2, 2);
  const BodyId b = world.add_body(definition(translated(other, {4, 0, 0}), 0.05));
  double last = -1.0;
  for (double x = 2.6; x > 1.2; x -= 0.01) {
    world.set_positions(b, translated(other, {x, 0.1, 0}).positions);
    const Report& report = world.detect();
    if (report.contacts().empty()) {
      EXPECT_EQ(last, -1.0) << x;
      continue;
    }
    const double depth = report.contacts()[0].depth;
    EXPECT_GE(depth, -0.1);
    if (last > -1.0) {
      EXPECT_NEAR(depth, last, 0.011) << x;
    }
    last = depth;
  }
  EXPECT_GT(last, 0.3);
}

// The contact stays while the hulls come to overlap and part again; what the candidate says of them does not.
TEST(Margins, CandidatesTellOverlapFromNear) {
  World world;
  world.add_body(definition(cube(1.0, {}), 0.1));
  const BodyId b = world.add_body(definition(cube(1.0, {1.05, 0, 0}), 0.1));
  for (const double x : {1.05, 0.95, 0.94, 1.05, 0.9}) {
    world.set_positions(b, cube(1.0, {x, 0, 0}).positions);
    const Report& report = world.detect();
    ASSERT_EQ(report.candidate_pairs().size(), 1u);
    EXPECT_EQ(report.candidate_pairs()[0].hulls_overlap, x < 1.0) << x;
    ASSERT_EQ(report.contacts().size(), 1u);
    EXPECT_EQ(report.contacts()[0].touching(), x < 1.0) << x;
  }
}

TEST(Margins, BadOnesAreRefusedByName) {
  World world;
  const Mesh mesh = cube(1.0, {});
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1e-300, kInfinity, std::nan(""), 0x1.8p300}) {
    EXPECT_TRUE(throws_error([&] { world.add_body(definition(mesh, bad)); }, ErrorCode::invalid_argument,
                             {"body 0", "margin"}));
  }
  const BodyId body = world.add_body(definition(mesh, 0x1p300));
  EXPECT_TRUE(throws_error([&] { world.set_margin(body, -1.0); }, ErrorCode::invalid_argument, {"body 0", "-1"}));
  EXPECT_EQ(world.margin(body), 0x1p300);
  EXPECT_EQ(world.body_count(), 1u);
}

Mesh folded_sheet(double radius) {
  return mapped(sheet(60, 10, 1.2, 0.2), [&](Vec3 p) {
    const double half = 2.0 * radius;  // a crease of straight walls
    if (p.x < -half) return Vec3{p.x + half, p.y, -radius};
    if (p.x > half) return Vec3{half - p.x, p.y, radius};
    return Vec3{radius * (1.0 - std::abs(p.x) / half), p.y, 0.5 * p.x};
  });
}

TEST(SelfContact, GivesPointsOfOneBodyWithItself) {
  World world({.threads = 2, .outputs = {.points = true}});
  const Mesh folded = folded_sheet(0.02);
  const BodyId id = world.add_body({.positions = folded.positions,
                                    .facets = folded.facets,
                                    .surface = Surface::sheet,
                                    .margin = 0.025,
                                    .self_contact = true});
  const Report& report = world.detect();
  ASSERT_EQ(report.contacts().size(), 1u);
  const Contact& contact = report.contacts()[0];
  EXPECT_EQ(contact.a, id);
  EXPECT_EQ(contact.b, id);
  EXPECT_EQ(contact.depth, 0.0);
  EXPECT_TRUE(contact.facet_pairs().empty());
  EXPECT_GT(contact.points().size(), 100u);
  world.set_self_contact(id, false);
  EXPECT_TRUE(world.detect().contacts().empty());
  world.set_self_contact(id, true);
  EXPECT_EQ(world.detect().contacts().size(), 1u);
  world.remove_body(id);
  EXPECT_TRUE(world.detect().contacts().empty());
}

// Contacts with itself stand in order among the others, and keep their results while nothing of theirs moves.
TEST(SelfContact, StandsInOrderAmongPairs) {
  World world({.outputs = {.points = true}});
  const Mesh folded = folded_sheet(0.02);
  std::vector<BodyId> ids;
  for (int k = 0; k < 4; ++k) {
    const Mesh moved = translated(folded, {0.3 * k, 0.0, 0.0});
    ids.push_back(world.add_body({.positions = moved.positions,
                                  .facets = moved.facets,
                                  .surface = Surface::sheet,
                                  .margin = 0.025,
                                  .self_contact = k != 1}));
  }
  const auto pairs_of = [](const Report& report) {
    std::vector<std::pair<BodyId, BodyId>> pairs;
    for (const Contact& contact : report.contacts()) pairs.emplace_back(contact.a, contact.b);
    return pairs;
  };
  const auto pairs = pairs_of(world.detect());
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  EXPECT_EQ(std::ranges::count_if(pairs, [](const auto& pair) { return pair.first == pair.second; }), 3);
  EXPECT_GT(pairs.size(), 4u);
  const std::uint64_t hash = world.detect().hash();
  for (int k = 0; k < 3; ++k) {
    world.set_positions(ids[0], translated(folded, {0.001, 0.0, 0.0}).positions);
    world.detect();
    world.set_positions(ids[0], folded.positions);
    const Report& back = world.detect();
    EXPECT_EQ(pairs_of(back), pairs);
    ASSERT_NE(back.find_contact(ids[3], ids[3]), nullptr);
    EXPECT_FALSE(back.find_contact(ids[3], ids[3])->points().empty());
  }
  EXPECT_NE(hash, 0u);
}

TEST(ContactPoints, AreTheSameBitsForAnyNumberOfThreads) {
  std::set<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    World world({.threads = threads, .outputs = {.points = true}});
    const Mesh lower = wrinkled_sheet(60, 2.0, 0.2, 3),
               upper = translated(wrinkled_sheet(50, 2.0, 0.2, 4), {0, 0, 0.05});
    world.add_body({.positions = lower.positions,
                    .facets = lower.facets,
                    .surface = Surface::sheet,
                    .margin = 0.03,
                    .self_contact = true});
    world.add_body({.positions = upper.positions,
                    .facets = upper.facets,
                    .surface = Surface::sheet,
                    .margin = 0.03,
                    .self_contact = true});
    const Report& report = world.detect();
    ASSERT_FALSE(report.contacts().empty());
    EXPECT_GT(report.find_contact(report.candidate_pairs()[0].a, report.candidate_pairs()[0].b)->points().size(), 500u);
    hashes.insert(report.hash());
  }
  EXPECT_EQ(hashes.size(), 1u);
}

TEST(ContactPoints, KeepTheirIdWhileTheirFeaturesAreNear) {
  World world({.outputs = {.points = true}});
  const Mesh floor = sheet(4, 4, 4.0, 4.0), tip = spike({0.1, 0.2, -1.0}, 0.1);
  world.add_body({.positions = floor.positions, .facets = floor.facets, .surface = Surface::sheet, .margin = 0.1});
  const BodyId b = world.add_body(definition(tip, 0.1));
  std::set<std::uint64_t> ids;
  for (int step = 0; step < 5; ++step) {
    world.set_positions(b, translated(tip, {0.01 * step, 0.0, 1.1 + 0.01 * step}).positions);
    const Report& report = world.detect();
    ASSERT_EQ(report.contacts().size(), 1u);
    ASSERT_EQ(report.contacts()[0].points().size(), 1u);
    EXPECT_NEAR(report.contacts()[0].points()[0].gap, 0.1 + 0.01 * step, 1e-14);
    ids.insert(report.contacts()[0].points()[0].id);
  }
  EXPECT_EQ(ids.size(), 1u);
  world.set_settings({});
  EXPECT_TRUE(world.detect().contacts()[0].points().empty());
}

}  // namespace
}  // namespace tact::tests
