// Patches of contact points: which they are, their names from step to step, events, and what solvers do with ids.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "tests/support/checks/detection.h"
#include "tests/support/environment/allocation_hook.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

const Settings kWithPatches{.outputs = {.patches = true, .points = true}};

BodyDefinition lasting_body(const Mesh& mesh, double margin, Surface surface = Surface::closed) {
  return {.positions = mesh.positions, .facets = mesh.facets, .surface = surface, .margin = margin};
}

using EventKey = std::tuple<PatchEvent::Kind, std::uint64_t, std::uint64_t>;

std::vector<EventKey> events_of(const Report& report) {
  std::vector<EventKey> events;
  for (const PatchEvent& event : report.patch_events()) events.emplace_back(event.kind, event.patch, event.other);
  return events;
}

std::vector<std::uint64_t> ids_of(const Report& report) {
  std::vector<std::uint64_t> ids;
  for (const Contact& contact : report.contacts()) {
    for (const Patch& patch : contact.patches()) ids.push_back(patch.id);
  }
  return ids;
}

// Every point and facet pair is in one patch, and the point says which.
void expect_members_once(const Contact& contact) {
  std::multiset<int> points, pairs;
  for (std::size_t k = 0; k < contact.patches().size(); ++k) {
    const Patch& patch = contact.patches()[k];
    points.insert(patch.points.begin(), patch.points.end());
    pairs.insert(patch.facet_pairs.begin(), patch.facet_pairs.end());
    for (const int i : patch.points) EXPECT_EQ(contact.points()[i].patch, static_cast<int>(k));
  }
  EXPECT_EQ(points.size(), contact.points().size());
  EXPECT_EQ(pairs.size(), contact.facet_pairs().size());
  EXPECT_EQ(std::set<int>(points.begin(), points.end()).size(), points.size());
  EXPECT_EQ(std::set<int>(pairs.begin(), pairs.end()).size(), pairs.size());
}

Mesh clamp(double half_gap) {
  const Mesh jaws[] = {gridded_box({-2, -1, -1}, {-half_gap, 1, 1}, 6), gridded_box({half_gap, -1, -1}, {2, 1, 1}, 6)};
  return merged(jaws);
}

TEST(LastingPatches, OfABodyInAClampAreTwoOfOppositeDirections) {
  for (const double half_gap : {0.495, 0.48}) {  // within the margins; crossing
    World world(kWithPatches);
    const Mesh jaws = clamp(half_gap), ball = icosphere(3, 0.5);
    world.add_body(lasting_body(jaws, 0.01));
    world.add_body(lasting_body(ball, 0.01));
    const Report& report = world.detect();
    ASSERT_EQ(report.contacts().size(), 1u);
    const Contact& contact = report.contacts()[0];
    ASSERT_EQ(contact.patches().size(), 2u);
    expect_members_once(contact);
    const Patch &p = contact.patches()[0], &q = contact.patches()[1];
    EXPECT_GT(std::abs(p.direction.x()), 0.999);
    EXPECT_LT((p.direction + q.direction).norm(), 0.03);
    EXPECT_NEAR(p.depth, 0.5 - half_gap, 1e-9);
    EXPECT_NEAR(q.depth, 0.5 - half_gap, 1e-9);
    EXPECT_NEAR(std::abs(p.point.x()), 0.5 * (0.5 + half_gap), 0.02);
    EXPECT_GT(p.area, 1e-4);
    EXPECT_NE(p.id, q.id);
  }
}

// A box of 0.8 m by 0.6 m on a floor, on a gridded side: the area is the side's, four corners span it.
TEST(LastingPatches, OfABoxOnAFloorSpanItsSide) {
  const Mesh floor = gridded_box({-2, -2, -1}, {2, 2, 0}, 9), block = gridded_box({-0.4, -0.3, 0}, {0.4, 0.3, 1}, 5);
  for (const double height : {0.005, 0.0, -0.003}) {
    World world(kWithPatches);
    world.add_body(lasting_body(floor, 0.01));
    const Mesh placed = translated(block, {0.03, 0.02, height});
    world.add_body(lasting_body(placed, 0.01));
    const Contact& contact = world.detect().contacts()[0];
    ASSERT_EQ(contact.patches().size(), 1u) << height;
    expect_members_once(contact);
    const Patch& patch = contact.patches()[0];
    EXPECT_NEAR(patch.depth, -height, 1e-12);
    EXPECT_NEAR(patch.direction.z(), 1.0, 1e-12);
    EXPECT_NEAR(patch.area, 0.48, 1e-9);
    std::set<std::pair<int, int>> corners;
    for (const int i : patch.spanning) {
      ASSERT_GE(i, 0);
      const ContactPoint& point = contact.points()[i];
      Eigen::Vector3d at = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        if (point.b_vertices[k] >= 0) at += point.b_weights[k] * placed.positions.col(point.b_vertices[k]);
      }
      corners.emplace(static_cast<int>(std::round(1000 * (at.x() - 0.03))),
                      static_cast<int>(std::round(1000 * (at.y() - 0.02))));
    }
    EXPECT_EQ(corners, (std::set<std::pair<int, int>>{{-400, -300}, {-400, 300}, {400, -300}, {400, 300}})) << height;
  }
}

TEST(LastingPatches, OfOnePointAndOfALineSpanWhatTheyHave) {
  World world(kWithPatches);
  world.add_body(lasting_body(gridded_box({-2, -2, -1}, {2, 2, 0}, 3), 0.01));
  world.add_body(lasting_body(translated(spike({0.1, 0.2, -1.0}, 0.1), {0, 0, 1.01}), 0.01));
  const Contact& contact = world.detect().contacts()[0];
  ASSERT_EQ(contact.patches().size(), 1u);
  EXPECT_EQ(contact.patches()[0].spanning, (std::array<int, 4>{0, -1, -1, -1}));
  EXPECT_EQ(contact.patches()[0].area, 0.0);
}

// A ball rolls along a finely meshed floor: features come and go, the patch stays.
TEST(LastingPatches, KeepTheirIdWhileFeaturesChange) {
  World world(kWithPatches);
  const Mesh floor = gridded_box({-2, -2, -1}, {2, 2, 0}, 24), ball = icosphere(3, 0.5);
  world.add_body(lasting_body(floor, 0.01));
  const BodyId b = world.add_body(lasting_body(translated(ball, {0, 0, 0.6}), 0.01));
  EXPECT_TRUE(ids_of(world.detect()).empty());
  std::set<std::uint64_t> ids, points;
  for (int step = 0; step < 60; ++step) {
    const double angle = 0.02 * step;
    const Mesh rolled = rotated(ball, rotation(std::cos(0.5 * angle), 0, std::sin(0.5 * angle), 0));
    world.set_positions(b, translated(rolled, {0.5 * angle, 0, 0.495}).positions);
    const Report& report = world.detect();
    for (const std::uint64_t id : ids_of(report)) ids.insert(id);
    for (const ContactPoint& point : report.contacts()[0].points()) points.insert(point.id);
    EXPECT_EQ(report.patch_events().size(), step == 0 ? 1u : 0u) << step;
    EXPECT_EQ(report.began().size(), step == 0 ? 1u : 0u) << step;
    EXPECT_TRUE(report.ended().empty());
  }
  EXPECT_EQ(ids.size(), 1u);
  EXPECT_GT(points.size(), 30u);
  world.set_positions(b, translated(ball, {0.6, 0, 0.6}).positions);
  const Report& report = world.detect();
  EXPECT_EQ(events_of(report), (std::vector<EventKey>{{PatchEvent::Kind::ended, *ids.begin(), 0}}));
  EXPECT_EQ(report.ended().size(), 1u);
  EXPECT_TRUE(world.detect().patch_events().empty());
}

// A sheet that is lifted in its middle has two patches, let down one: a split and a merge, each with its names.
TEST(LastingPatches, TellSplitsAndMerges) {
  World world(kWithPatches);
  const Mesh floor = sheet(40, 40, 4, 4), cloth = sheet(24, 4, 1.9, 0.3);
  world.add_body(lasting_body(floor, 0.005, Surface::sheet));
  const auto lifted = [&](double height) {
    return mapped(cloth, [&](Vec3 p) {
      return Vec3{p.x + 0.011, p.y + 0.007, 0.004 + (std::abs(p.x) < 0.3 ? height : 0.0)};
    });
  };
  const BodyId b = world.add_body(lasting_body(lifted(0.0), 0.005, Surface::sheet));
  const std::vector<std::uint64_t> first = ids_of(world.detect());
  ASSERT_EQ(first.size(), 1u);
  world.set_positions(b, lifted(0.1).positions);
  const Report& split = world.detect();
  const std::vector<std::uint64_t> two = ids_of(split);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(std::ranges::count(two, first[0]), 1);
  const std::uint64_t fresh = two[0] == first[0] ? two[1] : two[0];
  EXPECT_EQ(events_of(split), (std::vector<EventKey>{{PatchEvent::Kind::split, fresh, first[0]}}));
  EXPECT_TRUE(split.began().empty());
  world.set_positions(b, lifted(0.0).positions);
  const Report& merged = world.detect();
  const std::vector<std::uint64_t> one = ids_of(merged);
  ASSERT_EQ(one.size(), 1u);
  ASSERT_TRUE(std::ranges::count(two, one[0]) == 1);
  EXPECT_EQ(events_of(merged),
            (std::vector<EventKey>{{PatchEvent::Kind::merged, one[0] == two[0] ? two[1] : two[0], one[0]}}));
  // A body that goes takes its patches along.
  world.remove_body(b);
  EXPECT_EQ(events_of(world.detect()), (std::vector<EventKey>{{PatchEvent::Kind::ended, one[0], 0}}));
}

TEST(LastingPatches, OfABodyWithItselfBeginAndEnd) {
  World world(kWithPatches);
  const Mesh flat = sheet(40, 6, 1.2, 0.2);
  const auto folded = [&](double apart) {
    return mapped(flat, [&](Vec3 p) {
      const double half = 0.1;
      if (p.x < -half) return Vec3{p.x + half, p.y, -apart};
      if (p.x > half) return Vec3{half - p.x, p.y, apart};
      return Vec3{0.4 * (1.0 - std::abs(p.x) / half), p.y, apart * p.x / half};
    });
  };
  const Mesh start = folded(0.1);
  const BodyId id = world.add_body({.positions = start.positions,
                                    .facets = start.facets,
                                    .surface = Surface::sheet,
                                    .margin = 0.025,
                                    .self_contact = true});
  EXPECT_TRUE(world.detect().began().empty());
  world.set_positions(id, folded(0.02).positions);
  const Report& near = world.detect();
  ASSERT_EQ(near.began().size(), 1u);
  EXPECT_EQ(near.began()[0], (ContactEvent{id, id}));
  ASSERT_EQ(near.contacts().size(), 1u);
  EXPECT_FALSE(near.contacts()[0].patches().empty());
  expect_members_once(near.contacts()[0]);
  const std::vector<std::uint64_t> ids = ids_of(near);
  world.set_positions(id, folded(0.021).positions);
  const Report& still = world.detect();
  EXPECT_EQ(ids_of(still), ids);
  EXPECT_TRUE(still.began().empty() && still.ended().empty() && still.patch_events().empty());
  world.set_positions(id, folded(0.1).positions);
  const Report& apart = world.detect();
  ASSERT_EQ(apart.ended().size(), 1u);
  EXPECT_EQ(apart.patch_events().size(), ids.size());
}

TEST(LastingPatches, HaveTheSameNamesForAnyNumberOfThreads) {
  std::set<std::vector<std::uint64_t>> all;
  for (const int threads : {1, 2, 3, 4}) {
    World world({.threads = threads, .outputs = {.patches = true, .points = true}});
    std::vector<BodyId> ids;
    for (int k = 0; k < 12; ++k)
      ids.push_back(world.add_body(lasting_body(
          translated(blob(2, 0.5, 0.3, 1 + static_cast<unsigned>(k)), {0.9 * (k % 4), 0.9 * (k / 4), 0}), 0.02)));
    std::vector<std::uint64_t> names;
    for (int step = 0; step < 5; ++step) {
      for (int k = 0; k < 12; k += 1 + step % 2)
        world.set_positions(ids[k], translated(blob(2, 0.5, 0.3, 1 + static_cast<unsigned>(k)),
                                               {0.9 * (k % 4) + 0.02 * step * (k % 3), 0.9 * (k / 4), 0.03 * step})
                                        .positions);
      const Report& report = world.detect();
      for (const std::uint64_t id : ids_of(report)) names.push_back(id);
      for (const PatchEvent& event : report.patch_events()) names.push_back(event.patch + 1000 * event.other);
      EXPECT_TRUE(
          std::ranges::is_sorted(report.patch_events(), {}, [](const PatchEvent& e) { return std::pair(e.a, e.b); }));
    }
    EXPECT_GT(names.size(), 50u);
    all.insert(names);
  }
  EXPECT_EQ(all.size(), 1u);
}

// Bodies that cross, come near, part and crumple, over and over: what they need is there after the first rounds. They
// do not cross so deep that a crossing has no point of its own, which makes hulls of its facets anew.
TEST(LastingPatches, OfSteadyStepsAllocateNothing) {
  tact::World world({.threads = 1, .outputs = {.patches = true, .points = true}});
  std::vector<Mesh> meshes;
  std::vector<BodyId> ids;
  for (int k = 0; k < 6; ++k) {
    meshes.push_back(translated(blob(2, 0.5, 0.3, 1 + static_cast<unsigned>(k)), {1.1 * k, 0, 0}));
    ids.push_back(world.add_body(lasting_body(meshes.back(), 0.02)));
  }
  const Mesh folded = mapped(sheet(20, 4, 1.2, 0.2), [](Vec3 p) { return Vec3{std::abs(p.x), p.y - 3.0, 0.02 * p.x}; });
  const BodyId cloth = world.add_body({.positions = folded.positions,
                                       .facets = folded.facets,
                                       .surface = Surface::sheet,
                                       .margin = 0.01,
                                       .self_contact = true});
  const auto play = [&](int step) {
    const double phase = std::sin(0.1 * std::numbers::pi * step);
    for (std::size_t k = 0; k < ids.size(); ++k) {
      Eigen::Matrix3Xd positions = meshes[k].positions;
      positions.row(0).array() += (k % 2 == 0 ? 0.15 : -0.15) * phase;
      const long before = allocation_count();
      world.set_positions(ids[k], positions);
      EXPECT_TRUE(step < 60 || allocation_count() == before);
    }
    Eigen::Matrix3Xd positions = folded.positions;
    positions.row(2).array() *= 1.0 + 0.5 * phase;
    world.set_positions(cloth, positions);
    const long before = allocation_count();
    const std::size_t events = world.detect().patch_events().size();
    EXPECT_TRUE(step < 60 || allocation_count() == before) << step << ": " << allocation_count() - before;
    return events;
  };
  std::size_t events = 0;
  for (int step = 0; step < 100; ++step) events += play(step);
  EXPECT_GT(events, 10u);
}

TEST(Filters, OfGroupsAndOfPairsByName) {
  World world;
  const auto add = [&](double x, std::uint32_t group) {
    const Mesh mesh = cube(1.0, {x, 0, 0});
    return world.add_body({.positions = mesh.positions, .facets = mesh.facets, .name = "part", .group = group});
  };
  const BodyId a = add(0.0, 3), b = add(0.5, 3), c = add(0.7, 0);
  const auto pairs = [&] {
    std::set<std::pair<BodyId, BodyId>> found;
    for (const Contact& contact : world.detect().contacts()) found.emplace(contact.a, contact.b);
    return found;
  };
  using Pairs = std::set<std::pair<BodyId, BodyId>>;
  EXPECT_EQ(pairs(), (Pairs{{a, c}, {b, c}}));
  EXPECT_EQ(world.group(a), 3u);
  world.set_group(b, 4);
  EXPECT_EQ(pairs(), (Pairs{{a, b}, {a, c}, {b, c}}));
  world.set_excluded(c, a, true);
  EXPECT_TRUE(world.excluded(a, c));
  const Report& report = world.detect();
  EXPECT_EQ(report.contacts().size(), 2u);
  EXPECT_EQ(report.stats().named_excluded_pairs, 1);
  ASSERT_EQ(report.ended().size(), 1u);
  EXPECT_EQ(report.ended()[0], (ContactEvent{a, c}));
  EXPECT_EQ(world.detect().stats().named_excluded_pairs, 1);  // nothing moved
  // Also where one moves, and where it is on its way.
  world.set_positions(a, cube(1.0, {0.1, 0, 0}).positions);
  EXPECT_EQ(pairs(), (Pairs{{a, b}, {b, c}}));
  world.set_excluded(a, c, false);
  EXPECT_EQ(pairs(), (Pairs{{a, b}, {a, c}, {b, c}}));
  world.set_excluded(a, c, true);
  world.remove_body(c);
  const BodyId d = add(0.7, 0);
  EXPECT_EQ(d.index, c.index);
  EXPECT_FALSE(world.excluded(a, d));
  EXPECT_EQ(pairs(), (Pairs{{a, b}, {a, d}, {b, d}}));
  EXPECT_TRUE(throws_error([&] { world.set_excluded(a, a, true); }, ErrorCode::invalid_argument, {"part"}));
  EXPECT_TRUE(throws_error([&] { world.set_excluded(a, c, true); }, ErrorCode::stale_body));
  EXPECT_TRUE(throws_error([&] { world.set_group(c, 1); }, ErrorCode::stale_body));
}

// The ids of points last, so a solver keeps what it wants in a table of its own: here the impulses with which it
// begins. A box rests on a floor at four points; Gauss and Seidel's method finds what holds it. Begun from the last
// step's impulses it needs one pass, from nothing many.
TEST(PointIds, AreWhatWarmStartingNeeds) {
  World world(kWithPatches);
  const Mesh floor = gridded_box({-2, -2, -1}, {2, 2, 0}, 9), block = box({-0.5, -0.3, 0}, {0.5, 0.3, 1});
  world.add_body(lasting_body(floor, 0.01));
  const BodyId b = world.add_body(lasting_body(translated(block, {0.03, 0.02, 0.001}), 0.01));
  std::map<std::uint64_t, double> kept;
  std::vector<int> passes;
  for (int step = 0; step < 6; ++step) {
    world.set_positions(b, translated(block, {0.03 + 1e-4 * step, 0.02, 0.001}).positions);
    const Contact& contact = world.detect().contacts()[0];
    struct Row {
      std::uint64_t id;
      Eigen::Vector3d arm;
      double impulse;
    };
    std::vector<Row> rows;
    for (const ContactPoint& point : contact.points()) {
      if (point.kind != FeaturePair::facet_vertex) continue;
      const Vec3 at = block.position(point.b_vertices[0]);
      const auto found = kept.find(point.id);
      rows.push_back({point.id, {at.x, at.y, at.z - 0.5}, found != kept.end() ? found->second : 0.0});
    }
    ASSERT_EQ(rows.size(), 4u);
    // Mass 1, inertia of a box; gravity gave it a speed of -1 along z. No point may come nearer.
    const Eigen::Vector3d inertia{(0.36 + 1.0) / 12, (1.0 + 1.0) / 12, (1.0 + 0.36) / 12}, up{0, 0, 1};
    Eigen::Vector3d speed = -up, spin = Eigen::Vector3d::Zero();
    const auto apply = [&](const Row& row, double impulse) {
      speed += impulse * up;
      spin += row.arm.cross(impulse * up).cwiseQuotient(inertia);
    };
    for (const Row& row : rows) apply(row, row.impulse);
    int pass = 0;
    for (double worst = 1.0; worst > 1e-9 && pass < 1000; ++pass) {
      worst = 0.0;
      for (Row& row : rows) {
        const double approach = up.dot(speed + spin.cross(row.arm));
        const double mass = 1.0 / (1.0 + row.arm.cross(up).cwiseQuotient(inertia).cross(row.arm).dot(up));
        const double change = std::max(0.0, row.impulse - mass * approach) - row.impulse;
        row.impulse += change;
        apply(row, change);
        worst = std::max(worst, std::abs(change));
      }
    }
    passes.push_back(pass);
    kept.clear();
    for (const Row& row : rows) kept[row.id] = row.impulse;
  }
  EXPECT_GT(passes[0], 5);
  for (std::size_t step = 1; step < passes.size(); ++step) EXPECT_EQ(passes[step], 1) << step;
}

}  // namespace
}  // namespace tact::tests
