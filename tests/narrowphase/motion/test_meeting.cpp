// When features first meet, against rational arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "narrowphase/motion/meeting.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/motion_queries.h"

namespace tact::tests {
namespace {

using narrowphase::facet_seen_from;
using narrowphase::MeetingSearch;
using narrowphase::MovingPolygon;
using narrowphase::MovingVertex;

// All queries are answered right; returns how many meet.
template <class Make>
int meeting_of(int count, const Make& make) {
  MeetingSearch search;
  int meeting = 0;
  for (int i = 0; i < count; ++i) {
    const auto [answer, failure] = check(make(), search);
    EXPECT_EQ(failure, "") << "query " << i;
    meeting += answer == QueryAnswer::meets;
  }
  return meeting;
}

TEST(Meeting, RandomQueriesEqualRationalArithmetic) {
  Random random(1);
  EXPECT_GT(meeting_of(2'000, [&] { return random_query(random); }), 200);
}

// A corner that touches the other feature exactly, or stays apart by the smallest double, at one time.
TEST(Meeting, GrazingQueriesEqualRationalArithmetic) {
  Random random(2);
  EXPECT_GT(meeting_of(1'500, [&] { return grazing_query(random); }), 150);
}

TEST(Meeting, QueriesWithKnownAnswersAreRight) {
  const std::string folder = std::string(TACT_DATA_DIR) + "/ccd_unit_queries";
  const std::vector<UnitQuery> queries = read_unit_queries(folder);
  if (queries.empty()) GTEST_SKIP() << "no folder of test data at " << folder;
  EXPECT_EQ(queries.size(), 324u);
  MeetingSearch search;
  for (const UnitQuery& query : queries) {
    EXPECT_EQ(search.first(query.polygon(), 0.0).time <= 1.0, query.answer) << query.name;
    EXPECT_EQ(exact_time(query).has_value(), query.answer) << query.name;
    EXPECT_EQ(check(query, search).failure, "") << query.name;
  }
}

// With a reach: never late, and at the time found the distance is what was asked for.
TEST(Meeting, AReachIsMetWhenItIsReached) {
  const MovingVertex vertex{{{0.25, 0.25, 1.0}, {0.25, 0.25, -1.0}}};
  const MovingVertex facet[3] = {{{{0, 0, 0}, {0, 0, 0}}}, {{{1, 0, 0}, {1, 0, 0}}}, {{{0, 1, 0}, {0, 1, 0}}}};
  MeetingSearch search;
  EXPECT_NEAR(search.first(facet_seen_from(vertex, facet), 0.0).time, 0.5, 1e-10);
  EXPECT_NEAR(search.first(facet_seen_from(vertex, facet), 0.25).time, 0.375, 1e-10);
  EXPECT_LE(search.first(facet_seen_from(vertex, facet), 0.25).time, 0.375);
  // It begins nearer than 2, at 1: a tenth of that is allowed.
  EXPECT_NEAR(search.first(facet_seen_from(vertex, facet), 2.0).time, 0.45, 1e-10);
  // Just above the reach it is not stopped at once; a little more above it is.
  EXPECT_NEAR(search.first(facet_seen_from(vertex, facet), 0.9995).time, 0.45, 1e-10);
  EXPECT_NEAR(search.first(facet_seen_from(vertex, facet), 0.998).time, 0.001, 1e-10);
}

// The nearer end of an edge passes a vertex at 0.1414: from the right its first coordinate separates them, then its
// second.
TEST(Meeting, ACornerThatPassesACornerComesNoNearer) {
  const auto passing = [](double beside) {
    const MovingVertex vertex{{{0, 0, 0}, {0, 0, 0}}};
    const MovingVertex ends[2] = {{{{0.3, -beside, 0}, {-0.7, 1.0 - beside, 0}}},
                                  {{{1.3, -beside, 0}, {0.3, 1.0 - beside, 0}}}};
    return facet_seen_from(vertex, {ends[0], ends[1], ends[1]});
  };
  MeetingSearch search;
  EXPECT_GT(search.first(passing(0.1), 0.1).time, 1.0);
  EXPECT_GT(search.first(passing(0.1), 0.1414).time, 1.0);
  EXPECT_NEAR(search.first(passing(0.1), 0.1415).time, 0.2, 0.01);
  // Nearest at the corner, then inside the edge, which comes within 0.1 at 0.4.
  EXPECT_NEAR(search.first(passing(0.5), 0.1).time, 0.4, 1e-10);
}

// At half-way a corner is at the origin; before, it is the nearest point, and nearly on a side, which rounding may take
// for nearest as well.
TEST(Meeting, ACornerNearlyOnASideComesWithinAReachInTime) {
  MotionQuery query;
  query.edges = true;
  query.vertices = {MovingVertex{{{1, 2, 1}, {5, 6, 7}}}, MovingVertex{{{1, 0, 4}, {1, 0, 4}}},
                    MovingVertex{{{4, 3, 6}, {4, 3, 6}}}, MovingVertex{{{1, 6, 3}, {5, 2, 5}}}};
  MeetingSearch search;
  for (double reach = 1e-5; reach > 1e-9; reach *= 0.7) EXPECT_EQ(check_within(query, reach, search).failure, "");
}

TEST(Meeting, QueriesWithAReachEqualAlgebraicNumbers) {
  Random random(8);
  MeetingSearch search;
  int meeting = 0, missing = 0;
  for (int i = 0; i < 1200; ++i) {
    const MotionQuery query = i % 3 == 0 ? random_query(random) : query_past_corner(random);
    const auto [answer, failure] = check_within(query, reach_for(query, random), search);
    EXPECT_EQ(failure, "");
    meeting += answer == QueryAnswer::meets;
    missing += answer == QueryAnswer::misses;
  }
  EXPECT_GT(meeting, 200);
  EXPECT_GT(missing, 200);
}

struct MeetingCounts {
  int meeting = 0, at_once = 0;  // of these, without a search of spans of time
};

// Checks that each of `count` queries is answered rightly.
template <class Make>
MeetingCounts check_all(int count, std::uint64_t seed, const Make& make) {
  Random random(seed);
  MeetingSearch search;
  MeetingCounts counts;
  for (int i = 0; i < count; ++i) {
    const MotionQuery query = make(random);
    const CheckedQuery checked = check(query, search);
    EXPECT_EQ(checked.failure, "");
    if (checked.answer != QueryAnswer::meets) continue;
    ++counts.meeting;
    counts.at_once += search.first(query.polygon(), 0.0).spans == 0 ? 1 : 0;
  }
  return counts;
}

// Their volume is zero throughout.
TEST(Meeting, EdgesThatStayInOnePlaneAreRightMostlyAtOnce) {
  const auto [meeting, at_once] = check_all(2000, 5, query_in_plane);
  EXPECT_GT(meeting, 500);
  EXPECT_GT(at_once, meeting / 3);
}

// Corners whose way goes exactly through the origin; often something meets before them.
TEST(Meeting, CornersThatMeetExactlyAreRightMostlyAtOnce) {
  const auto [meeting, at_once] = check_all(3000, 6, query_of_layers);
  EXPECT_GT(meeting, 800);
  EXPECT_GT(at_once, meeting * 8 / 10);
}

// The way of a corner goes to the origin and ends there, or begins there.
TEST(Meeting, ACornerMeetsAtTheFirstOrLastTime) {
  const MovingVertex facet[3] = {{{{0, 0, 0}, {0, 0, 0}}}, {{{1, 0, 0}, {1, 0, 0}}}, {{{0, 1, 0}, {0, 1, 0}}}};
  MeetingSearch search;
  for (const double height : {-1.0, 1.0}) {
    const Vec3 away{0, 0, height}, corner{1, 0, 0};
    EXPECT_EQ(search.first(facet_seen_from({{corner, corner + away}}, facet), 0.0).time, 0.0);
    EXPECT_NEAR(search.first(facet_seen_from({{corner + away, corner}}, facet), 0.0).time, 1.0, 1e-10);
    EXPECT_NEAR(search.first(facet_seen_from({{corner + away, corner - away}}, facet), 0.0).time, 0.5, 1e-10);
    EXPECT_GT(search.first(facet_seen_from({{corner + away, corner + 0.5 * away}}, facet), 0.0).time, 1.0);
  }
}

TEST(Meeting, TheSearchTakesTheSameStepsWhateverIsLatest) {
  Random random(3);
  MeetingSearch search;
  for (int i = 0; i < 2000; ++i) {
    const MovingPolygon polygon = random_query(random).polygon();
    const double time = search.first(polygon, 0.0).time;
    for (const double latest : {0.0, 0.3, 0.7}) {
      const double found = search.first(polygon, 0.0, latest).time;
      EXPECT_TRUE(found == time || (time > latest && found > 1.0)) << time << " " << found;
    }
    EXPECT_EQ(search.first(polygon, 0.0, std::min(time, 1.0)).time, time);
  }
}

}  // namespace
}  // namespace tact::tests
