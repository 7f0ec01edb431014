// Minima on floors of unwelded facets and of many bodies.
#include <gtest/gtest.h>
#include <tact/joined_minima.h>
#include <tact/report_arrays.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

// Each facet with vertices of its own.
Mesh unwelded(const Mesh& mesh) {
  Mesh result;
  result.positions.resize(3, 3 * mesh.facets.cols());
  result.facets.resize(3, mesh.facets.cols());
  for (Eigen::Index i = 0; i < mesh.facets.size(); ++i) {
    result.positions.col(i) = mesh.positions.col(mesh.facets(i % 3, i / 3));
    result.facets(i % 3, i / 3) = static_cast<int>(i);
  }
  return result;
}

// A floor from -2 to 2 at height 0, turned with all that stands on it.
struct JoinedFloor {
  explicit JoinedFloor(const Rotation& given, Motion motion = Motion::fixed, std::uint32_t floor_layer = 1)
      : turn(given), floor_motion(motion), layer(floor_layer) {}
  BodyId add(const Mesh& mesh, Surface surface) {
    const Mesh turned = rotated(mesh, turn);
    return world.add_body({.positions = turned.positions,
                           .facets = turned.facets,
                           .surface = surface,
                           .motion = floor_motion,
                           .layer = layer,
                           .margin = 0.02});
  }
  // Slides something over the floor, and tells how the minima of its points with the floor stand.
  // Over a gap of at most `within` a normal may lean as far.
  void slide(const Mesh& mesh, const JoinedSurfaces& joined, int corners, const std::string& what) {
    const double upright_to = 1e-5 + 3.0 * joined.within / 0.01;
    const Mesh first = rotated(mesh, turn);
    const BodyId body = world.add_body({.positions = first.positions, .facets = first.facets, .margin = 0.02});
    const Vec3 up_row{turn.row[0].z, turn.row[1].z, turn.row[2].z};
    const Eigen::Vector3d up(up_row.x, up_row.y, up_row.z);
    int tilted_before = 0;
    for (int step = 0; step < 40; ++step) {
      const Mesh moved = rotated(translated(mesh, {-1.2 + 0.061 * step, -0.3 + 0.0171 * step, 0.0}), turn);
      world.set_positions(body, moved.positions);
      const Report& report = world.detect();
      const std::vector<std::uint8_t> minima = joined_minima(world, report, joined);
      ASSERT_EQ(minima.size(), point_count(report));
      std::size_t at = 0;
      int upright = 0;
      for (const Contact& contact : report.contacts()) {
        for (const ContactPoint& point : contact.points()) {
          const std::uint8_t is_minimum = minima[at++];
          if (contact.a != body && contact.b != body) continue;
          const double tilt = point.normal.cross(up).norm();
          tilted_before += point.minimum && tilt > upright_to ? 1 : 0;
          EXPECT_LE(is_minimum, point.minimum ? 1 : 0);
          if (is_minimum != 0) {
            EXPECT_LT(tilt, upright_to) << what << ", step " << step;
            const bool of_vertex =
                (contact.a == body ? point.kind == FeaturePair::vertex_facet : point.kind == FeaturePair::facet_vertex);
            upright += of_vertex ? 1 : 0;
          }
        }
      }
      EXPECT_GE(upright, corners) << what << ", step " << step;
    }
    EXPECT_GT(tilted_before, 0) << what;  // there is something to find
    world.remove_body(body);
  }
  // A ball and a box that hover.
  void slide_all(const JoinedSurfaces& joined, const std::string& what) {
    slide(translated(centered_box({0.3, 0.3, 0.3}), {0.0, 0.0, 0.31}), joined, 4, what + ", box");
    slide(translated(icosphere(2, 0.3), {0.0, 0.0, 0.31}), joined, 0, what + ", ball");
  }
  Rotation turn;
  Motion floor_motion;
  std::uint32_t layer;
  World world{{.threads = 1, .outputs = {.points = true}}};
};

Rotation any_turn() {
  Random random(3);
  return random.rotation();
}

Mesh floor_from(double left, double width, int columns, int rows) {
  return translated(sheet(columns, rows, width, 4.0), {left + 0.5 * width, 0.0, 0.0});
}

TEST(JoinedMinima, OfAFloorOfUnweldedFacets) {
  for (const Rotation& turn : {Rotation{}, any_turn()}) {
    JoinedFloor floor(turn);
    floor.add(unwelded(floor_from(-2.0, 4.0, 8, 8)), Surface::sheet);
    floor.slide_all({}, "unwelded");
  }
}

// Two grids of other pitch in one body: their border has vertices of one amid edges of the other.
TEST(JoinedMinima, OfAFloorWithVerticesAmidEdges) {
  JoinedFloor floor(any_turn());
  const Mesh a = floor_from(-2.0, 2.0, 4, 3), b = floor_from(0.0, 2.0, 5, 7);
  Mesh both;
  both.positions.resize(3, a.positions.cols() + b.positions.cols());
  both.positions << a.positions, b.positions;
  both.facets.resize(3, a.facets.cols() + b.facets.cols());
  both.facets << a.facets, (b.facets.array() + static_cast<int>(a.positions.cols())).matrix();
  floor.add(both, Surface::sheet);
  floor.slide_all({}, "other pitch");
}

void add_boxes(JoinedFloor& floor, double gap) {
  for (int i = -2; i < 2; ++i) {
    for (int j = -2; j < 2; ++j)
      floor.add(translated(centered_box({0.5 - gap, 0.5 - gap, 0.5}), {i + 0.5, j + 0.5, -0.5}), Surface::closed);
  }
}

TEST(JoinedMinima, OfAFloorOfFixedBodiesSideBySide) {
  for (const Rotation& turn : {Rotation{}, any_turn()}) {
    JoinedFloor floor(turn);
    add_boxes(floor, 0.0);
    floor.slide_all({}, "fixed boxes");
  }
}

TEST(JoinedMinima, OfBodiesOnOneLayerThatAreAlmostSideBySide) {
  JoinedFloor floor(Rotation{}, Motion::deformable, 4);
  add_boxes(floor, 1e-5);
  floor.slide_all({.within = 3e-5, .layers = 4}, "boxes of a layer");
}

// A small box in one of two, nearer to the wall between them than to any other: that wall is no way out.
TEST(JoinedMinima, AreNotAtWallsBetweenJoinedBodies) {
  for (const Motion motion : {Motion::fixed, Motion::deformable}) {  // the latter are not joined
    JoinedFloor floor{Rotation{}, motion};
    add_boxes(floor, 0.0);
    const Mesh inside = translated(centered_box({0.05, 0.05, 0.05}), {0.06, 0.5, -0.5});
    const BodyId body = floor.world.add_body({.positions = inside.positions, .facets = inside.facets});
    const Report& report = floor.world.detect();
    const std::vector<std::uint8_t> minima = joined_minima(floor.world, report);
    std::size_t at = 0;
    int sideways = 0, left = 0;
    for (const Contact& contact : report.contacts()) {
      for (const ContactPoint& point : contact.points()) {
        const bool is_sideways = contact.b == body && point.minimum && std::abs(point.normal.x()) > 0.999;
        sideways += is_sideways ? 1 : 0;
        left += is_sideways && minima[at] != 0 ? 1 : 0;
        ++at;
      }
    }
    EXPECT_GT(sideways, 0);
    EXPECT_EQ(left, motion == Motion::fixed ? 0 : sideways);
  }
}

// A box in the corner of a floor and a wall keeps its points with both, whatever leads nearer there.
TEST(JoinedMinima, StayInCorners) {
  World world({.threads = 1, .outputs = {.points = true}});
  const Mesh floor = centered_box({2.0, 2.0, 0.5}), wall = translated(centered_box({0.5, 2.0, 2.0}), {-2.5, 0.0, 1.5}),
             cube = translated(centered_box({0.25, 0.25, 0.25}), {-1.75, 0.0, 0.75 + 0x1p-7});
  for (const Mesh* mesh : {&floor, &wall})
    world.add_body({.positions = mesh->positions, .facets = mesh->facets, .motion = Motion::fixed, .margin = 0.02});
  const BodyId body = world.add_body({.positions = cube.positions, .facets = cube.facets, .margin = 0.02});
  const Report& report = world.detect();
  const std::vector<std::uint8_t> minima = joined_minima(world, report);
  std::size_t at = 0;
  int on_floor = 0, on_wall = 0;
  for (const Contact& contact : report.contacts()) {
    for (const ContactPoint& point : contact.points()) {
      if (minima[at++] == 0 || contact.b != body) continue;
      on_floor += contact.a.index == 0 && point.normal.z() > 0.999 ? 1 : 0;
      on_wall += contact.a.index == 1 && point.normal.x() > 0.999 ? 1 : 0;
    }
  }
  EXPECT_GE(on_floor, 4);
  EXPECT_GE(on_wall, 4);
}

TEST(JoinedMinima, RefuseWhatIsNoLength) {
  World world;
  for (const double within : {-1.0, std::nan(""), HUGE_VAL}) {
    try {
      joined_minima(world, world.detect(), {.within = within});
      FAIL() << within;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace tact::tests
