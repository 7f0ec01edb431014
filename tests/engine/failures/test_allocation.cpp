// Memory: what happens when there is none, and how much a step takes once it is warm. operator new is replaced for the
// whole test program: it counts, and fails where it is told to.
#include <gtest/gtest.h>
#include <tact/recording.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <sstream>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/environment/allocation_hook.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/inside/clustered.h"

namespace tact::tests {
namespace {

using PlainWorld = tact::World;  // records nothing: a recording allocates

enum class Outcome { finished, failed_unnoticed, threw };

#if defined(_GLIBCXX_FULLY_DYNAMIC_STRING) && _GLIBCXX_FULLY_DYNAMIC_STRING
constexpr bool kEmptyStringsTakeMemory = true;  // MinGW's do
#else
constexpr bool kEmptyStringsTakeMemory = false;
#endif

// Calls `call` with the allocation numbered `number` (from 0) failing, and all after it if `for_good`. What is thrown
// must be the error of tact's for want of memory, and no other; but there may be no memory for the error's text.
Outcome call_short_of_memory(long number, bool for_good, const std::function<void()>& call) {
  fail_allocation(number, for_good);
  try {
    call();
    return stop_failing() ? Outcome::failed_unnoticed : Outcome::finished;
  } catch (const Error& error) {
    stop_failing();
    EXPECT_EQ(error.code(), ErrorCode::out_of_memory) << error.what();
  } catch (const std::bad_alloc&) {
    stop_failing();
    EXPECT_TRUE(kEmptyStringsTakeMemory && for_good);
  }
  return Outcome::threw;
}

// A world and what it should hold.
struct Scene {
  PlainWorld world{{.threads = 2, .outputs = {.zones = true, .patches = true, .trace = true}}};
  std::vector<Mesh> bodies;
  std::vector<BodyId> ids;
  BodyId added;
};

// A call of the world, which is all that runs short of memory, and what it means.
struct Operation {
  std::function<void(Scene&)> call;
  std::function<void(Scene&)> note;
};

Operation add(const Mesh& mesh) {
  return {[mesh](Scene& scene) {
            scene.added = scene.world.add_body({.positions = mesh.positions, .facets = mesh.facets});
          },
          [mesh](Scene& scene) {
            scene.bodies.push_back(mesh);
            scene.ids.push_back(scene.added);
          }};
}

Operation move(std::size_t i, const Mesh& to) {
  return {[i, to](Scene& scene) { scene.world.set_positions(scene.ids[i], to.positions); },
          [i, to](Scene& scene) { scene.bodies[i] = to; }};
}

Operation move_first_two(const Mesh& to, const Mesh& other_to) {
  return {[to, other_to](Scene& scene) {
            const std::array updates = {PositionsUpdate{scene.ids[0], to.positions},
                                        PositionsUpdate{scene.ids[1], other_to.positions}};
            scene.world.set_positions(updates);
          },
          [to, other_to](Scene& scene) {
            scene.bodies[0] = to;
            scene.bodies[1] = other_to;
          }};
}

// So often that a body which has lost the shape in which it was grouped is noticed.
Operation move_to_and_fro(std::size_t i, const Mesh& first, const Mesh& last) {
  return {[i, first, last](Scene& scene) {
            for (int k = 0; k < 40; ++k) scene.world.set_positions(scene.ids[i], (k % 2 == 0 ? first : last).positions);
          },
          [i, last](Scene& scene) { scene.bodies[i] = last; }};
}

Operation remove(std::size_t i) {
  return {[i](Scene& scene) { scene.world.remove_body(scene.ids[i]); },
          [i](Scene& scene) {
            scene.bodies.erase(scene.bodies.begin() + static_cast<std::ptrdiff_t>(i));
            scene.ids.erase(scene.ids.begin() + static_cast<std::ptrdiff_t>(i));
          }};
}

Operation detect() {
  return {[](Scene& scene) { scene.world.detect(); }, [](Scene&) {}};
}

std::vector<Operation> small_life() {
  const Mesh a = icosphere(1), b = translated(blob(1, 0.9, 0.3, 1), {1.2, 0.1, 0.0});
  const Mesh cloth = wrinkled_sheet(8, 3.0, 0.3, 1), c = translated(icosphere(2), {0.3, 0.4, 0.9});
  return {add(a),
          add(b),
          detect(),
          add(cloth),
          move(0, translated(a, {0.1, 0.0, 0.0})),
          detect(),
          move_first_two(translated(a, {0.2, 0.0, 0.0}), translated(b, {-0.1, 0.0, 0.0})),
          detect(),
          remove(1),
          add(translated(a, {0.5, 0.5, 0.5})),
          detect(),
          add(scrambled(c, 2)),
          detect(),
          move(3, c),
          move_to_and_fro(3, translated(c, {0.1, 0.0, 0.0}), c),
          detect()};
}

::testing::AssertionResult is_as_noted(Scene& scene) {
  if (scene.world.body_count() != scene.bodies.size()) return ::testing::AssertionFailure() << "number of bodies";
  return same_meeting_bodies(meeting_bodies_by_oracle(scene.bodies), meeting_bodies(scene.world.detect(), scene.ids));
}

void fail_every_allocation_of(std::size_t tested, bool for_good) {
  const std::vector<Operation> operations = small_life();
  for (long number = 0;; ++number) {
    ASSERT_LT(number, 100000);
    Scene scene;
    for (std::size_t i = 0; i < tested; ++i) {
      operations[i].call(scene);
      operations[i].note(scene);
    }
    const Outcome outcome = call_short_of_memory(number, for_good, [&] { operations[tested].call(scene); });
    if (outcome == Outcome::threw) {
      ASSERT_TRUE(is_as_noted(scene)) << "operation " << tested << ", allocation " << number;
      operations[tested].call(scene);
    }
    operations[tested].note(scene);
    ASSERT_TRUE(is_as_noted(scene)) << "operation " << tested << ", allocation " << number;
    if (outcome == Outcome::finished) return;
  }
}

class FailingAllocation : public ::testing::TestWithParam<std::size_t> {};

TEST_P(FailingAllocation, LeavesAUsableWorld) { fail_every_allocation_of(GetParam(), false); }

TEST_P(FailingAllocation, LeavesAUsableWorldWhenAllThatFollowFailToo) { fail_every_allocation_of(GetParam(), true); }

INSTANTIATE_TEST_SUITE_P(Operations, FailingAllocation, ::testing::Range<std::size_t>(0, 16));

// Bodies that turn wildly from step to step: one iteration finds few directions.
struct WildCrowd {
  std::int64_t told = 0, without_text = 0;
  int steps = 0;
  PlainWorld world{{.threads = 1, .iteration_limit = 1, .on_message = [this](const Message& message) {
                      ++told;
                      without_text += message.text.empty() ? 1 : 0;
                    }}};
  std::vector<BodyId> ids;

  // What the next detect() finds.
  void move() {
    for (int i = 0; i < 6; ++i) {
      Mesh mesh = blob(2, 0.5, 0.4, static_cast<std::uint64_t>(100 * steps + i));
      mesh.positions.row((100 * steps + i) % 3) *= 3.0;
      if (steps == 0) ids.push_back(world.add_body({.positions = mesh.positions, .facets = mesh.facets}));
      if (steps > 0) world.set_positions(ids[i], mesh.positions);
    }
    ++steps;
  }
};

// A message whose text cannot be made is told without it: the step has its answer.
TEST(Allocation, ThatFailsForTheTextOfAMessageLeavesTheMessage) {
  WildCrowd first;
  while (first.told == 0) {
    ASSERT_LT(first.steps, 20);
    first.move();
    first.world.detect();
  }
  std::int64_t without_text = 0;
  for (long number = 0;; ++number) {
    ASSERT_LT(number, 2000);
    WildCrowd crowd;
    for (crowd.move(); crowd.steps < first.steps; crowd.move()) crowd.world.detect();
    const Outcome outcome = call_short_of_memory(number, false, [&] { crowd.world.detect(); });
    if (outcome != Outcome::threw) {
      EXPECT_EQ(crowd.told, first.told) << "allocation " << number;
    }
    without_text += crowd.without_text;
    if (outcome == Outcome::finished) break;
  }
  EXPECT_GT(without_text, 0);
}

// Patches that a failed step was finding: the list of what is at each vertex is whole again.
TEST(Allocation, ThatFailsWhilePatchesAreFoundLeavesAUsableWorld) {
  const Mesh first = sheet(12, 12, 12.0, 12.0), second = translated(first, {0.3, 0.0, 0.1});
  const Mesh less_near = translated(second, {0.0, 0.0, 0.01});
  for (long number = 0;; ++number) {
    ASSERT_LT(number, 2000);
    PlainWorld world({.threads = 1, .outputs = {.patches = true, .points = true}});
    std::vector<BodyId> ids;
    for (const Mesh* const mesh : {&first, &second}) {
      ids.push_back(world.add_body(
          {.positions = mesh->positions, .facets = mesh->facets, .surface = Surface::sheet, .margin = 0.1}));
    }
    const Outcome outcome = call_short_of_memory(number, false, [&] { world.detect(); });
    world.set_positions(ids[1], less_near.positions);
    const Report& report = world.detect();
    ASSERT_EQ(report.contacts().size(), 1u) << "allocation " << number;
    ASSERT_EQ(report.contacts()[0].patches().size(), 1u) << "allocation " << number;
    if (outcome == Outcome::finished) break;
  }
}

// What is left out below the body stays what it was where a call that sets it fails.
TEST(Allocation, ThatFailsWhileFiltersAreSetChangesNothing) {
  const Mesh mesh = icosphere(1);
  const std::vector<std::uint32_t> labels(static_cast<std::size_t>(mesh.facet_count()), 1);
  const std::vector<double> margins(static_cast<std::size_t>(mesh.vertex_count()), 0.0);
  PlainWorld world({.threads = 1});
  const std::vector<BodyId> ids = add_bodies(world, std::array{mesh, translated(mesh, {0.5, 0.0, 0.0})});
  world.set_excluded_labels({ids[0], 1, ids[0], 2}, true);
  const std::array<std::function<void()>, 3> calls{
      [&] { world.set_feature_settings(ids[0], {.facet_labels = labels, .margins = margins}); },
      [&] { world.set_self_contact_filter(ids[0], {.rings = 2, .rest_distance = 0.1}); },
      [&] {
        world.set_excluded_labels({ids[1], 3, ids[0], 1}, true);
      }};
  for (const auto& call : calls) {
    const std::vector<std::byte> before = world.save();
    int failures = 0;
    while (call_short_of_memory(failures, false, call) == Outcome::threw) {
      ASSERT_LT(++failures, 1000);
      ASSERT_EQ(world.save(), before) << "allocation " << failures;
    }
    EXPECT_GT(failures, 0);
    EXPECT_NE(world.save(), before);
  }
}

// What a player could not do for want of memory it does when it is asked again.
TEST(Allocation, ThatFailsInAPlayerIsMadeUpFor) {
  std::ostringstream out;
  Recorder recorder(out);
  int steps = 0;
  {
    PlainWorld world({.threads = 1});
    world.set_observer(&recorder);
    const std::vector<BodyId> ids = add_bodies(world, std::vector<Mesh>{icosphere(1), icosphere(1), icosphere(0)});
    world.set_excluded(ids[0], ids[2], true);
    for (; steps < 3; ++steps) {
      world.set_positions(ids[1], translated(icosphere(1), {0.5 + 0.1 * steps, 0.1, 0.0}).positions);
      world.detect();
    }
  }
  const std::string bytes = out.str();
  for (long number = 0;; ++number) {
    ASSERT_LT(number, 5000);
    std::optional<RecordingPlayer> player;
    const auto play = [&] {
      if (!player) player.emplace(bytes);
      while (player->next()) {
      }
    };
    const Outcome outcome = call_short_of_memory(number, false, play);
    if (outcome == Outcome::threw) play();
    EXPECT_FALSE(player->cut_at());
    EXPECT_EQ(player->world().body_count(), 3u);
    EXPECT_EQ(player->report().contacts().size(), 2u) << "allocation " << number;
    if (outcome == Outcome::finished) break;
  }
}

// Bodies so large that a batch moves one after the other, each on all threads: if a later one cannot be moved, none is.
TEST(Allocation, ThatFailsInABatchOfLargeBodiesMovesNone) {
  const std::array before = {wrinkled_sheet(140, 2.0, 0.3, 1), wrinkled_sheet(140, 2.0, 0.3, 2)};
  const std::array after = {translated(before[0], {0.0, 0.0, 0.03125}), translated(before[1], {0.125, 0.0, 0.0})};
  const std::vector<MeetingBodies> met_before = meeting_bodies_by_engine(before);
  const std::vector<MeetingBodies> met_after = meeting_bodies_by_engine(after);
  for (long number = 0;; ++number) {
    ASSERT_LT(number, 1000);
    PlainWorld world({.threads = 2});
    const std::vector<BodyId> ids = add_bodies(world, before);
    const std::array updates = {PositionsUpdate{ids[0], after[0].positions},
                                PositionsUpdate{ids[1], after[1].positions}};
    world.detect();
    const Outcome outcome = call_short_of_memory(number, false, [&] { world.set_positions(updates); });
    world.set_settings(world.settings());  // looks at every pair anew
    ASSERT_TRUE(
        same_meeting_bodies(outcome == Outcome::threw ? met_before : met_after, meeting_bodies(world.detect(), ids)))
        << "allocation " << number;
    if (outcome == Outcome::finished) break;
  }
}

// Two bodies of so many clusters that Embree's trees find their pairs: its own allocations are among those that fail.
// Where Embree fails to start is in test_embree_faults.cpp.
TEST(Allocation, ThatFailsInEmbreeLeavesAUsableWorld) {
  const Mesh a = icosphere(6), b = translated(scaled(a, 0.98), {0.03, 0.01, 0.0});
  const std::vector<FacetPair> expected = facet_pairs_by_oracle(a, b);
  ASSERT_GT(expected.size(), 100u);
  PlainWorld world({.threads = 1});
  add_bodies(world, std::array{a, b});
  world.detect();
  int failures = 0;
  for (long number = 0;; ++number) {
    ASSERT_LT(number, 1000);
    world.set_settings(world.settings());  // looks at every pair anew
    const Outcome outcome = call_short_of_memory(number, false, [&] { world.detect(); });
    failures += outcome == Outcome::threw ? 1 : 0;
    world.set_settings(world.settings());
    const Report& report = world.detect();
    ASSERT_EQ(report.stats().tree_pairs, 1);
    ASSERT_EQ(report.contacts().size(), 1u);
    ASSERT_TRUE(same_facet_pairs(expected, report.contacts()[0].facet_pairs())) << "allocation " << number;
    if (outcome == Outcome::finished) break;
  }
  EXPECT_GT(failures, 3);  // all of them Embree's: what is ours was there from the step before
}

TEST(Allocation, OfAWorldThatFailsLeavesNothing) {
  for (long number = 0; number < 1000; ++number) {
    const Outcome outcome = call_short_of_memory(number, false, [] { PlainWorld world; });
    if (outcome == Outcome::finished) return;
  }
  FAIL() << "a world takes more than 1000 allocations";
}

// Frames that go there and back, again and again: after the first rounds everything has its size.
struct Round {
  Round(Settings settings, const std::vector<Mesh>& bodies) : world(settings), ids(add_bodies(world, bodies)) {
    for (const int frame : {0, 1, 2, 3, 4, 5, 4, 3, 2, 1}) {
      frames.emplace_back();
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        frames.back().push_back(translated(bodies[i], {0.02 * frame, 0.01 * static_cast<double>(i % 5) * frame, 0.0}));
      }
    }
  }
  long allocations_in_a_round() {
    const long before = allocation_count();
    for (const std::vector<Mesh>& frame : frames) {
      for (std::size_t i = 0; i < ids.size(); ++i) world.set_positions(ids[i], frame[i].positions);
      world.detect();
    }
    return allocation_count() - before;
  }

  PlainWorld world;
  std::vector<BodyId> ids;
  std::vector<std::vector<Mesh>> frames;
};

std::vector<Mesh> crowd_and_sheet() {
  std::vector<Mesh> bodies = crowd_of_blobs(16, 1);
  bodies.push_back(wrinkled_sheet(16, 4.0, 0.5, 1));
  return bodies;
}

// On one thread nothing may be taken once the first rounds are over. Which of two threads looks at which pair is not
// the same in every step: until each has had the largest may take a while; what a step always takes shows in every
// round.
long fewest_allocations(Round& round, int threads) {
  if (threads == 1) {
    for (int repeat = 0; repeat < 5; ++repeat) round.allocations_in_a_round();
    return round.allocations_in_a_round() + round.allocations_in_a_round() + round.allocations_in_a_round();
  }
  long fewest = std::numeric_limits<long>::max();
  for (int repeat = 0; repeat < 100 && fewest > 0; ++repeat) {
    fewest = std::min(fewest, round.allocations_in_a_round());
  }
  return fewest;
}

TEST(Allocation, SteadyStepsTakeNone) {
  for (const Accuracy accuracy : {Accuracy::hulls, Accuracy::paper, Accuracy::exact}) {
    for (const DirectionPolicy policy : {DirectionPolicy::carried, DirectionPolicy::smallest}) {
      for (const int threads : {1, 2}) {
        const Outputs outputs{.zones = true, .trace = true};
        Round round({.threads = threads, .accuracy = accuracy, .direction = policy, .outputs = outputs},
                    crowd_and_sheet());
        EXPECT_EQ(fewest_allocations(round, threads), 0)
            << threads << " threads, level " << static_cast<int>(accuracy) << ", policy " << static_cast<int>(policy);
      }
    }
  }
}

TEST(Allocation, SteadyStepsWithAPairForAllThreadsTakeNone) {
  Round round({.threads = 2, .outputs = {.trace = true}}, {icosphere(5), wrinkled_sheet(160, 2.5, 1.0, 1)});
  EXPECT_EQ(fewest_allocations(round, 2), 0);
  round.world.set_positions(round.ids[0], round.frames[3][0].positions);
  const std::span<const TraceEvent> events = round.world.detect().trace();
  EXPECT_GT(std::count_if(events.begin(), events.end(),
                          [](const TraceEvent& event) { return event.kind == TraceEvent::Kind::range; }),
            1);
}

// A pair of so many clusters that trees find those that are near: what builds them takes memory for each, and nothing
// else does.
TEST(Allocation, SteadyStepsWithTreesTakeOnlyTheirBuilders) {
#if !defined(TACT_WITHOUT_EMBREE)
  constexpr long kTakenInAStep = 4;
#else
  constexpr long kTakenInAStep = 9;  // by three trees of up to 512 clusters, of which a sheet has 1250
#endif
  const Mesh a = wrinkled_sheet(200, 2.0, 0.05, 1), b = wrinkled_sheet(200, 2.0, 0.05, 2);
  Round round({.threads = 1}, {a, b});
  const long taken = fewest_allocations(round, 1);
  round.world.set_positions(round.ids[0], round.frames[3][0].positions);
  EXPECT_EQ(round.world.detect().stats().tree_pairs, 1);
  EXPECT_GT(taken, 0);
  EXPECT_LE(taken, 3 * kTakenInAStep * static_cast<long>(round.frames.size()));  // in three rounds
}

// Two equal spheres, one of which slides to and fro: GJK leaves most steps to hull_verdict().
TEST(Allocation, SteadyStepsOfHullsThatRoundingCannotTellTakeNone) {
  for (const DirectionPolicy policy : {DirectionPolicy::carried, DirectionPolicy::smallest}) {
    Round round({.threads = 1, .direction = policy}, {icosphere(1), icosphere(1)});
    round.frames.clear();
    for (int frame = -10; frame < 10; ++frame)
      round.frames.push_back({icosphere(1), translated(icosphere(1), {0.06 * (10 - std::abs(frame)), 0.0, 0.0})});
    EXPECT_EQ(fewest_allocations(round, 1), 0);
  }
}

// Plates and rods through each other, and a body in a thin wall: crossings without a vertex inside, and vertices whose
// side the crossing as a whole tells.
TEST(Allocation, SteadyStepsThatSeekWaysApartTakeNone) {
  const Mesh plate = centered_box({1.0, 1.0, 0.03125}), rod = centered_box({1.0, 0.0625, 0.0625}),
             blade = rotated(centered_box({0.5, 0.03125, 0.5}), rotation(1.0, 0.1, 0.2, 0.3));
  const Mesh walls[] = {cube(2.0, {}), turned_inside_out(cube(1.9, {}))};
  const Mesh across = rotated(rod, rotation(1.0, 0.1, 0.2, 0.9));
  Round round({.threads = 1, .outputs = {.points = true}},
              {plate, blade, translated(rod, {4.0, 0.0, 0.0}), translated(across, {4.01, 0.03, 0.02}),
               translated(merged(walls), {8.0, 0.0, 0.0}), translated(spike({0.3, 0.1, 0.9}, 0.4), {8.7, 0.2, 0.1})});
  EXPECT_EQ(fewest_allocations(round, 1), 0);
  EXPECT_EQ(round.world.detect().contacts().size(), 3u);
  for (const Contact& contact : round.world.detect().contacts()) EXPECT_FALSE(contact.points().empty());
}

TEST(Allocation, SteadyBatchesTakeNone) {
  Round round({.threads = 1}, crowd_and_sheet());
  std::vector<std::vector<PositionsUpdate>> batches;
  for (const std::vector<Mesh>& frame : round.frames) {
    batches.emplace_back();
    for (std::size_t i = 0; i < frame.size(); ++i) batches.back().push_back({round.ids[i], frame[i].positions});
  }
  long last = 0;
  for (int repeat = 0; repeat < 6; ++repeat) {
    const long before = allocation_count();
    for (const std::vector<PositionsUpdate>& batch : batches) {
      round.world.set_positions(batch);
      round.world.detect();
    }
    last = allocation_count() - before;
  }
  EXPECT_EQ(last, 0);
}

// Where there is no memory to put small bodies next to each other, they move as they are.
TEST(Allocation, ThatFailsWhileSmallBodiesArePackedLeavesAUsableWorld) {
  const std::vector<Mesh> before = crowd_of_blobs(80, 1);
  std::vector<Mesh> after;
  for (const Mesh& mesh : before) after.push_back(translated(mesh, {0.03125, 0.0, 0.0}));
  const std::vector<MeetingBodies> met = meeting_bodies_by_engine(after);
  for (long number = 0;; ++number) {
    ASSERT_LT(number, 1000);
    PlainWorld world({.threads = 2});
    const std::vector<BodyId> ids = add_bodies(world, before);
    std::vector<PositionsUpdate> updates;
    for (std::size_t i = 0; i < ids.size(); ++i) updates.push_back({ids[i], after[i].positions});
    const Outcome outcome = call_short_of_memory(number, false, [&] { world.set_positions(updates); });
    if (number == 0) {
      EXPECT_EQ(outcome, Outcome::failed_unnoticed);  // the first that packing takes
    }
    if (outcome == Outcome::threw) world.set_positions(updates);
    ASSERT_TRUE(same_meeting_bodies(met, meeting_bodies(world.detect(), ids))) << "allocation " << number;
    if (outcome == Outcome::finished) break;
  }
}

// Many small bodies are put next to each other by the first batch after they came, and again after a third of them
// went.
TEST(Allocation, ManySmallBodiesArePackedOnce) {
  const Mesh mesh = icosphere(1);
  PlainWorld world({.threads = 1});
  std::vector<BodyId> ids = add_bodies(world, std::vector<Mesh>(100, mesh));
  int move = 0;
  const auto allocations_of_a_batch = [&] {
    const Mesh moved = translated(mesh, {0.0, 0.0, 0x1p-20 * ++move});
    std::vector<PositionsUpdate> batch;
    for (const BodyId id : ids) batch.push_back({id, moved.positions});
    const long before = allocation_count();
    world.set_positions(batch);
    return allocation_count() - before;
  };
  allocations_of_a_batch();
  EXPECT_EQ(allocations_of_a_batch(), 0);
  for (int i = 0; i < 20; ++i) {
    world.remove_body(ids.back());
    ids.pop_back();
  }
  EXPECT_EQ(allocations_of_a_batch(), 0);
  for (int i = 0; i < 14; ++i) {
    world.remove_body(ids.back());
    ids.pop_back();
  }
  EXPECT_GT(allocations_of_a_batch(), 0);
  EXPECT_EQ(allocations_of_a_batch(), 0);
}

// A body that was one point when it was added, its facets in an order that is as good as any: it is grouped anew once,
// without gain, and never again.
TEST(Allocation, ABodyThatCannotBeGroupedBetterIsTriedOnce) {
  const Mesh blob_in_any_order = blob(3, 1.0, 0.3, 1);
  std::vector<int> vertices(static_cast<std::size_t>(blob_in_any_order.vertex_count()));
  std::iota(vertices.begin(), vertices.end(), 0);
  const Mesh mesh = permuted(blob_in_any_order, vertices, facet_order_of(blob_in_any_order));
  Mesh point = mesh;
  point.positions.setZero();
  PlainWorld world({.threads = 1});
  const BodyId id = add_bodies(world, std::array{point})[0];
  world.detect();
  constexpr int kMoves = 200;
  std::vector<int> allocating;  // moves
  for (int move = 0; move < kMoves; ++move) {
    const Mesh moved = translated(mesh, {0.0, 0.0, 0x1p-20 * move});
    const long before = allocation_count();
    world.set_positions(id, moved.positions);
    EXPECT_EQ(world.detect().stats().regrouped_bodies, 0);
    if (move > 0 && allocation_count() > before) allocating.push_back(move);
  }
  EXPECT_EQ(allocating.size(), 1u);
}

#if defined(__GLIBC__)
// A pair with many facet pairs comes and goes, and each time a small pair that stays takes what it leaves.
TEST(Allocation, RoomOfLargePairsThatAreGoneIsLimited) {
  const Mesh large = sheet(50, 50, 1.0, 1.0), small = icosphere(0);
  PlainWorld world({.threads = 1});
  const BodyId moving = add_bodies(world, std::array{large, large})[1];
  const auto meet = [&](bool together) {
    world.set_positions(moving, translated(large, {0.0, 0.0, together ? 0.0 : 5.0}).positions);
    return world.detect().contacts();
  };
  const auto first = meet(true);
  ASSERT_EQ(first.size(), 1u);
  const std::size_t bytes = first[0].facet_pairs().size_bytes();
  ASSERT_GT(bytes, 400'000u);
  const auto bytes_in_use = [] {
    const auto heap = mallinfo2();
    return heap.uordblks + heap.hblkhd;
  };
  const std::size_t before = bytes_in_use();
  constexpr int kTimes = 40;
  for (int k = 0; k < kTimes; ++k) {
    const Mesh here = translated(small, {10.0 + 5.0 * k, 0.0, 0.0});
    add_bodies(world, std::array{here, translated(here, {0.5, 0.0, 0.0})});
    meet(false);
    meet(true);
  }
  EXPECT_LT(bytes_in_use(), before + kTimes * bytes / 2);
}
#endif

TEST(Allocation, StepsAtRestTakeNone) {
  PlainWorld world({.outputs = {.zones = true, .patches = true}});
  add_bodies(world, crowd_of_blobs(20, 1));
  world.detect();
  const long before = allocation_count();
  for (int step = 0; step < 10; ++step) world.detect();
  EXPECT_EQ(allocation_count() - before, 0);
}

}  // namespace
}  // namespace tact::tests
