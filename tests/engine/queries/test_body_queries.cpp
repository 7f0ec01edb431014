// Distances, sweeps and overlaps of bodies, against rational numbers, 50 digits and CGAL.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/body_oracle.h"
#include "tests/support/oracles/query_oracle.h"

namespace tact::tests {
namespace {

BodyId add(World& world, const Mesh& mesh, Surface surface = Surface::closed) {
  return world.add_body({.positions = mesh.positions, .facets = mesh.facets, .surface = surface});
}

Mesh placed_at_random(const Mesh& mesh, double away, Random& random) {
  return translated(rotated(mesh, random.rotation()), away * random.direction());
}

// The place of an answer on one of the bodies.
Vec3 place_on(const Mesh& mesh, int facet, const std::array<double, 3>& barycentric) {
  return weighted(facet_at(mesh, facet), barycentric);
}

TEST(BodyQueries, DistancesEqualRationalArithmetic) {
  Random random(1);
  const std::vector<Mesh> meshes{icosphere(1), gridded_box({-1, -1, -1}, {1, 1, 1}, 3), wrinkled_sheet(6, 2.0, 0.3, 1),
                                 needles(30, 1e-4, 2), lattice_soup(30, 3, 4)};
  int meet = 0, apart = 0;
  for (int i = 0; i < 30; ++i) {
    const Mesh& one = meshes[static_cast<std::size_t>(random.below(5))];
    const Mesh& other = meshes[static_cast<std::size_t>(random.below(5))];
    // On the grid, where many are equally near, and anywhere.
    const Mesh moved = i % 3 == 0 ? translated(other, {2.0 + random.below(3), 0.5 * random.below(4), 0.0})
                                  : placed_at_random(other, random.uniform(0.5, 4.0), random);
    World world;
    const BodyId a = add(world, one), b = add(world, moved);
    const BodyDistance found = world.distance({a, b}), back = world.distance({b, a});
    const double expected = exact_distance(one, moved, found.distance);
    ASSERT_EQ(found.distance == 0.0, expected == 0.0) << i;
    EXPECT_NEAR(found.distance, expected, 1e-14 * 8) << i;
    EXPECT_EQ(back.distance == 0.0, found.distance == 0.0);
    EXPECT_NEAR(back.distance, found.distance, 1e-14);
    ASSERT_GE(found.a_facet, 0);
    EXPECT_NEAR(
        norm(place_on(one, found.a_facet, found.a_barycentric) - place_on(moved, found.b_facet, found.b_barycentric)),
        expected, 1e-12)
        << i;
    (expected == 0.0 ? meet : apart) += 1;
    EXPECT_LT(world.distance({a, b, 0.5 * found.distance}).a_facet, found.distance == 0.0 ? 1 << 30 : 0);
    EXPECT_EQ(world.distance({a, b, found.distance}).a_facet, found.a_facet);
  }
  EXPECT_GT(meet, 4);
  EXPECT_GT(apart, 10);
}

// Clusters and groups change nothing: meshes with facets in another order have the same places.
TEST(BodyQueries, AnswersDoNotDependOnClusters) {
  Random random(5);
  const Mesh ball = blob(4, 1.0, 0.3, 3), sheet = translated(wrinkled_sheet(40, 4.0, 0.3, 1), {0.0, 0.0, 1.7});
  const std::vector<int> vertices = random.permutation(ball.vertex_count()),
                         facets = random.permutation(ball.facet_count());
  const Mesh other = permuted(ball, vertices, facets);
  World world;
  const BodyId a = add(world, ball), b = add(world, other), c = add(world, sheet, Surface::sheet);
  const BodyDistance found = world.distance({a, c}), of_other = world.distance({b, c});
  EXPECT_EQ(found.distance, of_other.distance);
  EXPECT_EQ(norm(place_on(ball, found.a_facet, found.a_barycentric) -
                 place_on(other, of_other.a_facet, of_other.a_barycentric)),
            0.0);
  const QueryFilter nothing_else{.mask = 2};
  world.set_layers(c, 2, 0xffffffffu);
  const Eigen::Vector3d way(0.0, 0.1, 2.0), axis(1.0, 0.2, 0.3);
  const SweepHit hit = world.sweep({a, way, axis, {3.0, 0.0, 0.0}, 0.4, nothing_else}),
                 of_b = world.sweep({b, way, axis, {3.0, 0.0, 0.0}, 0.4, nothing_else});
  EXPECT_EQ(hit.body, c);
  EXPECT_EQ(hit.fraction, of_b.fraction);
  EXPECT_EQ(norm(place_on(ball, hit.facet, hit.barycentric) - place_on(other, of_b.facet, of_b.barycentric)), 0.0);
}

TEST(BodyQueries, DistancesOfWhatIsInsideAndOfPlanes) {
  World world;
  const Mesh ball = icosphere(1, 0.25), cube_ = centered_box({1.0, 1.0, 1.0});
  const BodyId inner = add(world, ball), outer = add(world, cube_), shell = add(world, cube_, Surface::sheet);
  const BodyId floor = world.add_plane({.offset = -2.0}),
               ceiling = world.add_plane({.normal = {0, 0, -1}, .offset = -0.5});
  const BodyDistance inside = world.distance({inner, outer});
  EXPECT_EQ(inside.containment, Containment::a_in_b);
  EXPECT_NEAR(inside.distance, 0.75, 0.02);
  EXPECT_EQ(world.distance({outer, inner}).containment, Containment::b_in_a);
  EXPECT_EQ(world.distance({inner, shell}).containment, Containment::none);
  EXPECT_EQ(world.distance({outer, shell}).distance, 0.0);
  EXPECT_EQ(world.distance({outer, floor}).distance, 1.0);
  EXPECT_EQ(world.distance({floor, outer}).b_facet, world.distance({outer, floor}).a_facet);
  EXPECT_EQ(world.distance({outer, ceiling}).distance, 0.0);
  EXPECT_EQ(world.distance({outer, ceiling}).containment, Containment::none);
  world.set_positions(inner, translated(ball, {0, 0, 5}).positions);
  EXPECT_EQ(world.distance({inner, ceiling}).containment, Containment::a_in_b);
  EXPECT_LT(world.distance({inner, floor, 1.0}).a_facet, 0);
}

TEST(BodyQueries, NearestBodiesAreThoseOfAllDistances) {
  World world({.threads = 2});
  const std::vector<Mesh> crowd = crowd_of_blobs(60, 3);
  std::vector<BodyId> ids;
  for (const Mesh& mesh : crowd) ids.push_back(add(world, mesh));
  ids.push_back(world.add_plane({.offset = -3.0}));
  for (int round = 0; round < 4; ++round) {  // the tree of bodies is made meanwhile
    for (std::size_t own = 0; own < 60; own += 7) {
      std::vector<DistanceQuery> queries;
      for (const BodyId other : ids)
        if (other != ids[own]) queries.push_back({ids[own], other});
      std::vector<BodyDistance> all(queries.size());
      world.distances(queries, all);
      std::ranges::stable_sort(all, {}, &BodyDistance::distance);
      const std::vector<BodyDistance> found = world.nearest_bodies({.body = ids[own], .count = 5});
      ASSERT_EQ(found.size(), 5u);
      for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(found[i].b, all[i].b);
        EXPECT_EQ(found[i].distance, all[i].distance);
        EXPECT_EQ(found[i].a_facet, all[i].a_facet);
      }
      const double within = all[2].distance;
      const auto expected = std::ranges::count_if(all, [&](const BodyDistance& one) { return one.distance <= within; });
      EXPECT_EQ(
          static_cast<std::ptrdiff_t>(world.nearest_bodies({.body = ids[own], .count = 100, .within = within}).size()),
          expected);
    }
  }
}

TEST(BodyQueries, SignedDistancesAreNegativeInside) {
  World world;
  const Mesh cube_ = centered_box({1.0, 1.0, 1.0}), ring = torus(16, 8, 1.0, 0.4);
  const BodyId a = add(world, cube_);
  EXPECT_EQ(world.signed_distance({.point = {0.5, 0.0, 0.25}}).distance, -0.5);
  EXPECT_EQ(world.signed_distance({.point = {1.5, 0.0, 0.25}}).distance, 0.5);
  EXPECT_EQ(world.signed_distance({.point = {1.0, 0.0, 0.25}}).distance, 0.0);
  EXPECT_FALSE(std::signbit(world.signed_distance({.point = {1.0, 0.0, 0.25}}).distance));
  EXPECT_EQ(world.signed_distance({.point = {0.5, 0.0, 0.25}, .within = 0.0}).body, a);
  EXPECT_LT(world.signed_distance({.point = {3.0, 0.0, 0.0}, .within = 1.0}).facet, 0);
  add(world, translated(cube_, {1.25, 0.0, 0.0}));
  add(world, gridded_box({-9, -9, -9}, {9, 9, 9}, 2), Surface::sheet);
  EXPECT_EQ(world.signed_distance({.point = {0.75, 0.0, 0.0}}).distance, -0.5) << "the deepest counts";
  const BodyId floor = world.add_plane({.offset = -4.0});
  EXPECT_EQ(world.signed_distance({.point = {0.0, 0.0, -6.0}}).distance, -2.0);
  EXPECT_EQ(world.signed_distance({.point = {0.0, 0.0, -3.5}}).body, floor);
  World other({.threads = 2});
  add(other, ring);
  Random random(4);
  std::vector<PointQuery> queries(300);
  for (PointQuery& query : queries) query.point = vector_of(1.6 * random.in_cube(1.0));
  std::vector<ClosestPoint> signed_ones(queries.size()), plain(queries.size());
  other.signed_distances(queries, signed_ones);
  other.closest_points(queries, plain);
  int inside = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const bool contained = !other.bodies_containing(queries[i]).empty();
    EXPECT_EQ(signed_ones[i].distance, contained ? -plain[i].distance : plain[i].distance);
    EXPECT_EQ(signed_ones[i].facet, plain[i].facet);
    inside += contained;
  }
  EXPECT_GT(inside, 10);
}

Mesh one_triangle(const Triangle& t) {
  MeshBuilder builder;
  builder.triangle(t[0], t[1], t[2]);
  return builder.mesh();
}

TEST(BodyQueries, TurnsAreNeverLate) {
  Random random(6);
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    Triangle t, u;
    for (Vec3& p : t) p = random.in_cube(1.0);
    for (Vec3& p : u) p = random.in_cube(1.0);
    const double size = i % 3 == 0 ? 0.05 : 1.0;  // small ones pass each other more often
    for (std::size_t k = 1; k < 3; ++k) t[k] = t[0] + size * (t[k] - t[0]), u[k] = u[0] + size * (u[k] - u[0]);
    const Vec3 axis = random.direction();
    const double angle = random.uniform(-8.0, 8.0);
    World world;
    const BodyId a = add(world, one_triangle(t)), b = add(world, one_triangle(u));
    const SweepHit hit = world.sweep({.body = a, .axis = vector_of(axis), .angle = angle});
    const std::optional<double> expected = first_on_turn(t, axis, angle, u);
    ASSERT_EQ(hit.facet >= 0, expected.has_value()) << i;
    if (!expected) continue;
    ++hits;
    EXPECT_EQ(hit.body, b);
    EXPECT_LE(hit.fraction, *expected + 1e-13) << i;
    EXPECT_GE(hit.fraction, *expected - 1e-6) << i;
  }
  EXPECT_GT(hits, 80);
}

// A rod that turns by a right angle passes a needle between where it begins and ends.
TEST(BodyQueries, ARodThatTurnsMeetsANeedleOnItsArc) {
  World world;
  const BodyId rod = add(world, box({0.0, -0.01, -0.01}, {1.0, 0.01, 0.01}));
  const Mesh needle = box({0.69, 0.69, -1.0}, {0.7, 0.7, 1.0});
  const BodyId other = add(world, needle);
  const SweepHit hit = world.sweep({.body = rod, .angle = std::numbers::pi / 2});
  ASSERT_EQ(hit.body, other);
  // The upper side of the rod, 0.01 from the line to its middle, reaches the needle's corner (0.7, 0.69).
  const double expected = std::atan2(0.69, 0.7) - std::asin(0.01 / std::hypot(0.69, 0.7));
  EXPECT_LE(hit.fraction, expected / (std::numbers::pi / 2));
  EXPECT_NEAR(hit.fraction, expected / (std::numbers::pi / 2), 1e-6);
  EXPECT_LT(world.sweep({.body = rod, .angle = -std::numbers::pi / 2}).facet, 0);
  EXPECT_LT(world.sweep({.body = rod, .angle = std::numbers::pi / 2, .filter = {.mask = 2}}).facet, 0);
}

TEST(BodyQueries, StraightSweepsAndPlanes) {
  World world;
  const BodyId ball = add(world, icosphere(2)), cube_ = add(world, box({3.0, -1.0, -1.0}, {4.0, 1.0, 1.0}));
  const SweepHit hit = world.sweep({.body = ball, .way = {4.0, 0.0, 0.0}});
  EXPECT_EQ(hit.body, cube_);
  EXPECT_LE(hit.fraction, 0.5);
  EXPECT_NEAR(hit.fraction, 0.5, 1e-12);
  EXPECT_NEAR(hit.normal.x(), 1.0, 1e-9);
  EXPECT_LT(world.sweep({.body = ball, .way = {1.999, 0.0, 0.0}}).facet, 0);
  EXPECT_EQ(world.sweep({.body = ball, .way = {1.999, 0.0, 0.0}}).fraction, 1.0);
  const BodyId floor = world.add_plane({.offset = -2.0});
  const SweepHit fall = world.sweep({.body = ball, .way = {0.0, 0.0, -4.0}});
  EXPECT_EQ(fall.body, floor);
  EXPECT_LE(fall.fraction, 0.25);
  EXPECT_NEAR(fall.fraction, 0.25, 1e-12);
  // A flap comes down on a floor below its hinge: its far edge is at height -sin.
  world.remove_body(ball);
  const BodyId step = world.add_plane({.offset = -0.5}), flap = add(world, box({0.0, 0.0, 0.0}, {1.0, 1.0, 0.5}));
  const SweepHit turned = world.sweep({.body = flap, .axis = {0, 2, 0}, .angle = 4.0});
  EXPECT_EQ(turned.body, step);
  EXPECT_LE(turned.fraction, std::numbers::pi / 24);
  EXPECT_NEAR(turned.fraction, std::numbers::pi / 24, 1e-12);
  // What meets at once, and what lies on another and is lifted.
  const BodyId lid = add(world, box({3.0, -1.0, 1.0}, {4.0, 1.0, 1.5}));
  EXPECT_EQ(world.sweep({.body = lid, .way = {0, 0, 1}}).fraction, 0.0);
  world.set_positions(lid, box({3.0, -1.0, 1.0 + 1e-14}, {4.0, 1.0, 1.5}).positions);
  EXPECT_LT(world.sweep({.body = lid, .way = {0, 0, 1}}).facet, 0) << "it parts";
  std::vector<Sweep> many(40, {.body = lid, .way = {-5, 0, -5}});
  std::vector<SweepHit> hits(many.size());
  world.sweeps(many, hits);
  for (const SweepHit& one : hits) EXPECT_EQ(one.fraction, world.sweep(many[0]).fraction);
}

// A body is what two others have of it that fill a box around it.
// Flat sides that stay parallel: between places that are very near no difference tells their normal.
TEST(BodyQueries, FlatSidesMeetAtTheirTime) {
  Random random(17);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto corner = [&] { return Vec3{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)}; };
    const auto whole = [&](Vec3 v) { return i % 2 == 0 ? Vec3{std::round(v.x), std::round(v.y), std::round(v.z)} : v; };
    const std::array<Vec3, 2> lower{whole(corner()), whole(corner())};
    const std::array<Vec3, 2> upper{lower[0] + Vec3{1, 2, 3}, lower[1] + Vec3{2, 1, 6}};
    const Vec3 way = 2.0 * whole(corner());
    double enters = 0.0, leaves = 1.0, speed = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double first = lower[1][axis] - upper[0][axis], last = upper[1][axis] - lower[0][axis];
      if (way[axis] == 0.0) {
        if (first > -0.01 || last < 0.01) leaves = -1.0;
        continue;
      }
      const double enters_here = std::min(first / way[axis], last / way[axis]);
      if (enters_here > enters) enters = enters_here, speed = std::abs(way[axis]);
      leaves = std::min(leaves, std::max(first / way[axis], last / way[axis]));
    }
    if (!(enters > 0.01 && enters < leaves - 0.01)) continue;  // beside it, past it, or along it
    World world;
    const BodyId a = add(world, box(lower[0], upper[0]));
    add(world, box(lower[1], upper[1]));
    const double found = world.sweep({.body = a, .way = {way.x, way.y, way.z}}).fraction;
    EXPECT_LE(found, enters + 1e-15 / speed) << i;
    EXPECT_GE(found, enters - 2e-12 / speed) << i;
    ++hits;
  }
  EXPECT_GT(hits, 300);
}

TEST(BodyQueries, OverlapsWithTwoHalvesAreTheWhole) {
  Random random(8);
  const auto whole = [](const Mesh& mesh) {
    Overlap sums;
    for (int f = 0; f < mesh.facet_count(); ++f) {
      const Triangle t = facet_at(mesh, f);
      sums.area += 0.5 * norm(cross(t[1] - t[0], t[2] - t[0]));
      sums.volume += dot(t[0], cross(t[1], t[2])) / 6.0;
    }
    return sums;
  };
  for (const Mesh& mesh : {icosphere(2), torus(16, 8, 1.0, 0.4), blob(2, 1.0, 0.3, 1), organ(3)}) {
    const Mesh turned = placed_at_random(mesh, 0.3, random);
    const double cut = random.uniform(-0.2, 0.2);
    // The halves have three cells and five: their vertices are not each other's.
    const std::vector<Mesh> halves{gridded_box({-3, -3, -3}, {cut, 3, 3}, 3), gridded_box({cut, -3, -3}, {3, 3, 3}, 5)};
    World world;
    const BodyId body = add(world, turned);
    Overlap sums;
    for (const Mesh& half : halves) {
      const BodyId other = add(world, half);
      const Overlap found = world.overlap(body, other), back = world.overlap(other, body);
      EXPECT_GT(found.volume, 0.0);
      EXPECT_NEAR(back.volume, found.volume, 1e-14);
      EXPECT_NEAR(back.area, found.area, 1e-13);
      sums.volume += found.volume;
      sums.area += found.area;
    }
    EXPECT_NEAR(sums.volume, whole(turned).volume, 1e-13);
    EXPECT_GT(sums.area, whole(turned).area) << "the cut counts twice";
  }
}

// Faces in one plane, edges on edges, corners on corners.
TEST(BodyQueries, OverlapsOfWhatTouchesAreExact) {
  const auto overlap = [](const Mesh& a, const Mesh& b) {
    World world;
    const BodyId of_a = add(world, a), of_b = add(world, b);
    return world.overlap(of_a, of_b);
  };
  const Mesh grid = gridded_box({0, 0, 0}, {1, 1, 1}, 3);
  for (const double x : {0.0, 0.25, 0.5, 1.0}) {
    for (const double y : {0.0, 0.5, 1.0, 1.5}) {
      const Mesh other = gridded_box({x, y, 0.0}, {x + 1.0, y + 1.0, 1.0}, 2);
      const Overlap found = overlap(grid, other);
      const double width = std::max(1.0 - x, 0.0), depth = std::max(1.0 - y, 0.0), volume = width * depth;
      EXPECT_NEAR(found.volume, volume, 1e-14) << x << " " << y;
      EXPECT_NEAR(found.area, volume > 0.0 ? 2.0 * (volume + width + depth) : 0.0, 1e-14) << x << " " << y;
    }
  }
  EXPECT_NEAR(overlap(grid, grid).volume, 1.0, 1e-14);
  EXPECT_NEAR(overlap(grid, turned_inside_out(grid)).volume, 1.0, 1e-14);
  EXPECT_NEAR(overlap(grid, grid).area, 6.0, 1e-13);
  EXPECT_EQ(overlap(grid, gridded_box({1, 1, 1}, {2, 2, 2}, 2)).volume, 0.0);
}

TEST(BodyQueries, RefusalsSayWhat) {
  World world;
  const BodyId ball = add(world, icosphere(1)), sheet_ = add(world, sheet(2, 2, 1.0, 1.0), Surface::sheet);
  const BodyId floor = world.add_plane({}), wall = world.add_plane({.normal = {1, 0, 0}});
  const auto code_of = [](const auto& call) {
    try {
      call();
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::out_of_memory;
  };
  EXPECT_EQ(code_of([&] { world.distance({ball, ball}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.distance({floor, wall}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.distance({ball, floor, std::nan("")}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.distance({ball, {}}); }), ErrorCode::stale_body);
  EXPECT_EQ(code_of([&] { world.overlap(ball, sheet_); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.overlap(ball, floor); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.overlap(ball, ball); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.sweep({.body = floor}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.sweep({.body = ball, .axis = {0, 0, 0}}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.sweep({.body = ball, .angle = 2000.0}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.sweep({.body = ball, .way = {std::nan(""), 0, 0}}); }), ErrorCode::non_finite_position);
  world.remove_body(sheet_);
  EXPECT_EQ(code_of([&] { world.nearest_bodies({.body = sheet_}); }), ErrorCode::stale_body);
}

// Lengths from 2^-300 to 2^290.
TEST(BodyQueries, HugeAndTinyBodiesAreMeasured) {
  for (const double unit : {0x1p-300, 1.0, 0x1p290}) {
    World world;
    const BodyId a = add(world, scaled(centered_box({1, 1, 1}), unit)),
                 b = add(world, scaled(box({3, 0, 0}, {4, 1, 1}), unit));
    EXPECT_EQ(world.distance({a, b}).distance, 2.0 * unit);
    EXPECT_NEAR(world.sweep({.body = a, .way = {4.0 * unit, 0, 0}}).fraction, 0.5, 1e-12);
    const BodyId c = add(world, scaled(box({0.5, 0.5, 0.5}, {2, 2, 2}), unit));
    const Overlap overlap = world.overlap(a, c);
    EXPECT_NEAR(overlap.volume / unit / unit / unit, 0.125, 1e-14);
    EXPECT_NEAR(overlap.area / unit / unit, 1.5, 1e-14);
  }
}

}  // namespace
}  // namespace tact::tests
