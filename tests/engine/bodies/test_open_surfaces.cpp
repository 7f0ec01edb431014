// Bodies that are added as closed and are not: they have no inside, however they are turned, and one word says so.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <string>
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

std::vector<std::string> told_of(const Mesh& mesh, Surface surface = Surface::closed) {
  std::vector<std::string> told;
  World world({.on_message = [&](const Message& message) {
    EXPECT_EQ(message.kind, MessageKind::open_surface);
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
  for (const Mesh& closed : {ball, unwelded(ball), turned_inside_out(ball), torus(8, 8, 1.0, 0.3), merged(hollow),
                             merged(two), rope.mesh(), Mesh{}}) {
    EXPECT_TRUE(told_of(closed).empty());
  }
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
