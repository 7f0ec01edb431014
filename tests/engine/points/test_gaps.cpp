// Contact points of bodies that cross each other: closed forms, sweeps, brute force, invariances.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "tests/support/checks/detection.h"
#include "tests/support/checks/sinking_bodies.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/oracles/crossing_oracle.h"

namespace tact::tests {
namespace {

const Settings kPoints{.outputs = {.points = true}};

BodyDefinition gap_body(const Mesh& mesh, double margin, Surface surface = Surface::closed) {
  return {.positions = mesh.positions, .facets = mesh.facets, .surface = surface, .margin = margin};
}

// Two bodies, the second of which is moved.
struct Two {
  Two(const Mesh& a, const Mesh& b, double margin, Surface surface_a = Surface::closed)
      : world(kPoints),
        first(world.add_body(gap_body(a, margin, surface_a))),
        second(world.add_body(gap_body(b, margin))),
        shape(b) {}
  const Contact* at(Vec3 shift) {
    world.set_positions(second, translated(shape, shift).positions);
    return world.detect().find_contact(first, second);
  }
  World world;
  BodyId first, second;
  Mesh shape;
};

// The gap of each vertex of b that has crossed a.
std::map<int, double> gaps_of_b(const Contact& contact) {
  std::map<int, double> gaps;
  for (const ContactPoint& point : contact.points()) {
    if (point.kind == FeaturePair::facet_vertex && point.gap < 0.0) {
      EXPECT_TRUE(gaps.emplace(point.b_vertices[0], point.gap).second);
    }
  }
  return gaps;
}

int lowest_vertex(const Mesh& mesh) {
  int lowest = mesh.facets(0, 0);
  for (const int v : mesh.facets.reshaped()) {
    if (mesh.position(v).z < mesh.position(lowest).z) lowest = v;
  }
  return lowest;
}

// What holds of any point: its gap is the distance of its two places along its normal.
void expect_places_to_agree(const Contact& contact, const Mesh& a, const Mesh& b) {
  for (const ContactPoint& point : contact.points()) {
    const Vec3 way = weighted(b, point.b_vertices, point.b_weights) - weighted(a, point.a_vertices, point.a_weights);
    const Vec3 n{point.normal.x(), point.normal.y(), point.normal.z()};
    EXPECT_NEAR(norm(n), 1.0, 1e-12);
    EXPECT_NEAR(dot(n, way), point.gap, 1e-12);
    EXPECT_NEAR(norm(way), std::abs(point.gap), 1e-12);
  }
}

TEST(Gaps, OfASphereInAFloorAreTheHeightsOfItsVertices) {
  const Mesh floor = gridded_box({-4, -4, -2}, {4, 4, 0}, 8), ball = icosphere(3);
  for (const double margin : {0.0, 0.05}) {
    Two two(floor, ball, margin);
    two.at({0.01, 0.02, 1.2});
    for (double z = 1.04; z > 0.0; z -= 0.13) {
      const Contact* contact = two.at({0.01, 0.02, z});
      const std::map<int, double> gaps = contact != nullptr ? gaps_of_b(*contact) : std::map<int, double>();
      for (int v = 0; v < ball.vertex_count(); ++v) {
        const double height = ball.position(v).z + z;
        ASSERT_EQ(gaps.contains(v), height < 0.0) << z;
        if (height < 0.0) {
          EXPECT_NEAR(gaps.at(v), height, 1e-9);
        }
      }
      if (contact != nullptr) expect_places_to_agree(*contact, floor, translated(ball, {0.01, 0.02, z}));
    }
  }
}

// The floor's vertices inside a coarse ball: the least distance to the planes of its facets.
TEST(Gaps, OfAFloorsVerticesInASphereAreTheirDistancesToIt) {
  const Mesh ball = icosphere(2), floor = gridded_box({-1, -1, -1}, {1, 1, 0}, 16);
  Two two(floor, ball, 0.02);
  two.at({0.01, 0.02, 1.1});
  const double z = 0.9;
  const Contact* contact = two.at({0.01, 0.02, z});
  ASSERT_NE(contact, nullptr);
  const Mesh placed = translated(ball, {0.01, 0.02, z});
  int found = 0;
  for (const ContactPoint& point : contact->points()) {
    if (point.kind != FeaturePair::vertex_facet || point.gap >= 0.0) continue;
    const Vec3 v = floor.position(point.a_vertices[0]);
    double least = 1.0;
    for (int f = 0; f < placed.facet_count(); ++f) {
      const Vec3 p = placed.position(placed.facets(0, f)), q = placed.position(placed.facets(1, f)),
                 r = placed.position(placed.facets(2, f));
      least = std::min(least, dot(normalized(cross(q - p, r - p)), p - v));
    }
    EXPECT_NEAR(point.gap, -least, 1e-9);
    ++found;
  }
  EXPECT_GT(found, 20);
}

TEST(Gaps, OfABoxInABoxAreItsDepthInAnyFrame) {
  const Mesh lower = box({-1, -1, -1}, {1, 1, 0}), upper = box({-0.5, -0.4, 0}, {0.5, 0.4, 1});
  for (const Rotation& turn : {rotation(1, 0, 0, 0), rotation(0.3, 0.4, -0.5, 0.7), rotation(0.1, -0.8, 0.3, 0.2)}) {
    World world(kPoints);
    const Vec3 away = rotated(translated(Mesh{Eigen::Matrix3Xd::Zero(3, 1), {}}, {0, 0, 1}), turn).position(0);
    world.add_body(gap_body(rotated(lower, turn), 0.01));
    const Mesh turned = rotated(upper, turn);
    const BodyId b = world.add_body(gap_body(translated(turned, 0.015 * away), 0.01));
    for (const double depth : {-0.015, 1e-6, 0.01, 0.05, 0.2, 0.05, 1e-6}) {
      world.set_positions(b, translated(turned, -depth * away).positions);
      const Report& report = world.detect();
      ASSERT_EQ(report.contacts().size(), 1u);
      double deepest = 1.0;
      int corners = 0;
      for (const ContactPoint& point : report.contacts()[0].points()) {
        deepest = std::min(deepest, point.gap);
        if (point.kind != FeaturePair::facet_vertex) continue;
        EXPECT_NEAR(point.gap, -depth, 1e-9);
        ++corners;
      }
      EXPECT_EQ(corners, 4) << depth;
      EXPECT_NEAR(deepest, -depth, 1e-9);
    }
  }
}

// A roof, 40 degrees to the upright on either side, from below into a box: the box's vertices are as far inside as
// their distance from the nearer slope, the ridge's ends as far as the box's bottom is above them.
TEST(Gaps, OfAWedgeAreTheDistancesToItsSlopes) {
  const double slope = 40.0 * std::numbers::pi / 180.0;
  MeshBuilder builder;
  const double h = 1.0, w = h * std::tan(slope);
  for (const double y : {-0.25, 0.25})
    builder.vertex({-w, y, -h}), builder.vertex({w, y, -h}), builder.vertex({0, y, 0});
  builder.facet(0, 1, 2), builder.facet(3, 5, 4);
  builder.quad(0, 3, 4, 1), builder.quad(1, 4, 5, 2), builder.quad(0, 2, 5, 3);
  const Mesh wedge = builder.mesh(), block = gridded_box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, 25);
  for (const double margin : {0.0, 0.002}) {
    Two two(wedge, block, margin);
    two.at({0.003, 0.004, 0.001});
    for (const double depth : {0.01, 0.03, 0.06, 0.1}) {
      const Contact* contact = two.at({0.003, 0.004, -depth});
      ASSERT_NE(contact, nullptr);
      int of_block = 0, of_ridge = 0;
      for (const ContactPoint& point : contact->points()) {
        if (point.gap >= 0.0) continue;
        if (point.kind == FeaturePair::facet_vertex) {
          const Vec3 v = block.position(point.b_vertices[0]) + Vec3{0.003, 0.004, -depth};
          EXPECT_NEAR(point.gap, -(-v.z * std::sin(slope) - std::abs(v.x) * std::cos(slope)), 1e-9);
          ++of_block;
        } else if (point.kind == FeaturePair::vertex_facet) {
          EXPECT_NEAR(point.gap, -depth, 1e-9);
          ++of_ridge;
        } else {
          EXPECT_LE(point.gap, 0.0);
          EXPECT_GE(point.gap, -depth - 1e-9);
        }
      }
      EXPECT_GT(of_block, depth < 0.05 ? -1 : 20) << depth;
      EXPECT_EQ(of_ridge, 2) << depth;
    }
  }
}

// Two bars with an edge up and an edge down: one point, between these edges.
TEST(Gaps, OfCrossedBarsStandBetweenTheirEdges) {
  const auto turned_bar = [](bool along_x) {
    const Mesh bar = along_x ? box({-1, -0.1, -0.1}, {1, 0.1, 0.1}) : box({-0.1, -1, -0.1}, {0.1, 1, 0.1});
    return rotated(bar, along_x ? rotation(std::cos(std::numbers::pi / 8), std::sin(std::numbers::pi / 8), 0, 0)
                                : rotation(std::cos(std::numbers::pi / 8), 0, std::sin(std::numbers::pi / 8), 0));
  };
  const double height = 0.2 * std::numbers::sqrt2;
  Two two(turned_bar(true), turned_bar(false), 0.01);
  std::set<std::uint64_t> ids;
  for (const double gap : {0.015, 0.005, 1e-6, -1e-6, -0.01, -0.05, -0.01, 0.01}) {
    const Contact* contact = two.at({0.03, 0.04, height + gap});
    ASSERT_NE(contact, nullptr);
    ASSERT_EQ(contact->points().size(), 1u) << gap;
    const ContactPoint& point = contact->points()[0];
    EXPECT_EQ(point.kind, FeaturePair::edge_edge);
    EXPECT_NEAR(point.gap, gap, 1e-9);
    EXPECT_NEAR(point.normal.z(), 1.0, 1e-9);
    ids.insert(point.id);
  }
  EXPECT_EQ(ids.size(), 1u);
}

// Through a plate and beyond its middle: every vertex keeps to the side that it came through, and its gap changes by no
// more than the way of a step.
TEST(Gaps, ChangeAsTheBodyMovesAndKeepTheirSideInAThinPlate) {
  const Mesh plate = gridded_box({-2, -2, -0.1}, {2, 2, 0}, 8), ball = icosphere(3, 0.5);
  for (const double margin : {0.0, 0.02}) {
    Two two(plate, ball, margin);
    std::map<int, double> last;
    const double step = 0.005;
    const auto go = [&](double z) {
      const Contact* contact = two.at({0.013, 0.027, z});
      std::map<int, double> gaps;
      if (contact != nullptr) gaps = gaps_of_b(*contact);
      for (const auto& [v, gap] : gaps) {
        const double height = ball.position(v).z + z;
        EXPECT_NEAR(gap, height, 1e-9);
        if (last.contains(v)) {
          EXPECT_LE(std::abs(gap - last.at(v)), step + 1e-9);
        } else if (height < -2 * step && z > -0.05) {
          EXPECT_LE(height, -0.1 + 2 * step);  // it comes back through the lower side
        }
        EXPECT_GE(gap, -contact->depth - 1e-12);
      }
      last = gaps;
      return gaps.size();
    };
    go(0.6);
    for (double z = 0.5; z > 0.37; z -= step) go(z);
    EXPECT_GT(go(0.37), 30u);
    for (double z = 0.37; z < 0.5; z += step) go(z);
    EXPECT_EQ(go(0.51), 0u);
  }
}

// A ball held by two jaws: what is in either has a normal away from it.
TEST(Gaps, InAClampPointBothWays) {
  const Mesh jaws[] = {gridded_box({-2, -1, -1}, {-0.48, 1, 1}, 6), gridded_box({0.48, -1, -1}, {2, 1, 1}, 6),
                       gridded_box({-2, -1, -3}, {2, 1, -2}, 4)};
  const Mesh clamp = merged(jaws), ball = icosphere(3, 0.5);
  for (const double margin : {0.0, 0.01}) {
    Two two(clamp, ball, margin);
    two.at({0, 0, 3});
    const Contact* contact = two.at({0, 0, 0});
    ASSERT_NE(contact, nullptr);
    int left = 0, right = 0;
    for (const ContactPoint& point : contact->points()) {
      if (point.kind != FeaturePair::facet_vertex || point.gap >= 0.0) continue;
      const double x = ball.position(point.b_vertices[0]).x;
      EXPECT_NEAR(point.gap, 0.48 - std::abs(x), 1e-9);
      EXPECT_NEAR(point.normal.x(), x < 0.0 ? 1.0 : -1.0, 1e-9);
      ++(x < 0.0 ? left : right);
    }
    EXPECT_GT(left, 3);
    EXPECT_EQ(left, right);
  }
}

// A ball that is pushed through a cloth: what is beyond it is as deep as it is far from the cloth, up to the end.
TEST(Gaps, OfAClothAreNegativeOnTheOtherSideThanBefore) {
  const Mesh cloth = sheet(20, 20, 3, 3), ball = icosphere(2, 0.5);
  for (const double side : {1.0, -1.0}) {
    for (const double margin : {0.0, 0.02}) {
      Two two(cloth, ball, margin, Surface::sheet);
      two.at({0.01, 0.02, side * 0.6});
      for (double z = 0.5; z > -0.5; z -= 0.06) {
        const Contact* contact = two.at({0.01, 0.02, side * z});
        if (contact == nullptr || contact->facet_pairs().empty()) continue;
        const std::map<int, double> gaps = gaps_of_b(*contact);
        for (int v = 0; v < ball.vertex_count(); ++v) {
          const double height = side * ball.position(v).z + z;
          ASSERT_EQ(gaps.contains(v), height < 0.0) << z << " " << side << " " << margin;
          if (height < 0.0) {
            EXPECT_NEAR(gaps.at(v), height, 1e-9);
          }
        }
      }
      const Contact* beyond = two.at({0.01, 0.02, -side * 0.53});
      EXPECT_TRUE(beyond == nullptr || gaps_of_b(*beyond).empty());
    }
  }
}

// A dome that reaches below the middle of a ball, with one vertex at its border dented into the ball. There the contact
// direction, along the dome's axis, shows to the wrong side: the ball would have to leave through the dome.
TEST(Gaps, OfAClothThatWrapsABallAreNoDeeperThanItsDent) {
  const Mesh ball = rotated(icosphere(3, 0.4), rotation(0.3, 0.4, -0.5, 0.7));
  Mesh dome = icosphere(3, 0.41);
  std::vector<int> kept;
  for (int f = 0; f < dome.facet_count(); ++f) {
    const auto corner = [&](int k) { return dome.position(dome.facets(k, f)); };
    if (std::min({corner(0).z, corner(1).z, corner(2).z}) > -0.25) kept.push_back(f);
  }
  dome.facets = Eigen::Matrix3Xi(dome.facets(Eigen::all, kept));
  const int border = lowest_vertex(dome);
  const Mesh flawless = dome;
  dome.positions.col(border) *= 0.392 / 0.41;
  for (const double margin : {0.0, 0.004}) {
    for (const bool looked_before : {false, true}) {
      for (const bool dome_first : {true, false}) {
        World world(kPoints);
        const auto add_dome = [&] {
          return world.add_body(gap_body(looked_before ? flawless : dome, margin, Surface::sheet));
        };
        const BodyId first = dome_first ? add_dome() : world.add_body(gap_body(ball, margin));
        const BodyId second = dome_first ? world.add_body(gap_body(ball, margin)) : add_dome();
        if (looked_before) world.detect();
        world.set_positions(dome_first ? first : second, dome.positions);
        const Contact* contact = world.detect().find_contact(first, second);
        ASSERT_NE(contact, nullptr);
        ASSERT_FALSE(contact->facet_pairs().empty());
        int crossed = 0;
        for (const ContactPoint& point : contact->points()) {
          if (point.gap >= 0.0) continue;
          ++crossed;
          EXPECT_GT(point.gap, -0.012) << margin << " " << looked_before << " " << dome_first;
        }
        EXPECT_GT(crossed, 0);
        EXPECT_LT(crossed, 20);
      }
    }
  }
}

// Random bodies that sink into each other step by step, each step against brute force with the last step's normals.
TEST(Gaps, EqualBruteForce) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Mesh a = seed % 3 == 0 ? random_hull(30, seed) : blob(2, 1.0, 0.3, seed),
               b = seed % 2 == 0 ? blob(1, 0.8, 0.3, 100 + seed) : random_hull(25, 100 + seed);
    const double margin = seed % 2 == 0 ? 0.02 : 0.0;
    Two two(a, b, margin);
    LastNormals last;
    int points = 0;
    for (const double x : {2.2, 1.6, 1.5, 1.3, 1.0, 0.6, 1.2}) {
      const Vec3 shift{x, 0.11, 0.07};
      const Contact* contact = two.at(shift);
      if (contact == nullptr) {
        last = {};
        continue;
      }
      if (!contact->facet_pairs().empty()) {
        const ExpectedGaps expected = gaps_by_brute_force(a, translated(b, shift), *contact, last);
        ASSERT_TRUE(has_gaps(*contact, expected, 1e-11)) << "seed " << seed << " x " << x;
        points += static_cast<int>(expected.vertices_of_a.size() + expected.vertices_of_b.size());
        expect_places_to_agree(*contact, a, translated(b, shift));
      }
      last = last_normals(*contact);
    }
    EXPECT_GT(points, 20) << seed;
  }
}

// Three of 15,000 drawn pairs: vertices that sink by more than the other body is thick, or that were not inside before.
TEST(Gaps, OfWhatSinksFastOrAnewEqualBruteForce) {
  for (const std::uint64_t seed : {3337189590430u, 3337189593273u, 87020890730007668u})
    EXPECT_GT(sink_and_compare(seed), 0u);
}

std::multiset<double> rounded_gaps(const Contact& contact, double unit) {
  std::multiset<double> gaps;
  for (const ContactPoint& point : contact.points()) gaps.insert(std::round(point.gap / unit * 1e9));
  return gaps;
}

TEST(Gaps, AreTheSameTurnedMovedScaledAndSwapped) {
  const Mesh a = blob(2, 1.0, 0.3, 5), b = translated(blob(2, 0.9, 0.3, 6), {1.4, 0.1, 0.2});
  const auto contact_of = [&](const Mesh& p, const Mesh& q, double margin) {
    World world(kPoints);
    world.add_body(gap_body(p, margin));
    world.add_body(gap_body(q, margin));
    return rounded_gaps(world.detect().contacts()[0], margin / 0.02);
  };
  const auto expected = contact_of(a, b, 0.02);
  EXPECT_LT(*expected.begin(), -1e7);
  EXPECT_EQ(contact_of(b, a, 0.02), expected);
  const Rotation turn = rotation(0.3, 0.4, -0.5, 0.7);
  EXPECT_EQ(contact_of(rotated(a, turn), rotated(b, turn), 0.02), expected);
  EXPECT_EQ(contact_of(translated(a, {8, -16, 4}), translated(b, {8, -16, 4}), 0.02), expected);
  for (const double scale : {0x1p-300, 0x1p-20, 0x1p30, 0x1p290})
    EXPECT_EQ(contact_of(scaled(a, scale), scaled(b, scale), 0.02 * scale), expected) << scale;
}

// Facets without area, facets that stand twice, soups without an inside, bodies that touch in a point.
TEST(Gaps, OfHostileMeshesAreFinite) {
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const Mesh a = lattice_soup(40, 3, seed),
               b = seed % 2 == 0 ? lattice_soup(40, 3, 100 + seed) : cube(3.0, {1, 0, 0});
    for (const Surface surface : {Surface::closed, Surface::sheet}) {
      World world(kPoints);
      world.add_body(gap_body(a, 0.05, surface));
      world.add_body(gap_body(b, 0.0, seed % 3 == 0 ? Surface::sheet : Surface::closed));
      for (int step = 0; step < 2; ++step) {
        for (const Contact& contact : world.detect().contacts()) {
          for (const ContactPoint& point : contact.points()) {
            ASSERT_TRUE(std::isfinite(point.gap)) << seed;
            ASSERT_NEAR(point.normal.norm(), 1.0, 1e-9) << seed;
            ASSERT_NEAR(point.a_weights[0] + point.a_weights[1] + point.a_weights[2], 1.0, 1e-9) << seed;
            ASSERT_NEAR(point.b_weights[0] + point.b_weights[1] + point.b_weights[2], 1.0, 1e-9) << seed;
          }
        }
        world.set_settings(kPoints);
      }
    }
  }
  Two two(cube(1.0, {}), spike({0, 0, -1}, 0.2), 0.0);
  const Contact* contact = two.at({0.1, 0.2, 1.5});
  ASSERT_NE(contact, nullptr);
  ASSERT_EQ(contact->points().size(), 1u);
  EXPECT_EQ(contact->points()[0].gap, 0.0);
  EXPECT_NEAR(contact->points()[0].normal.z(), 1.0, 1e-12);
}

TEST(Containment, IsExactAndTellsTheWayOut) {
  World world(kPoints);
  const Mesh outer = cube(2.0, {}), inner = cube(0.5, {0.3, 0, 0.5});
  const BodyId a = world.add_body(gap_body(outer, 0.0)), b = world.add_body(gap_body(inner, 0.0));
  const Contact* contact = world.detect().find_contact(a, b);
  ASSERT_NE(contact, nullptr);
  EXPECT_EQ(contact->containment, Containment::b_in_a);
  EXPECT_TRUE(contact->facet_pairs().empty());
  EXPECT_NEAR(contact->depth, 0.75, 1e-12);
  ASSERT_EQ(contact->points().size(), 8u);
  for (const ContactPoint& point : contact->points())
    EXPECT_NEAR(point.gap, inner.position(point.b_vertices[0]).z - 1.0, 1e-12);
  // From inside it touches the wall, then crosses it.
  for (const double x : {0.74, 0.75, 0.76}) {
    world.set_positions(b, cube(0.5, {x, 0, 0.5}).positions);
    const Contact& now = *world.detect().find_contact(a, b);
    EXPECT_EQ(now.containment, x < 0.75 ? Containment::b_in_a : Containment::none) << x;
    EXPECT_EQ(now.facet_pairs().empty(), x < 0.75) << x;
  }
}

TEST(Containment, NeedsEveryPartOfTheInnerBody) {
  const Mesh outer = cube(4.0, {}), parts[] = {cube(0.5, {1, 0, 0}), cube(0.5, {-1, 0, 0})};
  const Mesh shell_parts[] = {cube(3.0, {}), turned_inside_out(cube(2.0, {}))};
  const Mesh two_cubes = merged(parts), shell = merged(shell_parts);
  for (const bool swapped : {false, true}) {
    World world;
    const auto add = [&](const Mesh& mesh) { return world.add_body(gap_body(mesh, 0.0)); };
    const BodyId first = add(swapped ? two_cubes : outer), second = add(swapped ? outer : two_cubes);
    EXPECT_EQ(world.detect().find_contact(first, second)->containment,
              swapped ? Containment::a_in_b : Containment::b_in_a);
    // One of them in the wall of a shell, the other in its hollow.
    const BodyId third = add(shell);
    const Mesh split_parts[] = {cube(0.25, {1.25, 0, 0}), cube(0.25, {0, 0, 0})};
    const BodyId fourth = add(merged(split_parts));
    const Report& report = world.detect();
    EXPECT_EQ(report.find_contact(third, fourth)->containment, Containment::none);
    EXPECT_EQ(report.find_contact(swapped ? second : first, third)->containment, Containment::b_in_a);
  }
}

TEST(Containment, OfABallInABowlAndOfLinkedRingsIsNone) {
  const Mesh ring = torus(32, 8, 1.0, 0.2);
  Two rings(ring, translated(rotated(ring, rotation(1, 1, 0, 0)), {1, 0, 0}), 0.0);
  const Contact* contact = rings.at({0.01, 0, 0});
  ASSERT_NE(contact, nullptr);
  EXPECT_GT(contact->depth, 0.1);
  EXPECT_TRUE(contact->facet_pairs().empty());
  EXPECT_EQ(contact->containment, Containment::none);
  EXPECT_TRUE(contact->points().empty());
  const Mesh hollow[] = {cube(4.0, {}), turned_inside_out(cube(3.0, {}))};
  Two bowl(merged(hollow), icosphere(2, 0.5), 0.0);
  contact = bowl.at({0.1, 0, 0});
  ASSERT_NE(contact, nullptr);
  EXPECT_EQ(contact->containment, Containment::none);
  EXPECT_TRUE(contact->points().empty());
}

TEST(Gaps, AreTheSameBitsForAnyNumberOfThreads) {
  std::set<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3, 4}) {
    World world({.threads = threads, .outputs = {.points = true}});
    const Mesh blobs[] = {blob(4, 1.0, 0.3, 1), blob(4, 1.0, 0.3, 2), blob(3, 1.0, 0.3, 3), blob(3, 0.2, 0.3, 4)};
    for (int k = 0; k < 4; ++k) world.add_body(gap_body(translated(blobs[k], {k == 3 ? 0.0 : 1.2 * k, 0, 0}), 0.02));
    hashes.insert(world.detect().hash());
    EXPECT_GT(world.detect().contacts().size(), 1u);
  }
  EXPECT_EQ(hashes.size(), 1u);
}

}  // namespace
}  // namespace tact::tests
