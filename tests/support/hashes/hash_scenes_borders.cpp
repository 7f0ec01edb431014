// What lies on a border: surfaces that touch and no more, that are apart by the sum of their margins to a rounding,
// places equally near, facets hit at one place; and so many bodies that they are packed and prefetched.
#include <array>
#include <cstddef>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/hashes/hash_scene_list.h"
#include "tests/support/hashes/scene_player.h"

namespace tact::tests {
namespace {

// Of two bodies with this margin: touching, apart or crossing by little, and about the sum of the margins.
constexpr double kBorderMargin = 0.0625;
constexpr std::array kBorderGaps{0.0, 0x1p-30, -0x1p-30, 0.125 - 0x1p-20, 0.125, 0.125 + 0x1p-20};

// Unit cubes before a face, an edge and a corner of another, on either side, and sheets over them.
void add_border_pairs(ScenePlayer& player, double margin) {
  const Mesh unit = cube(1.0, {});
  Vec3 at;
  const auto add_pair = [&](const Mesh& other, Surface surface) {
    player.add({.mesh = translated(unit, at), .margin = margin});
    player.add({.mesh = translated(other, at), .surface = surface, .margin = margin});
    at.x += 4.0;
  };
  for (const double gap : kBorderGaps) {
    for (const double side : {1.0, -1.0}) {
      const double away = side * (1.0 + gap);
      for (const Vec3 by : {Vec3{away, 0.25, 0.125}, Vec3{0.25, away, away}, Vec3{away, away, away}})
        add_pair(translated(unit, by), Surface::closed);
      const Mesh above = sheet(2, 3, 0.75, 1.5);
      add_pair(translated(above, {0.125, 0.25, side * (0.5 + gap)}), Surface::sheet);
    }
    at = {0.0, at.y + 4.0, 0.0};
  }
}

}  // namespace

SceneHashes play_touching(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.patches = true, .points = true}});
  add_border_pairs(player, kBorderMargin);
  const std::size_t pairs_end = player.size();
  for (const Mesh& brick : brick_wall(2, 3))
    player.add({.mesh = translated(brick, {0.0, -16.0, 0.0}), .margin = kBorderMargin});
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    for (const Mesh& body : kissing_bodies(seed)) player.add({.mesh = body, .margin = kBorderMargin});
  }
  player.step();
  for (const Vec3 by : {Vec3{0x1p-20, 0.0, 0x1p-20}, Vec3{-0x1p-19, 0x1p-20, 0.0}, Vec3{0x1p-20, -0x1p-20, -0x1p-20}}) {
    for (std::size_t i = 1; i < pairs_end; i += 2) player.shift(i, by);
    for (const Impacts wanted : {Impacts::all, Impacts::first_of_pair}) player.find_impacts(wanted);
    player.step();
  }
  return player.hashes();
}

// The same without margins.
SceneHashes play_touching_bare(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.zones = true, .patches = true, .points = true}});
  add_border_pairs(player, 0.0);
  const std::size_t pairs_end = player.size();
  for (const Mesh& brick : brick_wall(2, 3)) player.add({.mesh = translated(brick, {0.0, -16.0, 0.0})});
  player.step();
  for (const Vec3 by : {Vec3{0x1p-30, 0.0, 0x1p-30}, Vec3{-0x1p-29, 0x1p-30, 0.0}}) {
    for (std::size_t i = 1; i < pairs_end; i += 2) player.shift(i, by);
    player.find_impacts(Impacts::all);
    player.step();
  }
  return player.hashes();
}

// Two parts of one body at such distances.
SceneHashes play_self_touching(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.patches = true, .points = true}});
  const Mesh flat = sheet(5, 4, 1.0, 1.0), unit = gridded_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 2);
  double x = 0.0;
  for (const double gap : kBorderGaps) {
    for (const double margin : {kBorderMargin, 0.0}) {
      const std::array sheets{flat, translated(flat, {0.125, 0.0625, gap})};
      const std::array solids{unit, translated(unit, {0.25, 0.125, 1.0 + gap})};
      player.add({.mesh = translated(merged(sheets), {x, 0.0, 0.0}),
                  .surface = Surface::sheet,
                  .margin = margin,
                  .self_contact = true});
      player.add({.mesh = translated(merged(solids), {x, 4.0, 0.0}), .margin = margin, .self_contact = true});
      x += 4.0;
    }
  }
  player.step();
  for (const double rise : {0x1p-19, -0x1p-18, 0x1p-19}) {
    for (std::size_t i = 0; i < player.size(); ++i) {
      Mesh mesh = player.mesh(i);
      for (int v = mesh.vertex_count() / 2; v < mesh.vertex_count(); ++v)
        mesh.set_position(v, mesh.position(v) + Vec3{0.0, 0.0, rise});
      player.move(i, mesh);
    }
    player.find_impacts(Impacts::all);
    player.step();
  }
  return player.hashes();
}

// Bodies face to face and in one place, asked at their corners, edges and middles.
SceneHashes play_query_ties(int threads) {
  ScenePlayer player({.threads = threads});
  const std::vector<Mesh> bricks = brick_wall(3, 3);
  for (int copy = 0; copy < 2; ++copy) {
    for (const Mesh& brick : bricks) player.add({.mesh = brick});
    player.add({.mesh = translated(icosphere(3, 1.5), {4.0, 6.0, 1.0})});
    player.add({.mesh = translated(sheet(6, 6, 12.0, 6.0), {6.0, 1.0, 1.0}), .surface = Surface::sheet});
  }
  Random random(23);
  const auto place = [&] {
    const double x = random.below(29), y = random.below(9);
    return Eigen::Vector3d(0.5 * x, 0.25 * y, 0.25 * random.below(13));
  };
  const tact::World& world = player.world();
  std::vector<Ray> rays;
  std::vector<PointQuery> points;
  std::vector<BoxQuery> boxes;
  for (int i = 0; i < 200; ++i) {
    Ray& ray = rays.emplace_back();
    ray.from = place();
    ray.to = place();
    if (i % 2 == 0) ray.to[i % 3] = ray.from[i % 3];
    points.emplace_back().point = place();
    BoxQuery& box = boxes.emplace_back();
    box.lower = place();
    const double x = random.below(5), y = random.below(5);
    box.upper = box.lower + Eigen::Vector3d(0.5 * x, 0.25 * y, 0.25 * random.below(5));
  }
  std::vector<RayHit> hits(rays.size());
  world.cast_rays(rays, hits);
  player.hash().add(hits);
  std::vector<ClosestPoint> closest(points.size());
  world.closest_points(points, closest);
  player.hash().add(closest);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    player.hash().add(world.cast_ray(rays[i]));
    player.hash().add(world.cast_ray_all(rays[i]));
    player.hash().add(world.closest_point(points[i]));
    player.hash().add(world.overlap_box(boxes[i]));
    player.hash().add(world.bodies_containing(points[i]));
  }
  return player.hashes();
}

// Packed into one piece of memory, prefetched, shared by several at a time; half of them moved by poses.
SceneHashes play_many_bodies(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.patches = true, .points = true}});
  std::vector<std::size_t> which;
  std::vector<Vec3> turns, moves;
  Random random(19);
  for (const Mesh& blob : crowd_of_blobs(300, 31)) {
    const bool rigid = player.size() % 2 == 0;
    const Vec3 middle = centroid(blob);
    if (rigid) {
      which.push_back(player.size());
      turns.push_back({});
      moves.push_back(middle);
    }
    player.add({.mesh = scaled(rigid ? translated(blob, -middle) : blob, 0.7, rigid ? Vec3{} : middle),
                .margin = player.size() % 3 == 0 ? 0.0 : 0.05,
                .motion = rigid ? Motion::rigid : Motion::deformable});
  }
  for (int step = 0; step < 3; ++step) {
    player.pose(which, turns, moves);
    if (step > 0) player.find_impacts(step == 1 ? Impacts::all : Impacts::first_of_pair);
    player.step();
    player.drift(0.03, random);
    for (std::size_t i = 0; i < which.size(); ++i) {
      turns[i] = turns[i] + 0.02 * random.in_ball();
      moves[i] = moves[i] + 0.03 * random.in_ball();
    }
  }
  return player.hashes();
}

}  // namespace tact::tests
