// What meets on the way from step to step, and bodies that are moved by poses.
#include <cstddef>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/hashes/hash_scene_list.h"
#include "tests/support/hashes/scene_player.h"

namespace tact::tests {
namespace {

void find_all_impacts(ScenePlayer& player) {
  for (const Impacts wanted : {Impacts::all, Impacts::first_of_pair, Impacts::first}) player.find_impacts(wanted);
}

}  // namespace

// Small bodies that leap, with and without margins, some standing still.
SceneHashes play_impacts(int threads) {
  ScenePlayer player({.threads = threads});
  int i = 0;
  for (const Mesh& blob : crowd_of_blobs(30, 9)) {
    player.add({.mesh = scaled(blob, 0.6, centroid(blob)), .margin = ++i % 2 == 0 ? 0.0 : 0.05});
  }
  player.add({.mesh = translated(sheet(6, 6, 6.0, 6.0), {0.0, 0.0, -1.0}),
              .surface = Surface::sheet,
              .motion = Motion::fixed});
  player.add({.mesh = lattice_soup(24, 3, 2), .surface = Surface::sheet, .self_contact = true});
  player.add({.mesh = brick_wall(1, 1)[0]});
  player.add({.mesh = brick_wall(1, 2)[1]});
  Random random(5);
  for (int step = 0; step < 4; ++step) {
    player.step();
    player.drift(step == 0 ? 0.01 : 0.3, random);
    find_all_impacts(player);
  }
  return player.hashes();
}

// Sheets that fly at a ball and at each other, and fold into themselves.
SceneHashes play_impacts_of_cloth(int threads) {
  ScenePlayer player({.threads = threads});
  const Mesh flat = sheet(40, 20, 1.0, 0.5);
  player.add({.mesh = flat, .surface = Surface::sheet, .margin = 0.002, .self_contact = true});
  player.add({.mesh = translated(flat, {0.0, 0.0, 0.3}), .surface = Surface::sheet, .self_contact = true});
  player.add({.mesh = translated(icosphere(3, 0.2), {0.0, 0.0, -0.45}), .margin = 0.001});
  Random random(7);
  int step = 0;
  for (const double overhang : {0.05, 0.1, 0.14, 0.02}) {
    player.step();
    player.move(0, jittered(pleated(flat, 2, 0.2, overhang), 0.002, random.bits()));
    player.move(1, jittered(translated(flat, {0.0, 0.01, 0.25 - 0.08 * step}), 0.002, random.bits()));
    player.shift(2, {0.01, 0.0, 0.08});
    find_all_impacts(player);
    ++step;
  }
  return player.hashes();
}

// A solver that goes as far as nothing meets, again and again.
SceneHashes play_first_impacts(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.points = true}});
  const std::vector<Mesh> bricks = brick_wall(3, 3);
  for (const Mesh& brick : bricks) player.add({.mesh = scaled(brick, 0.9, centroid(brick)), .margin = 0.01});
  player.add({.mesh = translated(icosphere(2, 1.0), {5.0, 4.0, 1.5}), .margin = 0.02});
  for (int step = 0; step < 10; ++step) {
    player.step();
    std::vector<Mesh> begin;
    for (std::size_t i = 0; i < player.size(); ++i) begin.push_back(player.mesh(i));
    const auto way_of = [&](std::size_t i) {
      return i + 1 == player.size() ? Vec3{0.02, -0.4, 0.01} : Vec3{0.0, 0.0, -0.03 * static_cast<double>(i % 3)};
    };
    for (std::size_t i = 0; i < player.size(); ++i) player.shift(i, way_of(i));
    const double time = player.world().detect_motion(Impacts::first).first_time();
    player.find_impacts(Impacts::first);
    const double free = time < 1.0 ? 0.999 * time : 1.0;
    for (std::size_t i = 0; i < player.size(); ++i) player.move(i, translated(begin[i], free * way_of(i)));
  }
  return player.hashes();
}

// Sheets of so many clusters that trees find the pairs on the way.
SceneHashes play_impacts_large(int threads) {
  ScenePlayer player({.threads = threads});
  player.add({.mesh = wrinkled_sheet(190, 4.0, 0.05, 3), .surface = Surface::sheet});
  player.add({.mesh = translated(wrinkled_sheet(192, 4.0, 0.05, 3), {0.0, 0.0, 0.002}), .surface = Surface::sheet});
  player.step();
  // Its border comes down farthest, and meets the other alone.
  player.move(1, mapped(player.mesh(1), [](Vec3 p) { return p - Vec3{0.0, 0.0, 0.00051 * (p.x + 2.0)}; }));
  player.find_impacts(Impacts::all);
  player.find_impacts(Impacts::first);
  return player.hashes();
}

// Rigid bodies that turn and fall onto a fixed one and a sheet.
SceneHashes play_poses(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.zones = true, .patches = true, .points = true}});
  player.add({.mesh = box({-4.0, -4.0, -1.0}, {4.0, 4.0, 0.0}), .margin = 0.02, .motion = Motion::fixed});
  player.add({.mesh = translated(wrinkled_sheet(12, 3.0, 0.2, 1), {0.0, 0.0, 0.3}),
              .surface = Surface::sheet,
              .margin = 0.02});
  Random random(11);
  std::vector<std::size_t> which;
  std::vector<Vec3> turns, moves, turn_rates;
  for (int i = 0; i < 24; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const Mesh mesh = i % 4 == 0   ? centered_box({0.3, 0.4, 0.5})
                      : i % 4 == 1 ? blob(i < 12 ? 1 : 3, 0.5, 0.3, seed)
                      : i % 4 == 2 ? torus(16, 8, 0.4, 0.15)
                                   : random_hull(16, seed);
    which.push_back(player.size());
    player.add({.mesh = mesh, .margin = i % 3 == 0 ? 0.0 : 0.02, .motion = Motion::rigid});
    turns.push_back(random.in_ball());
    turn_rates.push_back(0.1 * random.in_ball());
    moves.push_back(random.in_cube(1.5) + Vec3{0.0, 0.0, 1.8});
  }
  for (int step = 0; step < 6; ++step) {
    player.pose(which, turns, moves);
    if (step > 0) find_all_impacts(player);
    player.step();
    for (std::size_t i = 0; i < which.size(); ++i) {
      turns[i] = turns[i] + turn_rates[i];
      moves[i] = moves[i] - Vec3{0.0, 0.0, i % 5 == 0 ? 0.0 : 0.1};
    }
    if (step == 3) {
      player.world().set_motion(player.id(which.back()), Motion::fixed);
      which.pop_back();
    }
  }
  for (std::size_t i = 0; i < player.size(); ++i) {
    std::vector<double> coordinates(3 * player.world().vertex_count(player.id(i)));
    player.world().copy_positions(player.id(i), coordinates);
    player.hash().add(coordinates);
    const Bounds bounds = player.world().bounds(player.id(i));
    player.hash().add(bounds.lower);
    player.hash().add(bounds.upper);
  }
  return player.hashes();
}

}  // namespace tact::tests
