// Bodies that are added as closed and are not: they have no inside, however they are turned, and one word says so.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/mesh.h"

namespace tact::tests {
namespace {

Mesh without_first_facets(Mesh mesh, int count) {
  mesh.facets = mesh.facets.rightCols(mesh.facet_count() - count).eval();
  return mesh;
}

Mesh with_turned_facet(Mesh mesh) {
  std::swap(mesh.facets(1, 0), mesh.facets(2, 0));
  return mesh;
}

// Every facet twice, once each way, on vertices of their own.
Mesh doubled(const Mesh& mesh) {
  const Mesh both[] = {mesh, turned_inside_out(mesh)};
  return merged(both);
}

// Every facet with vertices of its own, as in STL files.
Mesh unwelded(const Mesh& mesh) {
  MeshBuilder builder;
  for (int f = 0; f < mesh.facet_count(); ++f)
    builder.triangle(mesh.position(mesh.facets(0, f)), mesh.position(mesh.facets(1, f)),
                     mesh.position(mesh.facets(2, f)));
  return builder.mesh();
}

std::vector<Rotation> quarter_turns() {
  std::vector<Rotation> all;
  for (const Rotation& first : {rotation(1, 0, 0, 0), rotation(0, 1, 0, 0), rotation(1, 1, 0, 0), rotation(1, -1, 0, 0),
                                rotation(1, 0, 1, 0), rotation(1, 0, -1, 0)}) {
    for (const Rotation& second :
         {rotation(1, 0, 0, 0), rotation(1, 0, 0, 1), rotation(0, 0, 0, 1), rotation(1, 0, 0, -1)}) {
      Rotation both;
      for (int i = 0; i < 3; ++i) {
        const Vec3& row = second.row[i];
        both.row[i] = row.x * first.row[0] + row.y * first.row[1] + row.z * first.row[2];
      }
      all.push_back(both);
    }
  }
  return all;
}

std::vector<std::string> told_of(const Mesh& mesh, Surface surface = Surface::closed,
                                 MessageKind kind = MessageKind::open_surface) {
  std::vector<std::string> told;
  World world({.on_message = [&](const Message& message) {
    EXPECT_EQ(message.kind, kind);
    EXPECT_EQ(message.a, message.b);
    told.emplace_back(message.text);
  }});
  const BodyId body =
      world.add_body({.positions = mesh.positions, .facets = mesh.facets, .surface = surface, .name = "it"});
  EXPECT_EQ(world.surface(body), surface);  // as it was added
  world.detect();
  world.set_positions(body, translated(mesh, {1, 0, 0}).positions);
  world.detect();
  return told;
}

TEST(OpenSurfaces, AreToldOfOnce) {
  const Mesh ball = icosphere(1);
  for (const Mesh& open :
       {without_first_facets(ball, 1), with_turned_facet(ball), doubled(ball), sheet(2, 2, 1, 1), soup(5, 1.0, 1)}) {
    const auto told = told_of(open);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("'it'"), std::string::npos) << told[0];
    EXPECT_TRUE(told_of(open, Surface::sheet).empty());
  }
  MeshBuilder rope;
  rope.vertex({0, 0, 0}), rope.vertex({1, 0, 0});
  rope.facet(0, 1, 1);
  const Mesh hollow[] = {icosphere(2), turned_inside_out(icosphere(2, 0.5))},
             two[] = {ball, translated(ball, {1, 0, 0})};
  for (const Mesh& closed :
       {ball, unwelded(ball), torus(8, 8, 1.0, 0.3), merged(hollow), merged(two), rope.mesh(), Mesh{}}) {
    EXPECT_TRUE(told_of(closed).empty());
  }
}

TEST(OpenSurfaces, BodiesInsideOutAreToldOfOnce) {
  const Mesh two[] = {icosphere(2), turned_inside_out(translated(icosphere(2, 1.5), {4, 0, 0}))};
  for (const Mesh& turned : {turned_inside_out(icosphere(1)), unwelded(turned_inside_out(cube(1.0, {1e6, 0, 0}))),
                             turned_inside_out(cube(1e-80, {})), merged(two)}) {
    const auto told = told_of(turned, Surface::closed, MessageKind::inside_out);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("'it'"), std::string::npos) << told[0];
    EXPECT_TRUE(told_of(turned, Surface::sheet).empty());
  }
  // Volumes that cancel are neither.
  const Mesh equal[] = {icosphere(2), turned_inside_out(translated(icosphere(2), {4, 0, 0}))};
  EXPECT_TRUE(told_of(rotated(merged(equal), rotation(1, 2, 3, 4)), Surface::closed, MessageKind::inside_out).empty());
}

// -0 and 0 are one place.
TEST(OpenSurfaces, AreNoneWhereZerosHaveSigns) {
  Mesh mesh = unwelded(box({0, 0, 0}, {1, 1, 1}));
  for (int v = 0; v < mesh.vertex_count(); v += 2) {
    for (int axis = 0; axis < 3; ++axis) {
      if (mesh.positions(axis, v) == 0.0) mesh.positions(axis, v) = -0.0;
    }
  }
  EXPECT_TRUE(told_of(mesh).empty());
}

// A ball that stands free in a cup, whichever way the mouth is.
TEST(OpenSurfaces, HaveNoInsideHoweverTheyAreTurned) {
  const Mesh cup = without_first_facets(cube(2.0, {}), 2), ball = icosphere(1, 0.5);
  for (const Rotation& turn : quarter_turns()) {
    World world({.outputs = {.points = true}});
    const Mesh turned = rotated(cup, turn);
    const BodyId a = world.add_body({.positions = turned.positions, .facets = turned.facets}),
                 b = world.add_body({.positions = ball.positions, .facets = ball.facets});
    const Contact* contact = world.detect().find_contact(a, b);
    ASSERT_NE(contact, nullptr);
    EXPECT_EQ(contact->containment, Containment::none);
    EXPECT_TRUE(contact->points().empty());
    const auto around = world.bodies_containing({.point = Eigen::Vector3d::Zero()});
    ASSERT_EQ(around.size(), 1u);
    EXPECT_EQ(around[0], b);
  }
}

// What crosses the wall of one has the points that it has with a sheet.
TEST(OpenSurfaces, HaveThePointsOfSheets) {
  for (const Mesh& open :
       {without_first_facets(cube(2.0, {}), 2), doubled(cube(2.0, {})), with_turned_facet(cube(2.0, {}))}) {
    const Mesh ball = translated(icosphere(2, 0.5), {0.9, 0.1, 0.05});
    std::vector<ContactPoint> points[2];
    for (const Surface surface : {Surface::closed, Surface::sheet}) {
      World world({.outputs = {.points = true}});
      const BodyId a = world.add_body({.positions = open.positions, .facets = open.facets, .surface = surface}),
                   b = world.add_body({.positions = ball.positions, .facets = ball.facets});
      const Contact* contact = world.detect().find_contact(a, b);
      ASSERT_NE(contact, nullptr);
      points[surface == Surface::sheet].assign(contact->points().begin(), contact->points().end());
    }
    ASSERT_FALSE(points[0].empty());
    ASSERT_EQ(points[0].size(), points[1].size());
    for (std::size_t i = 0; i < points[0].size(); ++i) {
      EXPECT_EQ(points[0][i].id, points[1][i].id);
      EXPECT_EQ(points[0][i].gap, points[1][i].gap);
    }
  }
}

// Two arms of a bent bar near each other.
Mesh horseshoe() {
  return mapped(gridded_box({-1, 0, 0}, {1, 0.1, 0.1}, 6), [](Vec3 p) {
    const double radius = 0.06 + p.z, turn = 0.5 * std::numbers::pi * (1.0 + p.x / 0.25);
    if (std::abs(p.x) <= 0.25) return Vec3{radius * std::sin(turn), p.y, -radius * std::cos(turn)};
    return Vec3{0.6 * (0.25 - std::abs(p.x)), p.y, p.x > 0.0 ? radius : -radius};
  });
}

// Each point by its features, whatever the order of their vertices, and its gap.
using Places = std::vector<std::tuple<FeaturePair, std::array<int, 3>, std::array<int, 3>, double>>;
Places places_of(const Mesh& a, const Mesh& b) {
  World world({.outputs = {.points = true}});
  const auto add = [&](const Mesh& mesh, bool with_itself) {
    return world.add_body(
        {.positions = mesh.positions, .facets = mesh.facets, .margin = 0.08, .self_contact = with_itself});
  };
  add(a, true), add(b, false);
  Places places;
  for (const Contact& contact : world.detect().contacts()) {
    for (const ContactPoint& point : contact.points()) {
      auto& [kind, of_a, of_b, gap] = places.emplace_back(point.kind, point.a_vertices, point.b_vertices, point.gap);
      std::ranges::sort(of_a), std::ranges::sort(of_b);
    }
  }
  std::ranges::sort(places);
  return places;
}

// A mirror turns facets inside out; turned back, all that is found is the image of what was.
TEST(MirroredBodies, HaveTheImagesOfPoints) {
  const auto image = [](const Mesh& mesh) {
    return turned_inside_out(mapped(mesh, [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; }));
  };
  const Mesh bar = jittered(horseshoe(), 0.001, 3);  // no two ways are equally long
  const std::array<Mesh, 2> pairs[] = {
      {bar, translated(icosphere(2, 0.07), {-0.2, 0.05, 0.13})},
      {rotated(bar, rotation(0.9, 0.2, -0.3, 0.1)), translated(blob(2, 0.1, 0.3, 5), {0.05, 0.1, 0.1})},
      {cube(2.0, {}), translated(icosphere(2, 0.5), {0.1, 0.05, 1.1})}};
  for (const auto& [a, b] : pairs) {
    const Places places = places_of(a, b), images = places_of(image(a), image(b));
    EXPECT_GT(places.size(), 20u);
    ASSERT_EQ(places.size(), images.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto& [kind, of_a, of_b, gap] = places[i];
      const auto& [image_kind, image_of_a, image_of_b, image_gap] = images[i];
      EXPECT_TRUE(kind == image_kind && of_a == image_of_a && of_b == image_of_b) << i;
      EXPECT_NEAR(gap, image_gap, 1e-12);
    }
  }
}

TEST(OpenSurfaces, StayOpenInSavedStates) {
  const Mesh cup = without_first_facets(cube(2.0, {}), 2);
  World world, other;
  world.add_body({.positions = cup.positions, .facets = cup.facets});
  world.add_body({.positions = cup.positions, .facets = cup.facets, .surface = Surface::sheet});
  const Mesh solid = unwelded(cube(1.0, {}));
  world.add_body({.positions = solid.positions, .facets = solid.facets});
  world.detect();
  other.restore(world.save());
  for (const World* one : {&world, &other})
    EXPECT_EQ(one->bodies_containing({.point = Eigen::Vector3d::Zero()}).size(), 1u);
}

}  // namespace
}  // namespace tact::tests
