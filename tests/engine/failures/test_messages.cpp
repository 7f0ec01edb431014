#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"

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

}  // namespace
}  // namespace tact::tests
