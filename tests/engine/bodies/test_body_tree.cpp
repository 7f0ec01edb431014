// Queries of a world of many bodies, which look for them in a tree, have the answers of one that scans all boxes:
// whatever was moved, added or removed, and whether or not a step has seen it.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <cstdint>
#include <tuple>
#include <vector>

#include "engine/bodies/body_tree.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

// What stands in a slot: bodies of two worlds have different ids.
struct Standing {
  Mesh mesh;
  bool there = true;
};

Eigen::Vector3d vector_in(double size, Random& random) {
  const Vec3 p = random.in_cube(size);
  return {p.x, p.y, p.z};
}

// Few enough queries that a world that was just made scans.
struct FewQueries {
  explicit FewQueries(Random& random) {
    for (int i = 0; i < 2; ++i) {
      rays.push_back({vector_in(6.0, random), vector_in(6.0, random)});
      points.push_back({.point = vector_in(6.0, random)});
    }
    points[1].within = 0.5;
    points[1].filter = {.layer = 1, .mask = 2};
    const Eigen::Vector3d lower = vector_in(4.0, random);
    box = {.lower = lower, .upper = lower + Eigen::Vector3d(1.5, 1.0, 2.0)};
  }

  // In slots instead of ids.
  std::vector<std::tuple<std::uint32_t, int, double>> answers(const World& world) const {
    std::vector<std::tuple<std::uint32_t, int, double>> all;
    for (const Ray& ray : rays) {
      const RayHit hit = world.cast_ray(ray), any = world.cast_ray(ray, RayHits::any);
      all.emplace_back(hit.body.index, hit.facet, hit.fraction);
      all.emplace_back(any.body.index, any.facet, any.fraction);
    }
    for (const PointQuery& point : points) {
      const ClosestPoint closest = world.closest_point(point);
      all.emplace_back(closest.body.index, closest.facet, closest.distance);
    }
    for (const FacetOfBody& facet : world.overlap_box(box)) all.emplace_back(facet.body.index, facet.facet, 0.0);
    return all;
  }

  std::vector<Ray> rays;
  std::vector<PointQuery> points;
  BoxQuery box;
};

std::uint32_t layer_of_slot(std::size_t slot) { return slot % 4 == 0 ? 2 : 1; }

// A world with the same bodies in the same slots, of which nothing was asked yet.
World copy_of(const std::vector<Standing>& bodies) {
  World world;
  std::vector<BodyId> gone;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Mesh& mesh = bodies[i].mesh;
    const BodyId id = world.add_body({.positions = mesh.positions, .facets = mesh.facets, .layer = layer_of_slot(i)});
    if (!bodies[i].there) gone.push_back(id);
  }
  for (const BodyId id : gone) world.remove_body(id);
  return world;
}

TEST(BodyTree, AnswersAreThoseOfAScan) {
  constexpr std::size_t kBodies = 300;
  Random random(3);
  std::vector<Standing> bodies;
  World world;
  std::vector<BodyId> ids;
  for (const Mesh& mesh : crowd_of_blobs(kBodies, 5)) {
    ids.push_back(
        world.add_body({.positions = mesh.positions, .facets = mesh.facets, .layer = layer_of_slot(bodies.size())}));
    bodies.push_back({mesh});
  }
  std::size_t found = 0;
  for (int round = 0; round < 40; ++round) {
    if (round % 8 == 7) world.detect();
    // Few bodies move, which stay beside the tree, or all.
    const std::size_t step = round % 5 == 4 ? 1 : 60;
    for (std::size_t i = static_cast<std::size_t>(round); i < kBodies; i += step) {
      if (!bodies[i].there) continue;
      bodies[i].mesh = translated(bodies[i].mesh, random.in_cube(round % 3 == 0 ? 3.0 : 0.1));
      world.set_positions(ids[i], bodies[i].mesh.positions);
    }
    const std::size_t other = static_cast<std::size_t>(round) * 7 % kBodies;
    if (bodies[other].there) {
      world.remove_body(ids[other]);
      bodies[other].there = false;
    }
    for (int k = 0; k < 4; ++k) {
      const FewQueries queries(random);
      const auto answers = queries.answers(world);
      ASSERT_EQ(answers, queries.answers(copy_of(bodies))) << "round " << round;
      found += answers.size();
    }
  }
  EXPECT_GT(found, 160U * 6);
}

// Small motion leaves the tree current; it is updated only after so many queries that it pays.
TEST(BodyTree, IsUpdatedWhenScansHaveCostAsMuch) {
  std::vector<base::Box> boxes(1000);
  BodyTree tree;
  tree.make_room(boxes.size());
  tree.resize(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const double x = i;
    boxes[i] = {{x, 0.0, 0.0}, {x + 0.5, 1.0, 1.0}};
    tree.note_change(i);
  }
  tree.expect(1, boxes);
  EXPECT_FALSE(tree.is_current());
  tree.expect(100, boxes);
  ASSERT_TRUE(tree.is_current());
  EXPECT_TRUE(tree.loose().empty());
  EXPECT_TRUE(tree.blocks().validate(boxes));
  tree.note_change(7);
  EXPECT_TRUE(tree.is_current());
  EXPECT_TRUE(tree.is_loose(7));
  for (std::uint32_t i = 0; i < boxes.size(); ++i) tree.note_change(i);
  EXPECT_FALSE(tree.is_current());
  tree.expect(100, boxes);
  EXPECT_TRUE(tree.is_current());
}

}  // namespace
}  // namespace tact::tests
