// The points that span a patch stay while a body trembles, and follow it where it moves.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

// A prism around the z axis, from z = 0 on.
Mesh prism(int sides, double radius, double height) {
  MeshBuilder builder;
  for (const double z : {0.0, height}) {
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      builder.vertex({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  const int bottom = builder.vertex({0.0, 0.0, 0.0}), top = builder.vertex({0.0, 0.0, height});
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    builder.facet(bottom, next, i);
    builder.facet(top, sides + i, sides + next);
    builder.facet(i, next, sides + next);
    builder.facet(i, sides + next, sides + i);
  }
  return builder.mesh();
}

// A body on another one that does not move.
class Resting {
 public:
  Resting(const Mesh& below, Surface surface, const Mesh& above, double margin) {
    world_.add_body({.positions = below.positions,
                     .facets = below.facets,
                     .surface = surface,
                     .motion = Motion::fixed,
                     .margin = margin});
    body_ = world_.add_body({.positions = above.positions, .facets = above.facets, .margin = margin});
  }
  // The ids of the points that span the first patch, once it was there.
  std::set<std::uint64_t> spanning(const Mesh& at) {
    world_.set_positions(body_, at.positions);
    const Report& report = world_.detect();
    std::set<std::uint64_t> ids;
    if (report.contacts().empty() || report.contacts()[0].patches().empty()) return ids;
    const Contact& contact = report.contacts()[0];
    for (const int i : contact.patches()[0].spanning) {
      if (i >= 0) ids.insert(contact.points()[static_cast<std::size_t>(i)].id);
    }
    return ids;
  }
  World& world() { return world_; }

 private:
  World world_{{.threads = 1, .outputs = {.patches = true, .points = true}}};
  BodyId body_;
};

Mesh trembling(const Mesh& body, double amount, Random& random) {
  const auto small = [&] { return amount * (2.0 * random.uniform() - 1.0); };
  const Eigen::Vector3d turn(small(), small(), 0.1 * small()), by(small(), small(), small());
  Mesh at = body;
  for (int v = 0; v < body.vertex_count(); ++v) {
    const Eigen::Vector3d p = body.positions.col(v);
    at.positions.col(v) = p + turn.cross(p) / 0.02 + by;
  }
  return at;
}

int jumps(const Mesh& below, Surface surface, const Mesh& above, double amount, const std::string& what) {
  Random random(3245);
  Resting resting(below, surface, above, 5e-4);
  std::set<std::uint64_t> last = resting.spanning(trembling(above, amount, random));
  EXPECT_GE(last.size(), 3u) << what;
  int count = 0;
  for (int step = 0; step < 60; ++step) {
    const std::set<std::uint64_t> now = resting.spanning(trembling(above, amount, random));
    count += now == last ? 0 : 1;
    last = now;
  }
  return count;
}

TEST(Spanning, StaysWhileABodyTrembles) {
  const Mesh floor = translated(sheet(5, 5, 0.2, 0.2), {-0.0013, 0.0013, 0.0});
  for (const double gap : {5e-4, -1e-6}) {
    for (const double amount : {2e-10, 2e-7}) {
      for (const int sides : {3, 6, 12, 32}) {
        const Mesh standing = translated(prism(sides, 0.02, 0.03), {0.0, 0.0, gap});
        const std::string what = std::to_string(sides) + " sides, gap " + std::to_string(gap);
        EXPECT_LE(jumps(floor, Surface::sheet, standing, amount, what), 3) << what << ", trembles by " << amount;
      }
      const Mesh cube_below = translated(centered_box({0.02, 0.02, 0.02}), {0.001, 0.0, -0.02});
      const Mesh cube_above = translated(centered_box({0.015, 0.015, 0.015}), {0.0, 0.002, 0.015 + gap});
      EXPECT_LE(jumps(cube_below, Surface::closed, cube_above, amount, "cubes"), 3)
          << "gap " << gap << ", trembles by " << amount;
    }
  }
}

// A body that tilts is held by what is deep now.
TEST(Spanning, FollowsABodyThatMoves) {
  const Mesh floor = sheet(4, 4, 0.4, 0.4), block = translated(centered_box({0.05, 0.05, 0.02}), {0.01, 0.02, 0.0203});
  Resting resting(floor, Surface::sheet, block, 5e-4);
  const std::set<std::uint64_t> level = resting.spanning(block);
  EXPECT_EQ(level.size(), 4u);
  Mesh tilted = block;
  for (int v = 0; v < block.vertex_count(); ++v) tilted.positions(2, v) += 0.05 * (block.positions(0, v) + 0.04);
  const std::set<std::uint64_t> steep = resting.spanning(tilted);
  EXPECT_NE(steep, level);
  EXPECT_FALSE(steep.empty());
}

// What is kept is part of a saved world.
TEST(Spanning, IsSavedWithAWorld) {
  const Mesh floor = translated(sheet(5, 5, 0.2, 0.2), {-0.0013, 0.0013, 0.0});
  const Mesh standing = translated(prism(24, 0.02, 0.03), {0.0, 0.0, 5e-4});
  Random random(7);
  Resting resting(floor, Surface::sheet, standing, 5e-4);
  for (int step = 0; step < 5; ++step) resting.spanning(trembling(standing, 2e-7, random));
  World other;
  other.restore(resting.world().save());
  for (int step = 0; step < 5; ++step) {
    const Mesh at = trembling(standing, 2e-7, random);
    resting.world().set_positions(resting.world().bodies()[1], at.positions);
    other.set_positions(other.bodies()[1], at.positions);
    const Report &one = resting.world().detect(), &two = other.detect();
    ASSERT_EQ(one.contacts().size(), 1u);
    EXPECT_EQ(one.contacts()[0].hash(), two.contacts()[0].hash());
  }
}

// Vertices of a floor ahead of a box, which lean against it, hold nothing.
TEST(Spanning, LeavesOutPointsThatLean) {
  const Mesh floor = sheet(8, 8, 4.0, 4.0), cube = translated(centered_box({0.3, 0.3, 0.3}), {0.69, 0.1, 0.31});
  World world({.threads = 1, .outputs = {.patches = true, .points = true}});
  world.add_body({.positions = floor.positions, .facets = floor.facets, .surface = Surface::sheet, .margin = 0.05});
  world.add_body({.positions = cube.positions, .facets = cube.facets, .margin = 0.05});
  const Contact& contact = world.detect().contacts()[0];
  const auto leans = [](const ContactPoint& point) { return std::hypot(point.normal.x(), point.normal.y()) > 0.1; };
  EXPECT_TRUE(std::ranges::any_of(contact.points(), leans));
  for (const Patch& patch : contact.patches()) {
    for (const int i : patch.spanning) {
      if (i >= 0) {
        EXPECT_FALSE(leans(contact.points()[static_cast<std::size_t>(i)]));
      }
    }
  }
}

}  // namespace
}  // namespace tact::tests
