// Report::trace(): every kind of work is there, on the thread that did it, and adds up to the step's own times.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/generators/folds.h"

namespace tact::tests {
namespace {

using Kind = TraceEvent::Kind;

double ms(const TraceEvent& event) {
  return std::chrono::duration<double, std::milli>(event.end - event.begin).count();
}

std::vector<TraceEvent> events_of(const Report& report, Kind kind) {
  std::vector<TraceEvent> found;
  std::ranges::copy_if(report.trace(), std::back_inserter(found), [&](const auto& e) { return e.kind == kind; });
  return found;
}

// Sorted by thread and time; of two events of a thread one lies in the other or behind it.
::testing::AssertionResult is_nested(std::span<const TraceEvent> events) {
  std::vector<TraceEvent> open;
  for (const TraceEvent& event : events) {
    if (event.end < event.begin) return ::testing::AssertionFailure() << "an event ends before it begins";
    if (!open.empty() && open.front().thread > event.thread) return ::testing::AssertionFailure() << "threads unsorted";
    while (!open.empty() && (open.back().thread != event.thread || open.back().end <= event.begin)) open.pop_back();
    if (!open.empty() && (event.begin < open.back().begin || event.end > open.back().end)) {
      return ::testing::AssertionFailure() << "event of kind " << static_cast<int>(event.kind)
                                           << " crosses one of kind " << static_cast<int>(open.back().kind);
    }
    open.push_back(event);
  }
  return ::testing::AssertionSuccess();
}

// Two spheres of 80,000 facets each: their stage 6 is cut into ranges.
struct LargePair {
  explicit LargePair(const Settings& settings) : world(settings) {
    const Mesh a = icosphere(6);
    ids = add_bodies(world, std::array{a, translated(scaled(a, 0.98), {0.03, 0.01, 0.0})});
  }
  World world;
  std::vector<BodyId> ids;
};

TEST(Trace, IsEmptyUnlessAskedFor) {
  World world;
  add_bodies(world, std::array{icosphere(2), translated(icosphere(2), {1.5, 0.0, 0.0})});
  EXPECT_TRUE(world.detect().trace().empty());
  world.set_settings({.outputs = {.trace = true}});
  EXPECT_FALSE(world.detect().trace().empty());
  world.set_settings({});
  EXPECT_TRUE(world.detect().trace().empty());
}

TEST(Trace, HoldsTheStagesOfAStepAndTheirTimes) {
  for (const int threads : {1, 2}) {
    World world({.threads = threads, .outputs = {.patches = true, .points = true, .trace = true}});
    const std::vector<Mesh> bodies = crowd_of_blobs(30, 1);
    const std::vector<BodyId> ids = add_bodies(world, bodies);
    const Mesh cloth = rolled_sheet(30, 10, 2.2, 0.12, 0.05);
    const BodyId self = world.add_body({.positions = cloth.positions,
                                        .facets = cloth.facets,
                                        .surface = Surface::sheet,
                                        .margin = 0.01,
                                        .self_contact = true});
    world.detect();
    world.set_positions(self, translated(cloth, {0.01, 0, 0}).positions);
    for (std::size_t i = 0; i < 3; ++i) world.set_positions(ids[i], translated(bodies[i], {0.01, 0, 0}).positions);
    const Report& report = world.detect();
    const StepStats& stats = report.stats();
    EXPECT_TRUE(is_nested(report.trace()));
    EXPECT_EQ(events_of(report, Kind::refresh).size(), 4u);
    double refresh_ms = 0.0;
    for (const TraceEvent& event : events_of(report, Kind::refresh)) refresh_ms += ms(event);
    EXPECT_NEAR(refresh_ms, stats.refresh_ms, 1e-5);
    double stages_ms = 0.0;
    for (const auto& [kind, expected] : {std::pair{Kind::sweep, stats.sweep_ms},
                                         {Kind::narrow_phase, stats.narrow_phase_ms},
                                         {Kind::containment, stats.containment_ms},
                                         {Kind::points, stats.points_ms},
                                         {Kind::self_facets, stats.self_facets_ms},
                                         {Kind::self_points, stats.self_points_ms},
                                         {Kind::patches, stats.patches_ms},
                                         {Kind::report, stats.report_ms}}) {
      const std::vector<TraceEvent> found = events_of(report, kind);
      ASSERT_EQ(found.size(), 1u) << static_cast<int>(kind);
      EXPECT_EQ(found[0].thread, 0);
      EXPECT_NEAR(ms(found[0]), expected, 1e-5);
      stages_ms += expected;
    }
    ASSERT_EQ(events_of(report, Kind::detect).size(), 1u);
    EXPECT_LE(stages_ms, ms(events_of(report, Kind::detect)[0]) + 1e-5);
  }
}

// Each pair that the step looked at is in one event, and each within the narrow phase.
TEST(Trace, TellsOfEveryPairOnce) {
  for (const int threads : {1, 2}) {
    World world({.threads = threads, .outputs = {.trace = true}});
    add_bodies(world, crowd_of_blobs(60, 1));
    const Report& report = world.detect();
    std::int64_t pairs = 0;
    for (const TraceEvent& event : events_of(report, Kind::small_pairs)) pairs += event.count;
    const std::vector<TraceEvent> separated = events_of(report, Kind::kdop_separated_pairs);
    ASSERT_EQ(separated.size(), 1u);
    EXPECT_EQ(separated[0].count, report.stats().kdop_separated_pairs);
    EXPECT_GT(separated[0].count, 0);
    pairs += separated[0].count;
    EXPECT_TRUE(is_nested(report.trace()));
    std::set<std::pair<BodyId, BodyId>> long_pairs;
    for (const TraceEvent& event : events_of(report, Kind::pair)) long_pairs.insert({event.a, event.b});
    EXPECT_EQ(pairs + static_cast<std::int64_t>(long_pairs.size()), report.stats().candidate_pairs);
    const TraceEvent narrow_phase = events_of(report, Kind::narrow_phase).at(0);
    for (const TraceEvent& event : report.trace()) {
      if (event.kind != Kind::pair && event.kind != Kind::small_pairs && event.kind != Kind::kdop_separated_pairs)
        continue;
      EXPECT_LT(event.thread, threads);
      EXPECT_GE(event.begin, narrow_phase.begin);
      EXPECT_LE(event.end, narrow_phase.end);
    }
  }
}

TEST(Trace, NamesALargePairWithItsStagesAndRanges) {
  LargePair large({.threads = 2, .outputs = {.trace = true}});
  const Report& report = large.world.detect();
  EXPECT_TRUE(is_nested(report.trace()));
  const auto facet_pairs = static_cast<std::int64_t>(report.contacts()[0].facet_pairs().size());
  for (const Kind kind : {Kind::pair, Kind::hulls, Kind::direction, Kind::cull, Kind::confirm}) {
    const std::vector<TraceEvent> found = events_of(report, kind);
    ASSERT_EQ(found.size(), 1u) << static_cast<int>(kind);
    EXPECT_EQ(found[0].a, large.ids[0]);
    EXPECT_EQ(found[0].b, large.ids[1]);
    EXPECT_EQ(found[0].count, kind == Kind::pair || kind == Kind::confirm ? facet_pairs : 0);
  }
  const std::vector<TraceEvent> ranges = events_of(report, Kind::range);
  EXPECT_GT(ranges.size(), 4u);
  std::int64_t found = 0;
  for (const TraceEvent& range : ranges) {
    found += range.count;
    EXPECT_GE(range.begin, events_of(report, Kind::confirm)[0].begin);
    EXPECT_LE(range.end, events_of(report, Kind::confirm)[0].end);
  }
  EXPECT_EQ(found, facet_pairs);
}

// Threads that are left without pairs take ranges of large ones, while others still have pairs.
TEST(Trace, OfSeveralLargePairsTellsOfEveryRange) {
  const Mesh ball = icosphere(5);
  const std::array bodies{ball, translated(scaled(ball, 0.98), {0.03, 0.01, 0.0}), translated(ball, {1.9, 0.0, 0.0}),
                          translated(scaled(ball, 0.97), {1.92, 0.02, 0.0})};
  World alone({.threads = 1});
  add_bodies(alone, bodies);
  const Report& expected = alone.detect();
  World world({.threads = 3, .outputs = {.trace = true}});
  add_bodies(world, bodies);
  for (int step = 0; step < 20; ++step) {
    const Report& report = world.detect();
    EXPECT_EQ(report.hash(), expected.hash());
    EXPECT_TRUE(is_nested(report.trace()));
    std::map<std::pair<BodyId, BodyId>, std::int64_t> found;
    for (const TraceEvent& range : events_of(report, Kind::range)) found[{range.a, range.b}] += range.count;
    EXPECT_GE(found.size(), 2u);
    std::int64_t all = 0;
    for (const Contact& contact : report.contacts()) {
      const auto facet_pairs = static_cast<std::int64_t>(contact.facet_pairs().size());
      if (!found.contains({contact.a, contact.b})) continue;
      EXPECT_EQ(found.at({contact.a, contact.b}), facet_pairs);
      all += facet_pairs;
    }
    std::int64_t told = 0;
    for (const TraceEvent& confirm : events_of(report, Kind::confirm)) {
      if (confirm.a == confirm.b) told += confirm.count;
    }
    EXPECT_EQ(told, all);
    world.set_settings(world.settings());  // looks at all pairs again
  }
}

TEST(Trace, OneThreadCutsNothing) {
  LargePair large({.threads = 1, .outputs = {.trace = true}});
  const Report& report = large.world.detect();
  EXPECT_TRUE(is_nested(report.trace()));
  EXPECT_TRUE(events_of(report, Kind::range).empty());
  EXPECT_EQ(events_of(report, Kind::confirm).size(), 1u);
}

TEST(Trace, OfAStepInWhichNothingMovedIsTheCallAlone) {
  World world({.outputs = {.trace = true}});
  add_bodies(world, crowd_of_blobs(10, 1));
  world.detect();
  const Report& report = world.detect();
  ASSERT_EQ(report.trace().size(), 1u);
  EXPECT_EQ(report.trace()[0].kind, Kind::detect);
}

}  // namespace
}  // namespace tact::tests
