// Cases of other projects on hulls, direction and depth, with the numbers that they were reported with. Cases on
// triangles stand in test_triangle_triangle.cpp, distances and closest points (openGJK, Jolt, parry, Box2D) in
// test_gjk.cpp, since a world tells none of bodies that are apart, nor points of those that overlap; the poses of
// queries of continuous detection in test_data_sets.cpp. Left out are depths of libccd's MPR, which are recorded output
// and no truth.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/checks/contact_checks.h"
#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/known_shapes.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::tests {
namespace {

// All three are seldom given: what is said of the pair must hold, and agree with the smallest separation by brute
// force.
void expect_right(const Mesh& a, const Mesh& b) {
  const double smallest = static_cast<double>(smallest_height(used_points(a), used_points(b), 0.0).height);
  const std::optional<Contact> contact = contact_of(a, b);
  const double size = extent(a) + extent(b);
  if (std::abs(smallest) > 1e-14 * size) {
    EXPECT_EQ(contact.has_value(), smallest > 0.0) << smallest;
  }
  if (contact) {
    EXPECT_TRUE(is_sound(*contact, a, b));
    EXPECT_NEAR(contact->depth, std::max(smallest, 0.0), 1e-13 * size);
  }
  EXPECT_TRUE(engine_agrees_with_oracle(a, b));
}

// libccd#25: two cubes of edge 2 at z = 0 and 1.9; GJK said depth 0 and a direction of NaN.
TEST(KnownAnswers, StackedCubes) {
  const std::optional<Contact> contact = contact_of(cube(2.0, {}), cube(2.0, {0.0, 0.0, 1.9}));
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->depth, 0.1, 1e-15);
  EXPECT_EQ(contact->direction, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(0.5 * (contact->plane_a + contact->plane_b), 0.95, 1e-15);
}

// libccd boxbox.c: a unit cube and a box of 0.5 x 1 x 1.5.
TEST(KnownAnswers, CubeInBox) {
  const Mesh box = centered_box({0.25, 0.5, 0.75});
  const std::optional<Contact> side = contact_of(cube(1.0, {-0.5, 0.5, 0.2}), box);
  ASSERT_TRUE(side);
  EXPECT_LT((side->depth * side->direction - Eigen::Vector3d(0.25, 0.0, 0.0)).norm(), 1e-15);
  const std::optional<Contact> top = contact_of(cube(1.0, {-0.3, 0.5, 1.0}), box);
  ASSERT_TRUE(top);
  EXPECT_LT((top->depth * top->direction - Eigen::Vector3d(0.0, 0.0, -0.25)).norm(), 1e-15);
}

// libccd mpr_boxbox.c: a box of 1 x 2 x 1 sweeps past one of 2 x 1 x 2; apart before step 35 and after step 65.
TEST(KnownAnswers, SweepingBoxes) {
  const Mesh still = centered_box({1.0, 0.5, 1.0}), moving = centered_box({0.5, 1.0, 0.5});
  World world;
  const std::vector<BodyId> ids = add_bodies(world, std::array{moving, still});
  for (int i = 0; i <= 100; ++i) {
    world.set_positions(ids[0], translated(moving, {i / 10.0 - 5.0, 0.0, 0.0}).positions);
    EXPECT_EQ(world.detect().contacts().size(), i >= 35 && i <= 65 ? 1u : 0u) << i;
  }
}

// The contact of such a pair, if depth > 0; at depth 0 rounding may part them, by no more than `error`.
void expect_edge_in_face(const Mesh& a, const Mesh& b, double depth, const Pose& frame, double error) {
  const std::optional<Contact> contact = contact_of(a, b);
  if (depth != 0.0) {
    ASSERT_EQ(contact.has_value(), depth > 0.0);
  } else if (!contact) {
    EXPECT_NEAR(static_cast<double>(smallest_height(used_points(a), used_points(b), 0.0).height), 0.0, error);
  }
  if (!contact) return;
  EXPECT_NEAR(contact->depth, depth, error);
  EXPECT_TRUE(is_sound(*contact, a, b));
  if (depth == 0.0) return;
  const auto& row = frame.rotation.row;
  const Vec3 n{-row[0].x, -row[1].x, -row[2].x};
  EXPECT_LT(norm(from_eigen(contact->direction) - n), error);
  // The face, at x = -0.5, and the edge, at depth - 0.5.
  EXPECT_NEAR(contact->plane_a, 0.5 + dot(n, frame.translation), error);
  EXPECT_NEAR(contact->plane_b, 0.5 - depth + dot(n, frame.translation), error);
}

// FCL: a unit cube and a box of 0.6 x 0.8 x 1 turned so that an edge points at it, at x = -1.1, -1 and -0.9; signed
// distances 0.1, 0 and -0.1, in several frames of the world, in doubles and in floats.
TEST(KnownAnswers, EdgeOfTurnedBoxAgainstFace) {
  const std::vector<Pose> frames = frames_of_the_world();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const double y : {0.0, 0.1, -0.1, -0.05}) {
      for (const double depth : {-0.1, 0.0, 0.1}) {
        SCOPED_TRACE(::testing::Message() << "frame " << i << ", y " << y << ", depth " << depth);
        const BoxPair boxes = edge_against_face(y, depth);
        const Mesh a = posed(boxes.a, frames[i]), b = posed(boxes.b, frames[i]);
        expect_edge_in_face(a, b, depth, frames[i], 1e-14);
        expect_edge_in_face(rounded_to_floats(a), rounded_to_floats(b), depth, frames[i], 1e-6);
      }
    }
  }
}

// FCL: poses that ended in an exception.
TEST(KnownAnswers, BoxesFromTheField) {
  for (const BoxPair& boxes : boxes_from_the_field()) {
    expect_right(boxes.a, boxes.b);
    expect_right(boxes.b, boxes.a);
  }
}

// Of which FCL expects a distance of 0, to 1.5e-8.
TEST(KnownAnswers, BoxesFromTheFieldThatTouch) {
  const BoxPair boxes = boxes_from_the_field_that_touch();
  expect_right(boxes.a, boxes.b);
  const std::optional<Contact> contact = contact_of(boxes.a, boxes.b);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->depth, 4.614e-11, 1e-14);
}

// FCL fcl#493, #495: equal cubes stacked in a tilted frame, apart or overlapping by a few units in the last place.
TEST(KnownAnswers, TiltedCubesThatKiss) {
  const Rotation tilt{{{0.94096063217417758029, 0.29296840037289501035, 0.16959541586174811667},
                       {-0.23569836841299879326, 0.92661523595848427348, -0.29296840037289506586},
                       {-0.2429801799032638987, 0.23569836841299884878, 0.94096063217417758029}}};
  for (const double edge : {0.01, 0.25, 0.5, 10.0, 1000.0}) {
    const Mesh a = posed_box({edge, edge, edge}, {tilt, {0.0, 0.0, 5.0 * edge}});
    for (const double distance : {-1e-15, -2.5e-16, -1e-16, 0.0, 1e-16, 2.5e-16, 1e-15}) {
      const double offset = edge + distance * std::max(1.0, edge);
      const Vec3 to_b{tilt.row[0].y * offset, tilt.row[1].y * offset, tilt.row[2].y * offset};
      expect_right(a, posed_box({edge, edge, edge}, {tilt, Vec3{0.0, 0.0, 5.0 * edge} + to_b}));
    }
  }
}

// A ball that reaches exactly `radius` from its centre in the direction of `tip`, and less elsewhere.
Mesh ball_with_tip(Vec3 center, double radius, Vec3 tip) {
  Mesh ball = icosphere(1, 0.999 * radius);
  int nearest = 0;
  for (int v = 1; v < ball.vertex_count(); ++v) {
    if (dot(ball.position(v), tip) > dot(ball.position(nearest), tip)) nearest = v;
  }
  ball.set_position(nearest, radius * normalized(tip));
  return translated(ball, center);
}

// Jolt EPATests: a ball against the face, the edge and the corner of a box; just short of it, just in it, and deep.
TEST(KnownAnswers, BallAgainstFaceEdgeAndCorner) {
  // The depth, the direction, and where the planes are: through the points that are deepest.
  const auto expect_hit = [](const Mesh& a, const Mesh& b, double depth, Vec3 direction, Vec3 deepest_of_a) {
    const std::optional<Contact> contact = contact_of(a, b);
    ASSERT_TRUE(contact);
    const Vec3 n = normalized(direction);
    EXPECT_NEAR(contact->depth, depth, 1e-14);
    EXPECT_LT(norm(from_eigen(contact->direction) - n), 1e-14);
    EXPECT_NEAR(contact->plane_a, dot(n, deepest_of_a), 1e-14);
    EXPECT_NEAR(contact->plane_b, dot(n, deepest_of_a - depth * n), 1e-14);
    EXPECT_TRUE(is_sound(*contact, a, b));
  };
  const Mesh face = box({-2.0, -3.0, -4.0}, {2.0, 3.0, 4.0});
  EXPECT_FALSE(contact_of(face, ball_with_tip({4.0, 0.0, 0.0}, 1.99, {-1.0, 0.0, 0.0})));
  expect_hit(face, ball_with_tip({4.0, 0.0, 0.0}, 2.01, {-1.0, 0.0, 0.0}), 0.01, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  expect_hit(face, ball_with_tip({3.0, 0.0, 0.0}, 2.0, {-1.0, 0.0, 0.0}), 1.0, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0});

  const double eight = std::sqrt(8.0), twelve = std::sqrt(12.0);
  const Mesh edge = box({1.0, 1.0, -2.0}, {2.0, 2.0, 2.0});
  EXPECT_FALSE(contact_of(edge, ball_with_facet({4.0, 4.0, 0.0}, eight - 0.01, {-1.0, -1.0, 0.0})));
  expect_hit(edge, ball_with_facet({4.0, 4.0, 0.0}, eight + 0.01, {-1.0, -1.0, 0.0}), 0.01, {1.0, 1.0, 0.0},
             {2.0, 2.0, 0.0});
  const Mesh corner = box({1.0, 1.0, 1.0}, {2.0, 2.0, 2.0});
  EXPECT_FALSE(contact_of(corner, ball_with_facet({4.0, 4.0, 4.0}, twelve - 0.01, {-1.0, -1.0, -1.0})));
  expect_hit(corner, ball_with_facet({4.0, 4.0, 4.0}, twelve + 0.01, {-1.0, -1.0, -1.0}), 0.01, {1.0, 1.0, 1.0},
             {2.0, 2.0, 2.0});
}

// Jolt GJKTests: two balls of radius 1 whose centres are 2 apart along (1, 1, 1) touch; here in one vertex, exactly. A
// unit in the last place farther they do not, nor where the other's centre is at (10, 10, 10).
TEST(KnownAnswers, BallsThatTouch) {
  const Vec3 tip = normalized(Vec3{1.0, 1.0, 1.0});
  const Mesh a = ball_with_tip({}, 1.0, tip);
  Mesh b = a;
  b.positions = -b.positions;
  b = turned_inside_out(translated(b, 2.0 * tip));
  EXPECT_FALSE(facet_pairs_by_engine(a, b).empty());
  EXPECT_TRUE(engine_agrees_with_oracle(a, b));
  const std::optional<Contact> contact = contact_of(a, b);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->depth, 0.0);
  EXPECT_FALSE(contact_of(a, translated(b, Vec3{10.0, 10.0, 10.0} - 2.0 * tip)));
  EXPECT_TRUE(facet_pairs_by_engine(a, translated(b, {2e-16, 2e-16, 2e-16})).empty());
}

// A fan of facets around the first of the points.
Mesh polygon(const std::vector<Vec3>& points) {
  MeshBuilder builder;
  for (const Vec3& p : points) builder.vertex(p);
  for (int i = 2; i < static_cast<int>(points.size()); ++i) builder.facet(0, i - 1, i);
  return builder.mesh();
}

// openGJK#3: two polygons in one plane that overlap; the distance came out as 0.508965.
TEST(KnownAnswers, PolygonsInOnePlane) {
  const Mesh a = polygon({{0.795121, -0.727851, 0.0},
                          {-0.178424, -0.989183, 0.0},
                          {-0.412644, -0.770664, 0.0},
                          {0.566564, 0.548772, 0.0}});
  const Mesh b = polygon({{-0.211223, -0.511346, 0.0}, {-0.347973, 0.45872, 0.0}, {0.277308, 0.969689, 0.0}});
  const std::optional<Contact> contact = contact_of(a, b);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->depth, 0.0);
  EXPECT_NEAR(std::abs(contact->direction.z()), 1.0, 4e-16);
  EXPECT_TRUE(engine_agrees_with_oracle(a, b));
  EXPECT_FALSE(facet_pairs_by_engine(a, b).empty());
}

// openGJK#52: two boxes that overlap 9e4 from the origin, in floats; the distance came out as 0.0032915156.
TEST(KnownAnswers, BoxesFarFromOrigin) {
  const auto box_of = [](std::array<float, 4> x, std::array<float, 4> y) {
    Mesh mesh = centered_box({1.0, 1.0, 1.0});
    const std::array<int, 4> around = {0, 1, 3, 2};  // counter-clockwise in the box's lower face
    for (std::size_t i = 0; i < 4; ++i) {
      mesh.set_position(around[i], {x[i], y[i], 0.0});
      mesh.set_position(around[i] + 4, {x[i], y[i], 300.0});
    }
    return mesh;
  };
  const Mesh a = box_of({90945.08f, 91077.46f, 91454.92f, 91322.54f}, {54122.54f, 53745.082f, 53877.46f, 54254.918f});
  const Mesh b = box_of({90919.64f, 91162.62f, 91480.36f, 91237.38f}, {54037.383f, 53719.637f, 53962.617f, 54280.363f});
  ASSERT_TRUE(contact_of(a, b));
  EXPECT_GT(contact_of(a, b)->depth, 100.0);
  expect_right(a, b);
}

// openGJK#54: a cube with its corners cut off, against points inside and outside. (The query of the report is not known
// here; test_gjk.cpp has points before each face, edge and cut corner.)
TEST(KnownAnswers, PointsAroundRegularPolytope) {
  constexpr double kLong = 0.414213562373, kShort = 0.171572875254;
  MeshBuilder builder;
  for (int axis = 0; axis < 3; ++axis) {
    for (int signs = 0; signs < 8; ++signs) {
      Vec3 p{kLong, kLong, kLong};
      p[axis] = kShort;
      builder.vertex({(signs & 1) != 0 ? -p.x : p.x, (signs & 2) != 0 ? -p.y : p.y, (signs & 4) != 0 ? -p.z : p.z});
    }
  }
  for (int i = 0; i < 24; ++i) builder.facet(i, (i + 1) % 24, (i + 2) % 24);
  const Mesh polytope = builder.mesh();
  Random random(54);
  for (int i = 0; i < 50; ++i) {
    const Vec3 p = 0.7 * random.in_ball();
    MeshBuilder point;
    point.triangle(p, p, p);
    expect_right(polytope, point.mesh());
  }
}

// parry#76: a facet without area is a segment, 0.17147861 from the point that lies in its box.
TEST(KnownAnswers, FacetWithoutAreaIsASegment) {
  MeshBuilder facet, point;
  facet.triangle({2.27699995, -7.9000001, 16.3180008}, {-0.569999993, -8.10000038, 16.6070004},
                 {-0.569999993, -8.10000038, 16.6070004});
  const Vec3 p{1.10000002, -7.9000001, 16.5879993};
  point.triangle(p, p, p);
  World world;
  add_bodies(world, std::array{facet.mesh(), point.mesh()});
  const Report& report = world.detect();
  EXPECT_EQ(report.candidate_pairs().size(), 1u);
  EXPECT_TRUE(report.contacts().empty());
}

// Box2D test_distance.c: a plank 3.2 mm thick and a point one slop (5 mm) off its end are apart.
TEST(KnownAnswers, PointOffTheEndOfAThinPlank) {
  const Mesh plank = rotated(centered_box({0.5, 0.0016, 0.0016}), rotation(1.0, 0.1, 0.2, 0.3));
  for (const double off : {0.005, 1e-6, 1e-12, -1e-12, -1e-6}) {
    MeshBuilder point;
    point.triangle({0.5 + off, 0.001, 0.0005}, {0.5 + off, 0.001, 0.0005}, {0.5 + off, 0.001, 0.0005});
    const Mesh placed = rotated(point.mesh(), rotation(1.0, 0.1, 0.2, 0.3));
    EXPECT_EQ(contact_of(plank, placed).has_value(), off < 0.0) << off;
  }
}

// parry#253: two triangles; the expanding polytope ended in a panic.
TEST(KnownAnswers, TwoTriangles) {
  const Mesh a = polygon({{-13.174434, 1.0, 8.736801}, {3.5251038, 1.0, 12.1}, {3.2048466, 1.0, 12.218325}});
  const Mesh b = polygon({{-1.63, 0.0, 11.19}, {-2.349647, 0.0, 11.037681}, {-2.349647, 1.0, 11.037681}});
  expect_right(a, b);
}

}  // namespace
}  // namespace tact::tests
