// Reports that stay while the world goes on.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <optional>
#include <thread>
#include <vector>

#include "tests/support/environment/allocation_hook.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/hashes/answer_hash.h"

namespace tact::tests {
namespace {

class Stack {
 public:
  Stack() {
    world.set_settings({.outputs = {.patches = true, .points = true, .curves = true, .within_reach = true}});
    const Mesh ball = icosphere(2), cloth = wrinkled_sheet(12, 3.0, 0.2, 1);
    ids.push_back(world.add_body({.positions = ball.positions, .facets = ball.facets, .margin = 0.1}));
    ids.push_back(world.add_body({.positions = cloth.positions,
                                  .facets = cloth.facets,
                                  .surface = Surface::sheet,
                                  .margin = 0.1,
                                  .self_contact = true}));
    world.add_plane({.offset = -0.9, .margin = 0.1});
  }
  const Report& step(int number) {
    world.set_positions(ids[0], translated(icosphere(2), {0.1 * number, 0.0, 0.05 * number}).positions);
    return world.detect();
  }
  World world{{.threads = 1}};
  std::vector<BodyId> ids;
};

std::uint64_t hash_of(const Report& report) {
  AnswerHash hash;
  hash.add(report);
  const AnswerHashes all = hash.hashes();
  return all.features ^ (all.numbers + 1);
}

TEST(KeptReport, HoldsAllOfAStepWhileTheWorldGoesOn) {
  std::vector<KeptReport> kept(4);
  std::vector<std::uint64_t> hashes, all;
  {
    Stack stack;
    for (int i = 0; i < 4; ++i) {
      const Report& report = stack.step(i);
      EXPECT_FALSE(report.contacts().empty());
      hashes.push_back(report.hash());
      all.push_back(hash_of(report));
      kept[static_cast<std::size_t>(i)].keep(report);
    }
  }
  // The world is gone.
  for (std::size_t i = 0; i < 4; ++i) {
    const Report& report = kept[i].report();
    EXPECT_EQ(report.hash(), hashes[i]);
    EXPECT_EQ(hash_of(report), all[i]);
    EXPECT_TRUE(std::ranges::any_of(report.contacts(), [](const Contact& one) { return !one.curves().empty(); }));
    EXPECT_TRUE(std::ranges::any_of(report.contacts(), [](const Contact& one) { return !one.patches().empty(); }));
  }
  KeptReport moved = std::move(kept[2]);
  EXPECT_EQ(moved.report().hash(), hashes[2]);
  moved.keep(moved.report());
  EXPECT_EQ(moved.report().hash(), hashes[2]);
  moved.keep(kept[0].report());
  EXPECT_EQ(moved.report().hash(), hashes[0]);
  EXPECT_TRUE(KeptReport().report().contacts().empty());
}

// Once two have held the largest steps, none takes memory.
TEST(KeptReport, TwoInTurnsTakeNoMemory) {
  Stack stack;
  KeptReport turns[2];
  long allocations = 0;
  for (int i = 0; i < 24; ++i) {
    const Report& report = stack.step(i % 4);
    const long before = allocation_count();
    turns[i % 2].keep(report);
    if (i >= 8) allocations += allocation_count() - before;
  }
  EXPECT_EQ(allocations, 0);
}

// Two in turns: what a step found is read by another thread while the next step runs.
TEST(KeptReport, TwoInTurnsAreReadBesideTheNextStep) {
  Stack stack, alone;
  KeptReport turns[2];
  std::vector<std::uint64_t> found(8), expected;
  std::optional<std::thread> reader;
  for (std::size_t i = 0; i < found.size(); ++i) {
    expected.push_back(hash_of(alone.step(static_cast<int>(i))));
    KeptReport& own = turns[i % 2];
    own.keep(stack.step(static_cast<int>(i)));
    if (reader) reader->join();
    reader.emplace([&own, &found, i] { found[i] = hash_of(own.report()); });
  }
  reader->join();
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace tact::tests
