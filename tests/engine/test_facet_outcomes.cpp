// What became of every facet of a contact: against the report's counts, and against geometry in long double.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "engine/facet_outcomes.h"
#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

using Vector = Eigen::Matrix<long double, 3, 1>;

constexpr std::array kBothAccuracies = {Accuracy::paper, Accuracy::exact};

// Folded sheets, and closed bodies with folds: all outcomes occur.
std::vector<Mesh> crowd(std::uint64_t seed) {
  return {blob(3, 1.0, 0.3, seed), translated(icosphere(3), {1.2, 0.4, 0.2}), wrinkled_sheet(24, 3.0, 0.3, seed),
          translated(torus(32, 16, 1.0, 0.4), {0.3, 0.9, 0.4})};
}

Settings with_zones(Accuracy accuracy, int threads = 1) {
  return {.threads = threads, .accuracy = accuracy, .outputs = {.zones = true}};
}

std::array<std::int64_t, kFacetOutcomes> counts_of(const std::vector<FacetOutcome>& outcomes) {
  std::array<std::int64_t, kFacetOutcomes> counts{};
  for (const FacetOutcome outcome : outcomes) ++counts[static_cast<std::size_t>(outcome)];
  return counts;
}

std::int64_t count(const std::vector<FacetOutcome>& outcomes, FacetOutcome outcome) {
  return std::count(outcomes.begin(), outcomes.end(), outcome);
}

std::vector<bool> facets_that_meet(const Contact& contact, int FacetPair::*side, std::size_t facets) {
  std::vector<bool> meets(facets, false);
  for (const FacetPair& pair : contact.facet_pairs()) meets[pair.*side] = true;
  return meets;
}

void expect_same_meeting_facets(const std::vector<FacetOutcome>& outcomes, const std::vector<bool>& meets) {
  ASSERT_EQ(outcomes.size(), meets.size());
  for (std::size_t i = 0; i < meets.size(); ++i) EXPECT_EQ(outcomes[i] == FacetOutcome::meets, meets[i]) << i;
}

// A net of edges and points over a ball, which has facets as well in one of two bodies.
TEST(FacetOutcomes, LeaveOutEdgesAndPointsAsTheCountsDo) {
  const Mesh ball = icosphere(2), other = translated(icosphere(2), {1.2, 0.1, 0.0});
  Eigen::Matrix2Xi edges(2, ball.facet_count());
  for (int f = 0; f < ball.facet_count(); ++f) edges.col(f) = ball.facets.col(f).head<2>();
  const std::vector<int> points{0, 3, 5, 11, 40};
  for (const Accuracy accuracy : kBothAccuracies) {
    for (const bool has_facets : {true, false}) {
      World world(with_zones(accuracy));
      world.add_body({.positions = ball.positions,
                      .facets = has_facets ? ball.facets : Eigen::Matrix3Xi(3, 0),
                      .edges = edges,
                      .points = points,
                      .surface = Surface::sheet});
      world.add_body({.positions = other.positions, .facets = other.facets});
      const Report& report = world.detect();
      ASSERT_EQ(report.contacts().size(), 1u);
      const Contact& contact = report.contacts()[0];
      const std::optional<FacetOutcomes> outcomes = FacetOutcomeFinder(report).find(contact);
      ASSERT_TRUE(outcomes);
      const auto kept = [&](const auto& of) { return count(of, FacetOutcome::kept) + count(of, FacetOutcome::meets); };
      EXPECT_EQ(kept(outcomes->a), contact.kept_facets_a);
      EXPECT_EQ(kept(outcomes->b), contact.kept_facets_b);
      EXPECT_EQ(contact.kept_facets_a > 0, has_facets);
      EXPECT_GT(report.stats().kept_facets, contact.kept_facets_a + contact.kept_facets_b);
    }
  }
}

TEST(FacetOutcomes, AddUpToTheCountsOfTheReport) {
  for (const Accuracy accuracy : kBothAccuracies) {
    const std::vector<Mesh> bodies = crowd(7);
    World world(with_zones(accuracy));
    add_bodies(world, bodies);
    const Report& report = world.detect();
    FacetOutcomeFinder finder(report);
    std::array<std::int64_t, kFacetOutcomes> sums{};
    for (const Contact& contact : report.contacts()) {
      const std::optional<FacetOutcomes> outcomes = finder.find(contact);
      ASSERT_TRUE(outcomes);
      const auto& [a, b] = *outcomes;
      EXPECT_EQ(a.size(), world.facet_count(contact.a));
      EXPECT_EQ(count(a, FacetOutcome::kept) + count(a, FacetOutcome::meets), contact.kept_facets_a);
      EXPECT_EQ(count(b, FacetOutcome::kept) + count(b, FacetOutcome::meets), contact.kept_facets_b);
      expect_same_meeting_facets(a, facets_that_meet(contact, &FacetPair::a, a.size()));
      expect_same_meeting_facets(b, facets_that_meet(contact, &FacetPair::b, b.size()));
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += counts_of(a)[k] + counts_of(b)[k];
    }
    const StepStats& stats = report.stats();
    const auto sum = [&](FacetOutcome outcome) { return sums[static_cast<std::size_t>(outcome)]; };
    EXPECT_EQ(sum(FacetOutcome::facing_away), stats.facets_facing_away);
    EXPECT_EQ(sum(FacetOutcome::outside_zone), stats.facets_outside_zone);
    EXPECT_EQ(sum(FacetOutcome::kept) + sum(FacetOutcome::meets), stats.kept_facets);
    EXPECT_GT(sum(FacetOutcome::outside_box), 0);
    EXPECT_GT(sum(FacetOutcome::outside_slab), 0);
    EXPECT_GT(sum(FacetOutcome::far), 0);
    EXPECT_GT(sum(FacetOutcome::meets), 0);
    if (accuracy == Accuracy::paper) {
      EXPECT_GT(sum(FacetOutcome::facing_away), 0);
      EXPECT_GT(sum(FacetOutcome::outside_zone), 0);
    }
    // Dropped whole or one by one: never fewer than the facets of opened clusters.
    EXPECT_GE(sum(FacetOutcome::outside_slab), stats.facets_outside_slab);
    EXPECT_GE(sum(FacetOutcome::outside_box), stats.facets_outside_box);
  }
}

// One body as the criteria see it, in long double: `sign` is 1 for a, -1 for b.
struct Side {
  const Mesh* mesh;
  Vector outward;
  long double plane;  // of the other, along `outward`
  ZoneDisk other_zone;

  Vector corner(int facet, int k) const { return mesh->positions.col(mesh->facets(k, facet)).cast<long double>(); }
  long double highest(int facet) const {
    long double best = outward.dot(corner(facet, 0));
    for (int k = 1; k < 3; ++k) best = std::max(best, outward.dot(corner(facet, k)));
    return best;
  }
  long double rise(int facet) const {  // of its normal
    const Vector normal = (corner(facet, 1) - corner(facet, 0)).cross(corner(facet, 2) - corner(facet, 0));
    return outward.dot(normal);
  }
  // How far the facet's projection is from the axis of the other's zone.
  long double distance_from_axis(int facet) const {
    const Vector center = other_zone.center.cast<long double>();
    std::array<Vector, 3> p;
    for (int k = 0; k < 3; ++k) {
      const Vector d = corner(facet, k) - center;
      p[k] = d - outward.dot(d) * outward;
    }
    const auto side = [&](std::size_t i) { return outward.dot(p[i].cross(p[(i + 1) % 3])); };
    const bool around =
        (side(0) >= 0 && side(1) >= 0 && side(2) >= 0) || (side(0) <= 0 && side(1) <= 0 && side(2) <= 0);
    if (around) return 0;
    long double nearest = p[0].norm();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector e = p[(i + 1) % 3] - p[i];
      const long double t = std::clamp(-p[i].dot(e) / e.squaredNorm(), 0.0L, 1.0L);
      nearest = std::min(nearest, (p[i] + t * e).norm());
    }
    return nearest;
  }
};

void expect_outcome(const Side& side, int facet, FacetOutcome outcome) {
  constexpr long double kRounding = 1e-12L;
  const bool low = side.highest(facet) < side.plane - kRounding;
  const bool outside = side.distance_from_axis(facet) > side.other_zone.radius + kRounding;
  switch (outcome) {
    case FacetOutcome::outside_slab: EXPECT_LT(side.highest(facet), side.plane + kRounding) << facet; break;
    case FacetOutcome::facing_away:
      EXPECT_LE(side.rise(facet), kRounding) << facet;
      EXPECT_FALSE(low) << facet;
      break;
    case FacetOutcome::outside_zone:
      EXPECT_GT(side.distance_from_axis(facet), side.other_zone.radius - kRounding) << facet;
      EXPECT_FALSE(low) << facet;
      break;
    case FacetOutcome::kept:
    case FacetOutcome::meets:
      EXPECT_FALSE(low) << facet;
      EXPECT_FALSE(outside) << facet;
      break;
    case FacetOutcome::outside_box:
    case FacetOutcome::far: EXPECT_GE(facet, 0); break;
  }
}

TEST(FacetOutcomes, AreTrue) {
  for (const Accuracy accuracy : kBothAccuracies) {
    const std::vector<Mesh> bodies = crowd(3);
    World world(with_zones(accuracy));
    add_bodies(world, bodies);
    const Report& report = world.detect();
    FacetOutcomeFinder finder(report);
    for (const Contact& contact : report.contacts()) {
      const Vector n = contact.direction.cast<long double>();
      const Side a{&bodies[contact.a.index], n, static_cast<long double>(contact.plane_b), contact.zone_b};
      const Side b{&bodies[contact.b.index], -n, -static_cast<long double>(contact.plane_a), contact.zone_a};
      const FacetOutcomes outcomes = finder.find(contact).value();
      for (std::size_t i = 0; i < outcomes.a.size(); ++i) expect_outcome(a, static_cast<int>(i), outcomes.a[i]);
      for (std::size_t i = 0; i < outcomes.b.size(); ++i) expect_outcome(b, static_cast<int>(i), outcomes.b[i]);
    }
  }
}

// Bodies that deform over many steps: carried directions, scrambled vertices, pairs that are kept.
void expect_outcomes_that_add_up(bool zones) {
  std::vector<Mesh> bodies = crowd(11);
  World world({.threads = 1, .outputs = {.zones = zones}});
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  std::int64_t kept = 0;
  for (int step = 0; step < 12; ++step) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (step % 3 == 2 && i < 2) continue;  // their pair is at rest
      bodies[i] = jittered(step == 6 ? scrambled(bodies[i], 5) : bodies[i], 0.02, static_cast<std::uint64_t>(step));
      world.set_positions(ids[i], bodies[i].positions);
    }
    const Report& report = world.detect();
    FacetOutcomeFinder finder(report);
    for (const Contact& contact : report.contacts()) {
      const FacetOutcomes outcomes = finder.find(contact).value();
      const auto kept_a = count(outcomes.a, FacetOutcome::kept) + count(outcomes.a, FacetOutcome::meets);
      const auto kept_b = count(outcomes.b, FacetOutcome::kept) + count(outcomes.b, FacetOutcome::meets);
      EXPECT_GE(kept_a, contact.kept_facets_a) << step;
      EXPECT_GE(kept_b, contact.kept_facets_b) << step;
      // What a step remembers of surfaces that lie on each other keeps fewer; with zones nothing is taken for such.
      if (zones) {
        EXPECT_EQ(kept_a + kept_b, contact.kept_facets_a + contact.kept_facets_b) << step;
      }
      expect_same_meeting_facets(outcomes.a, facets_that_meet(contact, &FacetPair::a, outcomes.a.size()));
    }
    kept += report.stats().kept_pairs;
  }
  EXPECT_GT(kept, 0);
}

TEST(FacetOutcomes, AddUpInEveryStep) {
  expect_outcomes_that_add_up(true);
  expect_outcomes_that_add_up(false);
}

TEST(FacetOutcomes, AreTheSameForAnyNumberOfThreads) {
  std::vector<FacetOutcomes> found;
  for (const int threads : {1, 3}) {
    World world(with_zones(Accuracy::exact, threads));
    add_bodies(world, {{icosphere(5), translated(icosphere(5), {1.5, 0.3, 0.1})}});  // large: cut into ranges
    const Report& report = world.detect();
    ASSERT_EQ(report.contacts().size(), 1u);
    found.push_back(FacetOutcomeFinder(report).find(report.contacts()[0]).value());
    EXPECT_EQ(count(found.back().a, FacetOutcome::kept) + count(found.back().a, FacetOutcome::meets),
              report.contacts()[0].kept_facets_a);
  }
  EXPECT_EQ(found[0].a, found[1].a);
  EXPECT_EQ(found[0].b, found[1].b);
}

TEST(FacetOutcomes, AreThereWhereFacetsWereLookedAt) {
  World world(with_zones(Accuracy::exact));
  const auto ids = add_bodies(
      world, {{icosphere(1), translated(icosphere(1), {1.5, 0, 0}), translated(icosphere(1), {1.7, 1.3, 0})}});
  const auto has_outcomes = [&](std::size_t a, std::size_t b) {
    const Report& report = world.detect();
    const Contact* contact = report.find_contact(ids[a], ids[b]);
    return contact != nullptr && FacetOutcomeFinder(report).find(*contact).has_value();
  };
  EXPECT_TRUE(has_outcomes(0, 1));
  EXPECT_TRUE(has_outcomes(0, 1)) << "nothing moved";
  world.set_settings({.threads = 1, .accuracy = Accuracy::hulls});
  EXPECT_FALSE(has_outcomes(0, 1));
  // Margins make the hulls of bodies that are apart a contact, of which no facet was looked at.
  world.set_settings(with_zones(Accuracy::exact));
  for (const BodyId id : ids) world.set_margin(id, 0.2);
  ASSERT_NE(world.detect().find_contact(ids[0], ids[2]), nullptr);
  EXPECT_FALSE(has_outcomes(0, 2));
}

TEST(Clusters, HoldUpTo64FacetsEachAndAll) {
  World world;
  const auto ids = add_bodies(world, {{icosphere(3)}});
  const std::vector<int> clusters = FacetOutcomeFinder(world.detect()).clusters(ids[0]);
  ASSERT_EQ(clusters.size(), world.facet_count(ids[0]));
  std::map<int, int> sizes;
  for (const int cluster : clusters) ++sizes[cluster];
  EXPECT_EQ(sizes.size(), (clusters.size() + 63) / 64);
  EXPECT_EQ(sizes.rbegin()->first, static_cast<int>(sizes.size()) - 1);
  for (const auto& [cluster, size] : sizes) EXPECT_LE(size, 64) << cluster;
}

}  // namespace
}  // namespace tact::tests
