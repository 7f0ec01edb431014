// Points of what touches without a gap: no rounding has a part in their normals.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/mesh.h"

namespace tact::tests {
namespace {

struct Bricks {
  Mesh a, b;
  int axis = 0;  // b begins where a ends
};

// Boxes with whole coordinates that have a part of a face in common.
Bricks random_bricks(Random& random) {
  const auto whole = [&](int below) { return random.below(below); };
  Vec3 lower_a, upper_a, lower_b, upper_b;
  const int axis = whole(3);
  for (int k = 0; k < 3; ++k) {
    lower_a[k] = whole(6);
    upper_a[k] = lower_a[k] + 1 + whole(5);
    lower_b[k] = k == axis ? upper_a[k] : lower_a[k] - 1 + whole(static_cast<int>(upper_a[k] - lower_a[k]) + 1);
    upper_b[k] = std::max(lower_b[k], k == axis ? lower_b[k] : lower_a[k]) + 1 + whole(4);
  }
  return {box(lower_a, upper_a), box(lower_b, upper_b), axis};
}

TEST(TouchingPoints, OfBricksLeadFromOneToTheOther) {
  Random random(7);
  for (int i = 0; i < 400; ++i) {
    const Bricks bricks = random_bricks(random);
    for (const double margin : {0.0, 0.01}) {
      World world({.threads = 1, .outputs = {.patches = true, .points = true}});
      for (const Mesh* mesh : {&bricks.a, &bricks.b})
        world.add_body({.positions = mesh->positions, .facets = mesh->facets, .margin = margin});
      const Report& report = world.detect();
      ASSERT_EQ(report.contacts().size(), 1u);
      const Contact& contact = report.contacts()[0];
      ASSERT_EQ(contact.depth, 0.0) << i;
      int minima = 0;
      for (const ContactPoint& point : contact.points()) {
        ASSERT_GE(point.gap, 0.0) << i;
        if (point.gap > 0.0 || !point.minimum) continue;
        ++minima;
        ASSERT_EQ(point.normal[bricks.axis], 1.0) << i << ": " << point.normal.transpose();
      }
      EXPECT_GT(minima, 1) << i;
      for (const Patch& patch : contact.patches()) EXPECT_GT(patch.direction[bricks.axis], 0.9) << i;
    }
  }
}

// The part of the way along a segment at which a grain lies on it is no double: a third, say.
TEST(TouchingPoints, OfAGrainOnARopeLeadAcrossIt) {
  for (int length = 2; length < 12; ++length) {
    for (int place = 1; place < length; ++place) {
      Eigen::Matrix3Xd rope(3, 2), grain(3, 1);
      rope << 0, length, 3, 3, 4, 4;
      grain << place, 3, 4;
      const Eigen::Matrix2Xi segment = Eigen::Vector2i(0, 1);
      const std::vector<int> point{0};
      World world({.threads = 1, .outputs = {.points = true}});
      world.add_body({.positions = rope, .edges = segment, .margin = 0.01});
      world.add_body({.positions = grain, .points = point, .margin = 0.01});
      const Report& report = world.detect();
      ASSERT_EQ(report.contacts().size(), 1u);
      const auto points = report.contacts()[0].points();
      ASSERT_EQ(points.size(), 1u);
      EXPECT_EQ(points[0].gap, 0.0);
      EXPECT_EQ(points[0].normal.x(), 0.0) << place << " of " << length;
    }
  }
}

// A ridge and one across it that touch in a point of both, or cross by a rounding more or less.
TEST(TouchingPoints, OfEdgesHaveTheSideThatIsFree) {
  for (int i = 1; i < 40; ++i) {
    const Vec3 place{i / 41.0, (41.0 - i) / 43.0, 1.0 / i};
    const auto ridge = [&](Vec3 along, double below) {
      MeshBuilder builder;
      const Vec3 p = place - (1.0 / 3.0) * along, q = place + (2.0 / 3.0) * along;
      const Vec3 side = 0.5 * Vec3{along.y, -along.x, 0.0} + Vec3{0.0, 0.0, below};
      const Vec3 other = Vec3{0.0, 0.0, below} - 0.5 * Vec3{along.y, -along.x, 0.0};
      builder.triangle(p, q, p + side);
      builder.triangle(q, p, p + other);
      return builder.mesh();
    };
    const Mesh below = ridge({1.0, 0.0, 0.0}, -1.0), above = ridge({0.3, 1.0, 0.0}, 1.0);
    World world({.threads = 1, .outputs = {.points = true}});
    for (const Mesh* mesh : {&below, &above})
      world.add_body({.positions = mesh->positions, .facets = mesh->facets, .surface = Surface::sheet, .margin = 0.01});
    const Report& report = world.detect();
    ASSERT_EQ(report.contacts().size(), 1u);
    int up = 0;
    for (const ContactPoint& point : report.contacts()[0].points()) {
      if (point.kind == FeaturePair::edge_edge && std::abs(point.gap) < 1e-12) up += point.normal.z() > 0.99 ? 1 : -100;
    }
    EXPECT_GT(up, 0) << i;
  }
}

}  // namespace
}  // namespace tact::tests
