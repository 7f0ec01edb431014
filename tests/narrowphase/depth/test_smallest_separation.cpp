#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "narrowphase/depth/smallest_separation.h"
#include "narrowphase/mesh/refit.h"
#include "tests/support/inside/mesh_through.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::is_local_minimum;
using tests::mesh_through;
using tests::minkowski_height;
using tests::smallest_height;
using tests::SmallestHeight;

using Points = std::vector<Vec3>;

// Two bodies whose hulls overlap or touch. Metres.
struct Pair {
  Points a;
  Points b;
};

// The answer in metres.
struct Answer {
  SmallestSeparation separation;
  double height = 0.0;
  double lower_bound = 0.0;
  double size = 0.0;
};

// The ways to an answer: by the exact polytope alone; in doubles first, from GJK's simplex; and from a last search.
enum class Way { exact, fresh, continued };
constexpr Way kWays[] = {Way::exact, Way::fresh, Way::continued};

void move_to(const Points& points, ClusteredMesh& mesh) {
  std::vector<double> positions;
  for (const Vec3& p : points) positions.insert(positions.end(), {p.x, p.y, p.z});
  refit(mesh, positions.data());
}

// `last`: where the bodies were in the last search, if that is the way.
Answer solve(const Pair& pair, Vec3 preferred = {0, 0, 1}, Way way = Way::fresh, const Pair* last = nullptr) {
  SmallestMemory memory;
  SurfaceShape shape;
  ClusteredMesh a = mesh_through((last ? *last : pair).a), b = mesh_through((last ? *last : pair).b);
  const auto search = [&] {
    const MinkowskiDifference m(a, b);
    const SmallestSeparation s = way == Way::exact
                                     ? expanding_polytope(m, preferred, memory.polytope)
                                     : smallest_separation(m, {preferred, gjk(m, {}, {}, {}).simplex, &shape}, memory);
    return Answer{s, s.height / m.scale(), s.lower_bound / m.scale(), m.size() / m.scale()};
  };
  if (way == Way::continued) search();
  move_to(pair.a, a);
  move_to(pair.b, b);
  return search();
}

// Height, direction and bounds against the oracle, to `relative` of the size.
void expect_smallest(const Pair& pair, double relative = 1e-13, const Pair* last = nullptr) {
  const double truth = static_cast<double>(smallest_height(pair.a, pair.b, 0.0).height);
  for (const Way way : kWays) {
    const Answer answer = solve(pair, {0, 0, 1}, way, last);
    SCOPED_TRACE(testing::Message() << "way " << static_cast<int>(way));
    const double tolerance = relative * answer.size;
    const Vec3 n = answer.separation.direction;
    EXPECT_FALSE(answer.separation.limit_reached);
    EXPECT_NEAR(norm(n), 1.0, 1e-15);
    EXPECT_NEAR(answer.height, truth, tolerance);
    EXPECT_NEAR(static_cast<double>(minkowski_height(pair.a, pair.b, n)), truth, tolerance);
    EXPECT_LE(answer.lower_bound, truth + 1e-15 * answer.size);
    EXPECT_GE(answer.lower_bound, truth - tolerance);
  }
}

class RandomHulls {
 public:
  explicit RandomHulls(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Vec3 point() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return normalized(Vec3{normal(engine_), normal(engine_), normal(engine_)});
  }
  Points cloud(int count) {
    Points points(static_cast<std::size_t>(count));
    for (Vec3& p : points) p = point();
    return points;
  }
  // A point of the hull.
  Vec3 point_in(const Points& points) {
    Vec3 sum;
    double weights = 0.0;
    for (const Vec3& p : points) {
      const double weight = uniform(0, 1);
      sum = sum + weight * p;
      weights += weight;
    }
    return (1.0 / weights) * sum;
  }

 private:
  std::mt19937 engine_;
};

void translate(Points& points, Vec3 by) {
  for (Vec3& p : points) p = p + by;
}

void rotate(Points& points, Vec3 axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (Vec3& p : points) p = c * p + s * cross(axis, p) + (1.0 - c) * dot(axis, p) * axis;
}

void stretch(Points& points, Vec3 by) {
  for (Vec3& p : points) p = {p.x * by.x, p.y * by.y, p.z * by.z};
}

Points box(Vec3 half, Vec3 center = {}) {
  Points points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(center + Vec3{i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
  }
  return points;
}

// Moves b so that a point inside both hulls coincides.
void make_overlap(Pair& pair, RandomHulls& random) {
  translate(pair.b, random.point_in(pair.a) - random.point_in(pair.b));
}

// Moves b so that the hulls touch across n.
void make_touch(Pair& pair, Vec3 n) { translate(pair.b, static_cast<double>(minkowski_height(pair.a, pair.b, n)) * n); }

// Runs `make(random)` for many seeds and holds each pair against the oracle.
template <class Make>
void expect_smallest_for_seeds(unsigned count, const Make& make) {
  for (unsigned seed = 0; seed < count; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    RandomHulls random(seed);
    expect_smallest(make(random));
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace

TEST(SmallestSeparation, RandomPolytopes) {
  expect_smallest_for_seeds(2500, [](RandomHulls& random) {
    Pair pair{random.cloud(random.integer(4, 8)), random.cloud(random.integer(4, 8))};
    make_overlap(pair, random);
    return pair;
  });
}

TEST(SmallestSeparation, LargerHulls) {
  expect_smallest_for_seeds(100, [](RandomHulls& random) {
    Pair pair{random.cloud(random.integer(9, 24)), random.cloud(random.integer(9, 24))};
    make_overlap(pair, random);
    return pair;
  });
}

TEST(SmallestSeparation, BoxesInRandomPoses) {
  expect_smallest_for_seeds(1000, [](RandomHulls& random) {
    Pair pair{box({1, 0.7, 0.4}), box({0.2, 0.5, 1.5})};
    rotate(pair.a, random.direction(), random.uniform(0, 3));
    rotate(pair.b, random.direction(), random.uniform(0, 3));
    make_overlap(pair, random);
    return pair;
  });
}

// Faces of M that many vertices share, in one plane exactly or but for rounding.
TEST(SmallestSeparation, AlignedBoxes) {
  expect_smallest_for_seeds(1500, [](RandomHulls& random) {
    const auto eighth = [&] { return random.integer(1, 8) / 8.0; };
    Pair pair{box({eighth(), eighth(), eighth()}), box({eighth(), eighth(), eighth()})};
    translate(pair.b, {random.integer(-1, 1) / 8.0, random.integer(-1, 1) / 8.0, random.integer(-1, 1) / 8.0});
    if (random.integer(0, 1) == 1) {
      const Vec3 axis = random.direction();
      rotate(pair.a, axis, 1.0);
      rotate(pair.b, axis, 1.0);
    }
    return pair;
  });
}

TEST(SmallestSeparation, AlignedGridsOfPoints) {
  expect_smallest_for_seeds(60, [](RandomHulls& random) {
    Points grid;
    for (int i = 0; i < 27; ++i) grid.push_back(Vec3{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0});
    rotate(grid, random.direction(), 0.3 * random.integer(0, 1));
    Pair pair{grid, grid};
    translate(pair.b, 0.25 * random.integer(0, 3) * (grid[26] - grid[0]) + 0.1 * random.integer(0, 1) * random.point());
    return pair;
  });
}

TEST(SmallestSeparation, CrossedBars) {
  expect_smallest_for_seeds(1000, [](RandomHulls& random) {
    Pair pair{box({2, 0.1, 0.1}), box({2, 0.1, 0.1})};
    rotate(pair.a, {1, 0, 0}, std::numbers::pi / 4 * random.integer(0, 1));
    rotate(pair.b, {1, 0, 0}, std::numbers::pi / 4 + random.uniform(-0.1, 0.1));
    rotate(pair.b, {0, 0, 1}, random.uniform(0.5, 2.6));
    translate(pair.b, {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(0.0, 0.25)});
    return pair;
  });
}

TEST(SmallestSeparation, FlatSheets) {
  expect_smallest_for_seeds(1000, [](RandomHulls& random) {
    Pair pair{random.cloud(random.integer(3, 6)), random.cloud(random.integer(3, 6))};
    for (Vec3& p : pair.a) p.z = 0.0;
    const int kind = random.integer(0, 2);  // both in one plane; across each other; a sheet in a solid
    if (kind < 2) {
      for (Vec3& p : pair.b) p.z = 0.0;
    }
    if (kind == 1) rotate(pair.b, random.direction(), random.uniform(0, 3));
    make_overlap(pair, random);
    if (random.integer(0, 1) == 1) {
      const Vec3 axis = random.direction();
      rotate(pair.a, axis, 1.0);
      rotate(pair.b, axis, 1.0);
    }
    return pair;
  });
}

TEST(SmallestSeparation, Needles) {
  expect_smallest_for_seeds(1500, [](RandomHulls& random) {
    const double width = std::pow(10.0, random.uniform(-9, -1));
    Pair pair{random.cloud(random.integer(4, 8)), random.cloud(random.integer(4, 8))};
    stretch(pair.a, {1.0, width, width});
    if (random.integer(0, 1) == 1) stretch(pair.b, {width, 1.0, random.integer(0, 1) == 1 ? 1.0 : width});
    rotate(pair.a, random.direction(), random.uniform(0, 3));
    rotate(pair.b, random.direction(), random.uniform(0, 3));
    make_overlap(pair, random);
    return pair;
  });
}

TEST(SmallestSeparation, OriginOnTheBorder) {
  expect_smallest_for_seeds(1500, [](RandomHulls& random) {
    Pair pair{random.cloud(random.integer(4, 8)), random.cloud(random.integer(4, 8))};
    if (random.integer(0, 1) == 1) pair.b = box({0.5, 0.25, 1.0});
    make_overlap(pair, random);
    make_touch(pair, smallest_height(pair.a, pair.b, 0.0).directions[0]);  // a face of M comes to the origin
    return pair;
  });
}

TEST(SmallestSeparation, EdgeOrCornerOfMOnTheOrigin) {
  expect_smallest_for_seeds(1000, [](RandomHulls& random) {
    Pair pair{random.cloud(random.integer(4, 8)), random.cloud(random.integer(4, 8))};
    if (random.integer(0, 1) == 1) pair = {box({1, 1, 1}), box({0.5, 0.25, 1.0})};
    make_overlap(pair, random);
    make_touch(pair, random.direction());  // a corner and a corner at the same height: move them together
    const auto farthest = [](const Points& points, Vec3 n) {
      return *std::max_element(points.begin(), points.end(), [&](Vec3 p, Vec3 q) { return dot(n, p) < dot(n, q); });
    };
    const Vec3 n = random.direction();
    translate(pair.b, farthest(pair.a, n) - farthest(pair.b, -n));
    return pair;
  });
}

TEST(SmallestSeparation, DirectionIsALocalMinimum) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomHulls random(seed);
    Pair pair{random.cloud(random.integer(4, 20)), random.cloud(random.integer(4, 20))};
    make_overlap(pair, random);
    EXPECT_TRUE(is_local_minimum(pair.a, pair.b, solve(pair).separation.direction, 1e-14)) << "seed " << seed;
  }
}

TEST(SmallestSeparation, ScalesWithPowersOfTwo) {
  RandomHulls random(1);
  Pair pair{random.cloud(8), random.cloud(8)};
  make_overlap(pair, random);
  const Answer answer = solve(pair);
  for (const int exponent : {-290, -30, 30, 290}) {
    Pair scaled = pair;
    for (Points* points : {&scaled.a, &scaled.b}) {
      for (Vec3& p : *points) p = std::ldexp(1.0, exponent) * p;
    }
    const Answer scaled_answer = solve(scaled);
    EXPECT_EQ(scaled_answer.separation.direction, answer.separation.direction);
    EXPECT_EQ(scaled_answer.height, std::ldexp(answer.height, exponent));
  }
}

TEST(SmallestSeparation, FlatDifferenceTakesThePreferredSide) {
  const Pair pair{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0.1, 0.1, 0}, {1, 1, 0}, {-1, 0.3, 0}}};
  EXPECT_EQ(solve(pair, {0.1, 0.2, 1}).separation.direction, (Vec3{0, 0, 1}));
  EXPECT_EQ(solve(pair, {0.1, 0.2, -1}).separation.direction, (Vec3{0, 0, -1}));
  for (unsigned seed = 0; seed < 300; ++seed) {  // turned, the sheets are flat but for rounding
    RandomHulls random(seed);
    Pair turned = pair;
    const Vec3 axis = random.direction();
    const double angle = random.uniform(0, 3);
    for (Points* points : {&turned.a, &turned.b}) rotate(*points, axis, angle);
    Points normal{{0, 0, 1}};
    rotate(normal, axis, angle);
    for (const double side : {1.0, -1.0}) {
      const Answer answer = solve(turned, side * normal[0] + 0.3 * random.point());
      EXPECT_NEAR(answer.height, 0.0, 1e-15) << "seed " << seed;
      EXPECT_LT(norm(answer.separation.direction - side * normal[0]), 1e-14) << "seed " << seed;
    }
  }
}

TEST(SmallestSeparation, SegmentAndPointDifferences) {
  const Pair segments{{{-1, 0, 0}, {2, 0, 0}}, {{0, 0, 0}, {5, 0, 0}}};
  const Answer across = solve(segments, {0.5, 3, 4});
  EXPECT_LT(norm(across.separation.direction - Vec3{0, 0.6, 0.8}), 1e-15);
  EXPECT_EQ(across.height, 0.0);
  const Answer along = solve(segments, {1, 0, 0});
  EXPECT_EQ(along.height, 0.0);
  EXPECT_EQ(along.separation.direction.x, 0.0);
  const Pair points{{{1, 2, 3}}, {{1, 2, 3}}};
  const Answer point = solve(points, {0, -2, 0});
  EXPECT_EQ(point.separation.direction, (Vec3{0, -1, 0}));
  EXPECT_EQ(point.height, 0.0);
  EXPECT_EQ(norm(solve(points, {0, 0, 0}).separation.direction), 1.0);
}

// Turned, the segments are straight but for rounding.
TEST(SmallestSeparation, SegmentDifferenceTakesTheNearestDirectionAcross) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    RandomHulls random(seed);
    const Vec3 along = random.direction();
    const Vec3 across = normalized(cross(along, random.direction()));
    const Answer answer = solve({{-1.0 * along, 2.0 * along}, {{0, 0, 0}, 5.0 * along}}, across + 0.5 * along);
    EXPECT_NEAR(answer.height, 0.0, 1e-14) << "seed " << seed;
    EXPECT_LT(norm(answer.separation.direction - across), 1e-14) << "seed " << seed;
  }
}

// The last search's surface, where the bodies have moved, turned and stretched since.
TEST(SmallestSeparation, ContinuesFromTheLastSearch) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    RandomHulls random(seed);
    Pair last{random.cloud(random.integer(4, 20)), random.cloud(random.integer(4, 20))};
    if (random.integer(0, 2) == 0) last = {box({1, 0.7, 0.4}), box({0.2, 0.5, 1.5})};
    make_overlap(last, random);
    Pair pair = last;
    const double step = std::pow(10.0, random.uniform(-6, 0));
    rotate(pair.b, random.direction(), step * random.integer(0, 1));
    for (Vec3& p : pair.a) p = p + random.integer(0, 1) * 0.1 * step * random.point();
    translate(pair.b, 0.3 * step * random.point());
    if (static_cast<double>(smallest_height(pair.a, pair.b, 0.0).height) < 0.0) continue;
    expect_smallest(pair, 1e-13, &last);
    if (testing::Test::HasFailure()) return;
  }
}

// On small motions the last surface is worth its memory: one or two queries a step.
TEST(SmallestSeparation, TakesFewQueriesOnCoherentMotion) {
  RandomHulls random(1);
  Pair pair{random.cloud(60), random.cloud(60)};
  SmallestMemory memory;
  SurfaceShape shape;
  ClusteredMesh a = mesh_through(pair.a), b = mesh_through(pair.b);
  int queries = 0;
  for (int step = 0; step < 50; ++step) {
    rotate(pair.b, {0, 0.6, 0.8}, 0.002);
    translate(pair.b, {0.01, 0.005, 0.0});
    move_to(pair.b, b);
    const MinkowskiDifference m(a, b);
    const SmallestSeparation found = smallest_separation(m, {{}, gjk(m, {}, {}, {}).simplex, &shape}, memory);
    if (step > 0) queries += found.support_queries;
  }
  EXPECT_LE(queries, 2 * 49);
}

// Known failures of other libraries, with the numbers that users reported.

// libccd#25: two cubes of side 2, centers 1.9 apart. GJK there says depth 0, direction nan.
TEST(SmallestSeparation, StackedCubes) {
  const Answer answer = solve({box({1, 1, 1}), box({1, 1, 1}, {0, 0, 1.9})});
  EXPECT_NEAR(answer.height, 0.1, 1e-15);
  EXPECT_EQ(answer.separation.direction, (Vec3{0, 0, 1}));
}

// libccd boxbox: a unit cube against a box of 0.5 x 1 x 1.5 at the origin; what parts them is (0.25, 0, 0), then
// (0, 0, -0.25), read as the shift of the box.
TEST(SmallestSeparation, CubeAgainstBox) {
  const Points still = box({0.25, 0.5, 0.75});
  const Answer side = solve({box({0.5, 0.5, 0.5}, {-0.5, 0.5, 0.2}), still});
  EXPECT_NEAR(side.height, 0.25, 1e-15);
  EXPECT_EQ(side.separation.direction, (Vec3{1, 0, 0}));
  const Answer top = solve({box({0.5, 0.5, 0.5}, {-0.3, 0.5, 1}), still});
  EXPECT_NEAR(top.height, 0.25, 1e-15);
  EXPECT_EQ(top.separation.direction, (Vec3{0, 0, -1}));
}

// fcl#545: a cube in the corner of another, at (0.4, 0.4, 0.4): the diagonal, sqrt(3) times the depth, comes back
// there.
TEST(SmallestSeparation, CornerCube) {
  const Answer answer = solve({box({0.5, 0.5, 0.5}), box({0.5, 0.5, 0.5}, {0.4, 0.4, 0.4})}, {1, 1, 1});
  EXPECT_NEAR(answer.height, 0.6, 1e-15);
  const Vec3 n = answer.separation.direction;
  EXPECT_EQ(std::max({n.x, n.y, n.z}), 1.0);
}

// FCL's signed distance test: a unit cube at height 0.5 and a box of 0.6 x 0.8 x 1 turned in the plane, whose edge
// touches the cube's side or is 0.1 inside, in several world frames.
TEST(SmallestSeparation, TurnedBoxAgainstCube) {
  for (unsigned frame = 0; frame < 6; ++frame) {
    for (const double y : {0.0, 0.1, -0.1, 0.05, -0.05}) {
      for (const double x : {-1.0, -0.9}) {
        RandomHulls random(frame);
        Points turned = box({0.3, 0.4, 0.5});
        for (Vec3& p : turned) p = {0.6 * p.x - 0.8 * p.y + x, 0.8 * p.x + 0.6 * p.y + y, p.z + 0.5};
        Pair pair{turned, box({0.5, 0.5, 0.5}, {0, 0, 0.5})};
        Points normal{{1, 0, 0}};
        if (frame > 0) {
          const Vec3 axis = random.direction();
          for (Points* points : {&pair.a, &pair.b, &normal}) rotate(*points, axis, frame);
        }
        const Answer answer = solve(pair, normal[0]);
        EXPECT_NEAR(answer.height, x + 1.0, 1e-15) << frame << ' ' << y;
        EXPECT_LT(norm(answer.separation.direction - normal[0]), 1e-14) << frame << ' ' << y;
      }
    }
  }
}

// fcl#503: boxes that touch are reported 0.33 to 1.84 deep. The depth is never more than the overlap along any axis.
TEST(SmallestSeparation, DepthIsAtMostTheOverlapAlongAnyAxis) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    RandomHulls random(seed);
    Pair pair{box({1, 0.5, 0.25}), box({0.3, 2, 0.7})};
    rotate(pair.b, random.direction(), random.uniform(0, 3));
    const Vec3 n = random.direction();
    make_touch(pair, n);
    const Answer answer = solve(pair);
    EXPECT_NEAR(answer.height, std::min(answer.height, 0.0), 1e-14) << seed;
    EXPECT_FALSE(answer.separation.limit_reached) << seed;
  }
}

// fcl#493, #398: "origin is outside of the polytope" is thrown for boxes that merely touch.
TEST(SmallestSeparation, OriginOutsideByRoundingIsNoError) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    RandomHulls random(seed);
    Pair pair{box({0.307, 1.5, 0.0185}), box({0.25, 0.25, 0.25})};
    rotate(pair.a, random.direction(), random.uniform(0, 3));
    const SmallestHeight truth = smallest_height(pair.a, pair.b, 0.0);
    make_touch(pair, truth.directions[0]);
    translate(pair.b, random.uniform(0, 1e-15) * truth.directions[0]);
    const Answer answer = solve(pair);
    EXPECT_NEAR(answer.height, 0.0, 1e-14) << seed;
    EXPECT_LT(norm(answer.separation.direction - truth.directions[0]), 1e-12) << seed;
  }
}

// Two squares in one plane that share a side only: the plane's normal and the side's are equally low.
TEST(SmallestSeparation, OfEqualDirectionsThePreferredComes) {
  const Pair pair{{{-1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-1, 1, 0}}, {{0, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0}}};
  EXPECT_EQ(solve(pair, {0.2, 0.1, -1}).separation.direction, (Vec3{0, 0, -1}));
  EXPECT_EQ(solve(pair, {1, 0.1, -0.2}).separation.direction, (Vec3{1, 0, 0}));
  const Pair cubes{box({1, 1, 1}), box({1, 1, 1})};
  EXPECT_EQ(solve(cubes, {0.2, -1, 0.1}).separation.direction, (Vec3{0, -1, 0}));
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomHulls random(seed);
    Pair turned{box({1, 2, 3}), box({1, 2, 3})};
    const Vec3 axis = random.direction(), preferred = random.direction();
    for (Points* points : {&turned.a, &turned.b}) rotate(*points, axis, 1.0);
    EXPECT_GT(dot(solve(turned, preferred).separation.direction, preferred), 0.0) << "seed " << seed;
  }
}

// coal#48, parry#253: two flat triangles, crossing or in one plane.
TEST(SmallestSeparation, TwoTriangles) {
  expect_smallest({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0.2, 0.2, -1}, {0.3, 0.2, 1}, {0.2, 0.4, 1}}});
  expect_smallest({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
}

TEST(SmallestSeparation, RoundBodiesCloseTheirBoundsInReasonableTime) {
  Points sphere;
  for (int i = 0; i < 500; ++i) {  // a spiral
    const double z = 1.0 - (2.0 * i + 1.0) / 500.0, turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    sphere.push_back({std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z});
  }
  for (const double offset : {0.0, 0.01, 1.0, 1.9}) {
    Pair pair{sphere, sphere};
    translate(pair.b, offset * normalized(Vec3{1, 2, 3}));
    const Answer answer = solve(pair);
    EXPECT_FALSE(answer.separation.limit_reached) << offset << ' ' << answer.separation.support_queries;
    EXPECT_NEAR(answer.height, 2.0 - offset, 0.02);
    EXPECT_NEAR(answer.height, answer.lower_bound, 1e-13);
  }
}

}  // namespace tact::narrowphase
