#include <gtest/gtest.h>
#include <tact/tact.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

struct Told {
  MessageKind kind;
  BodyId a, b;
  std::string text;
};

// Bodies that turn wildly between two steps, so that one iteration finds few directions.
std::vector<Told> told_by_a_wild_crowd(int iteration_limit, int threads, std::int64_t& limits) {
  std::vector<Told> told;
  tact::World world({.threads = threads, .iteration_limit = iteration_limit, .on_message = [&](const Message& m) {
                       told.push_back({m.kind, m.a, m.b, std::string(m.text)});
                     }});
  std::vector<BodyId> bodies;
  const auto there = [](int body, int step) {
    const auto seed = static_cast<std::uint64_t>(100 * step + body);
    Mesh mesh = blob(2, 0.5, 0.4, seed);
    mesh.positions.row(seed % 3) *= 3.0;
    return mesh;
  };
  for (int i = 0; i < 6; ++i) {
    const Mesh mesh = there(i, 0);
    bodies.push_back(
        world.add_body({.positions = mesh.positions, .facets = mesh.facets, .name = "b" + std::to_string(i)}));
  }
  limits = 0;
  for (int step = 0; step < 20; ++step) {
    for (int i = 0; i < 6; ++i) world.set_positions(bodies[i], there(i, step).positions);
    const std::size_t before = told.size();
    const Report& report = world.detect();
    limits += report.stats().limits_reached;
    // One message a contact that says so, in the order of the contacts.
    std::size_t at = before;
    for (const Contact& contact : report.contacts()) {
      if (!contact.limit_reached) continue;
      EXPECT_LT(at, told.size());
      if (at == told.size()) break;
      EXPECT_EQ(told[at].kind, MessageKind::direction_limit);
      EXPECT_EQ(told[at].a, contact.a);
      EXPECT_EQ(told[at].b, contact.b);
      EXPECT_NE(told[at].text.find("'" + world.name(contact.b) + "'"), std::string::npos) << told[at].text;
      ++at;
    }
  }
  return told;
}

TEST(Messages, TellOfEachLimit) {
  std::int64_t limits = 0;
  const std::vector<Told> told = told_by_a_wild_crowd(1, 1, limits);
  EXPECT_GT(limits, 0);
  EXPECT_GT(told.size(), 0u);
  std::int64_t again = 0;
  EXPECT_EQ(told_by_a_wild_crowd(1, 2, again).size(), told.size());
  EXPECT_EQ(again, limits);
}

TEST(Messages, NoneWhereNoLimitIsReached) {
  std::int64_t limits = 0;
  EXPECT_TRUE(told_by_a_wild_crowd(100, 1, limits).empty());
  EXPECT_EQ(limits, 0);
}

TEST(Messages, WhatTheFunctionThrowsComesOutOfAddBodyAndNothingIsAdded) {
  Mesh open = blob(1, 0.5, 0.4, 1);
  open.facets.conservativeResize(3, open.facets.cols() - 1);
  bool throws = true;
  tact::World world({.on_message = [&](const Message& message) {
    EXPECT_FALSE(message.text.empty());
    if (throws) throw std::runtime_error("no");
  }});
  const auto add = [&] {
    return world.add_body({.positions = open.positions, .facets = open.facets, .name = "open", .key = 7});
  };
  const BodyId last = world.add_body({.positions = open.positions, .facets = open.facets, .surface = Surface::sheet});
  world.remove_body(last);
  EXPECT_THROW(add(), std::runtime_error);
  EXPECT_EQ(world.body_count(), 0u);
  throws = false;
  EXPECT_EQ(add(), (BodyId{.index = last.index, .generation = last.generation + 1, .world = last.world}));
  EXPECT_EQ(world.body_count(), 1u);
}

// A sheet of so many cells of 1 m that stands in a flat one of the same body, half as deep as it is high.
std::vector<Told> told_by_crossing_sheets(int cells, StepStats& stats, bool& flag) {
  std::vector<Told> told;
  const Mesh flat = sheet(cells, cells, cells, cells);
  const Mesh upright = mapped(flat, [](Vec3 p) { return Vec3{p.x + 0.25, 0.3, p.y}; });
  const Mesh both = merged(std::vector<Mesh>{flat, upright});
  tact::World world({.outputs = {.points = true}, .on_message = [&](const Message& m) {
                       told.push_back({m.kind, m.a, m.b, std::string(m.text)});
                     }});
  world.add_body({.positions = both.positions,
                  .facets = both.facets,
                  .surface = Surface::sheet,
                  .name = "cloth",
                  .self_contact = true});
  const Report& report = world.detect();
  stats = report.stats();
  EXPECT_EQ(report.contacts().size(), 1u);
  flag = report.contacts()[0].point_limit_reached;
  EXPECT_EQ(stats.points, static_cast<std::int64_t>(report.contacts()[0].points().size()));
  return told;
}

TEST(Messages, TellOfASheetThatCrossesItselfDeeperThanItsPointsAreFound) {
  StepStats stats;
  bool flag = true;
  EXPECT_TRUE(told_by_crossing_sheets(1, stats, flag).empty());
  EXPECT_EQ(stats.point_limits_reached, 0);
  EXPECT_FALSE(flag);
  const std::vector<Told> told = told_by_crossing_sheets(8, stats, flag);
  EXPECT_GT(stats.points, 0);
  EXPECT_EQ(stats.point_limits_reached, 1);
  EXPECT_TRUE(flag);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, MessageKind::point_limit);
  EXPECT_EQ(told[0].a, told[0].b);
  EXPECT_NE(told[0].text.find("'cloth'"), std::string::npos) << told[0].text;
}

}  // namespace
}  // namespace tact::tests
