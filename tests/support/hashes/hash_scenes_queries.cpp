// Rays, nearest points, boxes and points inside, of many bodies that move between them.
#include <cstddef>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/hashes/hash_scene_list.h"
#include "tests/support/hashes/scene_player.h"

namespace tact::tests {
namespace {

Eigen::Vector3d eigen_of(Vec3 p) { return {p.x, p.y, p.z}; }

// Crowds, a body of many clusters, sheets, soups, nested and rigid ones; some in a layer of their own.
void add_asked_bodies(ScenePlayer& player) {
  int i = 0;
  for (const Mesh& blob : crowd_of_blobs(120, 12)) player.add({.mesh = blob, .layer = ++i % 4 == 0 ? 2u : 1u});
  player.add({.mesh = translated(blob(4, 2.0, 0.3, 1), {6.0, 0.0, 0.0})});
  player.add({.mesh = translated(cube(1.0, {0.0, 0.0, 0.0}), {6.0, 0.0, 0.0})});
  player.add({.mesh = translated(wrinkled_sheet(40, 8.0, 0.5, 2), {0.0, 0.0, -3.0}), .surface = Surface::sheet});
  player.add({.mesh = translated(soup(200, 2.0, 3), {0.0, 6.0, 0.0}), .surface = Surface::sheet});
  player.add({.mesh = translated(lattice_soup(60, 4, 4), {-6.0, 0.0, 0.0})});
  player.add({.mesh = translated(torus(32, 16, 1.5, 0.4), {0.0, -6.0, 0.0})});
  player.add({.mesh = organ(2), .motion = Motion::rigid});
  player.add({.mesh = random_hull(20, 3), .motion = Motion::rigid});
}

// A place: anywhere, on a grid that lattices share, a vertex of a body, the middle of an edge or of a facet.
Vec3 any_place(const ScenePlayer& player, Random& random) {
  const int kind = random.below(5);
  if (kind == 0) return random.in_cube(8.0);
  if (kind == 1) {
    const double x = random.below(17) - 8, y = random.below(17) - 8;
    return {x, y, static_cast<double>(random.below(17) - 8)};
  }
  const Mesh& mesh = player.mesh(static_cast<std::size_t>(random.below(static_cast<int>(player.size()) - 2)));
  const int f = random.below(mesh.facet_count());
  const Vec3 p = mesh.position(mesh.facets(0, f)), q = mesh.position(mesh.facets(1, f));
  if (kind == 2) return p;
  if (kind == 3) return 0.5 * p + 0.5 * q;
  return 0.25 * p + 0.25 * q + 0.5 * mesh.position(mesh.facets(2, f));
}

// Plays three rounds: `ask` before the first step, between steps, and after bodies moved that no step has seen.
template <class Ask>
SceneHashes ask_while_moving(int threads, const Ask& ask) {
  ScenePlayer player({.threads = threads});
  add_asked_bodies(player);
  const std::vector<std::size_t> rigid{player.size() - 2, player.size() - 1};
  Random random(17);
  for (int round = 0; round < 3; ++round) {
    ask(player, random);
    if (round == 1) player.step();
    player.drift(0.2, random);
    const double turn = 0.3 * (round + 1);
    player.pose(rigid, std::vector<Vec3>{{turn, 0.1, 0.0}, {0.0, turn, 0.2}},
                std::vector<Vec3>{{3.0, 3.0, turn}, {-3.0, turn, 3.0}});
    if (round == 1) player.remove(7);
  }
  return player.hashes();
}

}  // namespace

SceneHashes play_rays(int threads) {
  return ask_while_moving(threads, [](ScenePlayer& player, Random& random) {
    const tact::World& world = player.world();
    std::vector<Ray> rays;
    for (int i = 0; i < 400; ++i) {
      Ray& ray = rays.emplace_back();
      ray.from = eigen_of(any_place(player, random));
      ray.to = eigen_of(any_place(player, random));
      if (i % 10 == 0) ray.filter = {.layer = 1, .mask = 2};
      if (i % 20 == 5) ray.to = ray.from + eigen_of({0.0, 0.0, random.uniform(-9.0, 9.0)});
      if (i % 50 == 7) ray.to = ray.from;
    }
    for (int i = 0; i < 40; ++i) player.hash().add(world.cast_ray(rays[static_cast<std::size_t>(i)]));
    std::vector<RayHit> hits(rays.size());
    world.cast_rays(rays, hits);
    player.hash().add(hits);
    // Of RayHits::any, which facet it is may change.
    world.cast_rays(rays, hits, RayHits::any);
    for (const RayHit& hit : hits) player.hash().add_feature(hit.facet >= 0 ? 1 : 0);
    for (std::size_t i = 0; i < rays.size(); i += 4) player.hash().add(world.cast_ray_all(rays[i]));
  });
}

SceneHashes play_closest_points(int threads) {
  return ask_while_moving(threads, [](ScenePlayer& player, Random& random) {
    const tact::World& world = player.world();
    std::vector<PointQuery> points;
    for (int i = 0; i < 300; ++i) {
      PointQuery& point = points.emplace_back();
      point.point = eigen_of(any_place(player, random));
      if (i % 3 == 0) point.point += eigen_of(random.in_cube(1e-3));
      if (i % 4 == 0) point.within = random.uniform(0.0, 1.0);
      if (i % 10 == 0) point.filter = {.layer = 1, .mask = 2};
      if (i % 50 == 9) point.point *= 1000.0;
    }
    for (std::size_t i = 0; i < 40; ++i) player.hash().add(world.closest_point(points[i]));
    std::vector<ClosestPoint> answers(points.size());
    world.closest_points(points, answers);
    player.hash().add(answers);
  });
}

SceneHashes play_boxes(int threads) {
  return ask_while_moving(threads, [](ScenePlayer& player, Random& random) {
    const tact::World& world = player.world();
    std::vector<BoxQuery> boxes;
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = any_place(player, random);
      Vec3 size = random.in_ball();
      for (int axis = 0; axis < 3; ++axis) size[axis] = i % 7 == axis ? 0.0 : size[axis] * size[axis];
      if (i % 20 == 3) size = {};
      boxes.push_back({.lower = eigen_of(p), .upper = eigen_of(p + size), .filter = {}});
      if (i % 10 == 0) boxes.back().filter = {.layer = 1, .mask = 2};
    }
    boxes.push_back({.lower = {-9.0, -9.0, -9.0}, .upper = {9.0, 9.0, 9.0}, .filter = {}});
    for (std::size_t i = 0; i < 40; ++i) player.hash().add(world.overlap_box(boxes[i]));
    std::vector<std::vector<FacetOfBody>> answers(boxes.size());
    world.overlap_boxes(boxes, answers);
    for (const std::vector<FacetOfBody>& answer : answers) player.hash().add(answer);
  });
}

SceneHashes play_inside(int threads) {
  return ask_while_moving(threads, [](ScenePlayer& player, Random& random) {
    const tact::World& world = player.world();
    std::vector<PointQuery> points;
    for (int i = 0; i < 400; ++i) {
      PointQuery& point = points.emplace_back();
      point.point = eigen_of(any_place(player, random));
      if (i % 10 == 0) point.filter = {.layer = 1, .mask = 2};
    }
    for (std::size_t i = 0; i < 40; ++i) player.hash().add(world.bodies_containing(points[i]));
    std::vector<std::vector<BodyId>> answers(points.size());
    world.bodies_containing_each(points, answers);
    for (const std::vector<BodyId>& answer : answers) player.hash().add(answer);
  });
}

}  // namespace tact::tests
