// When features first meet, against rational arithmetic.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/motion/meeting.h"
#include "tests/support/motion_oracle.h"
#include "tests/support/random.h"

namespace tact::tests {
namespace {

using narrowphase::edge_seen_from;
using narrowphase::facet_seen_from;
using narrowphase::Meeting;
using narrowphase::MeetingSearch;
using narrowphase::MovingPolygon;
using narrowphase::MovingVertex;

// Two edges, or a vertex and a facet.
struct Query {
  bool edges = false;
  std::array<MovingVertex, 4> vertices;

  MovingPolygon polygon() const {
    const auto& v = vertices;
    return edges ? edge_seen_from({v[0], v[1]}, {v[2], v[3]}) : facet_seen_from(v[0], {v[1], v[2], v[3]});
  }
  std::optional<TimeEnclosure> exact() const {
    const auto& v = vertices;
    return edges ? first_time_of_edges({v[0], v[1]}, {v[2], v[3]})
                 : first_time_of_vertex_and_facet(v[0], {v[1], v[2], v[3]});
  }
};

std::ostream& operator<<(std::ostream& out, const Query& query) {
  out << (query.edges ? "edges" : "vertex and facet");
  out.precision(17);
  for (const MovingVertex& vertex : query.vertices) {
    out << "\n ";
    for (const Vec3& p : vertex.at) out << " " << p.x << " " << p.y << " " << p.z;
  }
  return out;
}

using LongVector = std::array<long double, 3>;

LongVector operator-(const LongVector& a, const LongVector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
long double dot(const LongVector& a, const LongVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// How far the polygon is from the origin at a time, over its size and way: the least over its sides and, where the
// origin lies above it, its plane.
double distance_at(const MovingPolygon& polygon, double time) {
  long double size = 0.0L, least = 0.0L;
  std::array<LongVector, 4> p;
  for (int i = 0; i < polygon.count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const long double begin = polygon.corner[0][i].head[axis], end = polygon.corner[1][i].head[axis];
      p[static_cast<std::size_t>(i)][static_cast<std::size_t>(axis)] = begin + time * (end - begin);
      size = std::max({size, std::abs(begin), std::abs(end)});
    }
  }
  const auto count = static_cast<std::size_t>(polygon.count);
  least = std::numeric_limits<long double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const LongVector side = p[(i + 1) % count] - p[i];
    const long double length = dot(side, side);
    const long double s = length > 0.0L ? std::clamp(-dot(p[i], side) / length, 0.0L, 1.0L) : 0.0L;
    LongVector nearest = p[i];
    for (std::size_t axis = 0; axis < 3; ++axis) nearest[axis] += s * side[axis];
    least = std::min(least, std::sqrt(dot(nearest, nearest)));
  }
  const LongVector e = p[1] - p[0], f = p[count - 1] - p[0];
  const long double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), determinant = ee * ff - ef * ef;
  if (determinant > 0.0L) {
    const long double ep = -dot(e, p[0]), fp = -dot(f, p[0]);
    const long double u = (ff * ep - ef * fp) / determinant, v = (ee * fp - ef * ep) / determinant;
    if (u >= 0.0L && v >= 0.0L && (count == 4 ? u <= 1.0L && v <= 1.0L : u + v <= 1.0L)) {
      LongVector nearest = p[0];
      for (std::size_t axis = 0; axis < 3; ++axis) nearest[axis] += u * e[axis] + v * f[axis];
      least = std::min(least, std::sqrt(dot(nearest, nearest)));
    }
  }
  return size > 0.0L ? static_cast<double>(least / size) : 0.0;
}

// Never missed, never late, at most 1e-6 early; and near each other at the time that is said.
void expect_exact(const Query& query, MeetingSearch& search, std::int64_t& hits) {
  const Meeting meeting = search.first(query.polygon(), 0.0);
  const auto exact = query.exact();
  if (!exact) {
    if (meeting.time <= 1.0) {
      EXPECT_LT(distance_at(query.polygon(), meeting.time), 1e-11) << query;
    }
    return;
  }
  ++hits;
  ASSERT_LE(meeting.time, exact->high) << query;
  EXPECT_GT(meeting.time, exact->low - 1e-6) << query;
}

Query random_query(Random& random) {
  Query query;
  query.edges = random.chance(0.5);
  // Whole numbers of few bits make what is coplanar, parallel or equal common.
  const int grid = random.chance(0.5) ? 2 + random.below(6) : 0;
  const double unit = std::ldexp(1.0, random.below(40) - 20);
  const Vec3 origin = random.chance(0.3) ? 1e3 * unit * random.in_cube(1.0) : Vec3{};
  const bool rigid = random.chance(0.2), flat = random.chance(0.1);
  const Vec3 way = random.in_cube(3.0);
  for (MovingVertex& vertex : query.vertices) {
    for (Vec3& p : vertex.at) {
      if (grid > 0) {
        p = {double(random.below(grid)), double(random.below(grid)), flat ? 0.0 : double(random.below(grid))};
      } else {
        p = random.in_cube(1.0);
        if (flat) p.z = 0.0;
      }
    }
    if (rigid) vertex.at[1] = vertex.at[0] + (&vertex < &query.vertices[query.edges ? 2 : 1] ? way : Vec3{});
    if (random.chance(0.1)) vertex.at[1] = vertex.at[0];
  }
  if (random.chance(0.1)) query.vertices[3] = query.vertices[2];
  for (MovingVertex& vertex : query.vertices) {
    for (Vec3& p : vertex.at) p = origin + unit * p;
  }
  return query;
}

TEST(Meeting, RandomQueriesEqualRationalArithmetic) {
  Random random(1);
  MeetingSearch search;
  std::int64_t hits = 0;
  for (int i = 0; i < 4'000; ++i) expect_exact(random_query(random), search, hits);
  EXPECT_GT(hits, 400);
}

// A corner that touches the other feature exactly, or stays apart by the smallest double, at one time.
TEST(Meeting, GrazingQueriesEqualRationalArithmetic) {
  Random random(2);
  MeetingSearch search;
  std::int64_t hits = 0;
  for (int i = 0; i < 3'000; ++i) {
    Query query = random_query(random);
    // At half-way the first vertex lies in a corner, on a side or inside the other feature, but for rounding.
    const double s = random.below(3) * 0.5, t = random.chance(0.5) ? 0.0 : random.uniform();
    const auto middle = [&](int k) {
      const auto& at = query.vertices[static_cast<std::size_t>(k)].at;
      return 0.5 * (at[0] + at[1]);
    };
    const Vec3 target = query.edges ? middle(2) + s * (middle(3) - middle(2))
                                    : middle(1) + s * (middle(2) - middle(1)) + t * (1.0 - s) * (middle(3) - middle(1));
    auto& first = query.vertices[0].at;
    first[1] = 2.0 * target - first[0];
    expect_exact(query, search, hits);
  }
  EXPECT_GT(hits, 300);
}

TEST(Meeting, QueriesWithKnownAnswersAreRight) {
  const std::string folder = std::string(TACT_DATA_DIR) + "/ccd_unit_queries/";
  if (!std::ifstream(folder + "edge-edge_0.csv")) GTEST_SKIP() << "no folder of test data at " << folder;
  MeetingSearch search;
  std::int64_t hits = 0;
  int count = 0;
  for (const char* name : {"edge-edge_0", "edge-edge_1", "vertex-face_0", "vertex-face_1"}) {
    std::ifstream in(folder + name + ".csv");
    std::string line;
    Query query;
    query.edges = name[0] == 'e';
    for (std::size_t row = 0; std::getline(in, line); ++row) {
      std::ranges::replace(line, ',', ' ');
      std::istringstream numbers(line);
      double x[6];
      bool answer = false;
      for (double& number : x) numbers >> number;
      numbers >> answer;
      ASSERT_TRUE(numbers) << name << ", row " << row;
      query.vertices[row % 4].at[row % 8 / 4] = {x[0] / x[1], x[2] / x[3], x[4] / x[5]};
      if (row % 8 != 7) continue;
      ++count;
      EXPECT_EQ(search.first(query.polygon(), 0.0).time <= 1.0, answer) << name << ", query " << row / 8;
      EXPECT_EQ(query.exact().has_value(), answer) << name << ", query " << row / 8;
      expect_exact(query, search, hits);
    }
  }
  EXPECT_EQ(count, 324);
  EXPECT_EQ(hits, 160);
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

// The filter leaves out nothing that meets, and every instruction set leaves out the same.
TEST(Meeting, TheFilterLeavesOutNothingThatMeets) {
  Random random(4);
  MeetingSearch search;
  std::int64_t left_out = 0, meeting = 0;
  for (int block = 0; block < 400; ++block) {
    for (const double reach : {0.0, 0.01}) {
      narrowphase::MovingPolygons polygons;
      polygons.corners = 3 + block % 2;
      std::vector<MovingPolygon> all;
      const int wanted = 1 + random.below(64);
      while (polygons.count < wanted) {
        Query query = random_query(random);
        if (query.edges != (polygons.corners == 4)) continue;
        for (MovingVertex& vertex : query.vertices) {
          for (Vec3& p : vertex.at) p = 1e-3 * p;
        }
        const MovingPolygon polygon = query.polygon();
        double size = 0.0;
        for (const auto& corners : polygon.corner) {
          for (int i = 0; i < polygon.count; ++i) size = std::max(size, norm(corners[i].head));
        }
        if (size > 2.0) continue;
        for (int time = 0; time < 2; ++time) {
          for (int i = 0; i < polygon.count; ++i) {
            for (int axis = 0; axis < 3; ++axis)
              polygons.corner[time][i][axis][polygons.count] = polygon.corner[time][i].head[axis];
          }
        }
        ++polygons.count;
        all.push_back(polygon);
      }
      const std::uint64_t apart = narrowphase::scalar_kernels()->apart_throughout(polygons, reach);
      for (const auto* other : {narrowphase::avx2_kernels(), narrowphase::avx512_kernels()}) {
        if (other == nullptr) continue;
        EXPECT_EQ(other->apart_throughout(polygons, reach), apart) << other->name;
      }
      for (std::size_t i = 0; i < all.size(); ++i) {
        const bool meets = search.first(all[i], reach).time <= 1.0;
        meeting += meets;
        if ((apart >> i & 1) == 0) continue;
        ++left_out;
        EXPECT_FALSE(meets);
      }
    }
  }
  EXPECT_GT(left_out, 5000);
  EXPECT_GT(meeting, 2000);
}

}  // namespace
}  // namespace tact::tests
