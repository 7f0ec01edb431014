// Bodies that cross without a vertex in each other, and thin ones: each crossing has points, and whoever moves along
// them comes out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/checks/parting.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

BodyDefinition crossing_body(const Mesh& mesh, double margin = 0.0) {
  return {.positions = mesh.positions, .facets = mesh.facets, .margin = margin};
}

// Moves b along the points until it is out of a.
Parting part(const Mesh& a, const Mesh& b, double margin, const std::string& what) {
  constexpr int kMost = 12;
  const Parting parting = part_by_points(a, b, {.margin = margin, .most_passes = kMost});
  EXPECT_EQ(parting.without_point, 0) << what;
  EXPECT_LT(parting.passes, kMost) << what << ": not apart";
  return parting;
}

TEST(WaysApart, OfBladesPlatesAndRodsAreTheLeastTranslation) {
  const Mesh plate = centered_box({1, 1, 0.0625}), blade = centered_box({0.5, 0.0625, 0.5});
  // Out of the plate, half of the blade and half of the plate.
  EXPECT_NEAR(part(plate, blade, 0.0, "upright").way, 0.5625, 1e-6);
  EXPECT_NEAR(part(plate, translated(blade, {0, 0, 0.25}), 0.0, "half way in").way, 0.3125, 1e-6);
  // Over its rim, where the nearest way is aside.
  EXPECT_NEAR(part(plate, translated(blade, {1.4, 0.1, 0.0}), 0.0, "rim").way, 0.1, 1e-6);
  const Mesh rod = centered_box({1, 0.0625, 0.0625});
  const Mesh across = rotated(rod, rotation(1.0, 0.1, 0.2, 0.9));
  for (const double shift : {0.0, 0.02, -0.05}) {
    const Mesh moved = translated(across, {0.01, 0.03, shift});
    const Parting parting = part(rod, moved, 0.0, "rods");
    EXPECT_LE(parting.way, 1.01 * least_overlap(rod, moved).depth);
    EXPECT_LE(parting.passes, 2);
  }
}

// Bodies of facets wider than they are thick, at random: the kinds of which half of the crossings have no vertex
// inside.
TEST(WaysApart, OfRandomThinBodiesAreThereAndShort) {
  Random random(5);
  const Mesh kinds[] = {centered_box({1, 1, 0.05}), centered_box({1, 0.06, 0.06}), centered_box({1, 0.3, 0.025}),
                        gridded_box({-1, -1, -0.05}, {1, 1, 0.05}, 2), spike({0, 0, 1}, 0.6)};
  int crossings = 0, long_ways = 0;
  for (int k = 0; k < 400; ++k) {
    const Mesh& a = kinds[random.below(5)];
    const Mesh b = translated(rotated(kinds[random.below(5)], random.rotation()), 0.7 * random.in_ball());
    const std::string what = "pair " + std::to_string(k);
    const Parting parting = part(a, b, k % 2 == 0 ? 0.0 : 0.01, what);
    if (parting.passes == 0) continue;
    ++crossings;
    long_ways += parting.way > 1.5 * least_overlap(a, b).depth + 1e-6;
    EXPECT_LE(parting.passes, 8) << what;
  }
  EXPECT_GT(crossings, 100);
  EXPECT_LE(long_ways, crossings / 10);
}

// Two plates at a right angle, or rotated so; the second kind of which the points led some to and fro, out of one side
// and so into the other one.
Mesh plates_at_a_right_angle() {
  const Mesh parts[] = {box({-0.5, -0.5, -0.03}, {0.5, 0.5, 0.03}), box({0.44, -0.5, 0.03}, {0.5, 0.5, 0.6})};
  return merged(parts);
}

struct CrossingState {
  Mesh a, b;
  PartingInput input;
};

// At once or by steps, with or without margins.
CrossingState random_crossing(const Mesh& a, const Mesh& b, std::uint64_t seed) {
  Random random(seed);
  const Vec3 place = 0.7 * random.in_ball();  // compilers evaluate arguments in orders of their own
  CrossingState state{a, translated(rotated(b, random.rotation()), place), {}};
  state.input = {.margin = random.chance(0.5) ? 0.0 : 0.01, .most_passes = 30};
  if (random.chance(0.5)) {
    state.input.steps = 1 << random.below(7);
    state.input.came_by = 2.5 * random.direction();
  }
  return state;
}

TEST(WaysApart, DoNotLeadToAndFro) {
  const Mesh plate = centered_box({0.5, 0.5, 0.03}), both = plates_at_a_right_angle();
  int crossings = 0;
  const auto expect_apart = [&](const CrossingState& state, const std::string& what) {
    const Parting parting = part_by_points(state.a, state.b, state.input);
    EXPECT_EQ(parting.without_point, 0) << what;
    EXPECT_LT(parting.passes, state.input.most_passes) << what;
    crossings += parting.passes > 0 ? 1 : 0;
  };
  // Of 1,500 each the ones that did not come apart.
  for (const std::uint64_t seed : {34, 38, 80, 86, 151, 240})
    expect_apart(random_crossing(both, both, seed), "two of them, seed " + std::to_string(seed));
  for (const std::uint64_t seed : {8, 38, 599, 689})
    expect_apart(random_crossing(plate, both, seed), "a plate and one, seed " + std::to_string(seed));
  // Of 10,000 those whose crossings ended beside new ones.
  for (const std::uint64_t seed : {2212, 2956, 3655, 3694, 4983, 5930, 6372, 9907})
    expect_apart(random_crossing(plate, both, seed), "a plate beside one, seed " + std::to_string(seed));
  EXPECT_GT(crossings, 6);
}

// Vertices came in on one side while others went out on another: of 12,000 states each some of those that stayed in
// each other, 7 with the plate and 20 with the hull.
TEST(WaysApart, OfConvexBodiesDoNotLeadToAndFro) {
  const Mesh spike_of_4 = spike({0.1, 0.2, 0.6}, 0.5), hull = random_hull(20, 3),
             plate = gridded_box({-0.5, -0.5, -0.03}, {0.5, 0.5, 0.03}, 3);
  const auto expect_apart = [](const CrossingState& state, const std::string& what) {
    const Parting parting = part_by_points(state.a, state.b, state.input);
    EXPECT_GT(parting.passes, 0) << what;
    EXPECT_LE(parting.passes, 8) << what;
  };
  for (const std::uint64_t seed : {733, 4582, 6979, 8339, 8487, 8616, 10298})
    expect_apart(random_crossing(plate, spike_of_4, seed), "a plate and a spike, seed " + std::to_string(seed));
  for (const std::uint64_t seed : {969, 1223, 2234, 3357, 3577})
    expect_apart(random_crossing(spike_of_4, hull, seed), "a spike and a hull, seed " + std::to_string(seed));
}

// A rod that sinks through another one: up, as far as it came in until it reaches out below.
TEST(WaysApart, OfARodThatSinksThroughARodLeadBackTheWayItCame) {
  const Mesh rod = centered_box({1, 0.0625, 0.0625}), across = rotated(rod, rotation(1.0, 0.0, 0.0, 0.9));
  for (const double margin : {0.0, 0.01}) {
    World world({.threads = 1, .outputs = {.points = true}});
    const BodyId a = world.add_body(crossing_body(rod, margin)),
                 b = world.add_body(crossing_body(translated(across, {0.01, 0.02, 0.2}), margin));
    world.detect();
    for (double z = 0.12; z > -0.12; z -= 0.01) {
      world.set_positions(b, translated(across, {0.01, 0.02, z}).positions);
      const Contact* contact = world.detect().find_contact(a, b);
      ASSERT_NE(contact, nullptr);
      ASSERT_FALSE(contact->points().empty()) << z;
      double deepest = 0.0;
      for (const ContactPoint& point : contact->points()) {
        if (point.gap < 0.0) {
          EXPECT_GT(point.normal.z(), 0.9) << z << ", margin " << margin;
        }
        deepest = std::min(deepest, point.gap);
      }
      EXPECT_LT(deepest, 0.0);
      if (z > 0.001) {
        EXPECT_NEAR(deepest, z - 0.125, 1e-9) << margin;
      }
    }
  }
}

// A square cup, open above: walls so thick.
Mesh cup(double wall) {
  MeshBuilder builder;
  const auto corners = [&](double half, double bottom) {
    for (int i = 0; i < 8; ++i) builder.vertex({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? 1.0 : bottom});
  };
  corners(1.0 + wall, -1.0 - wall);
  corners(1.0, -1.0);
  for (const auto& q : {std::array{0, 2, 3, 1},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5},
                        {8, 9, 11, 10},
                        {8, 12, 13, 9},
                        {10, 11, 15, 14},
                        {8, 10, 14, 12},
                        {9, 13, 15, 11},
                        {4, 5, 13, 12},
                        {5, 7, 15, 13},
                        {7, 6, 14, 15},
                        {6, 4, 12, 14}})
    builder.quad(q[0], q[1], q[2], q[3]);
  return builder.mesh();
}

// One vertex of the spike is in the wall of the cup, through both sides of which its edges come in.
TEST(Gaps, InAThinWallAreTheDistanceToTheWall) {
  const double wall = 0.0078125;
  MeshBuilder builder;
  for (const Vec3& v : {Vec3{1.25, 0, 0.6875}, {1.001953125, 0.25, 0.75}, {0.5, -0.25, 0.71875}, {0.5, 0, 0.65625}})
    builder.vertex(v);
  builder.facet(0, 2, 1), builder.facet(0, 1, 3), builder.facet(0, 3, 2), builder.facet(1, 2, 3);
  const Mesh tetrahedron = builder.mesh();
  World world({.threads = 1, .outputs = {.points = true}});
  const BodyId a = world.add_body(crossing_body(cup(wall))), b = world.add_body(crossing_body(tetrahedron));
  const Contact* contact = world.detect().find_contact(a, b);
  ASSERT_NE(contact, nullptr);
  int found = 0;
  for (const ContactPoint& point : contact->points()) {
    if (point.kind != FeaturePair::facet_vertex || point.gap >= 0.0) continue;
    EXPECT_EQ(point.b_vertices[0], 1);
    EXPECT_NEAR(point.gap, -0.001953125, 1e-12);
    ++found;
  }
  EXPECT_EQ(found, 1);
}

// A ring of so many sides, walls so thick, open at both ends.
Mesh tube(int sides, double wall) {
  MeshBuilder builder;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides, c = std::cos(angle), s = std::sin(angle);
    for (const double radius : {1.0 + wall, 1.0}) {
      for (const double z : {-1.0, 1.0}) builder.vertex({radius * c, radius * s, z});
    }
  }
  for (int i = 0; i < sides; ++i) {
    const int k = 4 * i, l = 4 * ((i + 1) % sides);
    builder.quad(k, l, l + 1, k + 1), builder.quad(k + 2, k + 3, l + 3, l + 2);
    builder.quad(k + 1, l + 1, l + 3, k + 3), builder.quad(k, k + 2, l + 2, l);
  }
  return builder.mesh();
}

Mesh hollow_box(double wall) {
  return merged(std::vector<Mesh>{cube(2.0 + 2.0 * wall, {}), turned_inside_out(cube(2.0, {}))});
}

struct WallCounts {
  int inside = 0, shallow = 0, too_deep = 0, not_exact = 0;
  double worst = 0.0;  // in walls
};

// Of the vertices of b in the walls of a, by their points. Vertices of ways apart are outside.
void count_in_walls(const World& world, const Mesh& walls, const Mesh& b, double wall, const Contact& contact,
                    WallCounts& counts) {
  for (const ContactPoint& point : contact.points()) {
    if (point.kind != FeaturePair::facet_vertex || point.gap >= 0.0) continue;
    const Vec3 v = b.position(point.b_vertices[0]), n{point.normal.x(), point.normal.y(), point.normal.z()};
    const auto around = world.bodies_containing({.point = {v.x, v.y, v.z}});
    if (std::ranges::find(around, contact.a) == around.end()) continue;
    ++counts.inside;
    counts.worst = std::max(counts.worst, -point.gap / wall);
    counts.too_deep += -point.gap > thickness_through(walls, v, n) + 1e-9;
    if (-point.gap > 0.5 * wall) continue;
    // Of what is nearer to its side than half the wall, nothing is nearer but a facet at a right angle to that side.
    ++counts.shallow;
    counts.not_exact += std::abs(distance_to(walls, v) + point.gap) > 1e-9;
  }
}

// Bodies somewhere in thin walls, without a last step.
TEST(Gaps, InRandomWallsAreNoDeeperThanTheWall) {
  Random random(11);
  WallCounts counts;
  for (int k = 0; k < 300; ++k) {
    const double wall = k % 2 == 0 ? 0.05 : 0.01;
    const Mesh walls = k % 3 == 0 ? hollow_box(wall) : k % 3 == 1 ? tube(24, wall) : cup(wall);
    const Mesh any[] = {icosphere(2, 0.4), centered_box({0.4, 0.4, 0.4}), spike({0, 0, 0.8}, 0.6)};
    const Mesh b =
        translated(rotated(any[random.below(3)], random.rotation()), random.uniform(0.75, 1.25) * random.direction());
    World world({.threads = 1, .outputs = {.points = true}});
    const double margin = k % 4 < 2 ? 0.0 : 0.004;
    const BodyId first = world.add_body(crossing_body(walls, margin)),
                 second = world.add_body(crossing_body(b, margin));
    const Contact* contact = world.detect().find_contact(first, second);
    if (contact != nullptr) count_in_walls(world, walls, b, wall, *contact, counts);
  }
  std::printf(
      "%d vertices in walls, %d of them shallow, of which %d have another gap than their distance; deepest %.3f "
      "walls\n",
      counts.inside, counts.shallow, counts.not_exact, counts.worst);
  EXPECT_GT(counts.inside, 300);
  EXPECT_EQ(counts.too_deep, 0);
  EXPECT_LE(counts.not_exact, counts.shallow / 50);
}

// From below into the bottom of a hollow box, and then at once into one of its sides: down would lead along the wall.
TEST(Gaps, AfterAStepThatIsLongerThanAWallAreNoDeeperThanTheWall) {
  const double wall = 0.0625;
  const Mesh body = spike({0, 0, 0.25}, 0.125);
  for (const double margin : {0.0, 0.01}) {
    World world({.threads = 1, .outputs = {.points = true}});
    const BodyId box = world.add_body(crossing_body(hollow_box(wall), margin)),
                 moved = world.add_body(crossing_body(translated(body, {0.5, 0.25, -1.5}), margin));
    const auto tip_at = [&](Vec3 tip) {
      world.set_positions(moved, translated(body, tip - Vec3{0, 0, 0.25}).positions);
      std::vector<ContactPoint> points;
      for (const ContactPoint& point : world.detect().find_contact(box, moved)->points()) {
        if (point.kind == FeaturePair::facet_vertex && point.gap < 0.0) points.push_back(point);
      }
      return points;
    };
    world.detect();
    for (const double depth : {0.01, 0.015, 0.02}) {
      const auto in_bottom = tip_at({0.5, 0.25, -1.0 - wall + depth});
      ASSERT_EQ(in_bottom.size(), 1u);
      EXPECT_NEAR(in_bottom[0].gap, -depth, 1e-12);
      EXPECT_NEAR(in_bottom[0].normal.z(), -1.0, 1e-12);
    }
    const auto in_side = tip_at({1.0 + wall / 4, 0.25, -0.5});
    EXPECT_FALSE(in_side.empty());
    for (const ContactPoint& point : in_side) EXPECT_GE(point.gap, -wall) << margin;
  }
}

}  // namespace
}  // namespace tact::tests
